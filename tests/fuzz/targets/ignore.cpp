// Patterns of .popupcignore: the first line is a path, the others are the file.
#include <algorithm>

#include "cli/files/path_patterns.h"
#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_ignore(std::string_view bytes) {
    const std::size_t line = std::min(bytes.find('\n'), bytes.size());
    const std::string_view path = bytes.substr(0, line);
    const std::string rest(bytes.substr(std::min(line + 1, bytes.size())));
    const PathPatterns patterns(rest);
    for (const bool directory : {false, true}) {
        const auto says = patterns.says(path, directory);
        expect(!says || !patterns.empty(), "no pattern matches nothing");
        // One more line that matches everything decides.
        PathPatterns more(rest + "\n*\n!*");
        expect(
            path.empty() || path.find('/') != std::string_view::npos || more.says(path, directory) == false,
            "the last that matches decides");
    }
}

}  // namespace popup::fuzz
