// The machine profiles: one row each. What `--profile` and `popupc list profiles` know of them follows from
// the rows.
#include <algorithm>

#include "base/nth.h"
#include "popup/diagnostics.h"
#include "popup/profile.h"

namespace popup {
namespace {

constexpr Color kBlack{0x00, 0x00, 0x00};
constexpr Color kRed{0xff, 0x00, 0x00};
constexpr Color kGreen{0x00, 0xff, 0x00};
constexpr Color kBlue{0x00, 0x00, 0xff};
constexpr Color kMagenta{0xff, 0x00, 0xff};
constexpr Color kCyan{0x00, 0xff, 0xff};
constexpr Color kTarget{0x8c, 0x8c, 0x8c};  // 3.4 : 1 on white
constexpr Color kText{0x73, 0x73, 0x73};

// Drivers that tell cutting from engraving by the width take no wider lines as cuts: 0.001 inch.
constexpr double kHairline = 0.0254;
constexpr double kThin = 0.1;

using Pens = std::array<Pen, kOperations.size()>;

Pen& pen_of(Pens& pens, Operation operation) { return nth(pens, operation); }

// What is printed. With an empty layer it is left out; a file that begins with such a profile may give it
// one.
Pens printing_pens(const char* layer) {
    Pens pens;
    pen_of(pens, Operation::fill) = {layer, kBlack};
    pen_of(pens, Operation::draw) = {layer, kBlack};
    pen_of(pens, Operation::glue) = {layer, kTarget, 0.2};
    pen_of(pens, Operation::label) = {layer, kText};
    pen_of(pens, Operation::legend) = {"", kBlack, 0.3};
    pen_of(pens, Operation::registration) = {layer, kBlack, 0.3};
    pen_of(pens, Operation::mark) = {"", kMagenta, kThin};
    return pens;
}

struct CuttingPens {
    Pen score, perforation, slit, inner_cut, outer_cut;
    Pen mark = {};
};
// For machines that cut and score: all folds are scored alike.
Pens cutting_pens(const CuttingPens& cutting, const char* printed = "") {
    Pens pens = printing_pens(printed);
    for (const Operation fold : {Operation::valley, Operation::mountain, Operation::seam})
        pen_of(pens, fold) = cutting.score;
    if (!cutting.mark.layer.empty()) pen_of(pens, Operation::mark) = cutting.mark;
    pen_of(pens, Operation::perforation) = cutting.perforation;
    pen_of(pens, Operation::slit) = cutting.slit;
    pen_of(pens, Operation::inner_cut) = cutting.inner_cut;
    pen_of(pens, Operation::outer_cut) = cutting.outer_cut;
    return pens;
}
Pens cutting_pens(const Pen& score, const Pen& cut, const Pen& mark, const char* printed = "") {
    return cutting_pens({score, cut, cut, cut, cut, mark}, printed);
}

Pens workshop_pens() {
    const Pen cut{"cut", kRed, 0.35};
    Pens pens = cutting_pens({{}, {"perforation", kRed, 0.35}, cut, cut, cut});
    pen_of(pens, Operation::valley) = {"valley", kMagenta, 0.3};
    pen_of(pens, Operation::mountain) = {"mountain", kBlue, 0.3};
    pen_of(pens, Operation::seam) = {"seam", kBlack, 0.3};
    for (const Operation printed : kOperations) {
        if (is_printed(printed)) pen_of(pens, printed).layer = to_string(printed);
    }
    return pens;
}

Pens silhouette_pens() {
    Pens pens = cutting_pens({"Score", kBlue, kThin}, {"Cut", kRed, kThin}, {}, "Print");
    pen_of(pens, Operation::registration).layer = "Regmarks";
    return pens;
}

Pens boxes_pens() {
    const Pen inner{"inner-cut", kBlue, kThin};
    Pens pens = cutting_pens({{"etch", kGreen, kThin},
                              inner,
                              {"slit", kBlue, kThin},
                              inner,
                              {"outer-cut", kBlack, kThin},
                              {"mark", kCyan, kThin}});
    pen_of(pens, Operation::label) = {"annotation", kRed};
    return pens;
}

// Spot colours are what tells lines apart in print shops; what they look like on a screen does not matter.
Pens production_pens() {
    constexpr double kQuarterPoint = 0.25 * 25.4 / 72.0;
    Pens pens = workshop_pens();
    pen_of(pens, Operation::legend).layer.clear();
    const auto set = [&pens](Operation operation, const char* layer, Color color, const char* spot) {
        Pen& pen = pen_of(pens, operation);
        pen = {layer, color, kQuarterPoint};
        pen.spot = spot;
    };
    set(Operation::valley, "Creasing", kBlue, "Crease");
    set(Operation::mountain, "Reverse creasing", kGreen, "ReverseCrease");
    set(Operation::seam, "Creasing of tabs", kBlue, "Crease");
    set(Operation::perforation, "Perforating", kRed, "PerfCutContour");
    for (const Operation cut : {Operation::slit, Operation::inner_cut, Operation::outer_cut})
        set(cut, "Cutting", kMagenta, "CutContour");
    return pens;
}

// What most rows have in common: a machine that follows lines one after the other.
Profile machine(std::string name, std::string about, FoldStyle folds, Pens pens) {
    Profile profile;
    profile.name = std::move(name);
    profile.about = std::move(about);
    profile.folds = folds;
    profile.machine_order = true;
    profile.pens = std::move(pens);
    return profile;
}

// One that scores with a beam, from one side.
Profile laser(std::string name, std::string about, Pens pens) {
    Profile profile = machine(std::move(name), std::move(about), FoldStyle::score, std::move(pens));
    profile.one_sided = true;
    profile.away_folds = AwayFolds::broken;
    return profile;
}

std::vector<Profile> make_table() {
    std::vector<Profile> table;
    Profile& workshop = table.emplace_back();
    workshop.name = "workshop";
    workshop.about = "for scissors and knife: cut red, valley magenta, mountain blue, seam black";
    workshop.pens = workshop_pens();

    table.push_back(laser(
        "generic-laser", "drivers that take hairlines in exact red as cuts, blue as scores, green as marks",
        cutting_pens({"score", kBlue, kHairline}, {"cut", kRed, kHairline}, {"mark", kGreen, kHairline})));

    table.push_back(laser(
        "lightburn",
        "LightBurn: a layer a colour; marks magenta, scores red, slits orange, inner cuts blue, outer black",
        cutting_pens({{"score", kRed, kThin},
                      {"perforation", {0x00, 0xe0, 0x00}, kThin},
                      {"slit", {0xff, 0x80, 0x00}, kThin},
                      {"inner-cut", kBlue, kThin},
                      {"outer-cut", kBlack, kThin},
                      {"mark", kMagenta, kThin}})));
    table.back().formats = {"lbrn2", "svg", "dxf", "pdf"};

    table.push_back(
        laser("k40", "K40 Whisperer: red is cut, blue is engraved as a line, no third colour",
              cutting_pens({"ENGRAVE", kBlue, kThin}, {"CUT", kRed, kThin}, {"ENGRAVE", kBlue, kThin})));
    table.back().styled_paths = true;
    table.back().outlined_text = true;
    table.back().formats = {"svg", "dxf"};

    table.push_back(laser("glowforge",
                          "a step a colour: inner cuts red, slits orange, outer black; choose score by hand "
                          "for blue and magenta",
                          cutting_pens({{"score", kBlue, kThin},
                                        {"perforation", kGreen, kThin},
                                        {"slit", {0xff, 0x80, 0x00}, kThin},
                                        {"inner-cut", kRed, kThin},
                                        {"outer-cut", kBlack, kThin},
                                        {"mark", kMagenta, kThin}})));
    table.back().outlined_text = true;
    table.back().formats = {"svg", "pdf"};

    const Pen design_space{"cut", kBlack, kThin};
    table.push_back(machine("cricut", "Design Space: folds perforated in red, cuts black, marks magenta",
                            FoldStyle::perforated,
                            cutting_pens({{"score", kBlue, kThin},
                                          {"perforation", kRed, kThin},
                                          design_space,
                                          design_space,
                                          design_space,
                                          {"mark", kMagenta, kThin}})));
    table.back().verified = false;
    table.back().formats = {"svg", "dxf"};

    table.push_back(machine("silhouette",
                            "folds as real dashes in the layer Cut; what is printed in the layer Print",
                            FoldStyle::perforated, silhouette_pens()));
    table.back().formats = {"svg", "dxf"};

    table.push_back(machine("print-and-cut",
                            "print shops: PDF with spot colours for cut, crease and perforation",
                            FoldStyle::score, production_pens()));
    table.back().outlined_text = true;
    table.back().formats = {"pdf"};

    table.push_back(laser(
        "boxes", "the colours of boxes.py: outer cuts black, inner and slits blue, etched green, marks cyan",
        boxes_pens()));
    return table;
}

std::span<const Profile> profiles() {
    static const std::vector<Profile> table = make_table();
    return table;
}

Operation open_cut(const Profile& profile) {
    return profile.pen(Operation::inner_cut).kerf_mm > 0.0 ? Operation::slit : Operation::inner_cut;
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
        case Operation::legend:
            return "legend";
        case Operation::registration:
            return "registration";
        case Operation::mark:
            return "mark";
        case Operation::valley:
            return "valley";
        case Operation::mountain:
            return "mountain";
        case Operation::seam:
            return "seam";
        case Operation::perforation:
            return "perforation";
        case Operation::slit:
            return "slit";
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

std::string_view to_string(Marks marks) {
    switch (marks) {
        case Marks::none:
            return "none";
        case Marks::corners:
            return "corners";
        case Marks::silhouette:
            return "silhouette";
    }
    broken_invariant("marks are one of their enumerators", __FILE__, __LINE__);
}

std::string_view to_string(MarksOn side) {
    switch (side) {
        case MarksOn::front:
            return "front";
        case MarksOn::back:
            return "back";
        case MarksOn::hidden:
            return "hidden";
        case MarksOn::none:
            return "none";
    }
    broken_invariant("where marks are is one of its enumerators", __FILE__, __LINE__);
}

std::string_view to_string(AwayFolds look) {
    switch (look) {
        case AwayFolds::whole:
            return "whole";
        case AwayFolds::broken:
            return "broken";
    }
    broken_invariant("a look of folds is one of its enumerators", __FILE__, __LINE__);
}

Operation operation_of(const PatternLine& line, const Profile& profile) {
    switch (line.kind) {
        case LineKind::cut:
            return open_cut(profile);
        case LineKind::mountain:
            return Operation::mountain;
        case LineKind::valley:
            return Operation::valley;
        case LineKind::seam:
            return line.glued_on ? Operation::glue : Operation::seam;
        case LineKind::mark:
            return Operation::draw;
    }
    broken_invariant("a line kind is one of its enumerators", __FILE__, __LINE__);
}

Operation operation_of(const Print& print) {
    if (std::holds_alternative<Stroke>(print)) return Operation::draw;
    if (const Text* text = std::get_if<Text>(&print)) return text->color ? Operation::draw : Operation::label;
    return Operation::fill;
}

Operation operation_of(const Contour& cut, const Profile& profile) {
    if (!cut.closed) return open_cut(profile);
    return cut.depth == 0 ? Operation::outer_cut : Operation::inner_cut;
}

bool Profile::dashes(Operation operation) const { return is_fold(operation) && folds == FoldStyle::dashed; }

bool Profile::perforates(Operation fold) const {
    return is_fold(fold) && draws(Operation::perforation) && !pen(fold).layer.empty();
}

bool Profile::marks_glue() const {
    return draws(Operation::mark) && !(draws(Operation::glue) && draws(Operation::label));
}

bool Profile::draws(Operation operation) const {
    if (pen(operation).layer.empty()) return false;
    if (operation == Operation::mark) return marks_on != MarksOn::none;
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
