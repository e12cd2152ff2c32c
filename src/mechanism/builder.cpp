#include "mechanism/builder.h"

#include <algorithm>
#include <utility>

#include "base/nth.h"

namespace popup {

const CutSpan* Fold::cut_within(double lo, double hi) const {
    auto next = gone.lower_bound(lo);
    if (next != gone.begin()) {
        const auto before = std::prev(next);
        if (before->second.end > lo) return &before->second;
    }
    return next != gone.end() && next->first < hi ? &next->second : nullptr;
}

std::optional<std::pair<double, double>> Fold::alive_around(double s) const {
    double lo = 0.0;
    double hi = length();
    const auto next = gone.upper_bound(s);
    if (next != gone.end()) hi = next->first;
    if (next != gone.begin()) {
        const auto before = std::prev(next);
        if (before->second.end > s) return std::nullopt;
        lo = before->second.end;
    }
    return std::pair{lo, hi};
}

void Builder::add_base_page(double width_mm, double height_mm, std::optional<Color> left,
                            std::optional<Color> right) {
    const double w = 0.5 * width_mm;
    const double h = 0.5 * height_mm;
    const int piece = add_piece("page");
    skeleton_.page_mirrored.push_back(false);
    const int left_plate = add_plate("page/left", piece, 0, {{{-w, -h}, {0, -h}, {0, h}, {-w, h}}, {}}, left);
    const int right_plate =
        add_plate("page/right", piece, 0, {{{0, -h}, {w, -h}, {w, h}, {0, h}}, {}}, right);
    const Ring corners{{-w, -h}, {w, -h}, {w, h}, {-w, h}};
    for (std::size_t i = 0; i < 4; ++i) add_cut(piece, {corners[i], corners[(i + 1) % 4]});

    Fold gutter;
    gutter.left_plate = left_plate;
    gutter.right_plate = right_plate;
    gutter.on_left = gutter.on_right = {{0, -h}, {0, h}};
    gutter.owner = "page";
    add_fold(std::move(gutter));

    for (const auto& [plate, turns] : {std::pair{left_plate, -1}, std::pair{right_plate, 1}}) {
        add_joint({"page", {}, Drive{plate, {0, -h}, {0, 1}, turns}});
        skeleton_.draft.covers.push_back(plate);
    }
}

int Builder::add_piece(const std::string& name) {
    skeleton_.draft.pieces.push_back({name, {}});
    return static_cast<int>(skeleton_.draft.pieces.size()) - 1;
}

int Builder::add_plate(const std::string& name, int piece, int page, Polygon outline,
                       std::optional<Color> fill) {
    const int index = static_cast<int>(skeleton_.draft.plates.size());
    if (signed_area(outline.outer) < 0.0) std::reverse(outline.outer.begin(), outline.outer.end());
    for (Ring& hole : outline.holes) {
        if (signed_area(hole) > 0.0) std::reverse(hole.begin(), hole.end());
    }
    Plate plate;
    plate.name = name;
    plate.piece = piece;
    plate.outline = std::move(outline);
    plate.fill = fill;
    skeleton_.draft.plates.push_back(std::move(plate));
    skeleton_.draft.pieces[static_cast<std::size_t>(piece)].plates.push_back(index);
    skeleton_.plate_page.push_back(page);
    skeleton_.cut_outs.emplace_back();
    skeleton_.holes_of.emplace_back();
    return index;
}

int Builder::add_cut_plate(const std::string& name, int piece, int page, Polygon outline,
                           std::optional<Color> fill) {
    const int index = add_plate(name, piece, page, std::move(outline), fill);
    const Polygon& made = nth(skeleton_.draft.plates, index).outline;
    const auto cut_round = [&](const Ring& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) add_cut(piece, {ring[i], ring[(i + 1) % ring.size()]});
    };
    cut_round(made.outer);
    for (const Ring& hole : made.holes) cut_round(hole);
    return index;
}

void Builder::add_cut(int piece, Segment at) {
    skeleton_.draft.lines.push_back({LineKind::cut, at, piece, -1, -1});
}

void Builder::add_curves(std::span<const FlatCurve> curves) {
    skeleton_.curves.insert(skeleton_.curves.end(), curves.begin(), curves.end());
}

int Builder::add_fold(Fold fold) {
    skeleton_.draft.hinges.push_back(
        {fold.left_plate, fold.right_plate, fold.on_left, fold.on_right, fold.seam});
    skeleton_.folds.push_back(std::move(fold));
    return static_cast<int>(skeleton_.folds.size()) - 1;
}

void Builder::add_glued_area(GluedArea area) { skeleton_.draft.glued_areas.push_back(std::move(area)); }

void Builder::add_glue(Glue glue) { skeleton_.draft.glue.push_back(std::move(glue)); }

void Builder::add_foot(Glue glue) {
    constexpr double kBesideFootMm = 1.0;
    skeleton_.draft.hinges.push_back({glue.piece_plate, glue.base_plate, glue.on_piece, glue.on_base, true});
    const Vec2 along = unit(glue.on_base.b - glue.on_base.a);
    const Vec2 in = kBesideFootMm * (glue.on_back ? left_of(along) : right_of(along));
    skeleton_.feet.push_back({glue.base_plate, glue.on_base, {glue.on_base.a + in, glue.on_base.b + in}});
    add_glue(std::move(glue));
}

void Builder::add_hole(int plate, Ring ring) {
    if (signed_area(ring) > 0.0) std::reverse(ring.begin(), ring.end());
    const int piece = nth(skeleton_.draft.plates, plate).piece;
    for (std::size_t i = 0; i < ring.size(); ++i) add_cut(piece, {ring[i], ring[(i + 1) % ring.size()]});
    nth(skeleton_.holes_of, plate).push_back(static_cast<int>(skeleton_.holes.size()));
    skeleton_.holes.push_back({plate, std::move(ring)});
}

void Builder::add_window(int page, Ring ring, std::span<const int> plates) {
    if (signed_area(ring) < 0.0) std::reverse(ring.begin(), ring.end());
    for (const int plate : plates) {
        nth(skeleton_.holes_of, plate).push_back(static_cast<int>(skeleton_.holes.size()));
        skeleton_.holes.push_back({plate, {ring.rbegin(), ring.rend()}, true});
    }
    skeleton_.windows.push_back({page, std::move(ring)});
}

void Builder::add_cut_out(int plate, int fold, Ring path) {
    const Fold& from = skeleton_.folds[static_cast<std::size_t>(fold)];
    const Segment& line = plate == from.left_plate ? from.on_left : from.on_right;
    const auto along = [&](Vec2 p) { return dot(unit(line.b - line.a), p - line.a); };
    if (along(path.front()) > along(path.back())) std::reverse(path.begin(), path.end());
    const double begin = along(path.front());
    skeleton_.cut_outs[static_cast<std::size_t>(plate)].push_back({fold, begin, std::move(path)});
}

void Builder::add_gone(int fold, double lo, double hi, const std::string& by) {
    skeleton_.folds[static_cast<std::size_t>(fold)].gone.emplace(lo, CutSpan{hi, by});
}

void Builder::add_joint(Joint joint) {
    hang_plates(joint, skeleton_.draft.plates);
    skeleton_.draft.joints.push_back(std::move(joint));
}

}  // namespace popup
