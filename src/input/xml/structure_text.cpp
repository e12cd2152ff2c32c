#include "input/xml/structure_text.h"

#include <fmt/format.h>

#include <iterator>
#include <string_view>

#include "input/xml/number.h"
#include "input/xml/path_text.h"
#include "popup/mechanism.h"

namespace popup::xml {

std::string_view indent_step(std::string_view indent) { return indent.ends_with('\t') ? "\t" : "  "; }

namespace {

class StructureText {
 public:
    StructureText(const Design& design, const PageNames& pages, const std::string& indent,
                  std::string_view source)
        : design_(design), pages_(pages), indent_(indent), source_(source) {}

    std::string run(const Structure& s, bool automatic) {
        const std::string id = automatic ? std::string() : fmt::format(" id=\"{}\"", s.id);
        line(0, "<structure type=\"{}\"{}{}>", s.type, id, attributes(s));
        if (!s.points.empty()) {
            line(1, "<outerpoints>");
            for (const DesignPoint& p : s.points) point(2, "point", p, true);
            line(1, "</outerpoints>");
        }
        children(s);
        ground(s);
        line(0, "</structure>");
        return fmt::to_string(out_);
    }

 private:
    template <class... Arguments>
    void line(int depth, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
        out_.append(indent_);
        for (int i = 0; i < depth; ++i) out_.append(indent_step(indent_));
        fmt::format_to(std::back_inserter(out_), text, std::forward<Arguments>(arguments)...);
        out_.push_back('\n');
    }

    [[nodiscard]] std::string length(double mm) const { return format_number(mm / design_.unit.mm); }

    static const ElementInfo& info_of(const Structure& structure) {
        const ElementInfo* info = find_element(structure.type);
        POPUP_INVARIANT(info != nullptr);
        return *info;
    }

    // The values that stand in the start tag.
    [[nodiscard]] std::string attributes(const Structure& s) const {
        const ElementInfo& info = info_of(s);
        std::string text;
        for (std::size_t i = 0; i < s.arguments.size(); ++i) {
            const auto& value = s.arguments[i].value;
            const ParameterInfo& parameter = info.parameters[i];
            if (!parameter.group.empty()) continue;
            if (const auto* word = std::get_if<std::string>(&value)) {
                text += fmt::format(" {}=\"{}\"", parameter.name, *word);
            } else if (const auto* number = std::get_if<double>(&value)) {
                text += fmt::format(
                    " {}=\"{}\"", parameter.name,
                    parameter.kind == ParameterKind::length ? length(*number) : format_number(*number));
            }
        }
        return text;
    }

    // The values that are child elements.
    void children(const Structure& s) {
        const ElementInfo& info = info_of(s);
        std::string grouped;
        for (std::size_t i = 0; i < s.arguments.size(); ++i) {
            const auto* number = std::get_if<double>(&s.arguments[i].value);
            if (number != nullptr && !info.parameters[i].group.empty())
                grouped += fmt::format(" {}=\"{}\"", info.parameters[i].name, length(*number));
        }
        if (!grouped.empty()) line(1, "<folds{}/>", grouped);
        for (std::size_t i = 0; i < s.arguments.size(); ++i) {
            const Argument& argument = s.arguments[i];
            const std::string_view name = info.parameters[i].name;
            const std::string page =
                argument.page ? fmt::format(" page=\"{}\"", pages_.of(*argument.page)) : std::string();
            if (const auto* tint = std::get_if<Color>(&argument.value)) {
                color(1, name, *tint);
            } else if (is_in_file(argument)) {
                const std::string_view tag =
                    source_.substr(argument.tag_text.offset, argument.tag_text.length);
                line(1, "{}{}", tag, tag.ends_with("/>") ? "" : fmt::format("</{}>", name));
            } else if (const auto* path = std::get_if<DrawnPath>(&argument.value)) {
                line(1, "<{}{} d=\"{}\"/>", name, page, path_text(*path, design_.unit));
            } else if (const auto* points = std::get_if<std::vector<DesignPoint>>(&argument.value)) {
                line(1, "<{}{}>", name, page);
                for (const DesignPoint& p : *points) point(2, "point", p, false);
                line(1, "</{}>", name);
            }
        }
    }

    [[nodiscard]] bool is_in_file(const Argument& argument) const {
        return !source_.empty() && std::holds_alternative<DrawnPath>(argument.value) &&
               !argument.text.present() && argument.tag_text.present() && !argument.changed;
    }

    void ground(const Structure& s) {
        if (s.finds_ground) return;
        if (s.named().given()) {
            line(1, "<{} on=\"{}\"/>", s.plate ? "parentplate" : "parentfold", s.named().text);
            return;
        }
        if (s.plate) {
            line(1, "<parentplate page=\"{}\" x=\"{}\" y=\"{}\"/>", pages_.of(s.plate->page),
                 length(s.plate->at.at.x), length(s.plate->at.at.y));
            return;
        }
        line(1, "<parentfold page=\"{}\">", pages_.of(s.fold.page));
        point(2, "begin", s.fold.begin, false);
        point(2, "end", s.fold.end, false);
        line(1, "</parentfold>");
    }

    void color(int depth, std::string_view name, const std::optional<Color>& value) {
        if (value) line(depth, "<{0}>{1}</{0}>", name, to_string(*value));
    }

    void point(int depth, std::string_view name, const DesignPoint& p, bool with_page) {
        const std::string page =
            with_page && p.page ? fmt::format(" page=\"{}\"", pages_.of(*p.page)) : std::string();
        line(depth, "<{} x=\"{}\" y=\"{}\"{}/>", name, length(p.at.x), length(p.at.y), page);
    }

    const Design& design_;
    const PageNames& pages_;
    const std::string& indent_;
    std::string_view source_;
    fmt::memory_buffer out_;
};

}  // namespace

std::string structure_text(const Design& design, const Structure& structure, const PageNames& pages,
                           const std::string& indent, bool automatic, std::string_view source) {
    return StructureText(design, pages, indent, source).run(structure, automatic);
}

}  // namespace popup::xml
