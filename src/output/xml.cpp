#include "output/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "assembly/orientation_names.h"
#include "base/nth.h"
#include "input/xml/number.h"
#include "input/xml/page_names.h"
#include "input/xml/path_text.h"
#include "input/xml/structure_text.h"
#include "output/markup.h"
#include "popup/check.h"
#include "popup/mechanism.h"

namespace popup {
namespace {

class DocumentText {
 public:
    DocumentText(const Design& design, std::string_view source)
        : design_(design), source_(source), version_(version_of(design)), pages_(design, version_) {}

    std::string run() {
        line(0, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
        line(0, "<popup version=\"{}\" units=\"{}\">", version_, design_.unit.name);
        std::string facts =
            opens_less(design_) ? fmt::format(" opens=\"{}\"", xml::format_number(design_.opens_deg)) : "";
        if (design_.orientation != Orientation::guessed)
            facts += fmt::format(" orientation=\"{}\"", nth(kOrientationNames, design_.orientation));
        line(1, "<mainpage width=\"{}\" height=\"{}\"{}{}", length(design_.width_mm),
             length(design_.height_mm), facts, design_.left || design_.right ? ">" : "/>");
        if (design_.left || design_.right) {
            color(2, "leftcolor", design_.left);
            color(2, "rightcolor", design_.right);
            line(1, "</mainpage>");
        }
        structures();
        drawn_lines();
        line(0, "</popup>");
        return fmt::to_string(out_);
    }

 private:
    template <class... Arguments>
    void line(int depth, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
        for (int i = 0; i < depth; ++i) out_.append(std::string_view("  "));
        fmt::format_to(std::back_inserter(out_), text, std::forward<Arguments>(arguments)...);
        out_.push_back('\n');
    }

    [[nodiscard]] std::string length(double mm) const { return xml::format_number(mm / design_.unit.mm); }

    static const ElementInfo& info_of(const Structure& structure) {
        const ElementInfo* info = find_element(structure.type);
        POPUP_INVARIANT(info != nullptr);
        return *info;
    }

    static bool opens_less(const Design& design) { return design.opens_deg < 180.0; }

    // Elements that Popup Workshop did not have need the newer version.
    static std::string_view version_of(const Design& design) {
        std::string_view version = design.version;
        for (const Structure& s : design.structures) {
            if (s.dropped) continue;
            version = std::max(version, version_needed(info_of(s), s.arguments));
            if (s.named().given()) version = std::max(version, std::string_view("3.0"));
        }
        const auto kept = [](const DrawnPrint& print) { return !print.dropped; };
        if (opens_less(design) || design.orientation != Orientation::guessed ||
            std::any_of(design.prints.begin(), design.prints.end(), kept))
            version = std::max(version, std::string_view("3.0"));
        return version;
    }

    void color(int depth, std::string_view name, const std::optional<Color>& value) {
        if (value) line(depth, "<{0}>{1}</{0}>", name, to_string(*value));
    }

    void point(int depth, const DesignPoint& p) {
        line(depth, "<point x=\"{}\" y=\"{}\"/>", length(p.at.x), length(p.at.y));
    }

    void structures() {
        line(1, "<structurelist>");
        std::size_t number = 0;
        for (const Structure& s : design_.structures) {
            if (s.dropped) continue;
            // An automatic id is left to the reader, unless it would now give another.
            ++number;
            const bool automatic = !s.id_given && s.id == fmt::format("e{}", number);
            out_.append(xml::structure_text(design_, s, pages_, "    ", automatic, source_));
        }
        line(1, "</structurelist>");
    }

    // The attributes of a place on a page.
    [[nodiscard]] std::string at(const DrawnPrint& print) const {
        return fmt::format(" page=\"{}\" x=\"{}\" y=\"{}\"", pages_.of(print.page), length(print.at.at.x),
                           length(print.at.at.y));
    }
    static std::string turn(const DrawnPrint& print) {
        if (print.rotate_deg == 0.0) return {};
        return fmt::format(" rotate=\"{}\"", xml::format_number(print.rotate_deg));
    }

    void printed(const DrawnPrint& print, const DrawnImage& image) {
        std::string more = turn(print);
        if (image.fit != PictureFit::stretch)
            more += fmt::format(" fit=\"{}\"", kPictureFitNames.at(static_cast<std::size_t>(image.fit)));
        if (image.horizon) more += fmt::format(" horizon=\"{}\"", xml::format_number(*image.horizon));
        if (image.horizon_mm) more += fmt::format(" horizonheight=\"{}\"", length(*image.horizon_mm));
        line(2, "<image{} width=\"{}\" height=\"{}\"{} href=\"{}\"/>", at(print), length(image.width_mm),
             length(image.height_mm), more, as_markup(image.href));
    }

    void printed(const DrawnPrint& print, const DrawnText& text) {
        std::string more = turn(print);
        if (text.font != TextFont::sans) more += fmt::format(" font=\"{}\"", to_string(text.font));
        line(2, "<text{} height=\"{}\"{} fill=\"{}\">{}</text>", at(print), length(text.height_mm), more,
             to_string(text.fill), as_markup(text.text));
    }

    void printed(const DrawnPrint& print, const DrawnArea& area) {
        line(2, "<area page=\"{}\" fill=\"{}\" d=\"{}\"/>", pages_.of(print.page), to_string(area.fill),
             as_markup(xml::path_text(area.shape, design_.unit)));
    }

    void drawn_lines() {
        const auto kept = [](const auto& drawn) { return !drawn.dropped; };
        if (std::none_of(design_.lines.begin(), design_.lines.end(), kept) &&
            std::none_of(design_.prints.begin(), design_.prints.end(), kept))
            return;
        line(1, "<drawnlinelist>");
        for (const DrawnPrint& print : design_.prints) {
            if (!print.dropped) std::visit([&](const auto& what) { printed(print, what); }, print.what);
        }
        for (const DrawnLine& l : design_.lines) {
            if (l.dropped) continue;
            line(2, "<drawnline page=\"{}\" thickness=\"{}\" color=\"{}\">", pages_.of(l.page),
                 xml::format_number(l.thickness_pt), to_string(l.color));
            for (const DesignPoint& p : l.points) point(3, p);
            line(2, "</drawnline>");
        }
        line(1, "</drawnlinelist>");
    }

    const Design& design_;
    std::string_view source_;
    std::string_view version_;
    xml::PageNames pages_;
    fmt::memory_buffer out_;
};

}  // namespace

std::string write_document(const Design& design, std::string_view source) {
    return DocumentText(design, source).run();
}

std::optional<std::string> write_xml(const CheckedDesign& design, const OutputOptions&, Diagnostics&) {
    return write_document(design.design());
}

}  // namespace popup
