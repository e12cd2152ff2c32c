// Results of batches: a line that is a result is written the same, and every line of a file is found again.
#include "batch/results.h"

#include <algorithm>

#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_results(std::string_view bytes) {
    const NamedBytes file(bytes);
    ResultIndex index;
    Diagnostics told("results");
    expect(index.add(file.name(), told) || told.has_errors(), "a file is read, or an error");
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
        const auto result = result_of(bytes.substr(at, end - at));
        at = end + 1;
        if (!result) continue;
        const std::string line = to_line(*result);
        const auto again = result_of(std::string_view(line).substr(0, line.size() - 1));
        expect(again && to_line(*again) == line, "a result is read as it is written");
        for (const JobResult& one : index.of(result->key))
            expect(one.key == result->key, "a result is of its job");
    }
}

}  // namespace popup::fuzz
