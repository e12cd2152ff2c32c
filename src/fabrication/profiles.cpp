// The machine profiles: one row each. What `--profile` and `popupc list profiles` know of them follows from
// the rows.
#include <algorithm>

#include "popup/diagnostics.h"
#include "popup/profile.h"

namespace popup {
namespace {

constexpr Color kBlack{0x00, 0x00, 0x00};
constexpr Color kRed{0xff, 0x00, 0x00};
constexpr Color kGreen{0x00, 0xff, 0x00};
constexpr Color kBlue{0x00, 0x00, 0xff};
constexpr Color kMagenta{0xff, 0x00, 0xff};
constexpr Color kTarget{0xa6, 0xa6, 0xa6};
constexpr Color kText{0x73, 0x73, 0x73};

// Drivers that tell cutting from engraving by the width take no wider lines as cuts: 0.001 inch.
constexpr double kHairline = 0.0254;
constexpr double kThin = 0.1;

// What is printed, and left out. A file that begins with such a profile may give it a layer.
Pen fill_pen(std::string layer) { return {std::move(layer), kBlack, 0.0}; }
Pen draw_pen(std::string layer) { return {std::move(layer), kBlack, 0.0}; }
Pen glue_pen(std::string layer) { return {std::move(layer), kTarget, 0.2}; }
Pen label_pen(std::string layer) { return {std::move(layer), kText, 0.0}; }

bool is_fold(Operation operation) {
    return operation == Operation::valley || operation == Operation::mountain || operation == Operation::seam;
}

using Pens = std::array<Pen, kOperations.size()>;

// For machines that cut and score: what is printed is left out, and all folds are scored alike.
Pens cutting_pens(const Pen& score, const Pen& perforation, const Pen& inner_cut, const Pen& outer_cut) {
    return {fill_pen(""), draw_pen(""), glue_pen(""), label_pen(""), score,
            score,        score,        perforation,  inner_cut,     outer_cut};
}

// The same, with what is printed in a layer.
Pens printing_pens(const char* layer, Pens pens) {
    const std::array printed{fill_pen(layer), draw_pen(layer), glue_pen(layer), label_pen(layer)};
    std::copy(printed.begin(), printed.end(), pens.begin());
    return pens;
}

Pens workshop_pens() {
    return {fill_pen("fill"),          draw_pen("draw"),
            glue_pen("glue"),          label_pen("label"),
            {"valley", kMagenta, 0.3}, {"mountain", kBlue, 0.3},
            {"seam", kBlack, 0.3},     {"perforation", kRed, 0.35},
            {"cut", kRed, 0.35},       {"cut", kRed, 0.35}};
}

Pens hairline_pens() {
    const Pen cut{"cut", kRed, kHairline};
    return cutting_pens({"score", kBlue, kHairline}, cut, cut, cut);
}

Pens k40_pens() {
    const Pen cut{"CUT", kRed, kThin};
    return cutting_pens({"ENGRAVE", kBlue, kThin}, cut, cut, cut);
}

Pens silhouette_pens() {
    const Pen cut{"Cut", kRed, kThin};
    return printing_pens("Print", cutting_pens({"Score", kBlue, kThin}, cut, cut, cut));
}

Pens boxes_pens() {
    const Pen inner{"inner-cut", kBlue, kThin};
    Pens pens = cutting_pens({"etch", kGreen, kThin}, inner, inner, {"outer-cut", kBlack, kThin});
    pens[static_cast<std::size_t>(Operation::label)] = {"annotation", kRed, 0.0};
    return pens;
}

std::span<const Profile> profiles() {
    constexpr Perforation kUsual{};
    // name, about, verified, folds, perforation, one-sided, styled paths, pens
    static const std::array kTable{
        Profile{"workshop", "for scissors and knife: cut red, valley magenta, mountain blue, seam black",
                true, FoldStyle::dashed, kUsual, false, false, workshop_pens()},
        Profile{"generic-laser", "drivers that take hairlines in exact red as cuts and blue as scores", true,
                FoldStyle::score, kUsual, true, false, hairline_pens()},
        Profile{"lightburn", "LightBurn: a layer a colour; red scores, then inner cuts blue, outer black",
                true, FoldStyle::score, kUsual, true, false,
                cutting_pens({"score", kRed, kThin}, {"perforation", {0x00, 0xe0, 0x00}, kThin},
                             {"inner-cut", kBlue, kThin}, {"outer-cut", kBlack, kThin})},
        Profile{"k40", "K40 Whisperer: red is cut, blue is engraved as a line, no third colour", true,
                FoldStyle::score, kUsual, true, true, k40_pens()},
        Profile{"glowforge", "a step a colour: inner cuts red, outer black; choose score by hand for blue",
                true, FoldStyle::score, kUsual, true, false,
                cutting_pens({"score", kBlue, kThin}, {"perforation", kGreen, kThin},
                             {"inner-cut", kRed, kThin}, {"outer-cut", kBlack, kThin})},
        Profile{"cricut", "Design Space: folds perforated, in a colour of their own", false,
                FoldStyle::perforated, kUsual, false, false,
                cutting_pens({"score", kBlue, kThin}, {"perforation", kRed, kThin}, {"cut", kBlack, kThin},
                             {"cut", kBlack, kThin})},
        Profile{"silhouette", "folds as real dashes in the layer Cut; what is printed in the layer Print",
                true, FoldStyle::perforated, kUsual, false, false, silhouette_pens()},
        Profile{"boxes", "the colours of boxes.py: outer cuts black, inner blue, etched green, notes red",
                true, FoldStyle::score, kUsual, true, false, boxes_pens()},
    };
    return kTable;
}

}  // namespace

std::string_view to_string(Operation operation) {
    switch (operation) {
        case Operation::fill:
            return "fill";
        case Operation::draw:
            return "draw";
        case Operation::glue:
            return "glue";
        case Operation::label:
            return "label";
        case Operation::valley:
            return "valley";
        case Operation::mountain:
            return "mountain";
        case Operation::seam:
            return "seam";
        case Operation::perforation:
            return "perforation";
        case Operation::inner_cut:
            return "inner-cut";
        case Operation::outer_cut:
            return "outer-cut";
    }
    broken_invariant("an operation is one of its enumerators", __FILE__, __LINE__);
}

std::string_view to_string(FoldStyle style) {
    switch (style) {
        case FoldStyle::dashed:
            return "dashed";
        case FoldStyle::score:
            return "score";
        case FoldStyle::perforated:
            return "perforated";
        case FoldStyle::both:
            return "both";
    }
    broken_invariant("a fold style is one of its enumerators", __FILE__, __LINE__);
}

Operation operation_of(const PatternLine& line, const Profile& profile) {
    switch (line.kind) {
        case LineKind::cut:
            return Operation::inner_cut;
        case LineKind::mountain:
            return Operation::mountain;
        case LineKind::valley:
            return Operation::valley;
        case LineKind::seam:
            return line.glued_on && profile.folds != FoldStyle::dashed ? Operation::glue : Operation::seam;
        case LineKind::mark:
            return Operation::draw;
    }
    broken_invariant("a line kind is one of its enumerators", __FILE__, __LINE__);
}

Operation operation_of(const Contour& cut) {
    return cut.closed && cut.depth == 0 ? Operation::outer_cut : Operation::inner_cut;
}

bool Profile::dashes(Operation operation) const { return is_fold(operation) && folds == FoldStyle::dashed; }

bool Profile::perforates(Operation fold) const {
    return is_fold(fold) && draws(Operation::perforation) && !pen(fold).layer.empty();
}

bool Profile::draws(Operation operation) const {
    if (pen(operation).layer.empty()) return false;
    if (is_fold(operation)) return folds != FoldStyle::perforated;
    if (operation == Operation::perforation)
        return folds == FoldStyle::perforated || folds == FoldStyle::both;
    return true;
}

std::span<const Profile> profile_table() { return profiles(); }

std::vector<std::string_view> profile_names() {
    std::vector<std::string_view> names;
    names.reserve(profiles().size());
    for (const Profile& row : profiles()) names.push_back(row.name);
    return names;
}

const Profile* find_profile(std::string_view name) {
    const std::span<const Profile> table = profiles();
    const auto at =
        std::find_if(table.begin(), table.end(), [name](const Profile& row) { return row.name == name; });
    return at == table.end() ? nullptr : &*at;
}

}  // namespace popup
