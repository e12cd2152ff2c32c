#include "gallery/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>
#include <system_error>

#include "base/system/digest.h"

namespace popup {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kDocument = ".xml";
constexpr std::size_t kDigits = 10;       // of the digest, in names
constexpr std::size_t kLongestStem = 60;  // of what comes before it

bool is_digit(char c) { return c >= '0' && c <= '9'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
bool is_plain(char c) { return (c >= 'a' && c <= 'z') || is_digit(c) || c == '-' || c == '_'; }

// The directory, links followed, as far as it is there.
fs::path settled(const fs::path& path) {
    std::error_code error;
    fs::path whole = fs::weakly_canonical(fs::absolute(path, error), error);
    if (error) whole = fs::absolute(path, error).lexically_normal();
    // "/a/" has an empty last part.
    return whole.has_filename() || whole == whole.root_path() ? whole : whole.parent_path();
}

fs::path directory_of(const std::string& file) {
    const fs::path parent = fs::path(file).parent_path();
    return parent.empty() ? fs::path(".") : parent;
}

fs::path common_of(const fs::path& a, const fs::path& b) {
    fs::path common;
    for (auto x = a.begin(), y = b.begin(); x != a.end() && y != b.end() && *x == *y; ++x, ++y) common /= *x;
    return common;
}

std::string with_digest(const std::string& label, std::size_t digits) {
    std::string stem;
    for (const char c : label) {
        if (const char small = lower(c); is_plain(small)) {
            stem += small;
        } else if (!stem.empty() && !stem.ends_with('-')) {
            stem += '-';
        }
    }
    stem.resize(std::min(stem.size(), kLongestStem));
    while (stem.ends_with('-')) stem.pop_back();
    return (stem.empty() ? "" : stem + "-") + sha256(label).substr(0, digits);
}

// Whether it could be a name that ends in a digest.
bool ends_like_digest(std::string_view stem) {
    const std::string_view end = stem.substr(stem.rfind('-') + 1);
    return end.size() >= kDigits &&
           std::all_of(end.begin(), end.end(), [](char c) { return is_digit(c) || (c >= 'a' && c <= 'f'); });
}

std::string name_of(const std::string& label) {
    if (label.ends_with(kDocument)) {
        std::string stem = label.substr(0, label.size() - kDocument.size());
        if (!stem.empty() && stem.size() <= kLongestStem && std::all_of(stem.begin(), stem.end(), is_plain) &&
            !ends_like_digest(stem)) {
            return stem;
        }
    }
    return with_digest(label, kDigits);
}

}  // namespace

GalleryPlan plan_gallery(const std::vector<std::string>& arguments, const std::vector<std::string>& files) {
    GalleryPlan plan;
    fs::path root;
    for (const std::string& argument : arguments) {
        std::error_code error;
        const fs::path directory =
            settled(fs::is_directory(argument, error) ? fs::path(argument) : directory_of(argument));
        root = root.empty() ? directory : common_of(root, directory);
    }
    plan.root = root.string();
    std::map<std::string, fs::path> directories;  // most files share theirs
    std::set<std::string> labels;
    for (const std::string& file : files) {
        const fs::path named = directory_of(file);
        const auto [at, fresh] = directories.try_emplace(named.string());
        if (fresh) at->second = settled(named);
        std::string label = (at->second / fs::path(file).filename()).lexically_relative(root).string();
        if (!labels.insert(label).second) continue;
        plan.designs.push_back({file, label, name_of(label)});
    }
    std::sort(plan.designs.begin(), plan.designs.end(),
              [](const auto& a, const auto& b) { return label_before(a.label, b.label); });
    // Two of the same digest are not likely, but somebody could look for them.
    std::map<std::string, int> taken;
    for (const GalleryDesign& one : plan.designs) ++taken[one.name];
    for (GalleryDesign& one : plan.designs) {
        if (taken[one.name] > 1) one.name = sha256(one.label);
    }
    return plan;
}

bool label_before(const std::string& a, const std::string& b) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < a.size() && j < b.size()) {
        if (is_digit(a[i]) && is_digit(b[j])) {
            const auto run = [](const std::string& text, std::size_t& at) {
                while (at + 1 < text.size() && text[at] == '0' && is_digit(text[at + 1])) ++at;
                const std::size_t from = at;
                while (at < text.size() && is_digit(text[at])) ++at;
                return std::string_view(text).substr(from, at - from);
            };
            const std::string_view x = run(a, i);
            const std::string_view y = run(b, j);
            if (x.size() != y.size()) return x.size() < y.size();
            if (x != y) return x < y;
            continue;
        }
        const auto x = static_cast<unsigned char>(lower(a[i]));
        const auto y = static_cast<unsigned char>(lower(b[j]));
        if (x != y) return x < y;
        ++i;
        ++j;
    }
    if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
    return a < b;
}

std::string escaped_name(const std::string& name) {
    std::string text;
    for (const char c : name) {
        if (c >= ' ' && c <= '~' && c != '%') {
            text += c;
        } else {
            text += fmt::format("%{:02X}", static_cast<unsigned char>(c));
        }
    }
    return text;
}

std::string unescaped_name(const std::string& text) {
    std::string name;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned value = 0;
        const char* begin = text.data() + i + 1;
        if (text[i] == '%' && i + 2 < text.size() &&
            std::from_chars(begin, begin + 2, value, 16).ptr == begin + 2) {
            name += static_cast<char>(value);
            i += 2;
        } else {
            name += text[i];
        }
    }
    return name;
}

}  // namespace popup
