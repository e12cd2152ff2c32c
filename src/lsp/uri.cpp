#include "lsp/uri.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

namespace popup::lsp {
namespace {

int digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

}  // namespace

std::optional<std::string> path_of(std::string_view uri) {
    constexpr std::string_view kScheme = "file://";
    if (!uri.starts_with(kScheme)) return std::nullopt;
    uri.remove_prefix(kScheme.size());
    for (const std::string_view host : std::array<std::string_view, 2>{"localhost", "127.0.0.1"}) {
        if (uri.starts_with(host)) uri.remove_prefix(host.size());
    }
    if (!uri.starts_with('/')) return std::nullopt;
    uri = uri.substr(0, uri.find_first_of("?#"));
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        char c = uri[i];
        if (c == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0) {
            c = static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
            i += 2;
        }
        if (c == '\0') return std::nullopt;
        path += c;
    }
    return path;
}

std::string uri_of(std::string_view path) {
    std::string uri = "file://";
    for (const char c : path) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           std::string_view("/-._~").find(c) != std::string_view::npos;
        if (plain) {
            uri += c;
        } else {
            uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
        }
    }
    return uri;
}

std::string real_path(const std::string& path) {
    std::error_code trouble;
    const std::filesystem::path whole = std::filesystem::absolute(path, trouble);
    if (trouble) return path;
    const std::filesystem::path real = std::filesystem::weakly_canonical(whole, trouble);
    return trouble ? whole.lexically_normal().string() : real.string();
}

std::string whole_path(const std::string& path) {
    const std::filesystem::path given = path;
    const bool dotted = std::any_of(given.begin(), given.end(), [](const std::filesystem::path& part) {
        return part == "." || part == "..";
    });
    if (dotted) return real_path(path);
    std::error_code trouble;
    const std::filesystem::path whole = std::filesystem::absolute(given, trouble);
    return trouble ? path : whole.string();
}

}  // namespace popup::lsp
