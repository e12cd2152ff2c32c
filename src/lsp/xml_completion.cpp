#include "lsp/xml_completion.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "input/color.h"
#include "input/text.h"
#include "input/xml/locate.h"
#include "input/xml/number.h"
#include "input/xml/units.h"
#include "lsp/xml_words.h"

namespace popup::lsp {
namespace {

using xml::Name;

class Completer {
 public:
    Completer(const View& view, std::size_t at) : view_(view), text_(marked(view.text.bytes())), at_(at) {}

    std::vector<Completion> run() {
        for (const MarkupComment& comment : text_.markup.comments) {
            if (comment.at.begin < at_ && at_ < comment.at.end) return in_comment(comment);
        }
        // Of what is being typed the "<" stands before the cursor.
        const int element = text_.markup.at(at_);
        if (element < 0) {
            in_content(-1, at_);
        } else {
            const MarkupElement& one = text_.element(element);
            if (one.name.touches(at_) && at_ > one.begin) {
                in_content(one.parent, one.begin);
            } else if (at_ <= one.tag.end && !(one.closed_tag && at_ == one.tag.end)) {
                in_tag(element);
            } else {
                in_content_of(element);
            }
        }
        return std::move(out_);
    }

 private:
    // Letters before the cursor that belong to the word.
    [[nodiscard]] Span word_before() const {
        std::size_t begin = at_;
        const auto in_word = [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                   c == '_';
        };
        while (begin > 0 && in_word(text_.text[begin - 1])) --begin;
        return {begin, at_};
    }

    void add(std::string label, ItemKind kind, std::string detail, std::string markdown, Span replaces,
             std::string text, bool snippet = false) {
        out_.push_back({std::move(label), kind, std::move(detail), std::move(markdown), replaces,
                        std::move(text), snippet});
    }

    std::vector<Completion> in_comment(const MarkupComment& comment) {
        const std::string_view said = text_.text.substr(comment.at.begin, at_ - comment.at.begin);
        if (said.find(xml::kAddress) == std::string_view::npos) return {};
        const Span word = word_before();
        if (said.find(" allow") == std::string_view::npos) {
            add("allow", ItemKind::word, "findings that are meant to be", {}, word, "allow ");
            return std::move(out_);
        }
        for (const CodeInfo& code : code_table()) {
            if (code.severity == Severity::error) continue;
            add(std::string(code.code), ItemKind::value, std::string(code.summary), code_markdown(code), word,
                std::string(code.code));
        }
        return std::move(out_);
    }

    void in_tag(int element) {
        for (const MarkupAttribute& attribute : text_.attributes(element)) {
            // A value without its first quote is a name.
            if (attribute.value.begin > attribute.name.end && attribute.value.touches(at_)) {
                const char before = text_.text[attribute.value.begin - 1];
                if (before == '"' || before == '\'')
                    values(element, meaning(text_.element(element).what, text_.word(attribute.name)),
                           text_.word(attribute.name), attribute.value);
                return;
            }
        }
        attributes(element);
    }

    void attributes(int element) {
        const Name what = text_.element(element).what;
        const ElementInfo* info = text_.row(text_.structure_of(element));
        std::set<std::string_view> given;
        for (const MarkupAttribute& one : text_.attributes(element)) {
            if (!one.name.touches(at_)) given.insert(text_.word(one.name));
        }
        const Span word = word_before();
        const auto offer = [&](std::string_view name, std::string_view detail, std::string markdown) {
            if (given.contains(name)) return;
            add(std::string(name), ItemKind::property, std::string(detail), std::move(markdown), word,
                fmt::format("{}=\"$1\"", name), true);
        };
        for (const std::string_view name : xml::names_in(what)) {
            const Name found = xml::find_name(what, name);
            if (found == Name::unknown || found == Name::value || !xml::is_scalar(found)) continue;
            if (is_color(found, name, info) && (what == Name::structure || what == Name::mainpage)) continue;
            offer(name, xml::about(found), {});
        }
        if (what != Name::structure || info == nullptr) return;
        for (const ParameterInfo& one : info->parameters) {
            const bool attribute = one.kind == ParameterKind::length || one.kind == ParameterKind::number ||
                                   one.kind == ParameterKind::choice;
            if (attribute && one.group.empty()) offer(one.name, one.about, takes(one));
        }
    }

    void values(int element, Name name, std::string_view spelling, Span at) {
        const ElementInfo* info = text_.row(text_.structure_of(element));
        if (name == Name::type) {
            for (const ElementInfo& row : element_table())
                add(std::string(row.name), ItemKind::element, std::string(row.about), row_markdown(row), at,
                    std::string(row.name));
        } else if (is_color(name, spelling, info)) {
            colors(at);
        } else if (name == Name::units) {
            for (const xml::UnitRow& row : xml::unit_table())
                add(std::string(row.unit.name), ItemKind::unit, fmt::format("{:g} mm", row.unit.mm), {}, at,
                    std::string(row.unit.name));
        } else if (name == Name::version) {
            std::set<std::string_view> versions{"2.0"};
            for (const ElementInfo& row : element_table()) versions.insert(row.since);
            for (const std::string_view one : versions) words(at, {&one, 1});
        } else if (name == Name::page) {
            pages(at);
        } else if (name == Name::on) {
            const bool plates = text_.element(element).what == Name::parentplate;
            for (const NamedPlace& one : places_before(text_, text_.structure_of(element), plates))
                add(one.name, ItemKind::reference, one.about, {}, at, one.name);
        } else if (name == Name::fit) {
            words(at, kPictureFitNames);
        } else if (name == Name::font) {
            words(at, kTextFontNames);
        } else if (name == Name::argument) {
            const ParameterInfo* parameter = parameter_of(info, spelling);
            if (parameter != nullptr) words(at, parameter->words);
        }
    }

    void words(Span at, std::span<const std::string_view> all) {
        for (const std::string_view one : all)
            add(std::string(one), ItemKind::value, {}, {}, at, std::string(one));
    }

    // Those of the document first: a card has few.
    void colors(Span at) {
        std::set<std::string> used;
        for (const ColorAt& one : find_service("xml")->colors(view_)) {
            if (!one.at.touches(at_)) used.insert(to_string(one.color));
        }
        for (const std::string& one : used) add(one, ItemKind::color, "used in this document", one, at, one);
        for (const std::string_view name : color_names())
            add(std::string(name), ItemKind::color, to_string(*parse_color(name)),
                to_string(*parse_color(name)), at, std::string(name));
    }

    // By their numbers, and from version 3.0 on by the elements whose pieces they are.
    void pages(Span at) {
        const auto offer = [&](const std::string& page, std::string detail) {
            add(page, ItemKind::value, std::move(detail), {}, at, page);
        };
        offer("0", "the base page");
        const bool named = version_of(text_) >= "3.0";
        const std::vector<int> all = text_.structures();
        const std::vector<std::string> ids = ids_of(text_);
        int page = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const ElementInfo* info = text_.row(all[i]);
            if (info == nullptr || !info->glued) continue;
            const std::string detail = fmt::format("the piece of {}", ids[i]);
            offer(std::to_string(++page), detail);
            if (named && text_.value(all[i], Name::id)) offer(ids[i], detail);
        }
    }

    // Behind the start tag of an element: its text, or children.
    void in_content_of(int element) {
        const MarkupElement& one = text_.element(element);
        const bool scalar = xml::is_scalar(one.what) ||
                            is_color(one.what, text_.word(one.name), text_.row(text_.structure_of(element)));
        if (scalar) {
            std::size_t begin = at_;
            while (begin > one.tag.end && !is_blank(text_.text[begin - 1])) --begin;
            values(element, one.what, text_.word(one.name), {begin, at_});
            return;
        }
        in_content(element, at_);
    }

    void child(std::string_view name, std::string detail, std::string markdown, Span at, std::string body) {
        add(std::string(name), ItemKind::element, std::move(detail), std::move(markdown), at, std::move(body),
            true);
    }

    // `begin`: of the "<", or the cursor where there is none.
    void in_content(int element, std::size_t begin) {
        const Name what = element < 0 ? Name::document : text_.element(element).what;
        if (what == Name::unknown || what == Name::argument) return;
        const Span at{begin, at_};
        std::set<Name> given;
        for (const int one : text_.markup.children(element)) given.insert(text_.element(one).what);
        if (what == Name::structurelist) rows(at);
        const ElementInfo* info = what == Name::structure ? text_.row(element) : nullptr;
        const bool stands = given.contains(Name::parentfold) || given.contains(Name::parentplate);
        if (what == Name::structure && !stands) {
            if (info == nullptr || !info->grounds.plate) folds(at, element);
            if (info == nullptr || info->grounds.plate) plates(at, element);
        }
        for (const std::string_view name : xml::names_in(what)) {
            const Name found = xml::find_name(what, name);
            if (found == Name::unknown) continue;
            const bool color = is_color(found, name, info);
            const bool colors_are_children = what == Name::structure || what == Name::mainpage;
            if (xml::is_scalar(found) && !(color && colors_are_children)) continue;
            if (color && info != nullptr && !find_parameter(*info, name)) continue;
            if (given.contains(found) && !xml::repeats(what, found)) continue;
            if (stands && (found == Name::parentfold || found == Name::parentplate)) continue;
            // Points stand in their list, and only what is cut from one sheet has folds of its own.
            if (what == Name::structure &&
                (found == Name::point || (found == Name::folds && !has_group(info))))
                continue;
            child(name, std::string(xml::about(found)), {}, at, body(found, name));
        }
        if (info == nullptr) return;
        for (const ParameterInfo& one : info->parameters) {
            if (xml::find_name(Name::structure, one.name) != Name::unknown) continue;
            const bool path = one.kind == ParameterKind::path;
            if (!path && one.kind != ParameterKind::points && one.kind != ParameterKind::colour) continue;
            child(one.name, std::string(one.about), takes(one), at,
                  path ? fmt::format("<{} d=\"$1\"/>", one.name) : fmt::format("<{0}>$1</{0}>", one.name));
        }
    }

    static bool has_group(const ElementInfo* info) {
        return info != nullptr && std::any_of(info->parameters.begin(), info->parameters.end(),
                                              [](const ParameterInfo& one) { return !one.group.empty(); });
    }

    [[nodiscard]] std::string body(Name name, std::string_view spelling) const {
        switch (name) {
            case Name::point:
            case Name::begin:
            case Name::end:
                return fmt::format("<{} x=\"$1\" y=\"$2\"/>", spelling);
            case Name::parentplate:
                if (version_of(text_) >= "3.0") return fmt::format("<{} on=\"$1\"/>", spelling);
                return fmt::format("<{} page=\"${{1:0}}\" x=\"$2\" y=\"$3\"/>", spelling);
            case Name::parentfold:
                if (version_of(text_) >= "3.0") return fmt::format("<{} on=\"$1\"/>", spelling);
                return "<parentfold>\n  <begin x=\"$1\" y=\"$2\"/>\n  <end x=\"$3\" "
                       "y=\"$4\"/>\n</parentfold>";
            case Name::structure:
                return "<structure type=\"$1\" id=\"$2\">\n  $0\n</structure>";
            case Name::popup:
                return "<popup version=\"3.0\" units=\"mm\">\n  <mainpage width=\"${1:200}\" "
                       "height=\"${2:140}\"/>\n"
                       "  <structurelist>\n    $0\n  </structurelist>\n</popup>";
            case Name::mainpage:
                return "<mainpage width=\"$1\" height=\"$2\"/>";
            default:
                break;
        }
        if (xml::is_scalar(name)) return fmt::format("<{0}>$1</{0}>", spelling);
        const std::vector<std::string_view> inner = xml::names_in(name);
        const bool lists = std::any_of(inner.begin(), inner.end(), [name](std::string_view one) {
            return xml::repeats(name, xml::find_name(name, one));
        });
        return lists ? fmt::format("<{0}>\n  $0\n</{0}>", spelling) : fmt::format("<{} $1/>", spelling);
    }

    // A structure of each row of the table, with its points in the order of their letters.
    void rows(Span at) {
        for (const ElementInfo& row : element_table()) {
            int stop = 0;
            std::string text =
                fmt::format("<structure type=\"{}\" id=\"${{{}:{}}}\">", row.name, ++stop, row.family);
            if (!row.points.empty()) {
                text += "\n  <outerpoints>";
                for (const PointInfo& point : row.points) {
                    text += fmt::format("\n    <point x=\"${{{}:0}}\" y=\"${{{}:0}}\"/> <!-- {} -->",
                                        stop + 1, stop + 2, point.letter);
                    stop += 2;
                }
                text += "\n  </outerpoints>";
            }
            for (const ParameterInfo& one : row.parameters) {
                if (!one.required) continue;
                text += one.kind == ParameterKind::path
                            ? fmt::format("\n  <{} d=\"${{{}}}\"/>", one.name, ++stop)
                            : fmt::format("\n  <{0}>${{{1}}}</{0}>", one.name, ++stop);
            }
            if (row.grounds.plate && version_of(text_) >= "3.0") {
                text += fmt::format("\n  <parentplate on=\"${{{}:{}}}\"/>", stop + 1, kPagePlates[1]);
            } else if (row.grounds.plate) {
                text += fmt::format("\n  <parentplate page=\"${{{}:0}}\" x=\"${{{}}}\" y=\"${{{}}}\"/>",
                                    stop + 1, stop + 2, stop + 3);
            } else if (!row.grounds.found && !row.grounds.page) {
                text += "\n" + gutter();
            }
            text += "\n</structure>";
            add(fmt::format("structure {}", row.name), ItemKind::snippet, std::string(row.about),
                row_markdown(row), at, std::move(text), true);
        }
    }

    [[nodiscard]] std::string gutter() const {
        if (version_of(text_) >= "3.0") return "  <parentfold on=\"gutter\"/>";
        const Design* design = view_.good == nullptr ? nullptr : &*view_.good->design;
        const double half = design == nullptr ? 70.0 : design->height_mm / design->unit.mm / 2;
        const std::string y = xml::format_number(half);
        return fmt::format(
            "  <parentfold>\n    <begin x=\"0\" y=\"-{0}\"/>\n    <end x=\"0\" y=\"{0}\"/>\n  </parentfold>",
            y);
    }

    // Every plate that there is to stand on, which has a name from version 3.0 on.
    void plates(Span at, int structure) {
        if (version_of(text_) < "3.0") return;
        for (const NamedPlace& one : places_before(text_, structure, true))
            add("parentplate " + one.name, ItemKind::reference, one.about, {}, at,
                fmt::format("<parentplate on=\"{}\"/>", one.name));
    }

    // Every fold that there is to stand on: by its name from version 3.0 on, else by its points.
    void folds(Span at, int structure) {
        std::set<std::string> named;
        if (version_of(text_) >= "3.0") {
            for (const NamedPlace& one : places_before(text_, structure, false)) {
                named.insert(one.name);
                add("parentfold " + one.name, ItemKind::reference, one.about, {}, at,
                    fmt::format("<parentfold on=\"{}\"/>", one.name));
            }
        }
        if (view_.good == nullptr) return;
        const Design& design = *view_.good->design;
        for (const StandingFold& fold : view_.good->standing.folds) {
            const std::string owner = fold.owner < 0
                                          ? std::string(kBasePage)
                                          : design.structures[static_cast<std::size_t>(fold.owner)].id;
            if (named.contains(fold.owner < 0 ? std::string(kGutter)
                                              : fmt::format("{}.{}", owner, fold.name)))
                continue;
            const auto point = [&](std::string_view name, Vec2 p) {
                return fmt::format("  <{} x=\"{}\" y=\"{}\"/>\n", name,
                                   xml::format_number(p.x / design.unit.mm),
                                   xml::format_number(p.y / design.unit.mm));
            };
            add(fmt::format("parentfold {}.{}", owner, fold.name), ItemKind::reference,
                fmt::format("the {} {} of \"{}\"", fold.name, fold.at.seam ? "seam" : "fold", owner), {}, at,
                fmt::format("<parentfold page=\"{}\">\n{}{}</parentfold>", fold.at.left_page,
                            point("begin", fold.at.on_left.a), point("end", fold.at.on_left.b)));
        }
    }

    const View& view_;
    MarkedText text_;
    std::size_t at_;
    std::vector<Completion> out_;
};

}  // namespace

std::vector<Completion> complete_xml(const View& view, std::size_t at) { return Completer(view, at).run(); }

}  // namespace popup::lsp
