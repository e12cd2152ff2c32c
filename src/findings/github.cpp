// Annotations of GitHub Actions: "::error file=F,line=1,col=2,title=CODE::MESSAGE" on standard output, as its
// manual describes workflow commands. It shows ten of each kind from a step and drops the others without a
// word, so the worst come first, and what is left out is counted.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "base/diagnostics/further_findings.h"
#include "base/diagnostics/render_diagnostics.h"
#include "findings/message_formats.h"
#include "findings/repository.h"
#include "findings/statistics.h"

namespace popup {
namespace {

constexpr std::size_t kOfAKind = 10;

std::string_view kind_of(Severity severity) {
    switch (severity) {
        case Severity::remark:
            return "notice";
        case Severity::warning:
            return "warning";
        case Severity::error:
            return "error";
    }
    broken_invariant("a severity is one of its enumerators", __FILE__, __LINE__);
}

// The text with what would end it escaped. Line breaks survive; other control characters and bytes that are
// no UTF-8 would reach the terminal of who reads the log.
std::string escaped(std::string_view text, bool property) {
    std::string result;
    while (!text.empty()) {
        const std::size_t plain = std::min(text.find_first_of("%\r\n:,"), text.size());
        result += visible(text.substr(0, plain));
        if (plain == text.size()) break;
        const char c = text[plain];
        if ((c == ':' || c == ',') && !property) {
            result += c;
        } else {
            result += fmt::format("%{:02X}", static_cast<unsigned>(c));
        }
        text.remove_prefix(plain + 1);
    }
    return result;
}

std::string annotation(const Diagnostic& one, const MessageStyle& style) {
    std::string text = fmt::format("::{} ", kind_of(one.severity));
    const bool in_a_file = !one.file.empty() && one.file != "-";
    if (in_a_file) {
        text += "file=" + escaped(path_from(style.workspace, style.working, one.file), true) + ",";
        if (one.place.line > 0) text += fmt::format("line={},", one.place.line);
        if (one.place.line > 0 && one.place.column > 0) text += fmt::format("col={},", one.place.column);
    }
    text += fmt::format("title={}::", escaped(one.code, true));
    if (one.file == "-") {
        text += one.place.line > 0 ? fmt::format("<stdin>:{}:{}: ", one.place.line, one.place.column)
                                   : "<stdin>: ";
    }
    text += escaped(one.message, false);
    for (const std::string& hint : one.hints) text += "%0Ahint: " + escaped(hint, false);
    return text + "\n";
}

std::size_t index_of(Severity severity) { return static_cast<std::size_t>(severity); }

// "8 errors and 3 warnings"
std::string listed(const std::array<std::size_t, 3>& counts) {
    std::vector<std::string> parts;
    for (const Severity severity : {Severity::error, Severity::warning, Severity::remark}) {
        const std::size_t count = counts.at(index_of(severity));
        if (count > 0)
            parts.push_back(fmt::format("{} {}{}", count, to_string(severity), count == 1 ? "" : "s"));
    }
    std::string text = fmt::format("{}", fmt::join(parts, ", "));
    if (const std::size_t comma = text.rfind(", "); comma != std::string::npos)
        text.replace(comma, 2, " and ");
    return text;
}

}  // namespace

std::string render_github(const Findings& findings, const MessageStyle& style) {
    std::vector<const Diagnostic*> all;
    for (const ToldFile& file : findings.files) {
        for (const Diagnostic& one : file.told) all.push_back(&one);
    }
    for (const Diagnostic& one : findings.run) all.push_back(&one);
    std::stable_sort(all.begin(), all.end(),
                     [](const Diagnostic* a, const Diagnostic* b) { return a->severity > b->severity; });
    // What was only counted is never shown by itself.
    std::array<std::size_t, 3> found{};
    std::array<std::size_t, 3> hidden{};
    for (const Diagnostic* one : all) {
        if (const auto further = further_of(*one)) {
            hidden.at(index_of(further->severity)) += further->count;
        } else {
            ++found.at(index_of(one->severity));
        }
    }
    const auto too_many = [](std::size_t count) { return count > kOfAKind; };
    const auto any = [](std::size_t count) { return count > 0; };
    const bool cut =
        std::any_of(found.begin(), found.end(), too_many) || std::any_of(hidden.begin(), hidden.end(), any);
    // The notice that says so is one of the ten.
    std::array<std::size_t, 3> room{kOfAKind - (cut ? 1 : 0), kOfAKind, kOfAKind};
    std::string text;
    for (const Diagnostic* one : all) {
        if (further_of(*one)) continue;
        const std::size_t kind = index_of(one->severity);
        if (room.at(kind) == 0) {
            ++hidden.at(kind);
            continue;
        }
        --room.at(kind);
        text += annotation(*one, style);
    }
    if (cut) {
        const std::string left_out = listed(hidden);
        text += fmt::format("::notice title=popupc::{} more: GitHub shows {} of a kind from a step\n",
                            left_out, kOfAKind);
        text += fmt::format("popupc: {} more; without --message-format github all are told\n", left_out);
    }
    // A line of the log, which must hold nothing that could be taken for a command.
    return text + summary_line(findings, std::nullopt);
}

}  // namespace popup
