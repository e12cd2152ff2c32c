// Response files: words, or a refusal that says why.
#include "base/text/quoted_words.h"
#include "cli/options/response_files.h"
#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_response(std::string_view bytes) {
    Diagnostics told("words");
    for (const QuotedWord& word : quoted_words(bytes, "bad-response-file", told))
        expect(word.place.line >= 1, "a word has its place");
    expect_told(told, bytes);
    // Names of other files would be looked for on the disk.
    if (bytes.find('@') != std::string_view::npos) return;
    const NamedBytes file(bytes);
    std::vector<std::string> files;
    try {
        cli::expand_response_files({"@" + file.name()}, files);
        expect(!told.has_errors(), "words that cannot be read are refused");
    } catch (const cli::UsageError& refused) {
        expect(std::string_view(refused.what()).size() > 1, "a refusal says why");
    }
}

}  // namespace popup::fuzz
