#include "findings/baseline.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostics/further_findings.h"
#include "base/text/fingerprint.h"
#include "base/text/place_at.h"
#include "findings/repository.h"

namespace popup {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr std::size_t kMostOfOne = 1000000000;

// "on line 12" as "on line": lines move, and what is said stays the same.
std::string without_lines(std::string_view text) {
    constexpr std::string_view kLine = " line ";
    constexpr std::string_view kDigits = "0123456789";
    std::string result;
    for (std::size_t at = text.find(kLine); at != std::string_view::npos; at = text.find(kLine)) {
        result += text.substr(0, at + kLine.size());
        text.remove_prefix(at + kLine.size());
        text.remove_prefix(std::min(text.find_first_not_of(kDigits), text.size()));
    }
    return result.append(text);
}

// The text without bytes that are no UTF-8, which JSON has no way to write.
std::string as_utf8(const std::string& text) {
    const std::string quoted = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
    return Json::parse(quoted).get<std::string>();
}

// A name that JSON cannot hold is percent-encoded; so is one that looks as if it were.
std::string name_of(const std::string& file, const BaselinePlaces& places) {
    if (file.empty()) return file;
    const std::string name = path_from(places.baseline, places.working, file);
    const bool plain = name.find('%') == std::string::npos && as_utf8(name) == name;
    return plain ? name : percent_encoded(name);
}

// Remarks fail nothing, and a file that could not be read was not looked at.
bool acceptable(const Diagnostic& one) {
    if (one.code == "unreadable-input") return false;
    const FurtherFindings some = further_of(one).value_or(FurtherFindings{1, one.severity});
    return some.severity != Severity::remark;
}

AcceptedFinding key_of(const Diagnostic& one, const BaselinePlaces& places) {
    std::string said = without_lines(one.message);
    if (one.change) said += "\n" + one.change->before + "\n" + one.change->after;
    return {name_of(one.file, places), one.code, as_utf8(one.element), fingerprint(said)};
}

// The files of a run, as a baseline names them.
std::set<std::string> looked_at(const Findings& findings, const BaselinePlaces& places) {
    std::set<std::string> names;
    for (const ToldFile& file : findings.files) {
        const bool unreadable = std::any_of(file.told.begin(), file.told.end(), [](const Diagnostic& one) {
            return one.code == "unreadable-input";
        });
        if (!unreadable) names.insert(name_of(file.name, places));
    }
    return names;
}

// Byte offsets of what stands in the list that the outer object holds. Precondition: the text is JSON.
std::vector<std::size_t> entries_in(std::string_view text) {
    std::vector<std::size_t> found;
    int depth = 0;
    bool quoted = false;
    bool awaited = false;  // an entry begins with the next character that is no blank
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted) {
            if (c == '\\') ++i;
            quoted = c != '"';
            continue;
        }
        const bool blank = c == ' ' || c == '\t' || c == '\n' || c == '\r';
        if (awaited && !blank) {
            if (c != ']') found.push_back(i);
            awaited = false;
        }
        if (c == '"') {
            quoted = true;
        } else if (c == '{' || c == '[') {
            awaited = ++depth == 2;
        } else if (c == '}' || c == ']') {
            --depth;
        } else if (c == ',') {
            awaited = depth == 2;
        }
    }
    return found;
}

bool is_digest(const std::string& text) {
    return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// What is wrong with an entry; empty when nothing is.
std::string read_entry(const Json& json, Baseline& baseline) {
    if (!json.is_object()) return "a finding is an object";
    AcceptedFinding entry;
    for (const auto& [name, target] :
         {std::pair("file", &entry.file), std::pair("code", &entry.code),
          std::pair("element", &entry.element), std::pair("digest", &entry.digest)}) {
        const auto value = json.find(name);
        if (value == json.end() || !value->is_string())
            return fmt::format("the finding has no text \"{}\"", name);
        *target = value->get<std::string>();
    }
    if (!is_digest(entry.digest)) return "the digest is 16 hexadecimal digits in lower case";
    const auto count = json.find("count");
    if (count == json.end() || !count->is_number_unsigned() || count->get<std::uint64_t>() < 1 ||
        count->get<std::uint64_t>() > kMostOfOne)
        return "the finding has no \"count\", a whole number from 1";
    if (json.size() != 5) {
        for (const auto& [name, value] : json.items()) {
            if (name != "file" && name != "code" && name != "element" && name != "digest" && name != "count")
                return fmt::format("a finding has no \"{}\"", name);
        }
    }
    if (!baseline.emplace(std::move(entry), count->get<std::size_t>()).second)
        return "the finding stands in the file twice";
    return {};
}

}  // namespace

std::optional<Baseline> read_baseline(const Source& source, Diagnostics& diagnostics) {
    const auto wrong = [&diagnostics](Place place, std::string message) {
        diagnostics.error("bad-baseline", place, std::move(message))
            .hint("--write-baseline makes the file; take a broken one away first");
        return std::nullopt;
    };
    Json json;
    try {
        json = Json::parse(source.text);
    } catch (const Json::parse_error& error) {
        // It counts bytes from 1, the one it stumbled over included.
        return wrong(place_at(source.text, error.byte == 0 ? 0 : error.byte - 1), "this is not JSON");
    } catch (const Json::exception&) {
        return wrong({}, "a number in it is too large");
    }
    const Place start{1, 1};
    if (!json.is_object() || json.find("version") == json.end() || json.find("findings") == json.end())
        return wrong(start, "this is not a baseline: an object with \"version\" and \"findings\"");
    if (json["version"] != kVersion)
        return wrong(start, fmt::format("this baseline is not of version {}, which is what popupc {}",
                                        kVersion, "reads"));
    if (json.size() != 2 || !json["findings"].is_array())
        return wrong(start, "a baseline has \"version\" and a list \"findings\", and nothing else");
    Baseline baseline;
    const std::vector<std::size_t> places = entries_in(source.text);
    std::size_t at = 0;
    for (const Json& one : json["findings"]) {
        const std::string trouble = read_entry(one, baseline);
        if (trouble.empty()) {
            ++at;
            continue;
        }
        return wrong(at < places.size() ? place_at(source.text, places[at]) : start, trouble);
    }
    return baseline;
}

std::string write_baseline(const Baseline& baseline) {
    std::string text = fmt::format("{{\n  \"version\": {},\n  \"findings\": [", kVersion);
    const char* separator = "\n";
    for (const auto& [entry, count] : baseline) {
        const auto quoted = [](const std::string& value) { return Json(value).dump(); };
        text += fmt::format(R"({}    {{"file": {}, "code": {}, "element": {}, "digest": {}, "count": {}}})",
                            separator, quoted(entry.file), quoted(entry.code), quoted(entry.element),
                            quoted(entry.digest), count);
        separator = ",\n";
    }
    return text + (baseline.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

std::size_t accept(Findings& findings, const Baseline& baseline, const BaselinePlaces& places) {
    Baseline left = baseline;
    const auto divide = [&](std::vector<Diagnostic>& told, std::vector<Diagnostic>& accepted) {
        std::vector<Diagnostic> fresh;
        for (Diagnostic& one : told) {
            const auto entry = acceptable(one) ? left.find(key_of(one, places)) : left.end();
            const bool known = entry != left.end() && entry->second > 0;
            if (known) --entry->second;
            (known ? accepted : fresh).push_back(std::move(one));
        }
        told = std::move(fresh);
    };
    for (ToldFile& file : findings.files) divide(file.told, file.accepted);
    divide(findings.run, findings.run_accepted);
    findings.compared = true;
    std::set<std::string> names = looked_at(findings, places);
    // An error may have kept other findings from being looked for: they are not gone.
    for (const ToldFile& file : findings.files) {
        const bool fails = std::any_of(file.told.begin(), file.told.end(),
                                       [](const Diagnostic& one) { return one.severity == Severity::error; });
        if (fails || !file.whole) names.erase(name_of(file.name, places));
    }
    std::size_t outdated = 0;
    for (const auto& [entry, count] : left) {
        if (names.contains(entry.file)) outdated += count;
    }
    return outdated;
}

Baseline baseline_of(const Findings& findings, const Baseline& old, const BaselinePlaces& places,
                     const std::function<bool(const std::string&)>& exists, std::size_t* kept) {
    Baseline baseline;
    const std::set<std::string> names = looked_at(findings, places);
    for (const auto& [entry, count] : old) {
        if (!entry.file.empty() && !names.contains(entry.file) && exists(percent_decoded(entry.file)))
            baseline.emplace(entry, count);
    }
    const auto add = [&](const std::vector<Diagnostic>& list) {
        for (const Diagnostic& one : list) {
            if (acceptable(one)) ++baseline[key_of(one, places)];
        }
    };
    for (const ToldFile& file : findings.files) {
        add(file.told);
        add(file.accepted);
    }
    add(findings.run);
    add(findings.run_accepted);
    // What was not looked for may still be there.
    std::set<std::string> partly;
    for (const ToldFile& file : findings.files) {
        if (!file.whole) partly.insert(name_of(file.name, places));
    }
    if (!partly.empty()) partly.emplace();  // sheets are laid out of all files, or not at all
    std::size_t held = 0;
    for (const auto& [entry, count] : old) {
        if (!partly.contains(entry.file)) continue;
        std::size_t& now = baseline[entry];
        held += count - std::min(now, count);
        now = std::max(now, count);
    }
    if (kept != nullptr) *kept = held;
    return baseline;
}

}  // namespace popup
