#include "pattern/tab_places.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "base/geometry/regions.h"
#include "pattern/glue_overlaps.h"
#include "pattern/silhouette.h"

namespace popup {
namespace {

// What a tab must stay off.
constexpr double kGapMm = 1.0;

std::size_t at(int number) { return static_cast<std::size_t>(number); }

void insert_ring(EdgeIndex& index, const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        index.insert({ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]}, true);
    }
}

// Adds to the obstacles the stretches of a seam where the tab's own side is not as it must be: off the plate
// or on an earlier target, in the piece or on another of its tabs.
void block(const EdgeIndex& index, const SeamFrame& frame, int free_winding,
           std::vector<Segment>& obstacles) {
    constexpr double kBeside = 0.01;  // looks past an edge that the seam lies on
    std::vector<double> ends{0.0, frame.length()};
    for (const Segment& s : obstacles) {
        const double a = s.a.y - kBeside;
        const double b = s.b.y - kBeside;
        if ((a > 0.0) == (b > 0.0)) continue;
        const double t = lerp(s.a, s.b, a / (a - b)).x;
        if (t > 0.0 && t < frame.length()) ends.push_back(t);
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const Vec2 probe = frame.to_page({0.5 * (ends[i] + ends[i + 1]), kBeside});
        if (index.winding(probe) == free_winding) continue;
        obstacles.push_back({{ends[i], kBeside}, {ends[i + 1], kBeside}});
    }
}

// Of the element's own tabs that come before, the one that takes most of a tab's place: moving the element
// moves both. Null: none does.
const Glue* own_tab_there(const Assembly& assembly, const TabRules& rules, const Glue& glue) {
    const auto place_of = [&](const Glue& one) {
        const SeamFrame frame(one.on_base, one.on_back);
        Ring ring = frame.to_page(full_tab(frame.length(), rules));
        if (signed_area(ring) < 0.0) std::reverse(ring.begin(), ring.end());
        return std::vector<Polygon>{{std::move(ring), {}}};
    };
    const std::vector<Polygon> place = place_of(glue);
    const Glue* most = nullptr;
    double taken = 0.25 * area(place);
    for (const Glue& other : assembly.glue) {
        if (&other == &glue) break;
        if (other.element != glue.element || other.base_plate != glue.base_plate ||
            other.on_back != glue.on_back)
            continue;
        const double shared = area(intersect(place, place_of(other)));
        if (shared <= taken) continue;
        taken = shared;
        most = &other;
    }
    return most;
}

}  // namespace

TabRules tab_rules(const PatternOptions& options) {
    return {options.tab_depth.mm, options.tab_taper.rad(), kGapMm};
}

TabPlaces::TabPlaces(const Assembly& assembly, const TabRules& rules)
    : in_(assembly),
      rules_(rules),
      lines_on_(assembly.plates.size()),
      plates_{std::vector<std::optional<EdgeIndex>>(assembly.plates.size()),
              std::vector<std::optional<EdgeIndex>>(assembly.plates.size())},
      outside_(assembly.pieces.size()),
      papers_(assembly.pieces.size()) {
    for (std::size_t i = 0; i < in_.lines.size(); ++i) {
        const Line& line = in_.lines[i];
        const bool fold = line.kind == LineKind::mountain || line.kind == LineKind::valley;
        if (!fold && line.kind != LineKind::cut) continue;
        if (line.plate >= 0) lines_on_[at(line.plate)].push_back(static_cast<int>(i));
        if (line.other_plate >= 0) lines_on_[at(line.other_plate)].push_back(static_cast<int>(i));
    }
}

const std::vector<Polygon>& TabPlaces::paper(int piece) {
    std::optional<std::vector<Polygon>>& paper = papers_[at(piece)];
    if (!paper) {
        const Piece& from = in_.pieces[at(piece)];
        std::vector<Polygon> outlines;
        if (from.paper.empty()) {
            for (const int plate : from.plates) outlines.push_back(in_.plates[at(plate)].outline);
        }
        paper = from.paper.empty() ? silhouette_of(outlines) : from.paper;
    }
    return *paper;
}

EdgeIndex& TabPlaces::on_plate(int plate, bool back) {
    std::optional<EdgeIndex>& index = plates_.at(back ? 1 : 0)[at(plate)];
    if (!index) {
        std::vector<Segment> lines;
        for (const int line : lines_on_[at(plate)]) lines.push_back(in_.lines[at(line)].at);
        index.emplace(edges_of(in_.plates[at(plate)].outline), lines);
    }
    return *index;
}

void TabPlaces::take(int plate, bool back, Ring ring) {
    // What is taken away runs clockwise.
    std::reverse(ring.begin(), ring.end());
    insert_ring(on_plate(plate, back), ring);
}

EdgeIndex& TabPlaces::off_piece(int piece) {
    std::optional<EdgeIndex>& index = outside_[at(piece)];
    if (!index) {
        std::vector<Segment> edges;
        for (const Polygon& part : paper(piece)) {
            const auto own = edges_of(part);
            edges.insert(edges.end(), own.begin(), own.end());
        }
        index.emplace(std::move(edges));
    }
    return *index;
}

// The obstacles of an index near a tab, in the coordinates of its seam.
std::vector<Segment> TabPlaces::near(const EdgeIndex& index, const SeamFrame& frame, const Ring& tab) {
    Box box;
    for (const Vec2 p : tab) box.extend(frame.to_page(p));
    const Vec2 margin{2.0 * kGapMm, 2.0 * kGapMm};
    index.query({box.min - margin, box.max + margin}, found_);
    std::vector<Segment> obstacles;
    obstacles.reserve(found_.size());
    for (const int i : found_) obstacles.push_back(frame.to_seam(index[i]));
    return obstacles;
}

std::vector<Ring> TabPlaces::place(const Glue& glue) {
    const SeamFrame on_piece(glue.on_piece, true);
    const SeamFrame on_base(glue.on_base, glue.on_back);
    EdgeIndex& base = on_plate(glue.base_plate, glue.on_back);
    EdgeIndex& outside = off_piece(in_.plates[at(glue.piece_plate)].piece);
    const Ring full = full_tab(on_piece.length(), rules_);
    std::vector<Segment> base_side = near(base, on_base, full);
    std::vector<Segment> piece_side = near(outside, on_piece, full);
    block(base, on_base, 1, base_side);
    block(outside, on_piece, 0, piece_side);
    std::vector<Ring> parts = trimmed_tab(on_piece.length(), rules_, base_side, piece_side);
    for (const Ring& part : parts) {
        insert_ring(outside, on_piece.to_page(part));
        Ring target = on_base.to_page(part);
        // The base's front sees the tab from the other side: what was counter-clockwise is clockwise.
        if (!glue.on_back) std::reverse(target.begin(), target.end());
        take(glue.base_plate, glue.on_back, std::move(target));
    }
    base.insert(glue.on_base, false);
    return parts;
}

void judge_tab(const Assembly& assembly, const TabRules& rules, const Glue& glue, std::span<const Ring> parts,
               Diagnostics& diagnostics) {
    const double seam = SeamFrame(glue.on_piece, true).length();
    const double wanted = std::min(kWeakTabMm, rules.depth);
    const double good = length_with_depth(parts, wanted - 1e-6);
    if (good > 0.5 * seam) return;
    const std::string& base = assembly.plates[at(glue.base_plate)].name;
    const std::string message =
        parts.empty()
            ? fmt::format("nothing is left of glue tab {} on its seam of {:.2f} mm", glue.label, seam)
            : fmt::format(
                  "glue tab {} is at least {:.4g} mm deep along only {:.2f} mm of its seam of {:.2f} mm",
                  glue.label, wanted, good, seam);
    const std::array<Ring, 1> full{full_tab(seam, rules)};
    const bool short_seam = length_with_depth(full, wanted - 1e-6) <= 0.5 * seam;
    const Glue* const own = short_seam ? nullptr : own_tab_there(assembly, rules, glue);
    std::string hint;
    if (short_seam) {
        hint = "make the seam longer, or taper the tabs less";
    } else if (own != nullptr) {
        hint = fmt::format(
            "tab {} of \"{}\" itself takes its place on {}, and goes along wherever it is moved: make \"{}\" "
            "larger, so that its seams are further apart, or --tab-depth less",
            own->label, glue.element, base, glue.element);
    } else {
        hint = fmt::format(
            "move the element so that {:.4g} mm of {} beside the seam are clear of folds, cuts and earlier "
            "tabs",
            wanted + kGapMm, base);
    }
    diagnostics.warning("tab-too-small", glue.place, message).about(glue.element).hint(hint);
}

void judge_tabs(const Assembly& assembly, const PatternOptions& options, Diagnostics& diagnostics) {
    const TabRules rules = tab_rules(options);
    report_glue_overlaps(assembly, options, diagnostics);
    TabPlaces places(assembly, rules);
    for (const Glue& glue : assembly.glue) judge_tab(assembly, rules, glue, places.place(glue), diagnostics);
}

}  // namespace popup
