#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"
#include "pattern/chain.h"
#include "pattern/labels.h"
#include "pattern/silhouette.h"
#include "pattern/tabs.h"
#include "popup/pattern.h"

namespace popup {
namespace {

// What a tab must stay off.
constexpr double kGapMm = 1.0;
// A tab with less depth than this along half its seam holds badly.
constexpr double kWeakMm = 3.0;

std::size_t at(int number) { return static_cast<std::size_t>(number); }

void insert_ring(EdgeIndex& index, const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        index.insert({ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]}, true);
    }
}

class Unfolder {
 public:
    Unfolder(const Assembly& assembly, const PatternOptions& options, Diagnostics& diagnostics)
        : in_(assembly),
          diagnostics_(diagnostics),
          rules_{options.tab_depth.mm, options.tab_taper.rad(), kGapMm},
          pieces_(assembly.pieces.size()),
          lines_on_(assembly.plates.size()),
          plates_(assembly.plates.size()) {}

    Pattern run() {
        sort_lines();
        for (std::size_t i = 0; i < pieces_.size(); ++i) unfold_plates(i);
        for (const Glue& glue : in_.glue) add_tab(glue);
        for (std::size_t i = 0; i < pieces_.size(); ++i) finish(i);
        for (const Plate& plate : in_.plates) out_.plate_names.push_back(plate.name);
        for (Work& work : pieces_) out_.pieces.push_back(std::move(work.piece));
        out_.curves = in_.curves;
        return std::move(out_);
    }

 private:
    enum { kMountain, kValley, kSeam, kDrawnKinds };

    // A piece in the making.
    struct Work {
        PatternPiece piece;
        std::string tab_label;  // of any of its tabs
        std::vector<TaggedSegment> cuts;
        std::array<std::vector<TaggedSegment>, kDrawnKinds> lines;
        std::vector<PatternLine> marks;
        std::vector<Segment> glued;            // what the assembly drew along these gives way to
        std::vector<TaggedSegment> tab_cuts;   // the tabs' free edges and the rests of their seams,
        std::vector<TaggedSegment> tab_seams;  // and the lines between piece and tab
        std::vector<Polygon> tabs;
        std::optional<EdgeIndex> outside;  // what tabs of this piece must stay off
    };

    void sort_lines() {
        for (std::size_t i = 0; i < in_.lines.size(); ++i) {
            const Line& line = in_.lines[i];
            Work& work = pieces_[at(line.piece)];
            const bool fold = line.kind == LineKind::mountain || line.kind == LineKind::valley;
            if (fold || line.kind == LineKind::cut) {
                if (line.plate >= 0) lines_on_[at(line.plate)].push_back(static_cast<int>(i));
                if (line.other_plate >= 0) lines_on_[at(line.other_plate)].push_back(static_cast<int>(i));
            }
            switch (line.kind) {
                case LineKind::cut:
                    work.cuts.push_back({line.at, 0});
                    break;
                case LineKind::mountain:
                    work.lines[kMountain].push_back({line.at, line.plate});
                    break;
                case LineKind::valley:
                    work.lines[kValley].push_back({line.at, line.plate});
                    break;
                case LineKind::seam:
                    work.lines[kSeam].push_back({line.at, line.plate});
                    break;
                case LineKind::mark:
                    work.marks.push_back({line.kind, line.at, line.plate});
                    break;
            }
        }
    }

    void unfold_plates(std::size_t number) {
        PatternPiece& piece = pieces_[number].piece;
        piece.name = in_.pieces[number].name;
        std::vector<Polygon> outlines;
        for (const int index : in_.pieces[number].plates) {
            const Plate& plate = in_.plates[at(index)];
            outlines.push_back(plate.outline);
            if (plate.fill) piece.fills.push_back({plate.outline, *plate.fill, index});
            for (const Stroke& stroke : plate.strokes) piece.strokes.push_back({stroke, index});
        }
        piece.silhouette = silhouette_of(outlines);
    }

    // Everything on a plate that a target must stay off: its edges, lines on it, and what was glued to it
    // before.
    EdgeIndex& on_plate(int plate) {
        std::optional<EdgeIndex>& index = plates_[at(plate)];
        if (!index) {
            std::vector<Segment> lines;
            for (const int line : lines_on_[at(plate)]) lines.push_back(in_.lines[at(line)].at);
            index.emplace(edges_of(in_.plates[at(plate)].outline), lines);
        }
        return *index;
    }

    EdgeIndex& off_piece(Work& work) {
        if (!work.outside) {
            std::vector<Segment> edges;
            for (const Polygon& part : work.piece.silhouette) {
                const auto own = edges_of(part);
                edges.insert(edges.end(), own.begin(), own.end());
            }
            work.outside.emplace(std::move(edges));
        }
        return *work.outside;
    }

    // The obstacles of an index near a tab, in the coordinates of its seam.
    std::vector<Segment> near(const EdgeIndex& index, const SeamFrame& frame, const Ring& tab) {
        Box box;
        for (const Vec2 p : tab) box.extend(frame.to_page(p));
        const Vec2 margin{2.0 * kGapMm, 2.0 * kGapMm};
        index.query({box.min - margin, box.max + margin}, found_);
        std::vector<Segment> obstacles;
        obstacles.reserve(found_.size());
        for (const int i : found_) obstacles.push_back(frame.to_seam(index[i]));
        return obstacles;
    }

    // Adds to the obstacles the stretches of a seam where the tab's own side is not as it must be: off the
    // plate or on an earlier target, in the piece or on another of its tabs.
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

    void add_tab(const Glue& glue) {
        const SeamFrame on_piece(glue.on_piece, true);
        const SeamFrame on_base(glue.on_base, false);
        const int piece_number = in_.plates[at(glue.piece_plate)].piece;
        Work& work = pieces_[at(piece_number)];
        EdgeIndex& base = on_plate(glue.base_plate);
        EdgeIndex& outside = off_piece(work);
        const Ring full = full_tab(on_piece.length(), rules_);
        std::vector<Segment> base_side = near(base, on_base, full);
        std::vector<Segment> piece_side = near(outside, on_piece, full);
        block(base, on_base, 1, base_side);
        block(outside, on_piece, 0, piece_side);
        const std::vector<Ring> parts = trimmed_tab(on_piece.length(), rules_, base_side, piece_side);
        judge(glue, on_piece.length(), parts);

        work.tab_label = glue.label;
        work.glued.push_back(glue.on_piece);
        Work& under = pieces_[at(in_.plates[at(glue.base_plate)].piece)];
        for (const Ring& part : parts) {
            add_part(glue, on_piece, part, work);
            Ring target;
            for (const Vec2 p : part) target.push_back(on_base.to_page(p));
            // The base sees the tab from the other side: what was counter-clockwise is clockwise.
            insert_ring(base, target);
            std::reverse(target.begin(), target.end());
            under.piece.targets.push_back({std::move(target), glue.base_plate});
        }
        add_rest_of_seam(on_piece, parts, work);
        base.insert(glue.on_base, false);
        if (const auto spot = place_in_tab(parts, glue.label)) {
            work.piece.labels.push_back({LabelKind::tab, glue.label, on_piece.to_page(spot->at), spot->height,
                                         on_piece.text_angle()});
            under.piece.labels.push_back({LabelKind::target, glue.label, on_base.to_page(spot->at),
                                          spot->height, on_base.text_angle()});
        }
    }

    void add_part(const Glue& glue, const SeamFrame& frame, const Ring& part, Work& work) {
        Ring ring;
        Ring joined;  // reaches a little into the piece, so that rounding leaves no gap between the two
        constexpr double kReach = 1e-3;
        for (std::size_t i = 0; i < part.size(); ++i) {
            const Vec2 before = part[i == 0 ? part.size() - 1 : i - 1];
            const Vec2 after = part[i + 1 == part.size() ? 0 : i + 1];
            const Segment edge{frame.to_page(part[i]), frame.to_page(after)};
            const bool to_seam = part[i].y == 0.0 && after.y == 0.0;
            const bool from_seam = part[i].y == 0.0 && before.y == 0.0;
            ring.push_back(edge.a);
            if (from_seam) joined.push_back(frame.to_page(part[i] - Vec2{2.0 * kReach, kReach}));
            joined.push_back(edge.a);
            if (to_seam) joined.push_back(frame.to_page(part[i] + Vec2{2.0 * kReach, -kReach}));
            if (to_seam) {
                work.tab_seams.push_back({edge, glue.piece_plate});
            } else {
                work.tab_cuts.push_back({edge, 0});
            }
        }
        insert_ring(*work.outside, ring);
        work.tabs.push_back({std::move(joined), {}});
        if (glue.fill) work.piece.fills.push_back({{std::move(ring), {}}, *glue.fill, -1});
    }

    // Where no tab is left the seam is simply the piece's edge.
    static void add_rest_of_seam(const SeamFrame& frame, const std::vector<Ring>& parts, Work& work) {
        double reached = 0.0;
        for (const Stretch& stretch : seam_stretches(parts)) {
            if (stretch.from > reached) {
                work.tab_cuts.push_back(
                    {{frame.to_page({reached, 0.0}), frame.to_page({stretch.from, 0.0})}, 0});
            }
            reached = stretch.to;
        }
        if (reached < frame.length()) {
            work.tab_cuts.push_back(
                {{frame.to_page({reached, 0.0}), frame.to_page({frame.length(), 0.0})}, 0});
        }
    }

    void judge(const Glue& glue, double seam, const std::vector<Ring>& parts) {
        const double wanted = std::min(kWeakMm, rules_.depth);
        const double good = length_with_depth(parts, wanted - 1e-6);
        if (good > 0.5 * seam) return;
        const std::string& base = in_.plates[at(glue.base_plate)].name;
        const std::string message =
            parts.empty()
                ? fmt::format("nothing is left of glue tab {} on its seam of {:.2f} mm", glue.label, seam)
                : fmt::format(
                      "glue tab {} is at least {:.4g} mm deep along only {:.2f} mm of its seam of "
                      "{:.2f} mm",
                      glue.label, wanted, good, seam);
        const std::array<Ring, 1> full{full_tab(seam, rules_)};
        const bool short_seam = length_with_depth(full, wanted - 1e-6) <= 0.5 * seam;
        diagnostics_.warning("tab-too-small", glue.place, message)
            .about(glue.element)
            .hint(short_seam
                      ? "make the seam longer, or taper the tabs less"
                      : fmt::format(
                            "move the element so that {:.4g} mm of {} beside the seam are clear of folds, "
                            "cuts and earlier tabs",
                            wanted + kGapMm, base));
    }

    void finish(std::size_t number) {
        Work& work = pieces_[number];
        PatternPiece& piece = work.piece;
        work.cuts = without(std::move(work.cuts), work.glued);
        work.cuts.insert(work.cuts.end(), work.tab_cuts.begin(), work.tab_cuts.end());
        piece.cuts = chained(merged(std::move(work.cuts)));
        work.tab_seams = merged(std::move(work.tab_seams));
        std::vector<Segment> folded;
        for (const TaggedSegment& s : work.tab_seams) folded.push_back(s.at);
        work.lines[kSeam] = without(without(std::move(work.lines[kSeam]), work.glued), folded);
        constexpr std::array kKinds{LineKind::mountain, LineKind::valley, LineKind::seam};
        for (std::size_t k = 0; k < kDrawnKinds; ++k) {
            for (const TaggedSegment& s : merged(std::move(work.lines[k]))) {
                piece.lines.push_back({kKinds[k], s.at, s.tag, kKinds[k] == LineKind::seam});
            }
        }
        for (const TaggedSegment& s : work.tab_seams) piece.lines.push_back({LineKind::seam, s.at, s.tag});
        piece.lines.insert(piece.lines.end(), work.marks.begin(), work.marks.end());
        if (!work.tabs.empty()) {
            work.tabs.insert(work.tabs.end(), piece.silhouette.begin(), piece.silhouette.end());
            piece.silhouette = silhouette_of(work.tabs);
        }
        for (const Polygon& part : piece.silhouette) {
            for (const Vec2 p : part.outer) piece.bounds.extend(p);
        }
        name_piece(number);
    }

    [[nodiscard]] Drawing drawing_on(int plate) const {
        std::vector<Segment> lines;
        double half_width = 0.0;
        for (const Stroke& stroke : in_.plates[at(plate)].strokes) {
            for (std::size_t i = 0; i + 1 < stroke.points.size(); ++i) {
                lines.push_back({stroke.points[i], stroke.points[i + 1]});
            }
            half_width = std::max(half_width, 0.5 * stroke.width_mm);
        }
        return {EdgeIndex({}, lines), half_width};
    }

    // The piece's name goes on one of its largest plates, after the number that its tabs have: in the order
    // of these numbers pieces are glued, for none stands on a later one. The name alone where both are too
    // long.
    void name_piece(std::size_t number) {
        const std::string& name = in_.pieces[number].name;
        const std::string order = glue_number(number);
        if (!order.empty() && write_on_piece(number, fmt::format("{}. {}", order, name))) return;
        write_on_piece(number, name);
    }

    // "3" of a piece with the tabs "3L" and "3R"; empty for one without tabs.
    [[nodiscard]] std::string glue_number(std::size_t piece) const {
        return pieces_[piece].tab_label.substr(0, pieces_[piece].tab_label.find_first_not_of("0123456789"));
    }

    bool write_on_piece(std::size_t number, const std::string& text) {
        constexpr std::size_t kTried = 3;
        std::vector<std::pair<double, int>> largest;
        for (const int plate : in_.pieces[number].plates) {
            largest.emplace_back(-std::round(1e3 * area(in_.plates[at(plate)].outline)), plate);
        }
        const std::size_t tried = std::min(kTried, largest.size());
        std::partial_sort(largest.begin(), largest.begin() + static_cast<std::ptrdiff_t>(tried),
                          largest.end());
        std::optional<TextSpot> best;
        for (std::size_t i = 0; i < tried; ++i) {
            const int plate = largest[i].second;
            const auto spot = place_on_plate(on_plate(plate), drawing_on(plate),
                                             bounds(in_.plates[at(plate)].outline.outer), text);
            if (spot && (!best || spot->height > best->height)) best = spot;
        }
        if (!best) return false;
        pieces_[number].piece.labels.push_back({LabelKind::piece, text, best->at, best->height, best->angle});
        return true;
    }

    const Assembly& in_;
    Diagnostics& diagnostics_;
    TabRules rules_;
    std::vector<Work> pieces_;
    std::vector<std::vector<int>> lines_on_;        // of each plate: folds and cuts that name it
    std::vector<std::optional<EdgeIndex>> plates_;  // of each plate that was asked for
    std::vector<int> found_;
    Pattern out_;
};

}  // namespace

std::optional<Pattern> make_pattern(const Assembly& assembly, const PatternOptions& options,
                                    Diagnostics& diagnostics) {
    return Unfolder(assembly, options, diagnostics).run();
}

}  // namespace popup
