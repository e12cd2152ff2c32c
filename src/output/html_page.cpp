#include "output/html_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "base/system/digest.h"
#include "base/text/base64.h"
#include "popup/diagnostics.h"

namespace popup {

std::string_view page_file(std::span<const PageFile> files, std::string_view name) {
    for (const PageFile& file : files) {
        if (file.name == name) return file.text;
    }
    broken_invariant("a file of a page is missing", __FILE__, __LINE__);
}

void append_page_lines(std::string& text, std::string_view source) {
    while (!source.empty()) {
        const std::size_t end = std::min(source.find('\n'), source.size() - 1);
        std::string_view line = source.substr(0, end + 1);
        source.remove_prefix(end + 1);
        line.remove_prefix(std::min(line.find_first_not_of(' '), line.size() - 1));
        if (line != "\n" && !line.starts_with("//") && !line.starts_with("/*")) text += line;
    }
}

std::string policy_source(std::string_view text) { return "'sha256-" + base64(sha256_bytes(text)) + "'"; }

std::string page_head(std::string_view policy, std::string_view title, std::string_view style) {
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta name=\"color-scheme\" content=\"light dark\">\n"
        "<meta name=\"generator\" content=\"popupc {}\">\n<link rel=\"icon\" href=\"data:,\">\n"
        "<title>{}</title>\n<style>{}</style>\n</head>\n",
        policy, POPUP_VERSION, title, style);
}

std::string filled_page(std::string_view page,
                        std::span<const std::pair<std::string_view, std::string>> values) {
    std::string result;
    while (true) {
        const std::size_t open = page.find("{{");
        result += page.substr(0, open);
        if (open == std::string_view::npos) return result;
        const std::size_t close = page.find("}}", open);
        const std::string_view name = page.substr(open + 2, close - open - 2);
        const auto value =
            std::find_if(values.begin(), values.end(), [name](const auto& one) { return one.first == name; });
        POPUP_INVARIANT(value != values.end());
        result += value->second;
        page.remove_prefix(close + 2);
    }
}

}  // namespace popup
