// Measures of elements on their folds, for who edits them.
#include <algorithm>
#include <cmath>

#include "mechanism/arguments.h"
#include "mechanism/element.h"
#include "mechanism/measures.h"

namespace popup {
namespace {

bool finite(Vec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); }

bool finite(const Element& e) {
    return std::all_of(e.on.begin(), e.on.end(),
                       [](SitePoint p) { return std::isfinite(p.s) && std::isfinite(p.w); }) &&
           std::all_of(e.extra.begin(), e.extra.end(), [](Vec2 p) { return finite(p); });
}

std::optional<std::vector<double>> sound_measures(const Element& e) {
    std::vector<double> made = element_row(*e.info).measured(e);
    POPUP_INVARIANT(made.size() == e.info->measures.size());
    if (!std::all_of(made.begin(), made.end(), [](double v) { return std::isfinite(v); }))
        return std::nullopt;
    return made;
}

// By how much the points stray from those that their measures give: rounding, and what check() would mend.
Element strays(const Element& e, std::span<const double> measures) {
    Element made = e;
    element_row(*e.info).shape(made, measures);
    for (std::size_t i = 0; i < made.on.size(); ++i)
        made.on[i] = {e.on[i].s - made.on[i].s, e.on[i].w - made.on[i].w};
    for (std::size_t i = 0; i < made.extra.size(); ++i) made.extra[i] = e.extra[i] - made.extra[i];
    return made;
}

}  // namespace

std::optional<std::vector<double>> measures_of(const ElementInfo& info, const PageFold& parent,
                                               int extra_page, std::span<const Vec2> points,
                                               std::span<const Argument> arguments) {
    if (info.measures.empty()) return std::vector<double>();
    return sound_measures(element_on(info, parent, extra_page, points, arguments));
}

std::optional<Shaped> shaped(const ElementInfo& info, const PageFold& parent, int extra_page,
                             std::span<const Vec2> points, std::span<const Argument> arguments,
                             std::span<const double> measures, const std::vector<bool>& given) {
    POPUP_INVARIANT(measures.size() == info.measures.size());
    Element e = element_on(info, parent, extra_page, points, arguments);
    // A single point at 0 is that of an element which is there where something is drawn about it.
    const bool there = points.size() == 1 && std::any_of(arguments.begin(), arguments.end(), is_drawn);
    const bool fresh =
        !there && std::all_of(points.begin(), points.end(), [](Vec2 p) { return p == Vec2{}; });
    if (fresh) {
        for (SitePoint& p : e.on) p = {};
    }
    const auto before = fresh ? std::nullopt : sound_measures(e);
    std::optional<Element> off;
    if (before) off = strays(e, *before);
    std::vector<double> wanted(measures.begin(), measures.end());
    if (!given.empty()) {
        if (const auto was = sound_measures(e)) measure::ask_for(given, *was, wanted);
    }
    if (!info.measures.empty()) element_row(info).shape(e, wanted);
    if (off && finite(*off)) {
        for (std::size_t i = 0; i < e.on.size(); ++i) {
            e.on[i].s += off->on[i].s;
            e.on[i].w += off->on[i].w;
        }
        for (std::size_t i = 0; i < e.extra.size(); ++i) e.extra[i] = e.extra[i] + off->extra[i];
    }
    if (!finite(e)) return std::nullopt;
    Shaped made;
    std::size_t on = 0;
    std::size_t extra = 0;
    for (const PointInfo& point : info.points) {
        if (point.page == PointPage::extra) {
            made.points.push_back(e.extra[extra++]);
        } else {
            const Side side = point.side == 'R' ? Side::right : Side::left;
            made.points.push_back(e.site.on_page(side, e.on[on++]));
        }
    }
    made.arguments = std::move(e.arguments);
    return made;
}

}  // namespace popup
