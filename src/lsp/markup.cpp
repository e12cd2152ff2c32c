#include "lsp/markup.h"

#include <algorithm>

#include "input/text.h"

namespace popup::lsp {
namespace {

using xml::Name;

// Elements within one another beyond this are taken as if they stood beside one another.
constexpr std::size_t kDeepest = 100;

bool is_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.' || c == ':' || static_cast<unsigned char>(c) >= 0x80;
}

class Scanner {
 public:
    explicit Scanner(std::string_view text) : text_(text) {}

    Markup run() {
        while (at_ < text_.size()) {
            at_ = text_.find('<', at_);
            if (at_ == std::string_view::npos) break;
            const std::string_view rest = text_.substr(at_);
            if (rest.starts_with("<!--")) {
                comment();
            } else if (rest.starts_with("<![CDATA[")) {
                skip_to("]]>");
            } else if (rest.starts_with("<?")) {
                skip_to("?>");
            } else if (rest.starts_with("<!")) {
                skip_to(">");
            } else if (rest.starts_with("</")) {
                end_tag();
            } else {
                start_tag();
            }
        }
        while (!open_.empty()) close(text_.size());
        return std::move(out_);
    }

 private:
    void skip_to(std::string_view end) {
        const std::size_t found = text_.find(end, at_ + 2);
        at_ = found == std::string_view::npos ? text_.size() : found + end.size();
    }

    // One that does not end is as long as its line: it is being typed, and what comes after it stays.
    void comment() {
        const std::size_t begin = at_;
        if (comment_end_ < at_ + 4) comment_end_ = text_.find("-->", at_ + 4);
        const std::size_t end = comment_end_;
        const std::size_t next = text_.find("<!--", at_ + 4);
        if (end == std::string_view::npos || next < end) {
            at_ = std::min(text_.find('\n', at_), text_.size());
        } else {
            at_ = end + 3;
        }
        out_.comments.push_back({{begin, at_}});
    }

    Span name() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && is_name(text_[at_])) ++at_;
        return {begin, at_};
    }
    void skip_blanks() {
        while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    }
    [[nodiscard]] std::string_view word(Span span) const { return text_.substr(span.begin, span.size()); }

    void close(std::size_t end) {
        MarkupElement& element = out_.elements[open_.back()];
        element.end = end;
        element.after = out_.elements.size();
        open_.pop_back();
    }

    [[nodiscard]] Name context() const {
        return open_.empty() ? Name::document : out_.elements[open_.back()].what;
    }

    // An element that cannot stand here, and can where an open one does, ends that one.
    void close_for(std::string_view spelling, std::size_t begin) {
        if (open_.size() >= kDeepest) close(begin);
        if (open_.empty() || meaning(context(), spelling) != Name::unknown) return;
        for (std::size_t depth = open_.size() - 1; depth-- > 0;) {
            const Name what = meaning(out_.elements[open_[depth]].what, spelling);
            if (what == Name::unknown || xml::is_scalar(what)) continue;
            while (open_.size() > depth + 1) close(begin);
            return;
        }
    }

    void start_tag() {
        MarkupElement made;
        made.begin = at_;
        ++at_;
        made.name = name();
        close_for(word(made.name), made.begin);
        made.parent = open_.empty() ? -1 : static_cast<int>(open_.back());
        made.what = meaning(context(), word(made.name));
        made.first = out_.attributes.size();
        attributes(made);
        made.count = out_.attributes.size() - made.first;
        made.tag = {made.begin, at_};
        made.end = at_;
        out_.elements.push_back(made);
        out_.elements.back().after = out_.elements.size();
        // A "<" alone has no content.
        if (!made.empty && made.name.size() > 0) open_.push_back(out_.elements.size() - 1);
    }

    void attributes(MarkupElement& made) {
        for (;;) {
            skip_blanks();
            if (at_ >= text_.size() || text_[at_] == '<') return;
            if (text_[at_] == '>') {
                ++at_;
                made.closed_tag = true;
                return;
            }
            if (text_.substr(at_, 2) == "/>") {
                at_ += 2;
                made.closed_tag = made.empty = true;
                return;
            }
            if (!is_name(text_[at_])) {
                ++at_;
                continue;
            }
            MarkupAttribute attribute;
            attribute.name = name();
            attribute.value = {at_, at_};
            const std::size_t behind = at_;
            skip_blanks();
            if (at_ < text_.size() && text_[at_] == '=') {
                ++at_;
                value(attribute);
            } else {
                at_ = behind;
            }
            out_.attributes.push_back(attribute);
        }
    }

    // A value that is not closed ends with its line.
    void value(MarkupAttribute& attribute) {
        const std::size_t behind = at_;
        skip_blanks();
        if (at_ >= text_.size() || (text_[at_] != '"' && text_[at_] != '\'')) {
            at_ = behind;
            attribute.value = {at_, at_};
            return;
        }
        const char quote = text_[at_++];
        const std::size_t begin = at_;
        const std::size_t close = std::min(text_.find(quote, begin), text_.size());
        const std::size_t tag = std::min(text_.find('<', begin), text_.size());
        if (close < tag) {
            attribute.value = {begin, close};
            attribute.quoted = true;
            at_ = close + 1;
            return;
        }
        std::size_t end = std::min({text_.find_first_of("\r\n", begin), text_.find('>', begin), tag});
        if (end > begin && end < text_.size() && text_[end] == '>' && text_[end - 1] == '/') --end;
        attribute.value = {begin, end};
        at_ = end;
    }

    void end_tag() {
        const std::size_t begin = at_;
        at_ += 2;
        const Span end_name = name();
        skip_blanks();
        if (at_ < text_.size() && text_[at_] == '>') ++at_;
        const auto same = [&](std::size_t element) {
            return word(out_.elements[element].name) == word(end_name);
        };
        const auto found = std::find_if(open_.rbegin(), open_.rend(), same);
        if (found == open_.rend()) return;
        const std::size_t depth = static_cast<std::size_t>(open_.rend() - found) - 1;
        while (open_.size() > depth + 1) close(begin);
        out_.elements[open_.back()].end_name = end_name;
        close(at_);
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t comment_end_ = 0;  // the first "-->" behind what was asked for last
    Markup out_;
    std::vector<std::size_t> open_;
};

}  // namespace

Name meaning(Name context, std::string_view spelling) {
    const Name name = xml::find_name(context, spelling);
    if (name != Name::unknown || (context != Name::structure && context != Name::folds)) return name;
    return xml::find_parameter_name(spelling).empty() ? Name::unknown : Name::argument;
}

Markup read_markup(std::string_view text) { return Scanner(text).run(); }

int Markup::at(std::size_t offset) const {
    // The last that begins before it, or one around that.
    const auto behind = std::partition_point(
        elements.begin(), elements.end(), [offset](const MarkupElement& one) { return one.begin < offset; });
    int found = static_cast<int>(behind - elements.begin()) - 1;
    while (found >= 0) {
        const MarkupElement& one = elements[static_cast<std::size_t>(found)];
        const bool ends = one.end_name.size() > 0 || one.empty;
        if (offset < one.end || (!ends && offset == one.end)) return found;
        found = one.parent;
    }
    return -1;
}

std::vector<int> Markup::children(int element) const {
    std::vector<int> found;
    const std::size_t end = element < 0 ? elements.size() : elements[static_cast<std::size_t>(element)].after;
    for (std::size_t i = static_cast<std::size_t>(element) + 1; i < end; i = elements[i].after)
        found.push_back(static_cast<int>(i));
    return found;
}

}  // namespace popup::lsp
