// Repairs written over the author's own text.
#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/text.h"
#include "input/xml/number.h"
#include "input/xml/page_names.h"
#include "input/xml/path_text.h"
#include "input/xml/read.h"
#include "input/xml/structure_text.h"
#include "popup/mechanism.h"

namespace popup::xml {
namespace {

class Patch {
 public:
    Patch(std::string_view text, const Design& design)
        : text_(text), design_(design), pages_(design, design.version) {}

    std::vector<PatchEdit> run(std::span<const TextRange> gone) {
        for (const TextRange& one : gone) remove(one);
        add_structures();
        if (design_.version_changed) version();
        for (const Structure& structure : design_.structures) {
            if (structure.added) continue;
            if (structure.dropped) {
                remove(structure.tag_text);
            } else {
                structure_edits(structure);
            }
        }
        for (const DrawnLine& line : design_.lines) {
            if (line.dropped) {
                remove(line.tag_text);
                continue;
            }
            page_number(line.page_text, line.page, line.page_changed);
            for (const DesignPoint& point : line.points) point_edits(point, line.page);
        }
        for (const DrawnPrint& print : design_.prints) print_edits(print);
        std::stable_sort(edits_.begin(), edits_.end(),
                         [](const PatchEdit& a, const PatchEdit& b) { return a.begin < b.begin; });
        return std::move(edits_);
    }

 private:
    // The blanks before a place, where nothing else stands before it on its line.
    [[nodiscard]] std::optional<std::string_view> indent_at(std::size_t at) const {
        std::size_t begin = at;
        while (begin > 0 && (text_[begin - 1] == ' ' || text_[begin - 1] == '\t')) --begin;
        if (begin > 0 && text_[begin - 1] != '\n') return std::nullopt;
        return text_.substr(begin, at - begin);
    }

    // Writes into an element, before its end tag; one that has none gets one.
    void append_to(TextRange element, std::string_view name, const std::string& inside) {
        const std::string_view whole = text_.substr(element.offset, element.length);
        const std::size_t end = whole.rfind("</");
        if (whole.ends_with("/>") || end == std::string_view::npos) {
            const std::size_t slash = element.offset + element.length - 2;
            const std::string outer(indent_at(element.offset).value_or(""));
            return edits_.push_back(
                {slash, slash + 2, in_lines(">\n" + inside + outer + "</" + std::string(name) + ">")});
        }
        const std::size_t at = element.offset + end;
        if (const auto indent = indent_at(at)) {
            edits_.push_back({at - indent->size(), at - indent->size(), in_lines(inside)});
        } else {
            edits_.push_back({at, at, in_lines("\n" + inside)});
        }
    }

    // With the line ends that the document has.
    [[nodiscard]] std::string in_lines(const std::string& text) const {
        if (text_.find("\r\n") == std::string_view::npos) return text;
        std::string made;
        for (const char c : text) made += c == '\n' ? "\r\n" : std::string(1, c);
        return made;
    }

    void add_structures() {
        const Structure* last = nullptr;
        for (const Structure& structure : design_.structures) {
            if (!structure.added && structure.tag_text.present()) last = &structure;
        }
        const auto& list = design_.list_text;
        const auto outer = list.present() ? indent_at(list.offset) : indent_at(design_.root_text.offset);
        std::string indent(outer.value_or(""));
        for (int i = list.present() ? 1 : 2; i > 0; --i) indent += indent_step(indent);
        const bool listed = last != nullptr && list.present() && last->tag_text.offset > list.offset &&
                            last->tag_text.offset < list.offset + list.length;
        if (listed) indent = indent_at(last->tag_text.offset).value_or(indent);
        std::string inside;
        for (const Structure& structure : design_.structures) {
            if (structure.added && !structure.dropped)
                inside += structure_text(design_, structure, pages_, indent, false);
        }
        if (inside.empty()) return;
        if (list.present()) return append_to(list, "structurelist", inside);
        std::string around(outer.value_or(""));
        around += indent_step(around);
        append_to(design_.root_text, "popup",
                  around + "<structurelist>\n" + inside + around + "</structurelist>\n");
    }

    void version() {
        if (design_.version_text.present()) return replace(design_.version_text, design_.version);
        attribute(design_.root_tag, "version", design_.version);
    }

    void structure_edits(const Structure& structure) {
        if (structure.type_changed) type(structure);
        if (structure.id_changed) id(structure);
        for (const DesignPoint& point : structure.points) point_edits(point, structure.ground_page());
        argument_edits(structure);
        if (structure.named().given()) {
            if (structure.named().changed) replace(structure.named().range, structure.named().text);
            return;
        }
        if (structure.plate) return plate_edits(*structure.plate);
        if (structure.finds_ground) return;
        const ParentFold& fold = structure.fold;
        page(fold.page_text, fold.tag_text, fold.page, fold.page_changed);
        for (const DesignPoint* end : {&fold.begin, &fold.end}) {
            // Where an end of the fold names the page as well, the two must go on agreeing.
            page_number(end->page_text, fold.page, fold.page_changed);
            if (end->changed) coordinates(*end);
        }
    }

    void print_edits(const DrawnPrint& print) {
        if (print.dropped) return remove(print.tag_text);
        page_number(print.page_text, print.page, print.page_changed);
        if (print.at.changed) {
            coordinates(print.at);
            number(print.rotate_text, print.rotate_deg);
        }
        const auto* area = std::get_if<DrawnArea>(&print.what);
        if (area != nullptr && area->shape.moved) replace(area->d_text, path_text(area->shape, design_.unit));
    }

    void plate_edits(const ParentPlate& plate) {
        if (plate.at.changed) coordinates(plate.at);
        page(plate.page_text, plate.tag_text, plate.page, plate.page_changed);
    }

    void argument_edits(const Structure& structure) {
        const ElementInfo* info = find_element(structure.type);
        POPUP_INVARIANT(info != nullptr && structure.arguments.size() <= info->parameters.size());
        for (std::size_t i = 0; i < structure.arguments.size(); ++i) {
            const Argument& argument = structure.arguments[i];
            if (argument.page) page_number(argument.page_text, *argument.page, argument.changed);
            if (!argument.changed) continue;
            if (!argument.given()) {
                take_out(argument);
                continue;
            }
            const ParameterInfo& parameter = info->parameters[i];
            if (const auto* points = std::get_if<std::vector<DesignPoint>>(&argument.value)) {
                for (const DesignPoint& point : *points) coordinates(point);
            } else if (const auto* value = std::get_if<double>(&argument.value)) {
                const double unit = parameter.kind == ParameterKind::length ? design_.unit.mm : 1.0;
                if (argument.text.present()) {
                    number(argument.text, *value / unit);
                } else {
                    attribute(structure.start_tag, parameter.name, format_number(*value / unit));
                }
            } else if (const auto* color = std::get_if<Color>(&argument.value)) {
                word(argument, structure, parameter, to_string(*color));
            } else if (const auto* chosen = std::get_if<std::string>(&argument.value)) {
                word(argument, structure, parameter, *chosen);
            } else if (const auto* path = std::get_if<DrawnPath>(&argument.value)) {
                if (argument.text.present())
                    replace(argument.text, path_text(*path, design_.unit));
                else if (!argument.tag_text.present())  // what a file draws stays there
                    attribute(structure.start_tag, parameter.name, path_text(*path, design_.unit));
            }
        }
    }

    void word(const Argument& argument, const Structure& structure, const ParameterInfo& parameter,
              const std::string& text) {
        if (argument.text.present()) return replace(argument.text, text);
        attribute(structure.start_tag, parameter.name, text);
    }

    // An element of its own, or an attribute with the blanks before it.
    void take_out(const Argument& argument) {
        if (argument.tag_text.present()) {
            std::size_t end = argument.tag_text.offset + argument.tag_text.length;
            if (!text_.substr(0, end).ends_with("/>"))
                end = std::min(text_.find('>', text_.find("</", end)), text_.size() - 1) + 1;
            return remove({argument.tag_text.offset, end - argument.tag_text.offset});
        }
        if (!argument.text.present()) return;
        std::size_t begin = text_.rfind('=', argument.text.offset);
        while (begin > 0 && is_blank(text_[begin - 1])) --begin;
        while (begin > 0 && !is_blank(text_[begin - 1])) --begin;
        while (begin > 0 && is_blank(text_[begin - 1])) --begin;
        // Behind the value stands its quote.
        edits_.push_back({begin, argument.text.offset + argument.text.length + 1, std::string()});
    }

    void replace(TextRange at, std::string text) {
        if (text_.substr(at.offset, at.length) == text) return;
        edits_.push_back({at.offset, at.offset + at.length, std::move(text)});
    }

    void point_edits(const DesignPoint& point, int default_page) {
        const bool has_page = point.page || point.page_text.present();
        if (has_page) page(point.page_text, point.tag_text, point.page.value_or(default_page), point.changed);
        if (point.changed) coordinates(point);
    }

    void coordinates(const DesignPoint& point) {
        number(point.x_text, point.at.x / design_.unit.mm);
        number(point.y_text, point.at.y / design_.unit.mm);
    }

    // A number that is the same as written keeps its digits.
    void number(TextRange at, double value) {
        if (!at.present()) return;
        const ParsedNumber old = parse_number(text_.substr(at.offset, at.length));
        std::string text = format_number(value);
        if (old.fault == NumberFault::none && format_number(old.value) == text) return;
        edits_.push_back({at.offset, at.offset + at.length, std::move(text)});
    }

    // A page that is written as the id of its element goes on being so, whatever that is called now; one that
    // is written as a number, too.
    void page_number(TextRange at, int value, bool changed) {
        if (!at.present()) return;
        const std::string_view old = text_.substr(at.offset, at.length);
        if (!is_id(old)) {
            if (changed) number(at, value);
        } else if (value == 0) {
            if (old != kBasePage) number(at, value);
        } else if (std::string name = pages_.name_of(value); name != old) {
            replace(at, std::move(name));
        }
    }

    // A page that was not written becomes the last attribute of the start tag, if it is not what it was.
    void page(TextRange at, TextRange start_tag, int value, bool changed) {
        if (at.present()) return page_number(at, value, changed);
        if (changed) attribute(start_tag, "page", pages_.of(value));
    }

    void attribute(TextRange start_tag, std::string_view name, const std::string& value) {
        if (!start_tag.present()) return;
        const std::string_view tag = text_.substr(start_tag.offset, start_tag.length);
        std::size_t end = tag.size() - 1;
        while (end > 0 && (is_blank(tag[end - 1]) || tag[end - 1] == '/')) --end;
        const std::size_t offset = start_tag.offset + end;
        edits_.push_back({offset, offset, " " + std::string(name) + "=\"" + value + "\""});
    }

    void id(const Structure& structure) {
        if (structure.id_text.present()) return replace(structure.id_text, structure.id);
        attribute(structure.start_tag, "id", structure.id);
    }

    // By code where the author wrote a code, else by name.
    void type(const Structure& structure) {
        const TextRange at = structure.type_text;
        const ElementInfo* info = find_element(structure.type);
        POPUP_INVARIANT(at.present() && info != nullptr);
        const std::string_view old = text_.substr(at.offset, at.length);
        const bool by_code = parse_number(old).fault == NumberFault::none && info->code >= 0;
        edits_.push_back({at.offset, at.offset + at.length,
                          by_code ? std::to_string(info->code) : std::string(info->name)});
    }

    // An element that has its lines to itself takes them with it.
    void remove(TextRange at) {
        POPUP_INVARIANT(at.present());
        std::size_t begin = at.offset;
        std::size_t end = at.offset + at.length;
        while (begin > 0 && (text_[begin - 1] == ' ' || text_[begin - 1] == '\t')) --begin;
        while (end < text_.size() && (text_[end] == ' ' || text_[end] == '\t' || text_[end] == '\r')) ++end;
        const bool alone = begin > 0 && text_[begin - 1] == '\n' && end < text_.size() && text_[end] == '\n';
        if (alone) {
            edits_.push_back({begin, end + 1, {}});
        } else {
            edits_.push_back({at.offset, at.offset + at.length, {}});
        }
    }

    std::string_view text_;
    const Design& design_;
    PageNames pages_;
    std::vector<PatchEdit> edits_;
};

}  // namespace

std::vector<PatchEdit> patch_edits(const Source& source, const Design& design,
                                   std::span<const TextRange> gone) {
    return Patch(source.text, design).run(gone);
}

std::string patched(std::string_view text, std::span<const PatchEdit> edits) {
    std::string out;
    out.reserve(text.size() + edits.size() * 8);
    std::size_t at = 0;
    for (const PatchEdit& edit : edits) {
        POPUP_INVARIANT(edit.begin >= at && edit.end >= edit.begin && edit.end <= text.size());
        out += text.substr(at, edit.begin - at);
        out += edit.text;
        at = edit.end;
    }
    out += text.substr(at);
    return out;
}

std::string patch(const Source& source, const Design& design) { return patch(source, design, {}); }

std::string patch(const Source& source, const Design& design, std::span<const TextRange> gone) {
    return patched(source.text, patch_edits(source, design, gone));
}

}  // namespace popup::xml
