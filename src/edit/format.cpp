// A document in its canonical spelling, with the comments that it had.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "input/text.h"
#include "input/xml/read.h"
#include "output/xml.h"
#include "popup/edit.h"

namespace popup {
namespace {

// A place that both texts have, by offset.
struct Anchor {
    std::size_t from = 0, to = 0;
    bool end = false;  // of what a comment before it stands in
};

// Places count code points.
std::size_t offset_of(std::string_view text, Place place) {
    std::size_t at = 0;
    for (int line = 1; line < place.line && at < text.size(); ++line)
        at = std::min(text.size(), text.find('\n', at)) + 1;
    for (int column = 1; column < place.column && at < text.size(); ++at) {
        const bool whole =
            at + 1 >= text.size() || (static_cast<unsigned char>(text[at + 1]) & 0xc0U) != 0x80U;
        if (whole) ++column;
    }
    return std::min(at, text.size());
}

struct Comment {
    std::size_t at = 0;
    std::string_view text;  // from "<!--" to behind "-->"; an instruction is one, too
};

std::vector<Comment> comments_of(std::string_view text) {
    std::vector<Comment> found;
    for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at)) {
        const std::string_view rest = text.substr(at);
        std::string_view end = ">";
        const bool comment = rest.starts_with("<!--");
        const bool instruction = rest.starts_with("<?");
        if (comment) end = "-->";
        if (instruction) end = "?>";
        if (rest.starts_with("<![CDATA[")) end = "]]>";
        const std::size_t stop = std::min(text.size(), text.find(end, at + (comment ? 4 : 1)) + end.size());
        const bool declaration =
            instruction && rest.size() > 5 && rest.starts_with("<?xml") && is_blank(rest[5]);
        if ((comment || instruction) && !declaration) found.push_back({at, text.substr(at, stop - at)});
        at = comment || instruction || end == "]]>" ? stop : at + 1;
    }
    return found;
}

class Anchors {
 public:
    Anchors(std::string_view from, std::string_view to) : from_(from), to_(to) {}

    std::vector<Anchor> of(const Design& a, const Design& b) {
        add(a.root_text, b.root_text);
        add_end(a.root_text, b.root_text);
        all_.push_back({offset_of(from_, a.page_place), offset_of(to_, b.page_place)});
        add(a.list_text, b.list_text);
        add_end(a.list_text, b.list_text);
        for (std::size_t i = 0; i < a.structures.size() && i < b.structures.size(); ++i)
            add(a.structures[i], b.structures[i]);
        for (std::size_t i = 0; i < a.lines.size() && i < b.lines.size(); ++i) {
            add(a.lines[i].tag_text, b.lines[i].tag_text);
            add(a.lines[i].points, b.lines[i].points);
            add_end(a.lines[i].tag_text, b.lines[i].tag_text);
        }
        for (std::size_t i = 0; i < a.prints.size() && i < b.prints.size(); ++i)
            add(a.prints[i].tag_text, b.prints[i].tag_text);
        std::sort(all_.begin(), all_.end(), [](Anchor x, Anchor y) { return x.from < y.from; });
        return std::move(all_);
    }

 private:
    void add(TextRange a, TextRange b) {
        if (a.present() && b.present()) all_.push_back({a.offset, b.offset});
    }
    // The end tags, where both have one.
    void add_end(TextRange a, TextRange b) {
        if (!a.present() || !b.present()) return;
        const auto end = [](std::string_view text, TextRange range) {
            return text.substr(range.offset, range.length).rfind("</");
        };
        const std::size_t i = end(from_, a);
        const std::size_t j = end(to_, b);
        if (i != std::string_view::npos && j != std::string_view::npos)
            all_.push_back({a.offset + i, b.offset + j, true});
    }
    void add(const std::vector<DesignPoint>& a, const std::vector<DesignPoint>& b) {
        for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
            add(a[i].tag_text.present() ? a[i].tag_text : a[i].x_text, b[i].tag_text);
    }
    void add(const Structure& a, const Structure& b) {
        add(a.tag_text, b.tag_text);
        add_end(a.tag_text, b.tag_text);
        add(a.points, b.points);
        add(a.fold.tag_text, b.fold.tag_text);
        if (a.fold.begin.tag_text.present()) add(a.fold.begin.tag_text, b.fold.begin.tag_text);
        if (a.fold.end.tag_text.present()) add(a.fold.end.tag_text, b.fold.end.tag_text);
        if (a.plate && b.plate) add(a.plate->tag_text, b.plate->tag_text);
        for (std::size_t i = 0; i < a.arguments.size() && i < b.arguments.size(); ++i) {
            const Argument& x = a.arguments[i];
            const Argument& y = b.arguments[i];
            add(x.tag_text.present() ? x.tag_text : x.text, y.tag_text.present() ? y.tag_text : y.text);
        }
    }
    std::string_view from_, to_;
    std::vector<Anchor> all_;
};

std::size_t line_begin(std::string_view text, std::size_t at) {
    const std::size_t before = at == 0 ? std::string_view::npos : text.rfind('\n', at - 1);
    return before == std::string_view::npos ? 0 : before + 1;
}

// Puts each comment before what stood behind it, or behind what stood before it on its line.
std::string with_comments(std::string_view from, const std::string& to, const std::vector<Anchor>& anchors) {
    struct Insertion {
        std::size_t at;
        std::string text;
    };
    std::vector<Insertion> insertions;
    for (const Comment& comment : comments_of(from)) {
        const auto next =
            std::find_if(anchors.begin(), anchors.end(), [&](Anchor a) { return a.from >= comment.at; });
        const bool trails = next != anchors.begin() && std::prev(next)->from >= line_begin(from, comment.at);
        std::string text(comment.text);
        std::erase(text, '\r');
        if (trails) {
            const std::size_t end = std::min(to.size(), to.find('\n', std::prev(next)->to));
            insertions.push_back({end, "  " + text});
        } else if (next != anchors.end()) {
            const std::size_t begin = line_begin(to, next->to);
            insertions.push_back({begin, to.substr(begin, to.find_first_not_of(' ', begin) - begin) +
                                             (next->end ? "  " : "") + text + "\n"});
        } else {
            insertions.push_back({to.size(), text + "\n"});
        }
    }
    std::stable_sort(insertions.begin(), insertions.end(),
                     [](const Insertion& a, const Insertion& b) { return a.at < b.at; });
    std::string made;
    std::size_t done = 0;
    for (const Insertion& one : insertions) {
        made += to.substr(done, one.at - done) + one.text;
        done = one.at;
    }
    return made + to.substr(done);
}

}  // namespace

std::optional<std::string> format_document(const Source& source, Diagnostics& diagnostics) {
    ReadOptions strict;
    strict.strict = true;  // what is not understood would be lost
    const auto design = xml::read(source, strict, diagnostics);
    if (!design) return std::nullopt;
    const std::string plain = write_document(*design, source.text);
    Diagnostics trouble(source.name);
    const auto again = xml::read({source.name, plain}, strict, trouble);
    POPUP_INVARIANT(again);
    return with_comments(source.text, plain, Anchors(source.text, plain).of(*design, *again));
}

}  // namespace popup
