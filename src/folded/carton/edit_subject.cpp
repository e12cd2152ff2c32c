#include "folded/carton/edit_subject.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/nth.h"
#include "base/text/nearest.h"
#include "base/text/shown.h"

namespace popup::folded {
namespace {

std::string some_names(const std::vector<std::string>& names) {
    constexpr std::size_t kMost = 40;
    if (names.size() <= kMost) return fmt::format("{}", fmt::join(names, " "));
    return fmt::format("{} and {} more", fmt::join(names.begin(), names.begin() + kMost, " "),
                       names.size() - kMost);
}

std::optional<int> number_in(std::string_view text) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

// What an edit names, as vertices with their moves.
class SubjectFinder {
 public:
    SubjectFinder(const Vertices& shape, const SheetEdit& edit, Diagnostics& diagnostics)
        : shape_(shape), edit_(edit), diagnostics_(diagnostics) {}

    std::optional<Subject> run() {
        switch (edit_.kind) {
            case SheetEdit::Kind::vertex:
                return vertex();
            case SheetEdit::Kind::edge:
                return edge();
            case SheetEdit::Kind::extrude:
                return extrude();
        }
        return std::nullopt;
    }

 private:
    std::optional<Subject> vertex() {
        const std::optional<int> corner = corner_named(edit_.name);
        if (!corner) return std::nullopt;
        return Subject{{{shape_.vertex_of(*corner), way_from(shape_.place(*corner))}}, {*corner}};
    }

    std::optional<Subject> edge() {
        std::optional<std::pair<int, int>> ends =
            edit_.name.find('+') == std::string::npos ? edge_of_panel() : fold_between();
        if (!ends) return std::nullopt;
        const auto [a, b] = *ends;
        const Vec3 way = way_from(0.5 * (shape_.place(a) + shape_.place(b)));
        return Subject{{{shape_.vertex_of(a), way}, {shape_.vertex_of(b), way}}, {a, b}};
    }

    std::optional<Subject> extrude() {
        const std::optional<int> panel = panel_named(edit_.name);
        if (!panel) return std::nullopt;
        const Vec3 out = shape_.out(*panel);
        Subject subject;
        bool is_flat = true;  // all of the shape
        const Vec3 at = shape_.place(nth(shape_.sheet().panels, *panel).outer.front());
        const auto in_plane = [&](int corner) {
            return std::abs(dot(out, shape_.place(corner) - at)) <= shape_.meet_mm();
        };
        for (const Panel& one : shape_.sheet().panels) {
            if (!std::all_of(one.outer.begin(), one.outer.end(), in_plane)) {
                is_flat = false;
                continue;
            }
            for (const int corner : one.outer) {
                if (shape_.vertex_of(corner) < 0) continue;
                subject.vertices.emplace(shape_.vertex_of(corner), edit_.out_mm * out);
                subject.exact.push_back(corner);
            }
        }
        if (is_flat && edit_.out_mm != 0.0) {
            refuse(fmt::format(
                       "extrude moves all that lies in the plane of {}, and the whole folded shape does: "
                       "it would be where it is, only further on",
                       shape_.name_of(*panel)),
                   "a shape that lies flat grows in its plane, by edge or vertex; for one with room inside, "
                   "draw walls between its panels, or let folds go by less than 180°");
            return std::nullopt;
        }
        return subject;
    }

    [[nodiscard]] Vec3 way_from(Vec3 at) const { return edit_.to ? edit_.by - at : edit_.by; }

    std::optional<int> panel_named(std::string_view name) {
        const int panel = shape_.find(name);
        if (panel >= 0) return panel;
        std::vector<std::string> names;
        for (const int one : shape_.tree().order) names.push_back(shape_.name_of(one));
        const std::vector<std::string_view> views(names.begin(), names.end());
        const std::vector<std::string> meant = nearest(name, views);
        refuse(fmt::format("the sheet has no panel \"{}\"", shown(name)),
               meant.empty() ? "its panels: " + some_names(names)
                             : fmt::format("did you mean {}?", fmt::join(meant, " or ")));
        return std::nullopt;
    }

    // The corner of a panel with this number.
    std::optional<int> corner_numbered(int panel, std::string_view number) {
        const std::vector<int>& named = shape_.named(panel);
        const auto wanted = number_in(number);
        if (wanted && *wanted >= 1 && *wanted <= static_cast<int>(named.size()))
            return nth(named, *wanted - 1);
        refuse(fmt::format("{} has no vertex {}: it has 1 to {}", shape_.name_of(panel), shown(number),
                           named.size()),
               "popupc show lists them with their places");
        return std::nullopt;
    }

    std::optional<int> corner_named(std::string_view name) {
        if (name.find('+') != std::string_view::npos) return corner_where(name);
        const std::size_t dot = name.rfind('.');
        if (dot == std::string_view::npos) {
            refuse(fmt::format("\"{}\" names no vertex", shown(name)),
                   "write PANEL.NUMBER, such as front.2, or the panels that meet there, such as "
                   "front+right+top; popupc show lists them");
            return std::nullopt;
        }
        const std::optional<int> panel = panel_named(name.substr(0, dot));
        return panel ? corner_numbered(*panel, name.substr(dot + 1)) : std::nullopt;
    }

    // A corner of the vertex at which all these panels meet; where nothing else does, if there are several.
    std::optional<int> corner_where(std::string_view name) {
        std::vector<int> wanted;
        for (std::string_view rest = name; !rest.empty();) {
            const std::size_t plus = std::min(rest.find('+'), rest.size());
            const std::optional<int> panel = panel_named(rest.substr(0, plus));
            if (!panel) return std::nullopt;
            wanted.push_back(*panel);
            rest.remove_prefix(std::min(plus + 1, rest.size()));
        }
        std::sort(wanted.begin(), wanted.end());
        wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
        std::vector<int> found;
        std::vector<int> exact;
        for (std::size_t i = 0; i < shape_.members().size(); ++i) {
            std::vector<int> panels;
            for (const CornerOf& one : shape_.members()[i]) panels.push_back(one.panel);
            std::sort(panels.begin(), panels.end());
            panels.erase(std::unique(panels.begin(), panels.end()), panels.end());
            if (!std::includes(panels.begin(), panels.end(), wanted.begin(), wanted.end())) continue;
            found.push_back(static_cast<int>(i));
            if (panels == wanted) exact.push_back(static_cast<int>(i));
        }
        if (!exact.empty()) found = std::move(exact);
        if (found.size() == 1) return corner_in(found.front(), wanted.front());
        if (found.empty()) {
            refuse(fmt::format("no vertex has all the panels of \"{}\"", shown(name)),
                   "popupc show lists what meets at each");
            return std::nullopt;
        }
        std::vector<std::string> names;
        names.reserve(found.size());
        for (const int vertex : found)
            names.push_back(name_of(corner_in(vertex, wanted.front()), wanted.front()));
        refuse(fmt::format("{} vertices have all the panels of \"{}\"", found.size(), shown(name)),
               "they are " + some_names(names));
        return std::nullopt;
    }
    [[nodiscard]] int corner_in(int vertex, int panel) const {
        const std::vector<int>& named = shape_.named(panel);
        return *std::find_if(named.begin(), named.end(),
                             [&](int corner) { return shape_.vertex_of(corner) == vertex; });
    }
    [[nodiscard]] std::string name_of(int corner, int panel) const {
        const std::vector<int>& named = shape_.named(panel);
        return fmt::format("{}.{}", shape_.name_of(panel),
                           std::find(named.begin(), named.end(), corner) - named.begin() + 1);
    }

    std::optional<std::pair<int, int>> edge_of_panel() {
        const std::string_view name = edit_.name;
        const std::size_t dot = name.rfind('.');
        const std::size_t dash = dot == std::string_view::npos ? dot : name.find('-', dot);
        if (dash == std::string_view::npos) {
            refuse(fmt::format("\"{}\" names no edge", shown(name)),
                   "write PANEL.NUMBER-NUMBER, such as front.2-3, or PANEL+PANEL for the fold between two; "
                   "popupc "
                   "show lists them");
            return std::nullopt;
        }
        const std::optional<int> panel = panel_named(name.substr(0, dot));
        if (!panel) return std::nullopt;
        const auto a = corner_numbered(*panel, name.substr(dot + 1, dash - dot - 1));
        const auto b = a ? corner_numbered(*panel, name.substr(dash + 1)) : std::nullopt;
        if (!b) return std::nullopt;
        const std::vector<int>& named = shape_.named(*panel);
        const auto at = [&](int corner) {
            return std::find(named.begin(), named.end(), corner) - named.begin();
        };
        const auto count = static_cast<std::ptrdiff_t>(named.size());
        if ((at(*a) + 1) % count != at(*b) && (at(*b) + 1) % count != at(*a)) {
            refuse(fmt::format("the vertices of \"{}\" are not beside each other", shown(name)),
                   "popupc show lists the edges of each panel");
            return std::nullopt;
        }
        return std::pair(*a, *b);
    }

    std::optional<std::pair<int, int>> fold_between() {
        const std::string_view name = edit_.name;
        const std::size_t plus = name.find('+');
        const std::optional<int> one = panel_named(name.substr(0, plus));
        const std::optional<int> other = one ? panel_named(name.substr(plus + 1)) : std::nullopt;
        if (!other) return std::nullopt;
        for (const Fold& fold : shape_.sheet().folds) {
            if (std::minmax(fold.left, fold.right) != std::minmax(*one, *other)) continue;
            const int a = fold.stretches.front().a;
            const int b = fold.stretches.back().b;
            if (shape_.vertex_of(a) >= 0 && shape_.vertex_of(b) >= 0) return std::pair(a, b);
        }
        refuse(
            fmt::format("there is no fold between {} and {}", shape_.name_of(*one), shape_.name_of(*other)),
            "popupc show lists the folds of each panel");
        return std::nullopt;
    }

    void refuse(std::string why, std::string hint) {
        diagnostics_.error("bad-edit", {}, std::move(why)).hint(std::move(hint));
    }

    const Vertices& shape_;
    const SheetEdit& edit_;
    Diagnostics& diagnostics_;
};

}  // namespace

std::optional<Subject> subject_of(const Vertices& shape, const SheetEdit& edit, Diagnostics& diagnostics) {
    return SubjectFinder(shape, edit, diagnostics).run();
}

}  // namespace popup::folded
