#include "input/dxf/groups.h"

#include <fmt/format.h>

#include <charconv>

#include "input/text.h"

namespace popup::dxf {
namespace {

constexpr int kComment = 999;

}  // namespace

std::string_view Groups::take_line() {
    const std::size_t end = text_.find_first_of("\r\n", at_);
    const std::string_view found = text_.substr(at_, end == std::string_view::npos ? end : end - at_);
    at_ += found.size();
    if (at_ < text_.size()) {
        const bool both = text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n';
        at_ += both ? 2 : 1;
    }
    ++line_;
    return trimmed(found);
}

bool Groups::next(Group& group) {
    while (at_ < text_.size() && trouble_.empty()) {
        const std::string_view code = take_line();
        // Blanks may follow the last group, and what some programs end a text with.
        if (code.empty() || code == "\x1a") {
            if (text_.find_first_not_of(" \t\r\n\x1a", at_) == std::string_view::npos) break;
        }
        const char* const end = code.data() + code.size();
        const auto [stop, error] = std::from_chars(code.data(), end, group.code);
        if (error != std::errc{} || stop != end) {
            --line_;
            trouble_ = fmt::format("here stands a group code, a whole number, and not \"{}\"", shown(code));
            return false;
        }
        if (at_ >= text_.size()) {
            --line_;
            trouble_ = fmt::format("the file ends behind the group code {}, without its value", group.code);
            return false;
        }
        group.line = line_;
        group.value = take_line();
        if (group.code != kComment) return true;
    }
    at_ = text_.size();
    return false;
}

}  // namespace popup::dxf
