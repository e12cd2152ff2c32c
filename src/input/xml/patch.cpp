// Repairs written over the author's own text.
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/text.h"
#include "input/xml/number.h"
#include "input/xml/path_text.h"
#include "input/xml/read.h"
#include "popup/mechanism.h"

namespace popup::xml {
namespace {

class Patch {
 public:
    Patch(std::string_view text, const Design& design) : text_(text), design_(design) {}

    std::vector<PatchEdit> run() {
        for (const Structure& structure : design_.structures) {
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
            if (line.page_changed) number(line.page_text, line.page);
            for (const DesignPoint& point : line.points) point_edits(point, line.page);
        }
        for (const DrawnPrint& print : design_.prints) print_edits(print);
        std::sort(edits_.begin(), edits_.end(),
                  [](const PatchEdit& a, const PatchEdit& b) { return a.begin < b.begin; });
        return std::move(edits_);
    }

 private:
    void structure_edits(const Structure& structure) {
        if (structure.type_changed) type(structure);
        for (const DesignPoint& point : structure.points) point_edits(point, structure.ground_page());
        argument_edits(structure);
        if (structure.plate) return plate_edits(*structure.plate);
        if (structure.finds_ground) return;
        const ParentFold& fold = structure.fold;
        if (fold.page_changed) page(fold.page_text, fold.tag_text, fold.page);
        for (const DesignPoint* end : {&fold.begin, &fold.end}) {
            // Where an end of the fold names the page as well, the two must go on agreeing.
            if (fold.page_changed) number(end->page_text, fold.page);
            if (end->changed) coordinates(*end);
        }
    }

    void print_edits(const DrawnPrint& print) {
        if (print.dropped) return remove(print.tag_text);
        if (print.page_changed) number(print.page_text, print.page);
        if (print.at.changed) {
            coordinates(print.at);
            number(print.rotate_text, print.rotate_deg);
        }
        const auto* area = std::get_if<DrawnArea>(&print.what);
        if (area != nullptr && area->shape.moved) replace(area->d_text, path_text(area->shape, design_.unit));
    }

    void plate_edits(const ParentPlate& plate) {
        if (plate.at.changed) coordinates(plate.at);
        if (plate.page_changed) page(plate.page_text, plate.tag_text, plate.page);
    }

    void argument_edits(const Structure& structure) {
        const ElementInfo* info = find_element(structure.type);
        POPUP_INVARIANT(info != nullptr && structure.arguments.size() <= info->parameters.size());
        for (std::size_t i = 0; i < structure.arguments.size(); ++i) {
            const Argument& argument = structure.arguments[i];
            if (!argument.changed) continue;
            const ParameterInfo& parameter = info->parameters[i];
            if (argument.page && argument.page_text.present()) number(argument.page_text, *argument.page);
            if (const auto* points = std::get_if<std::vector<DesignPoint>>(&argument.value)) {
                for (const DesignPoint& point : *points) coordinates(point);
            } else if (const auto* value = std::get_if<double>(&argument.value)) {
                const double unit = parameter.kind == ParameterKind::length ? design_.unit.mm : 1.0;
                if (argument.text.present()) {
                    number(argument.text, *value / unit);
                } else {
                    attribute(structure.start_tag, parameter.name, format_number(*value / unit));
                }
            } else if (const auto* path = std::get_if<DrawnPath>(&argument.value)) {
                if (argument.text.present())
                    replace(argument.text, path_text(*path, design_.unit));
                else if (!argument.tag_text.present())  // what a file draws stays there
                    attribute(structure.start_tag, parameter.name, path_text(*path, design_.unit));
            }
        }
    }

    void replace(TextRange at, std::string text) {
        if (text_.substr(at.offset, at.length) == text) return;
        edits_.push_back({at.offset, at.offset + at.length, std::move(text)});
    }

    void point_edits(const DesignPoint& point, int default_page) {
        if (!point.changed) return;
        coordinates(point);
        if (point.page || point.page_text.present()) {
            page(point.page_text, point.tag_text, point.page.value_or(default_page));
        }
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

    // A page that was not written becomes the last attribute of the start tag.
    void page(TextRange at, TextRange start_tag, int value) {
        if (at.present()) return number(at, value);
        attribute(start_tag, "page", std::to_string(value));
    }

    void attribute(TextRange start_tag, std::string_view name, const std::string& value) {
        if (!start_tag.present()) return;
        const std::string_view tag = text_.substr(start_tag.offset, start_tag.length);
        std::size_t end = tag.size() - 1;
        while (end > 0 && (is_blank(tag[end - 1]) || tag[end - 1] == '/')) --end;
        const std::size_t offset = start_tag.offset + end;
        edits_.push_back({offset, offset, " " + std::string(name) + "=\"" + value + "\""});
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
    std::vector<PatchEdit> edits_;
};

}  // namespace

std::vector<PatchEdit> patch_edits(const Source& source, const Design& design) {
    return Patch(source.text, design).run();
}

std::string patch(const Source& source, const Design& design) {
    const std::string_view text = source.text;
    const std::vector<PatchEdit> edits = patch_edits(source, design);
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

}  // namespace popup::xml
