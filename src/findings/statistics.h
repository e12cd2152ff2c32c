// How many findings there are of each kind.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "findings/findings.h"

namespace popup {

struct CodeCount {
    Severity severity = Severity::error;
    std::string code;
    std::size_t count = 0;    // those that were only counted included
    std::size_t designs = 0;  // that have one at least
};

// One row a severity and code of what is told: the worst first, of these the most frequent, then by name.
std::vector<CodeCount> count_findings(const Findings& findings);

// "popupc: 312 designs in 4.2 s: 3 errors, 17 warnings (12 tent-too-narrow, 5 collision)" and a line break;
// without `seconds` no time is named. Codes stand as in count_findings(), eight at most; remarks do not
// count.
std::string summary_line(const Findings& findings, std::optional<double> seconds);

// A row a line for people: count, severity, code, designs, and what the code stands for. Empty when there is
// nothing to count.
std::string statistics_text(const std::vector<CodeCount>& rows);

// The same as objects, one a line: severity, code, count, designs, summary.
std::string statistics_json(const std::vector<CodeCount>& rows);

}  // namespace popup
