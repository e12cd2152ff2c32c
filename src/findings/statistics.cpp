#include "findings/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "base/diagnostics/further_findings.h"

namespace popup {
namespace {

constexpr std::size_t kCodesInSummary = 8;

std::string counted(std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string_view summary_of(const CodeCount& row) {
    const CodeInfo* info = find_code(row.code);
    return info == nullptr ? std::string_view() : info->summary;
}

}  // namespace

std::vector<CodeCount> count_findings(const Findings& findings) {
    struct Tally {
        std::size_t count = 0;
        std::set<std::string_view> designs;
    };
    std::map<std::pair<Severity, std::string_view>, Tally> tallies;
    std::set<std::string_view> designs;
    for (const ToldFile& file : findings.files) {
        if (file.design) designs.insert(file.name);
    }
    const auto add = [&](const std::vector<Diagnostic>& list) {
        for (const Diagnostic& one : list) {
            const FurtherFindings some = further_of(one).value_or(FurtherFindings{1, one.severity});
            Tally& tally = tallies[{some.severity, one.code}];
            tally.count += some.count;
            if (designs.contains(one.file)) tally.designs.insert(one.file);
        }
    };
    for (const ToldFile& file : findings.files) add(file.told);
    add(findings.run);
    std::vector<CodeCount> rows;
    rows.reserve(tallies.size());
    for (const auto& [kind, tally] : tallies) {
        rows.push_back({kind.first, std::string(kind.second), tally.count, tally.designs.size()});
    }
    // By code they are in order already.
    std::stable_sort(rows.begin(), rows.end(), [](const CodeCount& a, const CodeCount& b) {
        return std::tuple(b.severity, b.count) < std::tuple(a.severity, a.count);
    });
    return rows;
}

std::string summary_line(const Findings& findings, std::optional<double> seconds) {
    std::size_t errors = 0;
    std::size_t warnings = 0;
    std::vector<std::pair<std::string, std::size_t>> codes;
    for (const CodeCount& row : count_findings(findings)) {
        if (row.severity == Severity::remark) continue;
        (row.severity == Severity::error ? errors : warnings) += row.count;
        // A code that is an error here and a warning there counts once.
        const auto same = std::find_if(codes.begin(), codes.end(),
                                       [&row](const auto& one) { return one.first == row.code; });
        if (same == codes.end()) {
            codes.emplace_back(row.code, row.count);
        } else {
            same->second += row.count;
        }
    }
    std::string text = "popupc: " + counted(findings.designs(), "design");
    if (seconds) text += fmt::format(" in {:.1f} s", *seconds);
    if (codes.empty()) {
        return fmt::format("{}: nothing {}to report\n", text, findings.accepted() > 0 ? "new " : "");
    }
    std::vector<std::string> counts;
    if (errors > 0) counts.push_back(counted(errors, "error"));
    if (warnings > 0) counts.push_back(counted(warnings, "warning"));
    std::vector<std::string> kinds;
    for (const auto& [code, count] : codes) {
        if (kinds.size() == kCodesInSummary) {
            kinds.emplace_back("\u2026");
            break;
        }
        kinds.push_back(fmt::format("{} {}", count, code));
    }
    return fmt::format("{}: {} ({})\n", text, fmt::join(counts, ", "), fmt::join(kinds, ", "));
}

std::string statistics_text(const std::vector<CodeCount>& rows) {
    std::size_t count_width = 0;
    std::size_t designs_width = 0;
    std::size_t code_width = 0;
    for (const CodeCount& row : rows) {
        count_width = std::max(count_width, std::to_string(row.count).size());
        designs_width = std::max(designs_width, counted(row.designs, "design").size());
        code_width = std::max(code_width, row.code.size());
    }
    std::string text;
    for (const CodeCount& row : rows) {
        text += fmt::format("{:>{}}  {:<7}  {:<{}}  in {:<{}}  {}\n", row.count, count_width,
                            to_string(row.severity), row.code, code_width, counted(row.designs, "design"),
                            designs_width, summary_of(row));
    }
    return text;
}

std::string statistics_json(const std::vector<CodeCount>& rows) {
    std::string text;
    for (const CodeCount& row : rows) {
        nlohmann::ordered_json json;
        json["severity"] = to_string(row.severity);
        json["code"] = row.code;
        json["count"] = row.count;
        json["designs"] = row.designs;
        json["summary"] = summary_of(row);
        text += json.dump() + "\n";
    }
    return text;
}

}  // namespace popup
