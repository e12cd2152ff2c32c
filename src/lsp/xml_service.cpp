// Popup documents, as an editor asks about them.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "input/color.h"
#include "input/text.h"
#include "input/xml/locate.h"
#include "lsp/xml_completion.h"
#include "lsp/xml_words.h"
#include "popup/edit.h"

namespace popup::lsp {
namespace {

using xml::Name;

bool is_ours(std::string_view text) {
    const Markup markup = read_markup(text);
    if (markup.elements.empty()) return true;
    const MarkupElement& root = markup.elements.front();
    return root.name.size() == 0 || root.what == Name::popup;
}

// A document with what was known of it when it could be read last.
class Page {
 public:
    explicit Page(const View& view) : view_(view), text_(marked(view.text.bytes())) {
        const std::vector<int> all = text_.structures();
        const std::vector<std::string> ids = ids_of(text_);
        for (std::size_t i = 0; i < all.size(); ++i) {
            by_id_.emplace(ids[i], all[i]);
            ids_.emplace(all[i], ids[i]);
        }
        if (view.good == nullptr) return;
        const auto& structures = view.good->design->structures;
        for (std::size_t i = 0; i < structures.size(); ++i)
            number_of_[structures[i].id] = static_cast<int>(i);
    }

    [[nodiscard]] const MarkedText& text() const { return text_; }

    // The id of a structure, as given or as the reader would make it.
    [[nodiscard]] const std::string& id(int structure) const { return ids_.at(structure); }

    // What a structure stands on, as far as it is known.
    [[nodiscard]] const Ground* ground(const std::string& id) const {
        const auto number = number_of_.find(id);
        return number == number_of_.end()
                   ? nullptr
                   : &view_.good->standing.ground[static_cast<std::size_t>(number->second)];
    }
    // The id of what it stands on; empty: the page, or it is not known.
    [[nodiscard]] std::string below(const std::string& id) const {
        const Ground* on = ground(id);
        return on == nullptr || on->owner < 0
                   ? std::string()
                   : view_.good->design->structures[static_cast<std::size_t>(on->owner)].id;
    }
    // "the centre fold of "bird"", "the gutter".
    [[nodiscard]] std::string ground_text(const std::string& id) const {
        const Ground* on = ground(id);
        if (on == nullptr) return {};
        if (on->fold < 0)
            return on->plate_owner < 0 ? std::string() : fmt::format("a plate of \"{}\"", below(id));
        const StandingFold& fold = view_.good->standing.folds[static_cast<std::size_t>(on->fold)];
        if (fold.owner < 0) return "the gutter";
        return fmt::format("the {} {} of \"{}\"", fold.name, fold.at.seam ? "seam" : "fold", below(id));
    }

    // "at 25, length 40, width 50", as it was measured last; empty: it was not.
    [[nodiscard]] std::string measures(const std::string& id) const {
        if (!number_of_.contains(id)) return {};
        Diagnostics unheard;
        const Design& design = *view_.good->design;
        const auto shown = show_tree(design, view_.good->card->of(design), {id}, unheard);
        const std::size_t begin = shown ? shown->find(": ") : std::string::npos;
        if (begin == std::string::npos || begin > shown->find('\n')) return {};
        return shown->substr(begin + 2, shown->find_first_of(";\n", begin) - begin - 2);
    }

    // The structure of that id in the text; -1: none.
    [[nodiscard]] int structure(const std::string& wanted) const {
        const auto found = by_id_.find(wanted);
        return found == by_id_.end() ? -1 : found->second;
    }
    // The structure that a page or ground of an element names; -1: none.
    [[nodiscard]] int named_in(int element, Name what) const {
        for (const Naming& one : namings(text_)) {
            if (one.element == element && one.what == what) return structure(std::string(text_.word(one.id)));
        }
        return -1;
    }
    // Where its id is written, or else its name.
    [[nodiscard]] Span id_at(int structure) const {
        const auto value = text_.value(structure, Name::id);
        return value && value->size() > 0 ? *value : text_.element(structure).name;
    }

 private:
    const View& view_;
    MarkedText text_;
    std::map<int, std::string> ids_;        // of structures, by their elements
    std::map<std::string, int> by_id_;      // the same, turned round; of equal ids the first
    std::map<std::string, int> number_of_;  // in the design
};

std::string element_markdown(const Page& page, int structure) {
    const std::string& id = page.id(structure);
    std::string text = fmt::format("\"{}\"", id);
    if (const std::string ground = page.ground_text(id); !ground.empty()) text += " stands on " + ground;
    const ElementInfo* info = page.text().row(structure);
    if (info == nullptr) return text;
    if (const std::string measures = page.measures(id); !measures.empty()) text += ": " + measures;
    return text + "\n\n" + row_markdown(*info);
}

std::string color_markdown(std::string_view written) {
    const auto color = parse_color(written);
    if (!color) return {};
    std::string text =
        fmt::format("`{}`: red {}, green {}, blue {}", to_string(*color), color->r, color->g, color->b);
    for (const std::string_view name : color_names()) {
        if (*parse_color(name) == *color) return text + fmt::format(" (*{}*)", name);
    }
    return text;
}

// What a word of the table, or a parameter, is.
std::string name_markdown(Name name, std::string_view spelling, const ElementInfo* info) {
    const bool value = name == Name::argument || name == Name::leftcolor || name == Name::rightcolor ||
                       name == Name::lefttabcolor || name == Name::righttabcolor;
    if (value) {
        if (const ParameterInfo* parameter = parameter_of(info, spelling))
            return fmt::format("**{}**: {}; {}", parameter->name, parameter->about, takes(*parameter));
    }
    return name == Name::unknown ? std::string()
                                 : fmt::format("**{}**: {}", xml::canonical(name), xml::about(name));
}

// The number of a point among those of its list.
std::size_t number_of(const MarkedText& text, int point) {
    std::size_t number = 0;
    for (const int sibling : text.markup.children(text.element(point).parent)) {
        if (sibling == point) break;
        if (text.element(sibling).what == Name::point) ++number;
    }
    return number;
}

std::string hover_of_element(const Page& page, int element) {
    const MarkedText& text = page.text();
    const MarkupElement& one = text.element(element);
    const int structure = text.structure_of(element);
    const ElementInfo* info = text.row(structure);
    if (one.what == Name::structure) return element_markdown(page, element);
    const bool outer = one.parent >= 0 && (text.element(one.parent).what == Name::outerpoints ||
                                           text.element(one.parent).what == Name::structure);
    if (one.what == Name::point && outer && info != nullptr) {
        const std::size_t number = number_of(text, element);
        if (number < info->points.size()) return point_markdown(*info, number);
    }
    std::string said = name_markdown(one.what, text.word(one.name), info);
    if (one.what == Name::parentfold || one.what == Name::parentplate) {
        const std::string ground = structure < 0 ? std::string() : page.ground_text(page.id(structure));
        if (!ground.empty()) said += fmt::format("\n\nHere it is {}.", ground);
    }
    return said;
}

std::optional<Hover> hover_of_attribute(const Page& page, int element, const MarkupAttribute& attribute,
                                        std::size_t at) {
    const MarkedText& text = page.text();
    const std::string_view spelling = text.word(attribute.name);
    const Name name = meaning(text.element(element).what, spelling);
    const int structure = text.structure_of(element);
    const ElementInfo* info = text.row(structure);
    if (!attribute.name.touches(at) && attribute.value.touches(at)) {
        if (name == Name::type && info != nullptr) return Hover{attribute.value, row_markdown(*info)};
        if (name == Name::id && structure >= 0)
            return Hover{attribute.value, element_markdown(page, structure)};
        if (is_color(name, spelling, info)) {
            if (const std::string said = color_markdown(text.word(attribute.value)); !said.empty())
                return Hover{attribute.value, said};
        }
        const Name parent = text.element(element).what;
        if ((name == Name::x || name == Name::y || name == Name::page) && parent == Name::point)
            return Hover{attribute.value, hover_of_element(page, element)};
    }
    std::string said = name_markdown(name, spelling, info);
    if (said.empty()) return std::nullopt;
    if (name == Name::on && structure >= 0) {
        if (const std::string ground = page.ground_text(page.id(structure)); !ground.empty())
            said += fmt::format("\n\nHere it is {}.", ground);
    } else if (const int owner = page.named_in(element, name); name == Name::page && owner >= 0) {
        said += fmt::format("\n\nHere it is that of the piece of \"{}\".", page.id(owner));
    }
    return Hover{attribute.name.touches(at) ? attribute.name : attribute.value, said};
}

// A code in a comment that is meant for this program.
std::optional<Hover> hover_of_comment(const MarkedText& text, const MarkupComment& comment, std::size_t at) {
    const std::string_view said = text.word(comment.at);
    if (said.find(xml::kAddress) == std::string_view::npos) return std::nullopt;
    const auto in_code = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; };
    std::size_t begin = at;
    std::size_t end = at;
    while (begin > comment.at.begin && in_code(text.text[begin - 1])) --begin;
    while (end < comment.at.end && in_code(text.text[end])) ++end;
    const CodeInfo* code = find_code(text.text.substr(begin, end - begin));
    if (code == nullptr) return std::nullopt;
    return Hover{{begin, end}, code_markdown(*code)};
}

std::optional<Hover> hover(const View& view, std::size_t at) {
    const Page page(view);
    const MarkedText& text = page.text();
    for (const MarkupComment& comment : text.markup.comments) {
        if (comment.at.contains(at)) return hover_of_comment(text, comment, at);
    }
    const int element = text.markup.at(at);
    if (element < 0) return std::nullopt;
    const MarkupElement& one = text.element(element);
    for (const MarkupAttribute& attribute : text.attributes(element)) {
        if (attribute.name.touches(at) || attribute.value.touches(at))
            return hover_of_attribute(page, element, attribute, at);
    }
    if (one.name.touches(at) || (one.end_name.size() > 0 && one.end_name.touches(at))) {
        const std::string said = hover_of_element(page, element);
        if (said.empty()) return std::nullopt;
        return Hover{one.name.touches(at) ? one.name : one.end_name, said};
    }
    // The text of a value.
    if (at < one.tag.end || one.end_name.size() == 0 || at >= one.end_name.begin) return std::nullopt;
    const ElementInfo* info = text.row(text.structure_of(element));
    const Span content{one.tag.end, one.end_name.begin - 2};
    if (is_color(one.what, text.word(one.name), info)) {
        if (const std::string said = color_markdown(text.word(content)); !said.empty())
            return Hover{content, said};
    }
    if (one.what == Name::type && info != nullptr) return Hover{content, row_markdown(*info)};
    return std::nullopt;
}

std::vector<Symbol> symbols(const View& view) {
    const Page page(view);
    const MarkedText& text = page.text();
    std::vector<Symbol> all;
    std::map<std::string, int> by_id;
    for (std::size_t i = 0; i < text.markup.elements.size(); ++i) {
        const MarkupElement& one = text.markup.elements[i];
        const int element = static_cast<int>(i);
        if (one.what == Name::mainpage) {
            all.push_back({"mainpage", "the base page", SymbolKind::module, one.all(), one.name, -1});
        } else if (one.what == Name::structure) {
            const std::string& id = page.id(element);
            const auto type = text.value(element, Name::type);
            const ElementInfo* info = text.row(element);
            std::string detail(info != nullptr ? info->name : type ? text.word(*type) : std::string_view());
            const auto below = by_id.find(page.below(id));
            by_id.emplace(id, static_cast<int>(all.size()));
            all.push_back({id, std::move(detail), SymbolKind::element, one.all(), page.id_at(element),
                           below == by_id.end() ? -1 : below->second});
        } else if (one.what == Name::drawnline || one.what == Name::image || one.what == Name::area ||
                   (one.what == Name::text && one.parent >= 0)) {
            all.push_back(
                {std::string(xml::canonical(one.what)), {}, SymbolKind::property, one.all(), one.name, -1});
        }
    }
    return all;
}

// The structure that an id, a page or a parent fold at that byte names; -1: none.
int named_at(const Page& page, std::size_t at) {
    const MarkedText& text = page.text();
    for (const Naming& one : namings(text)) {
        if (!one.value.touches(at)) continue;
        const int named = page.structure(std::string(text.word(one.id)));
        if (named >= 0) return named;
    }
    const int element = text.markup.at(at);
    const int structure = text.structure_of(element);
    if (structure < 0) return -1;
    for (int one = element; one != structure; one = text.element(one).parent) {
        const Name what = text.element(one).what;
        if (what != Name::parentfold && what != Name::parentplate) continue;
        const std::string below = page.below(page.id(structure));
        return below.empty() ? -1 : page.structure(below);
    }
    const Span id = page.id_at(structure);
    return id.touches(at) || text.element(structure).name.touches(at) ? structure : -1;
}

std::optional<Target> definition(const View& view, std::size_t at) {
    const Page page(view);
    const int structure = named_at(page, at);
    if (structure >= 0) return Target{view.path, page.id_at(structure)};
    // The gutter is the page's.
    const MarkedText& text = page.text();
    for (int one = text.markup.at(at); one >= 0; one = text.element(one).parent) {
        if (text.element(one).what != Name::parentfold) continue;
        const int around = text.structure_of(one);
        if (around < 0 || page.ground_text(page.id(around)) != "the gutter") return std::nullopt;
        for (const MarkupElement& element : text.markup.elements) {
            if (element.what == Name::mainpage) return Target{view.path, element.name};
        }
    }
    return std::nullopt;
}

std::vector<Target> references(const View& view, std::size_t at) {
    const Page page(view);
    const int structure = named_at(page, at);
    if (structure < 0) return {};
    const MarkedText& text = page.text();
    const std::string& id = page.id(structure);
    std::vector<Span> places;
    std::set<int> named;  // grounds that are named
    for (const Naming& one : namings(text)) {
        if (one.what == Name::on) named.insert(one.element);
        if (text.word(one.id) == id) places.push_back(one.value);
    }
    for (const int other : text.structures()) {
        if (page.below(page.id(other)) != id) continue;
        for (const int child : text.markup.children(other)) {
            const Name what = text.element(child).what;
            const bool ground = what == Name::parentfold || what == Name::parentplate;
            if (ground && !named.contains(child)) places.push_back(text.element(child).name);
        }
    }
    std::sort(places.begin(), places.end(), [](Span a, Span b) { return a.begin < b.begin; });
    std::vector<Target> all{{view.path, page.id_at(structure)}};
    for (const Span place : places) all.push_back({view.path, place});
    return all;
}

// An id that can be changed: where it stands, and the structure that has it; -1: there is none.
struct Renamed {
    Span at;
    int structure = -1;
};

Renamed renamed_at(const Page& page, std::size_t at) {
    const MarkedText& text = page.text();
    const auto given = [&](int structure) {
        const auto id = structure < 0 ? std::nullopt : text.value(structure, Name::id);
        return id && id->size() > 0 ? id : std::nullopt;
    };
    for (const Naming& one : namings(text)) {
        const int structure = one.id.touches(at) ? page.structure(std::string(text.word(one.id))) : -1;
        if (given(structure)) return {one.id, structure};
    }
    const int structure = text.structure_of(text.markup.at(at));
    const auto id = given(structure);
    return id && id->touches(at) ? Renamed{*id, structure} : Renamed{};
}

std::optional<Span> renameable(const View& view, std::size_t at) {
    const Page page(view);
    const Renamed found = renamed_at(page, at);
    return found.structure < 0 ? std::nullopt : std::optional(found.at);
}

Renaming rename(const View& view, std::size_t at, std::string_view name) {
    const Page page(view);
    const MarkedText& text = page.text();
    const Renamed found = renamed_at(page, at);
    if (found.structure < 0) return {{}, "there is no id to rename here"};
    if (!is_id(name)) return {{}, fmt::format("\"{}\" cannot be an id: {}", shown(name), kIdHint)};
    if (name == kBasePage || name == kGutter)
        return {{}, fmt::format("the id \"{}\" is kept for the base page", name)};
    const int other = page.structure(std::string(name));
    if (other >= 0 && other != found.structure)
        return {{}, fmt::format("there is an element \"{}\" already", name)};
    // Where it stands first; then all that names it.
    std::vector<TextEdit> edits{{page.id_at(found.structure), std::string(name)}};
    for (const Naming& one : namings(text)) {
        if (text.word(one.id) == page.id(found.structure)) edits.push_back({one.id, std::string(name)});
    }
    std::sort(edits.begin(), edits.end(),
              [](const TextEdit& a, const TextEdit& b) { return a.at.begin < b.at.begin; });
    return {{{view.path, std::move(edits)}}, {}};
}

std::optional<Fix> allow(const View& view, const Finding& finding) {
    const Diagnostic& said = finding.diagnostic;
    const CodeInfo* code = find_code(said.code);
    // Errors cannot be allowed, nor can what there is to say of comments that allow.
    if (code == nullptr || code->severity == Severity::error || said.severity == Severity::error ||
        said.change || said.code == "bad-allow" || said.code == "unused-allow")
        return std::nullopt;
    const Page page(view);
    const MarkedText& text = page.text();
    const std::string comment = fmt::format("<!-- popupc: allow {} -->", said.code);
    const int structure = said.element.empty() ? -1 : page.structure(said.element);
    std::size_t where = 0;
    if (structure >= 0) {
        where = text.element(structure).begin;
    } else if (!text.markup.elements.empty() && text.markup.elements.front().closed_tag) {
        where = text.markup.elements.front().tag.end;
    } else {
        return std::nullopt;
    }
    const std::string title = structure >= 0 ? fmt::format("Allow {} for \"{}\"", said.code, said.element)
                                             : fmt::format("Allow {} in this document", said.code);
    const std::string_view bytes = text.text;
    const std::string end = bytes.find("\r\n") != std::string_view::npos ? "\r\n" : "\n";
    if (structure < 0) return Fix{title, {{{where, where}, end + "  " + comment}}};
    std::size_t line = where;
    while (line > 0 && (bytes[line - 1] == ' ' || bytes[line - 1] == '\t')) --line;
    const std::string indent(bytes.substr(line, where - line));
    return Fix{title, {{{where, where}, comment + end + indent}}};
}

std::vector<ColorAt> colors(const View& view) {
    const MarkedText text = marked(view.text.bytes());
    std::vector<ColorAt> found;
    for (std::size_t i = 0; i < text.markup.elements.size(); ++i) {
        const int element = static_cast<int>(i);
        const MarkupElement& one = text.element(element);
        const auto add = [&](Name name, std::string_view spelling, Span at) {
            if (!is_color(name, spelling, nullptr)) return;
            if (const auto color = parse_color(text.word(at))) found.push_back({at, *color});
        };
        for (const MarkupAttribute& attribute : text.attributes(element))
            add(meaning(one.what, text.word(attribute.name)), text.word(attribute.name), attribute.value);
        if (one.end_name.size() > 0 && one.after == i + 1)
            add(one.what, text.word(one.name), {one.tag.end, one.end_name.begin - 2});
    }
    return found;
}

}  // namespace

Service xml_service() {
    return {"xml",      is_ours,    hover,  complete_xml, symbols, definition,
            references, renameable, rename, allow,        colors};
}

}  // namespace popup::lsp
