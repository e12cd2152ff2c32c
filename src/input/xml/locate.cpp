#include "input/xml/locate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string>

#include "input/text.h"
#include "input/xml/encoding.h"
#include "input/xml/reference.h"

namespace popup::xml {
namespace {

// The names that tinyxml2 takes: letters, digits, ":", "_", "-", "." and everything outside ASCII.
bool starts_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == ':' || c == '_' ||
           (static_cast<unsigned char>(c) >= 0x80);
}
bool continues_name(char c) { return starts_name(c) || (c >= '0' && c <= '9') || c == '-' || c == '.'; }

class Scanner {
 public:
    Scanner(std::string_view text, Doctype doctype, Diagnostics& diagnostics)
        : text_(text), doctype_(doctype), places_(text), diagnostics_(diagnostics) {
        out_.text = text;
    }

    std::optional<Located> run() {
        // One "<" an element is a bound that is seldom far off; an untouched reserve costs nothing.
        const auto tags = static_cast<std::size_t>(std::count(text_.begin(), text_.end(), '<'));
        const auto attributes = static_cast<std::size_t>(std::count(text_.begin(), text_.end(), '='));
        out_.elements.reserve(std::min(tags, kMarkupLimit));
        out_.attributes.reserve(std::min(attributes, kMarkupLimit));
        at_ = text_.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
        start_ = at_;
        while (at_ < text_.size()) {
            if (!step()) return std::nullopt;
        }
        if (!open_.empty()) {
            const Offset last = open_.back();
            error(text_.size(), "xml-syntax",
                  fmt::format("the document ends inside <{}>, which begins on line {}",
                              shown(out_.name(last)), out_.elements[last].place.line))
                .hint("the file may have been cut off; every start tag needs its end tag");
            return std::nullopt;
        }
        if (out_.elements.empty()) {
            error(text_.size(), "xml-syntax", "the document has no element at all");
            return std::nullopt;
        }
        return std::move(out_);
    }

 private:
    // One piece of text, or one piece of markup. False after an error.
    bool step() {
        const auto* found =
            static_cast<const char*>(std::memchr(text_.data() + at_, '<', text_.size() - at_));
        const std::size_t next = found ? static_cast<std::size_t>(found - text_.data()) : text_.size();
        if (next > at_) return piece_of_text(next);
        const std::string_view rest = text_.substr(at_);
        if (rest.starts_with("</")) return end_tag();
        if (rest.starts_with("<!--")) return comment();
        if (rest.starts_with("<![CDATA[")) return cdata();
        if (doctype_ == Doctype::skip && rest.starts_with("<!DOCTYPE") && out_.elements.empty()) {
            return skip_doctype() && count_aside();
        }
        if (rest.starts_with("<!")) {
            error(at_, "doctype",
                  "a document type declaration (DTD) is not read, nor are entities defined in one")
                .hint("take the <!...> declaration out; popup documents need none");
            return false;
        }
        if (rest.starts_with("<?")) return instruction();
        return start_tag();
    }

    // Up to the ">" that stands in no quotes, comment or brackets.
    bool skip_doctype() {
        const std::size_t begin = at_;
        int brackets = 0;
        for (std::size_t at = at_; at < text_.size(); ++at) {
            const char c = text_[at];
            if (c == '"' || c == '\'') {
                at = text_.find(c, at + 1);
            } else if (text_.substr(at, 4) == "<!--") {
                at = text_.find("-->", at + 4);
            } else if (c == '[') {
                ++brackets;
            } else if (c == ']') {
                --brackets;
            } else if (c == '>' && brackets <= 0) {
                at_ = at + 1;
                return true;
            }
            if (at == std::string_view::npos) break;
        }
        error(begin, "xml-syntax", "this document type declaration has no end (\">\")");
        return false;
    }

    bool piece_of_text(std::size_t end) {
        const std::size_t begin = at_;
        std::size_t first = begin;
        while (first < end && is_blank(text_[first])) ++first;
        at_ = end;
        if (first == end) return true;
        if (open_.empty()) {
            const bool before = out_.elements.empty();
            error(first, "xml-syntax",
                  before ? "text stands before the first tag; this is not an XML document"
                         : "text stands behind the end of the document");
            return false;
        }
        const Place place = places_.at(first);
        if (!check_references(first, end)) return false;
        return add_text(begin, end, place, false);
    }

    bool cdata() {
        const std::size_t begin = at_ + 9;
        const Place place = places_.at(at_);
        if (open_.empty()) {
            error(at_, "xml-syntax", "a CDATA section stands outside the document's root element");
            return false;
        }
        return skip_to("]]>", 9, "CDATA section") && add_text(begin, at_ - 3, place, true);
    }

    bool add_text(std::size_t begin, std::size_t end, Place place, bool cdata) {
        if (!count_one()) return false;
        out_.texts.push_back({static_cast<Offset>(begin), static_cast<Offset>(end), place, cdata});
        return true;
    }

    bool skip_to(std::string_view closing, std::size_t opening, std::string_view what) {
        const std::size_t found = text_.find(closing, at_ + opening);
        if (found == std::string_view::npos) {
            error(at_, "xml-syntax", fmt::format("this {} has no end (\"{}\")", what, closing));
            return false;
        }
        at_ = found + closing.size();
        return true;
    }

    bool comment() {
        const std::size_t begin = at_ + 4;
        if (!skip_to("-->", 4, "comment")) return false;
        const std::size_t end = at_ - 3;
        std::size_t word = begin;
        while (word < end && is_blank(text_[word])) ++word;
        if (text_.substr(word, end - word).starts_with(kAddress)) {
            out_.comments.push_back({static_cast<Offset>(begin), static_cast<Offset>(end),
                                     open_.empty() ? kNoElement : open_.back(),
                                     static_cast<Offset>(out_.elements.size())});
        }
        return count_aside();
    }

    bool instruction() {
        const std::size_t begin = at_;
        if (!skip_to("?>", 2, "processing instruction")) return false;
        const std::string_view content = text_.substr(begin + 2, at_ - begin - 4);
        const bool declaration = content.starts_with("xml") && (content.size() == 3 || is_blank(content[3]));
        if (!declaration) {
            out_.instructions.push_back({static_cast<Offset>(begin), static_cast<Offset>(at_)});
            return count_aside();
        }
        if (begin == start_) return check_declared_encoding(content, begin);
        error(begin, "xml-syntax", "an XML declaration may stand only at the very start of the document");
        return false;
    }

    bool check_declared_encoding(std::string_view declaration, std::size_t begin) {
        const std::size_t word = declaration.find("encoding");
        if (word == std::string_view::npos) return true;
        const std::size_t open = declaration.find_first_of("\"'", word);
        if (open == std::string_view::npos) return true;
        const std::size_t close = declaration.find(declaration[open], open + 1);
        std::string name(
            declaration.substr(open + 1, close == std::string_view::npos ? close : close - open - 1));
        const std::string written = shown(name);
        name = lower(name);
        if (name == "utf-8" || name == "utf8" || name == "us-ascii" || name == "ascii") return true;
        error(begin + 2 + word, "encoding",
              fmt::format("the encoding is \"{}\", and only UTF-8 is read", written))
            .hint("save the document as UTF-8 and declare encoding=\"UTF-8\"");
        return false;
    }

    bool start_tag() {
        const std::size_t begin = at_;
        const Place place = places_.at(begin);
        if (begin + 1 >= text_.size() || !starts_name(text_[begin + 1])) {
            error(begin, "xml-syntax", "\"<\" does not begin a tag here")
                .hint("in text and values write &lt;");
            return false;
        }
        if (open_.empty() && !out_.elements.empty()) {
            error(begin, "xml-syntax", "a second root element stands behind the first");
            return false;
        }
        if (open_.size() >= kDepthLimit) {
            error(begin, "xml-syntax", fmt::format("tags are nested more than {} deep", kDepthLimit));
            return false;
        }
        if (!count_one()) return false;
        const auto index = static_cast<Offset>(out_.elements.size());
        LocatedElement element;
        element.begin = static_cast<Offset>(begin);
        element.first_attribute = static_cast<Offset>(out_.attributes.size());
        element.first_text = static_cast<Offset>(out_.texts.size());
        element.asides_before = out_.asides;
        element.place = place;
        element.after = index + 1;
        at_ = skip_name(begin + 1);
        bool empty = false;
        if (!attributes(element, empty)) return false;
        element.tag_end = element.end = static_cast<Offset>(at_);
        out_.elements.push_back(element);
        if (!empty) open_.push_back(index);
        return true;
    }

    // The rest of a start tag, up to and with its ">".
    bool attributes(const LocatedElement& element, bool& empty) {
        while (true) {
            const std::size_t before = at_;
            skip_blanks();
            if (at_ >= text_.size()) return tag_without_end(element);
            if (text_[at_] == '>') {
                ++at_;
                return unique_attributes(element.first_attribute);
            }
            if (text_.substr(at_).starts_with("/>")) {
                empty = true;
                at_ += 2;
                return unique_attributes(element.first_attribute);
            }
            if (!starts_name(text_[at_])) {
                if (text_[at_] == '<') return tag_without_end(element);
                error(at_, "xml-syntax",
                      fmt::format("'{}' may not stand in the tag <{}>", shown(text_.substr(at_, 1)),
                                  tag_name(element)));
                return false;
            }
            if (at_ == before) {
                error(at_, "xml-syntax", "a blank is missing between two attributes");
                return false;
            }
            // tinyxml2 compares each attribute with all before it.
            if (out_.attributes.size() - element.first_attribute >= kAttributesLimit) {
                error(at_, "document-too-large",
                      fmt::format("the tag <{}> has more than {} attributes", tag_name(element),
                                  kAttributesLimit));
                return false;
            }
            if (!attribute(element)) return false;
        }
    }

    bool attribute(const LocatedElement& element) {
        if (!count_one()) return false;
        LocatedAttribute made;
        made.place = places_.at(at_);
        made.name = static_cast<Offset>(at_);
        at_ = skip_name(at_);
        made.name_length = static_cast<Offset>(at_) - made.name;
        const std::string_view name = text_.substr(made.name, made.name_length);
        skip_blanks();
        if (at_ >= text_.size()) return tag_without_end(element);
        if (text_[at_] != '=') {
            error(made.name, "xml-syntax", fmt::format("the attribute '{}' has no value", shown(name)),
                  made.place)
                .hint(fmt::format("write {}=\"...\"", shown(name)));
            return false;
        }
        ++at_;
        skip_blanks();
        if (at_ >= text_.size()) return tag_without_end(element);
        const char quote = text_[at_];
        if (quote != '"' && quote != '\'') {
            error(at_, "xml-syntax", fmt::format("the value of '{}' does not stand in quotes", shown(name)));
            return false;
        }
        const std::size_t first = at_ + 1;
        const std::size_t close = text_.find(quote, first);
        const std::size_t less =
            text_.substr(first, close == std::string_view::npos ? close : close - first).find('<');
        if (less != std::string_view::npos || close == std::string_view::npos) {
            error(at_, "xml-syntax", fmt::format("the value of '{}' has no closing quote", shown(name)))
                .hint("a \"<\" inside a value is written &lt;");
            return false;
        }
        if (!check_references(first, close)) return false;
        made.value = static_cast<Offset>(first);
        made.value_length = static_cast<Offset>(close - first);
        at_ = close + 1;
        out_.attributes.push_back(made);
        return true;
    }

    bool tag_without_end(const LocatedElement& element) {
        error(element.begin, "xml-syntax", "this tag has no end (\">\")", element.place);
        return false;
    }

    // XML forbids the same attribute twice in a tag.
    bool unique_attributes(std::size_t first) {
        const std::size_t count = out_.attributes.size() - first;
        if (count < 2) return true;
        const auto name = [&](const LocatedAttribute& a) {
            return std::string_view(text_.data() + a.name, a.name_length);
        };
        // Two, which is what points have, are compared in place; what is wrong is told below.
        if (count == 2 && name(out_.attributes[first]) != name(out_.attributes[first + 1])) return true;
        order_.assign(out_.attributes.begin() + static_cast<std::ptrdiff_t>(first), out_.attributes.end());
        std::sort(order_.begin(), order_.end(), [&](const LocatedAttribute& a, const LocatedAttribute& b) {
            return name(a) != name(b) ? name(a) < name(b) : a.name < b.name;
        });
        const auto twice = std::adjacent_find(
            order_.begin(), order_.end(),
            [&](const LocatedAttribute& a, const LocatedAttribute& b) { return name(a) == name(b); });
        if (twice == order_.end()) return true;
        error(twice[1].name, "xml-syntax",
              fmt::format("the attribute '{}' stands twice in one tag", shown(name(*twice))), twice[1].place);
        return false;
    }

    bool end_tag() {
        const std::size_t begin = at_;
        const std::size_t stop = skip_name(begin + 2);
        const std::string_view name = text_.substr(begin + 2, stop - begin - 2);
        at_ = stop;
        skip_blanks();
        if (at_ >= text_.size() || text_[at_] != '>') {
            error(begin, "xml-syntax", "this end tag has no end (\">\")");
            return false;
        }
        ++at_;
        if (open_.empty()) {
            error(begin, "xml-syntax", fmt::format("</{}> ends nothing", shown(name)));
            return false;
        }
        const Offset index = open_.back();
        if (out_.name(index) != name) {
            error(begin, "xml-syntax",
                  fmt::format("</{}> stands where <{}> of line {} should end", shown(name),
                              shown(out_.name(index)), out_.elements[index].place.line));
            return false;
        }
        open_.pop_back();
        out_.elements[index].end = static_cast<Offset>(at_);
        out_.elements[index].after = static_cast<Offset>(out_.elements.size());
        return true;
    }

    bool check_references(std::size_t begin, std::size_t end) {
        using Fault = Reference::Fault;
        // Never looks behind `end`: a search to the end of the text would make the whole quadratic.
        const std::string_view part = text_.substr(0, end);
        for (std::size_t at = part.find('&', begin); at != std::string_view::npos; at = part.find('&', at)) {
            const Reference reference = read_reference(part.substr(at));
            const std::string written = shown(text_.substr(at, reference.length));
            switch (reference.fault) {
                case Fault::none:
                    break;
                case Fault::no_reference:
                    error(at, "xml-syntax", "\"&\" does not begin a reference here").hint("write &amp;");
                    return false;
                case Fault::unknown_entity:
                    if (doctype_ == Doctype::skip) break;
                    error(at, "xml-syntax", fmt::format("the entity {} is not defined", written));
                    return false;
                case Fault::forbidden_character:
                    error(at, "bad-character",
                          fmt::format("{} stands for a character that XML forbids", written));
                    return false;
            }
            at += reference.length;
        }
        return true;
    }

    bool count_aside() {
        ++out_.asides;
        return count_one();
    }

    bool count_one() {
        if (++counted_ <= kMarkupLimit) return true;
        error(at_, "document-too-large",
              fmt::format("the document has more than {} elements, attributes, texts and comments",
                          kMarkupLimit));
        return false;
    }

    [[nodiscard]] std::size_t skip_name(std::size_t at) const {
        while (at < text_.size() && continues_name(text_[at])) ++at;
        return at;
    }
    void skip_blanks() {
        while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    }
    [[nodiscard]] std::string tag_name(const LocatedElement& element) const {
        return shown(text_.substr(element.begin + 1, skip_name(element.begin + 1) - element.begin - 1));
    }

    // Every error is the last thing that is looked at, so a place that lies back may be counted anew.
    Diagnostic& error(std::size_t offset, std::string_view code, std::string message, Place place = {}) {
        return diagnostics_.error(code, place.line ? place : PlaceCounter(text_).at(offset),
                                  std::move(message));
    }

    std::string_view text_;
    Doctype doctype_;
    PlaceCounter places_;
    Diagnostics& diagnostics_;
    Located out_;
    std::vector<Offset> open_;
    std::vector<LocatedAttribute> order_;
    std::size_t at_ = 0;
    std::size_t start_ = 0;
    std::size_t counted_ = 0;
};

}  // namespace

std::string_view Located::name(Offset element) const {
    const std::size_t begin = elements[element].begin + 1;
    std::size_t end = begin;
    while (end < text.size() && continues_name(text[end])) ++end;
    return text.substr(begin, end - begin);
}

std::optional<Located> locate(std::string_view text, Diagnostics& diagnostics, Doctype doctype) {
    if (text.size() >= std::numeric_limits<Offset>::max()) {
        diagnostics.error("document-too-large", {}, fmt::format("the document has {} bytes", text.size()));
        return std::nullopt;
    }
    return Scanner(text, doctype, diagnostics).run();
}

std::vector<Offset> decoded_offsets(std::string_view raw, bool references) {
    std::vector<Offset> offsets;
    offsets.reserve(raw.size() + 1);
    for (std::size_t at = 0; at < raw.size();) {
        if (references && raw[at] == '&') {
            const Reference reference = read_reference(raw.substr(at));
            offsets.insert(offsets.end(), reference.utf8_length, static_cast<Offset>(at));
            at += reference.length;
        } else {
            // tinyxml2 takes "\n\r" as one line end, too.
            const std::string_view pair = raw.substr(at, 2);
            offsets.push_back(static_cast<Offset>(at));
            at += pair == "\r\n" || pair == "\n\r" ? 2 : 1;
        }
    }
    offsets.push_back(static_cast<Offset>(raw.size()));
    return offsets;
}

}  // namespace popup::xml
