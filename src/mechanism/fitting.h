// Repairs that several elements share: lines made parallel, cut elements fitted onto their paper.
#pragma once

#include <functional>
#include <string_view>
#include <utility>

#include "mechanism/element.h"
#include "mechanism/site_lines.h"

namespace popup {

// Turns both pairs (a, b), which should run along the fold, about their midpoints until they do; a repair
// where the deviation is more than rounding. `name` is the line's ("A–B").
void make_parallel(Element& element, std::size_t a, std::size_t b, std::string_view name);

// The largest t in (0, 1] for which ok(t), which is assumed to hold below it as well; 0 when it holds
// nowhere.
double largest_that_fits(const std::function<bool(double)>& ok);

// Makes a cut element fit on its paper: pulled towards the fold on the side where it is too large, else
// shortened along the fold about `fixed_s`, else both. `footprint` gives a side's half from the points as
// they are, `span` the stretch of the fold between the cuts. False after failed().
struct Footprint {
    std::function<Ring(const Element&, Side)> half;
    std::function<std::pair<double, double>(const Element&)> span;
    double fixed_s = 0.0;
    std::function<bool(const Element&)> valid =
        nullptr;  // what else must hold of the smaller element; none: nothing
};
bool fit_cut(Element& element, const Footprint& footprint);

}  // namespace popup
