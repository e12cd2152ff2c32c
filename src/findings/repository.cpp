#include "findings/repository.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>

namespace popup {
namespace {

namespace fs = std::filesystem;

bool leads_out(const fs::path& relative) { return relative.empty() || *relative.begin() == ".."; }

// Without the empty last part that "a/" has.
fs::path tidy(const fs::path& path) {
    fs::path normal = path.lexically_normal();
    return normal.has_filename() || !normal.has_relative_path() ? normal : normal.parent_path();
}

fs::path followed(const fs::path& path) {
    std::error_code error;
    fs::path real = fs::weakly_canonical(path, error);
    return error ? path : real;
}

}  // namespace

fs::path repository_of(const fs::path& directory) {
    std::error_code error;
    for (fs::path at = tidy(directory);; at = at.parent_path()) {
        if (fs::exists(at / ".git", error)) return at;
        if (!at.has_relative_path()) return tidy(directory);
    }
}

std::string path_from(const fs::path& root, const fs::path& working, const std::string& name) {
    if (name == "-") return "<stdin>";
    const fs::path file = tidy(working / name);
    const fs::path written = file.lexically_relative(tidy(root));
    if (!leads_out(written)) return written.generic_string();
    const fs::path real = followed(file.parent_path()) / file.filename();
    const fs::path found = real.lexically_relative(followed(tidy(root)));
    return (found.empty() ? file : found).generic_string();
}

std::string percent_encoded(std::string_view path) {
    std::string text;
    for (const char c : path) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           std::string_view("-._~/").find(c) != std::string_view::npos;
        if (plain) {
            text += c;
        } else {
            text += fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
        }
    }
    return text;
}

std::string percent_decoded(std::string_view text) {
    std::string path;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned value = 0;
        const char* const digits = text.data() + i + 1;
        const bool escape = text[i] == '%' && i + 2 < text.size() &&
                            std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2;
        path += escape ? static_cast<char>(value) : text[i];
        if (escape) i += 2;
    }
    return path;
}

}  // namespace popup
