#include "cli/files/path_patterns.h"

#include <fnmatch.h>

#include <algorithm>
#include <cstddef>

namespace popup {
namespace {

// "**": any number of parts.
bool any_parts(const std::string& part) {
    return part.size() >= 2 && part.find_first_not_of('*') == std::string::npos;
}

// Moves on from a "[" to the "]" that closes it. False when there is none.
bool skip_brackets(std::string_view part, std::size_t& at) {
    ++at;
    if (at < part.size() && (part[at] == '!' || part[at] == '^')) ++at;
    for (bool first = true; at < part.size(); first = false, ++at) {
        if (part[at] == ']' && !first) return true;
        if (part[at] == '\\') ++at;
        if (at < part.size() && part.substr(at).starts_with("[:")) {
            const std::size_t close = part.find(":]", at + 2);
            if (close != std::string_view::npos) at = close + 1;
        }
    }
    return false;
}

// The parts of a pattern, between its "/". One in brackets is a character like others there, and a backslash
// before one says nothing. False for a "[" that is never closed: fnmatch() takes it for itself, and git lets
// such a pattern match nothing.
bool split_pattern(std::string_view pattern, std::vector<std::string>& parts) {
    std::size_t begin = 0;
    for (std::size_t at = 0; at < pattern.size(); ++at) {
        const bool escaped = pattern[at] == '\\' && at + 1 < pattern.size();
        if (pattern[at + (escaped ? 1 : 0)] == '/') {
            parts.emplace_back(pattern.substr(begin, at - begin));
            at += escaped ? 1 : 0;
            begin = at + 1;
        } else if (escaped) {
            ++at;
        } else if (pattern[at] == '[' && !skip_brackets(pattern, at)) {
            return false;
        }
    }
    parts.emplace_back(pattern.substr(begin));
    return true;
}

// Without blanks at the end, but for those with a backslash before them.
std::string_view without_blanks(std::string_view line) {
    std::size_t kept = 0;
    for (std::size_t at = 0; at < line.size(); ++at) {
        if (line[at] == '\\') {
            kept = ++at + 1;
        } else if (line[at] != ' ') {
            kept = at + 1;
        }
    }
    return line.substr(0, kept);
}

bool part_matches(const std::string& pattern, const std::string& part) {
    return ::fnmatch(pattern.c_str(), part.c_str(), 0) == 0;
}

std::vector<std::string> parts_of(std::string_view path) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        parts.emplace_back(path.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

// Goes back to the last "**" only: what an earlier one could take, the later one can take as well.
bool parts_match(const std::vector<std::string>& pattern, const std::vector<std::string>& path) {
    std::size_t p = 0;
    std::size_t at = 0;
    std::size_t star = pattern.size();  // the last "**", and from where its next try begins
    std::size_t retry = 0;
    while (at < path.size()) {
        if (p < pattern.size() && any_parts(pattern[p])) {
            // At the end it stands for what is inside, so for one part at least.
            if (p + 1 == pattern.size()) return true;
            star = p++;
            retry = at;
        } else if (p < pattern.size() && part_matches(pattern[p], path[at])) {
            ++p;
            ++at;
        } else if (star < pattern.size()) {
            p = star + 1;
            at = ++retry;
        } else {
            return false;
        }
    }
    return p == pattern.size();
}

}  // namespace

PathPatterns::PathPatterns(std::string_view lines) {
    if (lines.starts_with("\xEF\xBB\xBF")) lines.remove_prefix(3);
    for (std::size_t begin = 0; begin < lines.size();) {
        const std::size_t end = std::min(lines.find('\n', begin), lines.size());
        std::string_view line = lines.substr(begin, end - begin);
        if (line.ends_with('\r')) line.remove_suffix(1);
        add(line);
        begin = end + 1;
    }
}

void PathPatterns::add(std::string_view line) {
    if (line.starts_with('#')) return;
    line = without_blanks(line);
    Pattern made;
    if (line.starts_with('!')) {
        made.turned = true;
        line.remove_prefix(1);
    }
    if (line.ends_with('/')) {
        made.directories = true;
        line.remove_suffix(1);
    }
    if (line.empty()) return;
    made.last_part = line.find('/') == std::string_view::npos;
    if (line.starts_with('/')) line.remove_prefix(1);
    if (split_pattern(line, made.parts)) patterns_.push_back(std::move(made));
}

std::optional<bool> PathPatterns::says(std::string_view path, bool directory) const {
    if (patterns_.empty()) return std::nullopt;
    const std::vector<std::string> parts = parts_of(path);
    for (auto pattern = patterns_.rbegin(); pattern != patterns_.rend(); ++pattern) {
        if (pattern->directories && !directory) continue;
        const bool matches = pattern->last_part ? part_matches(pattern->parts.front(), parts.back())
                                                : parts_match(pattern->parts, parts);
        if (matches) return !pattern->turned;
    }
    return std::nullopt;
}

}  // namespace popup
