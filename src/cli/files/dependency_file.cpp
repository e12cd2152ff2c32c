#include "cli/files/dependency_file.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

namespace popup::cli {
namespace {

constexpr std::size_t kLineWidth = 100;

enum class Role { target, input };

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

// A backslash in front makes make look for the name itself, not for what matches it.
bool is_wildcard(std::string_view name, std::size_t at) {
    if (name[at] == '[') return name.find(']', at) != std::string_view::npos;
    return name[at] == '*' || name[at] == '?';
}

// Names that mean something to make where a target could stand.
bool is_special_target(std::string_view name) {
    return name.size() > 1 && name.front() == '.' && std::all_of(name.begin() + 1, name.end(), [](char c) {
               return (c >= 'A' && c <= 'Z') || c == '_';
           });
}

bool make_can_hold(std::string_view name, Role role) {
    if (name.empty() || std::any_of(name.begin(), name.end(), is_control)) return false;
    if (name.find_first_of(";|") != std::string_view::npos) return false;
    if (name.front() == '~') return false;
    if (name.back() == ' ' || name.back() == '\\' || name.back() == '&') return false;
    // An assignment, where it is the second word of a line.
    if (name.front() == '=' || name.starts_with("+=") || name.starts_with("!=")) return false;
    // A member of an archive.
    if (name.back() == ')' && name.find('(', 1) != std::string_view::npos) return false;
    if (is_special_target(name)) return false;
    // Make looks for files with such names, and then takes every backslash away.
    const bool sought = name.find_first_of("*?[") != std::string_view::npos;
    const bool percent = role == Role::target && name.find('%') != std::string_view::npos;
    const bool backslash = name.find('\\') != std::string_view::npos;
    return !(sought && percent) && !(backslash && (sought || percent));
}

// Whether ninja reads the name as make_name() writes it.
bool ninja_can_hold(std::string_view name, Role role) {
    constexpr std::string_view kPlain = "+,/_:.~()}{%=@[]!- #$\\";
    for (std::size_t i = 0; i < name.size(); ++i) {
        const char c = name[i];
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                            static_cast<unsigned char>(c) >= 0x80;
        if (!letter && kPlain.find(c) == std::string_view::npos) return false;
        if (c == '\\' && i + 1 < name.size() &&
            std::string_view("#:$").find(name[i + 1]) != std::string_view::npos) {
            return false;
        }
        if (is_wildcard(name, i) || (c == '%' && role == Role::target)) return false;
    }
    return !name.ends_with(':');
}

std::string make_name(std::string_view name, Role role) {
    std::string text;
    std::size_t backslashes = 0;  // just before
    for (std::size_t i = 0; i < name.size(); ++i) {
        const char c = name[i];
        if (c == ' ' || c == '#' || c == ':') {
            text.append(backslashes + 1, '\\');
        } else if (is_wildcard(name, i) || (c == '%' && role == Role::target)) {
            text += '\\';
        } else if (c == '$') {
            text += '$';
        }
        text += c;
        backslashes = c == '\\' ? backslashes + 1 : 0;
    }
    return text;
}

// "a=b: c" and "define a: b" are no rules.
bool may_be_first(std::string_view name) {
    static constexpr std::array<std::string_view, 19> kWords{
        "define",  "else",     "endef",    "endif",    "export", "ifdef", "ifeq",
        "ifndef",  "ifneq",    "include",  "-include", "load",   "-load", "override",
        "private", "sinclude", "undefine", "unexport", "vpath"};
    return name.find('=') == std::string_view::npos &&
           std::find(kWords.begin(), kWords.end(), name) == kWords.end();
}

std::vector<std::string> each_once(const std::vector<std::string>& names) {
    std::vector<std::string> once;
    std::set<std::string_view> seen;
    for (const std::string& name : names) {
        if (seen.insert(name).second) once.push_back(name);
    }
    return once;
}

// The words of a rule, line by line.
class Folded {
 public:
    void add(std::string_view word) {
        if (!text_.empty() && column_ + 1 + word.size() > kLineWidth - 2) {
            text_ += " \\\n ";
            column_ = 1;
        } else if (!text_.empty()) {
            text_ += ' ';
            ++column_;
        }
        text_ += word;
        column_ += word.size();
    }
    void colon() { text_ += ':', ++column_; }
    [[nodiscard]] const std::string& text() const { return text_; }

 private:
    std::string text_;
    std::size_t column_ = 0;
};

}  // namespace

std::optional<std::string> dependency_rule(const std::vector<std::string>& targets,
                                           const std::vector<std::string>& inputs, bool phony,
                                           const std::string& file, Diagnostics& diagnostics) {
    if (inputs.empty()) return std::string();
    bool good = true;
    const auto refuse = [&](const std::string& why) {
        diagnostics.error("unwritable-output", {}, fmt::format("{} cannot be written: {}", file, why))
            .hint("--deps-format json holds any name");
        good = false;
    };
    const auto words = [&](const std::vector<std::string>& names, Role role) {
        std::vector<std::string> once = each_once(names);
        for (const std::string& name : once) {
            if (!make_can_hold(name, role)) refuse(fmt::format("a makefile cannot name \"{}\"", name));
        }
        const auto first = std::find_if(once.begin(), once.end(), may_be_first);
        if (first != once.end()) {
            std::rotate(once.begin(), first, first + 1);
        } else if (good) {
            refuse(fmt::format("in a makefile \"{}\" cannot come first", once.front()));
        }
        for (std::string& name : once) name = make_name(name, role);
        return once;
    };
    const std::vector<std::string> made = words(targets, Role::target);
    const std::vector<std::string> read = words(inputs, Role::input);
    const std::vector<std::string> kept =
        phony && good ? words(inputs, Role::target) : std::vector<std::string>();
    if (!good) return std::nullopt;
    const auto warn = [&](const std::string& name) {
        diagnostics
            .warning("dependency-name", {},
                     fmt::format("ninja does not read \"{}\" in {} as that name; make does", name, file))
            .hint("rename the file, or if ninja does not read it: --allow dependency-name");
    };
    for (const std::string& name : each_once(targets)) {
        if (!ninja_can_hold(name, Role::target)) warn(name);
    }
    for (const std::string& name : each_once(inputs)) {
        if (!ninja_can_hold(name, Role::input) || (phony && !ninja_can_hold(name, Role::target))) warn(name);
    }
    Folded rule;
    for (const std::string& name : made) rule.add(name);
    rule.colon();
    for (const std::string& name : read) rule.add(name);
    std::string text = rule.text() + "\n";
    if (phony) {
        Folded rest;
        for (const std::string& name : kept) rest.add(name);
        rest.colon();
        text += "\n" + rest.text() + "\n";
    }
    return text;
}

std::optional<std::string> dependency_json(const std::vector<std::string>& inputs,
                                           const std::optional<std::vector<std::string>>& outputs,
                                           const std::string& file, Diagnostics& diagnostics) {
    nlohmann::ordered_json json;
    json["inputs"] = each_once(inputs);
    json["outputs"] = nullptr;
    if (outputs) json["outputs"] = *outputs;
    try {
        return json.dump(2) + "\n";
    } catch (const nlohmann::ordered_json::type_error&) {
        diagnostics.error(
            "unwritable-output", {},
            fmt::format("{} cannot be written: the name of a file of this run is not UTF-8, and JSON "
                        "cannot hold it",
                        file));
        return std::nullopt;
    }
}

std::vector<std::string> names_of_files(const std::vector<std::string>& names) {
    std::vector<std::string> files;
    for (const std::string& name : each_once(names)) {
        struct stat status {};
        if (name == "-" || (::stat(name.c_str(), &status) == 0 && !S_ISREG(status.st_mode))) continue;
        files.push_back(name);
    }
    return files;
}

}  // namespace popup::cli
