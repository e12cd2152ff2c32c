#include "findings/findings.h"

#include <algorithm>

#include "base/diagnostics/further_findings.h"

namespace popup {
namespace {

bool is_finding(const Diagnostic& one) { return told_severity(one) != Severity::remark; }

}  // namespace

std::size_t Findings::designs() const {
    return static_cast<std::size_t>(
        std::count_if(files.begin(), files.end(), [](const ToldFile& file) { return file.design; }));
}

bool Findings::fail() const {
    return std::any_of(run.begin(), run.end(), is_finding) ||
           std::any_of(files.begin(), files.end(), [](const ToldFile& file) {
               return std::any_of(file.told.begin(), file.told.end(), is_finding);
           });
}

std::size_t Findings::accepted() const {
    std::size_t count = run_accepted.size();
    for (const ToldFile& file : files) count += file.accepted.size();
    return count;
}

Findings collect(const std::vector<FileFindings>& files, const Diagnostics& run) {
    Findings findings;
    findings.files.reserve(files.size());
    for (const FileFindings& file : files) {
        findings.files.push_back(
            {file.diagnostics->file(), file.text, file.design, file.diagnostics->sorted(), {}, file.whole});
    }
    findings.run = run.sorted();
    return findings;
}

Findings without_remarks(Findings findings) {
    const auto clean = [](std::vector<Diagnostic>& list) {
        list.erase(
            std::remove_if(list.begin(), list.end(), [](const Diagnostic& one) { return !is_finding(one); }),
            list.end());
    };
    clean(findings.run);
    for (ToldFile& file : findings.files) clean(file.told);
    return findings;
}

}  // namespace popup
