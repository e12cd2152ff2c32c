// Designs made in code, for tests: lengths in millimetres, page 0 unless said otherwise.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "popup/check.h"
#include "popup/language.h"
#include "popup/mechanism.h"
#include "popup/motion.h"

namespace popup::test {

// An empty card.
Design card(double width_mm = 279.4, double height_mm = 215.9);

// Adds a structure; points as in POPUP_XML's order, the fold from begin to end on `page`. Returns it.
Structure& add(Design& design, const std::string& type, const std::vector<Vec2>& points, Vec2 begin, Vec2 end,
               int page = 0);
// The same on the gutter.
Structure& add(Design& design, const std::string& type, const std::vector<Vec2>& points);
// A tent on the gutter of a card, over it from at - half to at + half, its seams `out` to either side and its
// sides `wide` high.
Structure& add_tent(Design& design, double at, double half, double out, double wide);

// Checks and assembles; fails the running test, with all findings in its message, when that is not possible.
struct Built {
    std::optional<CheckedDesign> checked;
    std::optional<Assembly> assembly;
    Diagnostics diagnostics;
};
Built build(const Design& design, const CheckOptions& options = {});
// The assembly of a card of 200 × 150 mm with these structures, in mm, version 3.0.
struct FromXml {
    std::optional<Assembly> assembly;  // nothing where there are errors
    std::string text;                  // all findings
    // The number of the plate of that name; fails the running test where there is none.
    [[nodiscard]] std::size_t plate(const std::string& name) const;
};
FromXml from_xml(const std::string& structures);

// A path as the value of a parameter.
Argument path_argument(const Path& path);
Argument path_argument(const std::string& text);

// All findings as lines "severity code: message".
std::string findings(const Diagnostics& diagnostics);

// A random design of `elements` elements of all kinds on all kinds of folds, that needs no repair. Equal
// seeds give equal designs on every machine. Elements that find no room are left out, so it may have fewer.
Design generate(std::uint64_t seed, int elements, double width_mm = 279.4, double height_mm = 215.9);
// The same of one element only, from its row alone: random points that check() has mended. It stands on folds
// or seams.
Design generate_of(const ElementInfo& info, std::uint64_t seed, int elements);

// A random design of all elements of the table on all that they may stand on, with drawn outlines on half of
// the pieces that may have one; as of generate().
Design generate_any(std::uint64_t seed, int elements);

// An element of one row, and one of another that stands on it, on a fold or plate chosen at random, if
// check() finds room for it in one try.
struct OnAnother {
    Design design;
    std::vector<std::size_t> wanted;       // folds that it may stand on, by the ground's row; 0: a plate
    std::optional<std::size_t> stands_on;  // that on which it does
};
OnAnother generate_on(const ElementInfo& info, const ElementInfo& ground, std::uint64_t seed);
// Elements of which each stands on the one before, `depth` of them if there is room.
Design generate_tower(std::uint64_t seed, int depth);

// A long card, to see what size costs: groups of five along the gutter, a step, a smaller one on its side
// fold, one on its centre fold, a tent beside it, and a v-fold on the tent's centre fold. Nothing collides.
// At least five elements. `scale` makes all of it smaller: a page is 10 m long at most, and so long are 830
// elements of their own size.
Design row(int elements, double scale = 1.0);

}  // namespace popup::test
