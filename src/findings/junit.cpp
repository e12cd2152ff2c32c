// A JUnit report: a test suite with a case a file. There is no standard; this is what the readers of Jenkins,
// GitLab and junitparser have in common. They take one failure a case, so all findings stand in its text.
#include <fmt/format.h>
#include <tinyxml2.h>

#include <map>
#include <string>
#include <vector>

#include "base/diagnostics/further_findings.h"
#include "base/diagnostics/render_diagnostics.h"
#include "findings/message_formats.h"

namespace popup {
namespace {

struct Case {
    std::string group, name;
    std::string_view text;  // of the file
    std::vector<const Diagnostic*> findings;
    std::vector<const Diagnostic*> remarks;

    [[nodiscard]] bool unreadable() const {
        return !findings.empty() && findings.front()->code == "unreadable-input";
    }
};

Case case_of(const ToldFile& file) {
    const std::string name = file.name == "-" ? "<stdin>" : visible(file.name);
    const std::size_t slash = name.find_last_of('/');
    if (slash == std::string::npos) return {"popupc", name, file.text, {}, {}};
    return {name.substr(0, slash == 0 ? 1 : slash), name.substr(slash + 1), file.text, {}, {}};
}

void add(Case& one, const std::vector<Diagnostic>& told) {
    for (const Diagnostic& diagnostic : told) {
        (told_severity(diagnostic) == Severity::remark ? one.remarks : one.findings).push_back(&diagnostic);
    }
}

// A case a file, in their order; findings of the run are with the file they name, else in a case at the end.
std::vector<Case> cases_of(const Findings& findings) {
    std::vector<Case> cases;
    std::map<std::string_view, std::size_t> index;
    for (const ToldFile& file : findings.files) {
        index.emplace(file.name, cases.size());
        cases.push_back(case_of(file));
        add(cases.back(), file.told);
    }
    Case run{"popupc", "run", {}, {}, {}};
    for (const Diagnostic& one : findings.run) {
        const auto file = index.find(one.file);
        Case& target = file == index.end() ? run : cases[file->second];
        (told_severity(one) == Severity::remark ? target.remarks : target.findings).push_back(&one);
    }
    if (!run.findings.empty() || !run.remarks.empty()) cases.push_back(std::move(run));
    return cases;
}

std::string text_of(const std::vector<const Diagnostic*>& list, std::string_view source) {
    PlaceFinder finder(source);
    std::string text;
    for (const Diagnostic* one : list) text += render_text(*one, finder);
    return text;
}

class Report {
 public:
    explicit Report(std::vector<Case> cases) : cases_(std::move(cases)) {}

    std::string text() {
        xml_.PushDeclaration("xml version=\"1.0\" encoding=\"UTF-8\"");
        xml_.OpenElement("testsuites");
        totals();
        xml_.OpenElement("testsuite");
        totals();
        for (const Case& one : cases_) add(one);
        xml_.CloseElement();
        xml_.CloseElement();
        return xml_.CStr();
    }

 private:
    void attribute(const char* name, const std::string& value) { xml_.PushAttribute(name, value.c_str()); }

    // How long it took would differ from run to run.
    void totals() {
        std::size_t errors = 0;
        std::size_t failures = 0;
        for (const Case& one : cases_) {
            if (!one.findings.empty()) ++(one.unreadable() ? errors : failures);
        }
        attribute("name", "popupc");
        attribute("tests", std::to_string(cases_.size()));
        attribute("failures", std::to_string(failures));
        attribute("errors", std::to_string(errors));
        attribute("skipped", "0");
        attribute("time", "0");
    }

    void add(const Case& one) {
        xml_.OpenElement("testcase");
        attribute("classname", one.group);
        attribute("name", one.name);
        attribute("time", "0");
        if (!one.findings.empty()) {
            const Diagnostic& worst = *one.findings.front();
            std::string message = visible(worst.message);
            if (const std::size_t more = one.findings.size() - 1; more > 0)
                message += fmt::format(" (and {} more)", more);
            xml_.OpenElement(one.unreadable() ? "error" : "failure");
            attribute("type", worst.code);
            attribute("message", message);
            xml_.PushText(text_of(one.findings, one.text).c_str());
            xml_.CloseElement();
        }
        if (!one.remarks.empty()) {
            xml_.OpenElement("system-out");
            xml_.PushText(text_of(one.remarks, one.text).c_str());
            xml_.CloseElement();
        }
        xml_.CloseElement();
    }

    std::vector<Case> cases_;
    tinyxml2::XMLPrinter xml_;
};

}  // namespace

std::string render_junit(const Findings& findings, const MessageStyle& /*style*/) {
    return Report(cases_of(findings)).text();
}

}  // namespace popup
