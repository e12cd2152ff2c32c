// SARIF 2.1.0, the Static Analysis Results Interchange Format of OASIS (errata 01, 2023).
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "base/diagnostics/further_findings.h"
#include "base/text/fingerprint.h"
#include "findings/message_formats.h"
#include "findings/repository.h"
#include "popup/compile.h"

namespace popup {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kRoot = "SRCROOT";

std::string_view level_of(Severity severity) {
    switch (severity) {
        case Severity::remark:
            return "note";
        case Severity::warning:
            return "warning";
        case Severity::error:
            return "error";
    }
    broken_invariant("a severity is one of its enumerators", __FILE__, __LINE__);
}

// In the text of a message braces stand for arguments, unless they are doubled (3.11.5), and "[a](b)" is a
// link, unless its brackets are escaped (3.11.6).
std::string message_text(std::string_view text) {
    const bool like_a_link = text.find("](") != std::string_view::npos;
    std::string result;
    for (const char c : text) {
        if (like_a_link && (c == '[' || c == ']')) result += '\\';
        if (c == '{' || c == '}') result += c;
        result += c;
    }
    return result;
}

class Log {
 public:
    Log(const Findings& findings, const MessageStyle& style) : findings_(findings), style_(style) {}

    std::string text() {
        find_rules();
        Json results = Json::array();
        for (const ToldFile& file : findings_.files) {
            for (const Diagnostic& one : file.told) results.push_back(result(one, false));
            for (const Diagnostic& one : file.accepted) results.push_back(result(one, true));
        }
        Json notifications = Json::array();
        for (const bool accepted : {false, true}) {
            for (const Diagnostic& one : accepted ? findings_.run_accepted : findings_.run) {
                // A result without a place is refused by those who show results beside the lines of files.
                if (one.file.empty()) {
                    notifications.push_back(notification(one));
                } else {
                    results.push_back(result(one, accepted));
                }
            }
        }
        Json invocation{{"executionSuccessful", successful_}};
        if (!notifications.empty()) invocation["toolExecutionNotifications"] = std::move(notifications);

        Json driver{{"name", "popupc"},
                    {"version", version()},
                    {"semanticVersion", version()},
                    {"rules", std::move(rules_)}};
        Json run{{"tool", {{"driver", std::move(driver)}}},
                 {"invocations", Json::array({std::move(invocation)})},
                 {"originalUriBaseIds",
                  {{kRoot,
                    {{"description",
                      {{"text", "The root of the repository, or the directory in which popupc ran."}}}}}}},
                 {"columnKind", "unicodeCodePoints"},
                 {"results", std::move(results)}};
        const Json log{
            {"$schema",
             "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"},
            {"version", "2.1.0"},
            {"runs", Json::array({std::move(run)})}};
        return log.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    }

 private:
    // A rule for each code that occurs, in the order of their names.
    void find_rules() {
        std::set<std::string_view> codes;
        const auto add = [&codes](const std::vector<Diagnostic>& list) {
            for (const Diagnostic& one : list) codes.insert(one.code);
        };
        for (const ToldFile& file : findings_.files) {
            add(file.told);
            add(file.accepted);
        }
        add(findings_.run);
        add(findings_.run_accepted);
        for (const std::string_view code : codes) {
            rule_index_[code] = rules_.size();
            Json rule{{"id", code}};
            if (const CodeInfo* info = find_code(code)) {
                rule["shortDescription"]["text"] = info->summary;
                rule["fullDescription"]["text"] = info->explanation;
                rule["help"]["text"] = info->explanation;
                rule["defaultConfiguration"]["level"] = level_of(info->severity);
            }
            rules_.push_back(std::move(rule));
        }
    }

    std::string uri(const std::string& file) const {
        return percent_encoded(path_from(style_.repository, style_.working, file));
    }

    static Json physical(const std::string& uri, Place place) {
        Json location{{"artifactLocation", {{"uri", uri}, {"uriBaseId", kRoot}}}};
        if (place.line > 0) location["region"]["startLine"] = place.line;
        if (place.line > 0 && place.column > 0) location["region"]["startColumn"] = place.column;
        return location;
    }

    // What was wrong, and below it what would mend it.
    static std::string words(const Diagnostic& one) {
        std::string text = one.message;
        for (const std::string& hint : one.hints) text += "\nhint: " + hint;
        return message_text(text);
    }

    Json result(const Diagnostic& one, bool accepted) {
        successful_ = successful_ && one.code != "unreadable-input";
        const std::string file = uri(one.file);
        Json location{{"physicalLocation", physical(file, one.place)}};
        if (!one.element.empty())
            location["logicalLocations"] = Json::array({{{"name", one.element}, {"kind", "element"}}});
        Json json{{"ruleId", one.code},
                  {"ruleIndex", rule_index_.at(one.code)},
                  {"level", level_of(told_severity(one))},
                  {"message", {{"text", words(one)}}},
                  {"locations", Json::array({std::move(location)})}};
        for (const Related& other : one.related) {
            json["relatedLocations"].push_back({{"id", json["relatedLocations"].size() + 1},
                                                {"physicalLocation", physical(file, other.place)},
                                                {"message", {{"text", message_text(other.text)}}}});
        }
        json["partialFingerprints"]["popupcFinding/v1"] = identity(file, one);
        if (findings_.compared) json["baselineState"] = accepted ? "unchanged" : "new";
        if (accepted)
            json["suppressions"] =
                Json::array({{{"kind", "external"}, {"justification", "It stands in the baseline."}}});
        if (one.change) json["properties"] = {{"before", one.change->before}, {"after", one.change->after}};
        return json;
    }

    Json notification(const Diagnostic& one) {
        successful_ = successful_ && one.severity != Severity::error;
        return {{"descriptor", {{"id", one.code}, {"index", rule_index_.at(one.code)}}},
                {"level", level_of(told_severity(one))},
                {"message", {{"text", words(one)}}}};
    }

    // What stays when lines move and numbers change: the file, the rule, the element and the others that the
    // finding is about. Where that is the same the first, second … is meant.
    std::string identity(const std::string& file, const Diagnostic& one) {
        std::string text = file + '\n' + one.code + '\n' + one.element;
        for (const Related& other : one.related) text += '\n' + other.text;
        const std::size_t number = ++seen_[text];
        return fingerprint(number == 1 ? text : fmt::format("{}\n#{}", text, number));
    }

    const Findings& findings_;
    const MessageStyle& style_;
    Json rules_ = Json::array();
    std::map<std::string_view, std::size_t> rule_index_;
    std::map<std::string, std::size_t> seen_;
    bool successful_ = true;
};

}  // namespace

std::string render_sarif(const Findings& findings, const MessageStyle& style) {
    return Log(findings, style).text();
}

}  // namespace popup
