// Findings to be told, and readers of the formats in which they are: what each must be to be valid.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics/render_diagnostics.h"
#include "findings/message_formats.h"

namespace popup::test {

using nlohmann::json;

// A card with `tents` tents, each narrower than its seams are apart.
inline std::string camp(int tents = 1, const std::string& inner = "22") {
    std::string text = "<popup version=\"2.0\" units=\"mm\">\n  <mainpage width=\"200\" height=\"200\"/>\n";
    text += "  <structurelist>\n";
    for (int i = 0; i < tents; ++i) {
        const int y = -90 + 30 * i;
        text += fmt::format(R"(    <structure type="tent" id="tent-{0}"><outerpoints>
      <point x="-25" y="{1}"/> <point x="-25" y="{2}"/> <point x="25" y="{1}"/> <point x="25" y="{2}"/>
      <point x="-{3}" y="-10"/> <point x="-{3}" y="10"/> <point x="{3}" y="-10"/> <point x="{3}" y="10"/>
      </outerpoints><parentfold><begin x="0" y="-100"/><end x="0" y="100"/></parentfold></structure>
)",
                            i, y, y + 20, inner);
    }
    return text + "  </structurelist>\n</popup>\n";
}

inline MessageStyle style() {
    MessageStyle style;
    style.working = "/srv/shop";
    style.repository = "/srv";
    style.workspace = "/srv";
    return style;
}

inline ToldFile told(const std::string& name, std::vector<Diagnostic> findings) {
    for (Diagnostic& one : findings) one.file = name;
    return {name, {}, true, std::move(findings), {}};
}

Diagnostic found(Severity severity, const std::string& message, Place place = {4, 5},
                 const std::string& code = "collision", const std::string& element = "front") {
    return {severity, code, "", place, message, {}, element, {}, {}};
}

inline std::string rendered(std::string_view format, const Findings& findings) {
    const MessageFormat* row = find_message_format(format);
    return row == nullptr ? "" : row->render(findings, style());
}

inline std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

// Letters, digits and a few marks, and everything else as "%20".
inline bool is_uri_path(const std::string& text) {
    constexpr std::string_view kHex = "0123456789ABCDEF";
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        if (c == '%') {
            if (i + 2 >= text.size() || kHex.find(text[i + 1]) == std::string_view::npos ||
                kHex.find(text[i + 2]) == std::string_view::npos)
                return false;
            i += 2;
        } else if (c >= 0x80 || (std::isalnum(c) == 0 &&
                                 std::string_view("._~/-").find(text[i]) == std::string_view::npos)) {
            return false;
        }
    }
    return !text.empty();
}

// What a consumer of SARIF relies on; an empty text when all of it is there. The schema says more, and is
// asked where it is at hand.
inline std::string sarif_trouble(const json& log) {
    if (log.value("version", "") != "2.1.0") return "version";
    if (!log.contains("runs") || log["runs"].size() != 1) return "runs";
    const json& run = log["runs"][0];
    const json& driver = run["tool"]["driver"];
    if (driver.value("name", "") != "popupc" || driver.value("version", "").empty()) return "driver";
    if (!std::regex_match(driver.value("semanticVersion", ""), std::regex("[0-9]+\\.[0-9]+\\.[0-9]+")))
        return "semanticVersion";
    if (run.value("columnKind", "") != "unicodeCodePoints") return "columnKind";
    if (!run["originalUriBaseIds"].contains("SRCROOT")) return "originalUriBaseIds";
    if (!run["invocations"][0]["executionSuccessful"].is_boolean()) return "executionSuccessful";
    const std::set<std::string> levels{"none", "note", "warning", "error"};
    for (const json& rule : driver["rules"]) {
        if (rule["id"].get<std::string>().empty()) return "rule id";
        for (const char* part : {"shortDescription", "fullDescription", "help"}) {
            if (rule[part].value("text", "").empty()) return part;
        }
        if (!levels.contains(rule["defaultConfiguration"]["level"])) return "rule level";
    }
    const auto location_trouble = [](const json& location) -> std::string {
        const json& physical = location["physicalLocation"];
        const auto uri = physical["artifactLocation"]["uri"].get<std::string>();
        if (!is_uri_path(uri)) return "uri " + uri;
        if (uri.front() == '/') return "absolute uri";
        if (physical["artifactLocation"]["uriBaseId"] != "SRCROOT") return "uriBaseId";
        if (!physical.contains("region")) return {};
        for (const auto& [name, value] : physical["region"].items()) {
            if (name != "startLine" && name != "startColumn") return name;
            if (!value.is_number_integer() || value < 1) return "region";
        }
        return {};
    };
    for (const json& result : run["results"]) {
        const json& rule = driver["rules"].at(result["ruleIndex"].get<std::size_t>());
        if (rule["id"] != result["ruleId"]) return "ruleIndex";
        if (!levels.contains(result["level"])) return "level";
        if (result["message"].value("text", "").empty()) return "message";
        if (result["locations"].size() != 1) return "locations";
        if (result["partialFingerprints"].size() != 1) return "partialFingerprints";
        std::vector<json> places{result["locations"][0]};
        if (result.contains("relatedLocations"))
            places.insert(places.end(), result["relatedLocations"].begin(), result["relatedLocations"].end());
        for (const json& place : places) {
            if (std::string trouble = location_trouble(place); !trouble.empty()) return trouble;
        }
    }
    return {};
}

// An annotation as GitHub's runner reads it.
struct Annotation {
    std::string kind, message;
    std::map<std::string, std::string> properties;
};

inline std::string unescaped(std::string text, bool property) {
    std::vector<std::pair<std::string, std::string>> escapes{{"%0D", "\r"}, {"%0A", "\n"}};
    if (property) escapes.insert(escapes.end(), {{"%3A", ":"}, {"%2C", ","}});
    escapes.emplace_back("%25", "%");
    for (const auto& [from, to] : escapes) {
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
    }
    return text;
}

inline std::optional<Annotation> parse_annotation(const std::string& line) {
    if (!line.starts_with("::")) return std::nullopt;
    const std::size_t end = line.find("::", 2);
    if (end == std::string::npos) return std::nullopt;
    const std::string command = line.substr(2, end - 2);
    Annotation result;
    result.kind = command.substr(0, command.find(' '));
    std::istringstream properties(command.substr(std::min(command.size(), result.kind.size() + 1)));
    for (std::string one; std::getline(properties, one, ',');) {
        const std::size_t equals = one.find('=');
        if (equals == std::string::npos) return std::nullopt;
        result.properties[one.substr(0, equals)] = unescaped(one.substr(equals + 1), true);
    }
    result.message = unescaped(line.substr(end + 2), false);
    return result;
}

struct Log {
    std::vector<Annotation> annotations;
    std::vector<std::string> others;  // lines that are no commands
};

inline Log parse_log(const std::string& text) {
    Log log;
    for (const std::string& line : lines_of(text)) {
        if (auto one = parse_annotation(line)) {
            log.annotations.push_back(std::move(*one));
        } else {
            log.others.push_back(line);
        }
    }
    return log;
}

// Every format of these findings, held against a reader of it.
inline void expect_all_valid(const Findings& findings) {
    std::size_t count = findings.run.size();
    for (const ToldFile& file : findings.files) count += file.told.size();

    const std::vector<std::string> objects = lines_of(rendered("json", findings));
    EXPECT_EQ(objects.size(), count);
    for (const std::string& line : objects) EXPECT_TRUE(json::parse(line).is_object());

    const json log = json::parse(rendered("sarif", findings));
    EXPECT_EQ(sarif_trouble(log), "");

    const std::string report = rendered("junit", findings);
    tinyxml2::XMLDocument document;
    ASSERT_EQ(document.Parse(report.c_str(), report.size()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
    const tinyxml2::XMLElement* suite = document.RootElement()->FirstChildElement("testsuite");
    ASSERT_NE(suite, nullptr);
    int cases = 0;
    int failures = 0;
    int errors = 0;
    for (const auto* one = suite->FirstChildElement("testcase"); one != nullptr;
         one = one->NextSiblingElement("testcase")) {
        ++cases;
        failures += one->FirstChildElement("failure") != nullptr ? 1 : 0;
        errors += one->FirstChildElement("error") != nullptr ? 1 : 0;
        EXPECT_NE(one->Attribute("name"), nullptr);
        EXPECT_NE(one->Attribute("classname"), nullptr);
    }
    EXPECT_EQ(suite->IntAttribute("tests", -1), cases);
    EXPECT_EQ(suite->IntAttribute("failures", -1), failures);
    EXPECT_EQ(suite->IntAttribute("errors", -1), errors);
    EXPECT_GE(cases, static_cast<int>(findings.files.size()));
    for (const char c : report) EXPECT_TRUE(static_cast<unsigned char>(c) >= ' ' || c == '\n');

    const std::string commands = rendered("github", findings);
    const Log read = parse_log(commands);
    std::map<std::string, int> kinds;
    for (const Annotation& one : read.annotations) {
        EXPECT_LE(++kinds[one.kind], 10) << one.kind;
        EXPECT_TRUE(one.kind == "error" || one.kind == "warning" || one.kind == "notice") << one.kind;
        for (const auto& [name, value] : one.properties)
            EXPECT_TRUE(name == "file" || name == "line" || name == "col" || name == "title") << name;
    }
    for (const std::string& line : read.others) {
        EXPECT_TRUE(line.starts_with("popupc: ")) << line;
        EXPECT_EQ(line.find("##["), std::string::npos) << line;
    }
    for (const char c : commands) EXPECT_TRUE(static_cast<unsigned char>(c) >= ' ' || c == '\n');

    for (const std::string_view format : {"text", "short"}) {
        for (const char c : rendered(format, findings))
            EXPECT_TRUE(static_cast<unsigned char>(c) >= ' ' || c == '\n');
    }
}

}  // namespace popup::test
