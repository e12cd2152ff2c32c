#include "input/drawing/entities.h"

#include <cstddef>

namespace popup::drawing {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

std::string_view behind_blanks(std::string_view text) {
    const std::size_t at = text.find_first_not_of(kBlanks);
    return at == std::string_view::npos ? std::string_view{} : text.substr(at);
}

}  // namespace

Entities::Entities(std::string_view prolog) {
    constexpr std::string_view kEntity = "<!ENTITY";
    constexpr std::string_view kComment = "<!--";
    const std::size_t doctype = prolog.find("<!DOCTYPE");
    if (doctype == std::string_view::npos) return;
    std::string_view rest = prolog.substr(doctype + 1);
    for (std::size_t at = rest.find("<!"); at != std::string_view::npos; at = rest.find("<!")) {
        rest.remove_prefix(at);
        if (rest.starts_with(kComment)) {
            const std::size_t end = rest.find("-->", kComment.size());
            if (end == std::string_view::npos) return;
            rest.remove_prefix(end);
            continue;
        }
        if (!rest.starts_with(kEntity)) {
            rest.remove_prefix(2);
            continue;
        }
        rest = behind_blanks(rest.substr(kEntity.size()));
        // "%" begins a parameter entity, and a word in place of a quotation mark names a file.
        const std::size_t length = rest.find_first_of(kBlanks);
        if (length == std::string_view::npos) return;
        const std::string_view name = rest.substr(0, length);
        rest = behind_blanks(rest.substr(length));
        if (name == "%" || rest.empty() || (rest.front() != '"' && rest.front() != '\'')) continue;
        const std::size_t end = rest.find(rest.front(), 1);
        if (end == std::string_view::npos) return;
        const std::string_view value = rest.substr(1, end - 1);
        rest.remove_prefix(end + 1);
        if (values_.size() == kMost || value.size() > kLongest) continue;
        const std::optional<std::string> whole = expanded(value, kLongest);
        values_.emplace(name, whole.value_or(std::string(value)));
    }
}

std::optional<std::string> Entities::expanded(std::string_view value) {
    std::optional<std::string> made = expanded(value, kLongestValue);
    if (!made || made->size() > left_) return std::nullopt;
    left_ -= made->size();
    return made;
}

std::optional<std::string> Entities::expanded(std::string_view value, std::size_t longest) const {
    if (values_.empty()) return std::nullopt;
    std::string out;
    bool any = false;
    std::size_t done = 0;
    for (std::size_t at = value.find('&'); at != std::string_view::npos; at = value.find('&', at + 1)) {
        const std::size_t length = value.substr(at + 1, kLongestName).find(';');
        if (length == std::string_view::npos) continue;
        const std::size_t end = at + 1 + length;
        const auto known = values_.find(value.substr(at + 1, length));
        if (known == values_.end()) continue;
        out += value.substr(done, at - done);
        out += known->second;
        if (out.size() > longest) return std::nullopt;
        done = end + 1;
        at = end;
        any = true;
    }
    if (!any) return std::nullopt;
    out += value.substr(done);
    return out.size() > longest ? std::nullopt : std::optional(std::move(out));
}

}  // namespace popup::drawing
