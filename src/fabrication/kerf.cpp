#include "fabrication/kerf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <polyclipping/clipper.hpp>
#include <span>
#include <string>
#include <utility>

#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"
#include "base/geometry/tolerances.h"
#include "base/nth.h"
#include "base/text/numbers.h"
#include "fabrication/kerf_room.h"
#include "fabrication/parallel_ring.h"

namespace popup {
namespace {

using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;

constexpr double kLeastKerfMm = 1e-4;
// Corners of the paper longer than this many half kerfs are cut square.
constexpr double kMitreLimit = 2.0;
// The same when a path is moved back: it says how sharp a corner of the waste may be that counts as a corner,
// and not as a notch that is too narrow.
constexpr double kCornerLimit = 20.0;
// Rings whose area is less than this times their length are rounding, or too narrow to be cut.
constexpr double kThinMm = 1e-5;
constexpr std::size_t kMostFindings = 20;
// What closes is called so narrow only where that is at least this share of the kerf that it takes.
constexpr double kNarrowedTo = 0.8;
// Curves of so many corners are moved edge by edge where they can be. The library of polygons makes a spike,
// twice half a kerf long, at each corner where edges come together, and looks at all crossings of these.
constexpr std::size_t kManyCorners = 1000;
// Of a piece for which it is tried how wide a kerf may be: each try takes as long as the kerf itself.
constexpr std::size_t kMostCornersTried = 20'000;

double active(double kerf) { return kerf < kLeastKerfMm ? 0.0 : kerf; }

// Whether fewer edges of the ring meet an upright line than a level one, on average.
bool is_comb(const Ring& ring) {
    double wide = 0.0;
    double high = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 along = ring[(i + 1) % ring.size()] - ring[i];
        wide += std::abs(along.x);
        high += std::abs(along.y);
    }
    const Box box = bounds(ring);
    return wide * box.height() < high * box.width();
}

// The mirror image in the diagonal, running the same way.
Ring mirrored(Ring ring) {
    for (Vec2& p : ring) std::swap(p.x, p.y);
    std::reverse(ring.begin(), ring.end());
    return ring;
}

IntPoint to_int(Vec2 p) {
    POPUP_INVARIANT(std::abs(p.x) <= kRangeMm && std::abs(p.y) <= kRangeMm);
    return {std::llround(p.x * kPerMm), std::llround(p.y * kPerMm)};
}

Ring to_ring(const Path& path) {
    Ring ring;
    ring.reserve(path.size());
    for (const IntPoint& p : path)
        ring.push_back({static_cast<double>(p.X) / kPerMm, static_cast<double>(p.Y) / kPerMm});
    return ring;
}

// How edges that part at a corner are joined again.
enum class Join {
    mitre,
    square,   // every corner cut square at the distance of the offset
    restore,  // mitres, for a path that is moved back
};

// The counter-clockwise ring made larger by `delta` mm, or smaller. What is outside of the result and was
// inside, or the other way round, gives more rings; the largest comes first.
std::vector<Ring> moved(const Ring& ring, double delta, Join join) {
    // The library sweeps upwards, and its cost grows with the edges that a level line meets.
    const bool comb = is_comb(ring);
    Path path;
    path.reserve(ring.size());
    for (const Vec2 p : comb ? mirrored(ring) : ring) path.push_back(to_int(p));
    ClipperLib::ClipperOffset offset(join == Join::restore ? kCornerLimit : kMitreLimit);
    offset.AddPath(path, join == Join::square ? ClipperLib::jtSquare : ClipperLib::jtMiter,
                   ClipperLib::etClosedPolygon);
    Paths paths;
    offset.Execute(paths, delta * kPerMm);
    std::vector<std::pair<double, Ring>> sized;
    for (const Path& part : paths) {
        Ring result = comb ? mirrored(to_ring(part)) : to_ring(part);
        const double size = std::abs(signed_area(result));
        if (size > kThinMm * perimeter(result)) sized.emplace_back(size, std::move(result));
    }
    std::stable_sort(sized.begin(), sized.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Ring> rings;
    rings.reserve(sized.size());
    for (auto& [size, part] : sized) rings.push_back(std::move(part));
    return rings;
}

EdgeIndex index_of(std::span<const Ring> rings) {
    std::vector<Segment> edges;
    for (const Ring& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], ring[(i + 1) % ring.size()]});
    }
    return EdgeIndex(std::move(edges));
}

// Something the path cannot make.
struct Flaw {
    enum class Kind {
        vanishes,  // a hole of which nothing is left
        parts,     // a hole that falls into several
        closes,    // a place between two stretches of an edge, with waste on its far side as well
        fills,     // a notch, or an end of a hole
        meets,     // waste between two contours
    };
    Kind kind = Kind::vanishes;
    bool hole = false;  // of a contour at odd depth
    double kerf = 0.0;
    Vec2 at;
    std::optional<double> width;  // of what is too narrow, if known
};

// One closed contour on its way, counter-clockwise.
struct Move {
    Ring drawn;
    bool outwards = true;
    double half = 0.0;  // of the kerf, mm
    Join join = Join::mitre;
    std::vector<Ring> path;
    std::vector<Ring> restored;  // the path moved back; clockwise where waste is shut off from the outside

    // Whether p lies in the paper that would be left, and deep.
    [[nodiscard]] bool buried(const EdgeIndex& index, Vec2 p) const {
        return index.clearance(p, kLostMm) >= kLostMm && (index.winding(p) != 0) == outwards;
    }
};

void run(Move& move, Join join) {
    const double delta = move.outwards ? move.half : -move.half;
    move.join = join;
    move.path = moved(move.drawn, delta, join);
    move.restored.clear();
    for (Ring ring : move.path) {
        const bool shut_off = signed_area(ring) < 0.0;
        if (shut_off) std::reverse(ring.begin(), ring.end());
        for (Ring& back : moved(ring, shut_off ? delta : -delta, Join::restore)) {
            if (shut_off) std::reverse(back.begin(), back.end());
            move.restored.push_back(std::move(back));
        }
    }
}

// A corner of the drawn contour that is lost, if any is. In a place that fills no point is deeper than the
// deepest corner, so corners are enough.
std::optional<Vec2> lost_corner(const Move& move) {
    const EdgeIndex index = index_of(move.restored);
    for (const Vec2 p : move.drawn) {
        if (move.buried(index, p)) return p;
    }
    return std::nullopt;
}

void widest_place(const Polygon& waste, Flaw& flaw) {
    constexpr double kPrecisionMm = 1e-3;
    const InnerPoint inner = inner_point(waste, kPrecisionMm);
    if (inner.clearance <= 0.0) return;
    flaw.at = inner.at;
    flaw.width = 2.0 * inner.clearance;
}

// Where the second of the paths comes nearest to the others: what closes lies halfway.
void narrow_place(const Move& move, Flaw& flaw) {
    std::vector<Ring> others = move.path;
    others.erase(others.begin() + 1);
    const EdgeIndex index = index_of(others);
    double best = HUGE_VAL;
    Vec2 from;
    for (const Vec2 p : move.path[1]) {
        const double d = index.clearance(p, best);
        if (d < best) {
            best = d;
            from = p;
        }
    }
    std::vector<int> found;
    const Vec2 reach{best + kGridMm, best + kGridMm};
    index.query({from - reach, from + reach}, found);
    Vec2 to = from;
    double nearest = HUGE_VAL;
    for (const int number : found) {
        const Segment& edge = index[number];
        const Vec2 along = edge.b - edge.a;
        const double squared = dot(along, along);
        const double t = squared > 0.0 ? std::clamp(dot(from - edge.a, along) / squared, 0.0, 1.0) : 0.0;
        const Vec2 p = lerp(edge.a, edge.b, t);
        if (distance(from, p) < nearest) {
            nearest = distance(from, p);
            to = p;
        }
    }
    flaw.at = lerp(from, to, 0.5);
    flaw.width = 2.0 * index_of({&move.drawn, 1}).clearance(flaw.at, HUGE_VAL);
}

// The narrowest of the regions that are lost, slivers along edges and corners not counted. None may be found
// where mitres meet across a narrow place.
void filled_place(const Move& move, Flaw& flaw) {
    const bool comb = is_comb(move.drawn);
    const auto solid = [comb](const Ring& ring) { return Polygon{comb ? mirrored(ring) : ring, {}}; };
    std::vector<Polygon> paper;
    std::vector<Polygon> waste;
    for (const Ring& ring : move.restored) (signed_area(ring) > 0.0 ? paper : waste).push_back(solid(ring));
    if (!waste.empty()) paper = subtract(paper, waste);
    const std::vector<Polygon> drawn{solid(move.drawn)};
    const EdgeIndex index = index_of(move.restored);
    std::size_t looked_at = 0;
    for (Polygon& part : move.outwards ? subtract(paper, drawn) : subtract(drawn, paper)) {
        if (comb) part.outer = mirrored(std::move(part.outer));
        bool deep = false;
        for (std::size_t i = 0; i < part.outer.size() && !deep; ++i) {
            const Vec2 here = part.outer[i];
            const Vec2 next = part.outer[(i + 1) % part.outer.size()];
            deep = move.buried(index, here) || move.buried(index, lerp(here, next, 0.5));
        }
        if (!deep) continue;
        if (++looked_at > kMostFindings) break;
        Flaw found = flaw;
        widest_place({part.outer, {}}, found);
        if (found.width && (!flaw.width || *found.width < *flaw.width)) flaw = found;
    }
}

// What is wrong with the move, without its place.
std::optional<Flaw> flaw_of(const Move& move, std::optional<Vec2>& corner) {
    Flaw flaw;
    flaw.hole = !move.outwards;
    flaw.kerf = 2.0 * move.half;
    if (move.path.empty()) {
        flaw.kind = Flaw::Kind::vanishes;
    } else if (move.path.size() > 1) {
        flaw.kind = move.outwards ? Flaw::Kind::closes : Flaw::Kind::parts;
    } else {
        corner = lost_corner(move);
        if (!corner) return std::nullopt;
        flaw.kind = Flaw::Kind::fills;
    }
    return flaw;
}

void locate(const Move& move, const std::optional<Vec2>& corner, Flaw& flaw) {
    if (flaw.kind == Flaw::Kind::vanishes) {
        flaw.at = move.drawn.front();
        widest_place({move.drawn, {}}, flaw);
        return;
    }
    if (corner) flaw.at = *corner;
    filled_place(move, flaw);
    if (!flaw.width && move.path.size() > 1) narrow_place(move, flaw);
}

// Where the first corner of the drawn ring goes.
Vec2 image_of_start(const Move& move) {
    const Ring& ring = move.drawn;
    const Vec2 here = ring.front();
    std::size_t last = ring.size() - 1;
    std::size_t next = 1;
    while (last > 0 && ring[last] == here) --last;
    while (next < last && ring[next] == here) ++next;
    if (ring[last] == here || ring[next] == here) return here;
    const Vec2 out_a = right_of(unit(here - ring[last]));
    const Vec2 out_b = right_of(unit(ring[next] - here));
    const double delta = move.outwards ? move.half : -move.half;
    const double straight = 1.0 + dot(out_a, out_b);  // 2: no turn; 0: turned about
    if (straight < 1e-9) return here;
    const Vec2 mitre = (1.0 / straight) * (out_a + out_b);
    const bool parts = cross(out_a, out_b) * delta > 0.0;
    const bool square = parts && (move.join == Join::square || length(mitre) > kMitreLimit);
    return here + delta * (square ? unit(mitre) : mitre);
}

// Turns the ring so that it starts at the corner nearest to p; of several as near, at the first of a run.
void start_near(Ring& ring, Vec2 p) {
    double best = HUGE_VAL;
    for (const Vec2 q : ring) best = std::min(best, distance(p, q));
    const auto is_near = [&](std::size_t i) { return distance(p, ring[i]) <= best + kTieMm; };
    std::size_t start = 0;
    while (!is_near(start)) ++start;
    if (start == 0) {
        for (std::size_t i = ring.size() - 1; i > 0 && is_near(i); --i) start = i;
    }
    std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(start), ring.end());
}

// The kerf that must fit between two contours; 0 when the waste between them, if any, is another's. Waste
// lies between contours at the same even depth, and between a hole and what lies in it.
double kerf_between(int a, int b, const KerfWidths& kerf) {
    const int least = std::min(a, b);
    const bool facing = least % 2 == 0 ? a == b : std::max(a, b) == least + 1;
    return facing ? active(kerf.at_depth(least)) : 0.0;
}

// The nearest two contours with waste between them that is narrower than the kerf.
std::optional<Flaw> crowded(const std::vector<Contour>& cuts, const KerfWidths& kerf) {
    std::size_t outer = 0;
    bool nested = false;
    for (const Contour& cut : cuts) {
        if (!cut.closed) continue;
        outer += cut.depth == 0 ? 1 : 0;
        nested = nested || cut.depth > 1;
    }
    if (outer < 2 && !nested) return std::nullopt;
    std::vector<Segment> edges;
    std::vector<std::size_t> owner;
    for (std::size_t i = 0; i < cuts.size(); ++i) {
        if (!cuts[i].closed) continue;
        const std::vector<Vec2>& points = cuts[i].points;
        for (std::size_t k = 0; k < points.size(); ++k) {
            edges.push_back({points[k], points[(k + 1) % points.size()]});
            owner.push_back(i);
        }
    }
    const EdgeIndex index(edges);
    const double widest = std::max(active(kerf.inner_mm), active(kerf.outer_mm));
    const Vec2 reach{widest, widest};
    std::optional<Flaw> flaw;
    std::vector<int> found;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        Box box;
        box.extend(edges[i].a);
        box.extend(edges[i].b);
        index.query({box.min - reach, box.max + reach}, found);
        for (const int number : found) {
            const auto j = static_cast<std::size_t>(number);
            if (j <= i || owner[i] == owner[j]) continue;
            const double wanted = kerf_between(cuts[owner[i]].depth, cuts[owner[j]].depth, kerf);
            const double room = distance(edges[i], edges[j]);
            if (room >= wanted - kGridMm || (flaw && room >= *flaw->width)) continue;
            flaw.emplace();
            flaw->kind = Flaw::Kind::meets;
            flaw->kerf = wanted;
            flaw->width = room;
            // One of the four ends is nearest; at a crossing any of them is near enough to be found.
            const bool own = std::min(distance(edges[i].a, edges[j]), distance(edges[i].b, edges[j])) <=
                             std::min(distance(edges[j].a, edges[i]), distance(edges[j].b, edges[i]));
            const Segment& from = own ? edges[i] : edges[j];
            const Segment& to = own ? edges[j] : edges[i];
            flaw->at = distance(from.a, to) <= distance(from.b, to) ? from.a : from.b;
        }
    }
    return flaw;
}

struct Result {
    std::vector<Contour> cuts;
    std::optional<Flaw> worst;  // the narrowest
    std::size_t flaws = 0;
};

Result compensate(const PatternPiece& piece, const KerfWidths& kerf) {
    POPUP_INVARIANT(std::isfinite(kerf.inner_mm) && kerf.inner_mm >= 0.0);
    POPUP_INVARIANT(std::isfinite(kerf.outer_mm) && kerf.outer_mm >= 0.0);
    Result result;
    const auto note = [&result](const Flaw& flaw) {
        const auto width = [](const Flaw& f) { return f.width.value_or(HUGE_VAL); };
        if (!result.worst || width(flaw) < width(*result.worst)) result.worst = flaw;
    };
    result.cuts.reserve(piece.cuts.size());
    for (const Contour& cut : piece.cuts) {
        const double width = active(kerf.at_depth(cut.depth));
        result.cuts.push_back(cut);
        if (!cut.closed || width <= 0.0 || cut.points.size() < 3) continue;

        Move move;
        move.drawn = cut.points;
        move.outwards = cut.depth % 2 == 0;
        move.half = 0.5 * width;
        const bool clockwise = signed_area(move.drawn) < 0.0;
        if (clockwise) std::reverse(move.drawn.begin() + 1, move.drawn.end());
        if (move.drawn.size() >= kManyCorners) {
            if (auto ring = moved_edge_by_edge(move.drawn, move.outwards ? move.half : -move.half)) {
                if (clockwise) std::reverse(ring->begin() + 1, ring->end());
                result.cuts.back().points = *std::move(ring);
                continue;
            }
        }
        run(move, Join::mitre);
        std::optional<Vec2> corner;
        auto flaw = flaw_of(move, corner);
        if (flaw) {
            // Two mitres may meet across a place that is not too narrow.
            run(move, Join::square);
            flaw = flaw_of(move, corner);
        }
        if (flaw) {
            // To find a place costs far more than to know that there is one.
            if (++result.flaws > kMostFindings) continue;
            locate(move, corner, *flaw);
            note(*flaw);
            continue;
        }
        Ring& ring = move.path.front();
        if (clockwise) std::reverse(ring.begin(), ring.end());
        start_near(ring, image_of_start(move));
        result.cuts.back().points = std::move(ring);
    }
    if (const auto flaw = crowded(piece.cuts, kerf)) {
        ++result.flaws;
        note(*flaw);
    }
    return result;
}

// `most`: the widest kerf that works.
std::string what_of(const Flaw& flaw, double most) {
    const std::string at =
        fmt::format("at ({}, {}) mm", number_text(flaw.at.x, 2), number_text(flaw.at.y, 2));
    const std::string wide = flaw.width && *flaw.width >= kNarrowedTo * most
                                 ? fmt::format("about {} mm wide", number_text(*flaw.width, 3))
                                 : "too narrow for it";
    switch (flaw.kind) {
        case Flaw::Kind::vanishes:
            return fmt::format("the hole {} is {}, and nothing is left of its cut", at, wide);
        case Flaw::Kind::parts:
            return fmt::format("the hole {} is {}, and its cut falls apart", at, wide);
        case Flaw::Kind::closes:
            return fmt::format("the way into a notch {} is {}, and closes", at, wide);
        case Flaw::Kind::fills:
            return fmt::format("the {} {} is {}, and closes", flaw.hole ? "end of a hole" : "notch", at,
                               wide);
        case Flaw::Kind::meets:
            return fmt::format("two contours are {} mm apart {}, and their cuts meet",
                               number_text(flaw.width.value_or(0.0), 3), at);
    }
    return {};
}

// The widest kerf, in whole hundredths of a millimetre, that the piece can be cut with; 0: there is none, or
// the piece has too many corners to try. How wide what closes is does not say so: a notch that runs to a
// point is narrow there however wide it begins.
double widest_that_works(const PatternPiece& piece, const KerfWidths& kerf) {
    std::size_t corners = 0;
    for (const Contour& cut : piece.cuts) corners += cut.points.size();
    if (corners > kMostCornersTried) return 0.0;
    int works = 0;
    int fails = static_cast<int>(std::ceil(100.0 * std::max(kerf.inner_mm, kerf.outer_mm)));
    while (fails - works > 1) {
        const int middle = (works + fails) / 2;
        const double most = middle / 100.0;
        const KerfWidths narrower{std::min(kerf.inner_mm, most), std::min(kerf.outer_mm, most)};
        (compensate(piece, narrower).flaws == 0 ? works : fails) = middle;
    }
    return works / 100.0;
}

Diagnostic& report(const Result& result, const PatternPiece& piece, const KerfWidths& kerf,
                   std::string_view name, Diagnostics& diagnostics) {
    const Flaw& flaw = *result.worst;
    const double most = widest_that_works(piece, kerf);
    std::string message = fmt::format("the kerf of {} mm is too wide for piece \"{}\": {}",
                                      number_text(flaw.kerf, 3), name, what_of(flaw, most));
    if (result.flaws == 2) message += "; another place fails as well";
    if (result.flaws > 2) message += fmt::format("; {} more places fail as well", result.flaws - 1);
    Diagnostic& finding = diagnostics.error("kerf-too-wide", {}, std::move(message));
    if (most <= 0.0) return finding.hint("take a smaller --kerf, or make that place wider");
    return finding.hint(fmt::format(
        "take a --kerf of {} mm or less, or make the design at least {} times as large with --scale",
        number_text(most, 2), number_text(std::ceil(flaw.kerf / most * 10.0) / 10.0, 1)));
}

}  // namespace

std::optional<std::vector<Contour>> compensated(const PatternPiece& piece, std::string_view name,
                                                const KerfWidths& kerf, Diagnostics& diagnostics) {
    Result result = compensate(piece, kerf);
    if (result.flaws == 0) return std::move(result.cuts);
    report(result, piece, kerf, name, diagnostics);
    return std::nullopt;
}

bool apply_kerf(Layout& layout, const KerfWidths& kerf, double spacing_mm, Diagnostics& diagnostics) {
    // What is narrower than anything can be moved by is not moved.
    const KerfWidths moved{active(kerf.inner_mm), active(kerf.outer_mm)};
    std::size_t findings = check_kerf_distances(layout, moved, spacing_mm, diagnostics);
    std::vector<std::vector<Contour>> all;
    std::size_t unnamed = 0;  // failing pieces that have no finding
    Diagnostic* last = nullptr;
    for (std::size_t d = 0; d < layout.designs.size(); ++d) {
        const DesignPattern& design = layout.designs[d];
        for (std::size_t p = 0; p < design.pattern.pieces.size(); ++p) {
            const PatternPiece& piece = design.pattern.pieces[p];
            Result result = compensate(piece, kerf);
            if (result.flaws == 0) {
                if (findings == 0) all.push_back(std::move(result.cuts));
            } else if (findings == kMostFindings) {
                ++unnamed;
            } else {
                ++findings;
                const std::string name =
                    layout.piece_name({static_cast<int>(d), static_cast<int>(p), 0, 0, {}, {}});
                last = &report(result, piece, kerf, name, diagnostics);
                last->about(piece.name).file = design.file;
            }
        }
    }
    if (unnamed > 0) {
        last->message +=
            fmt::format(" ({} more {} not listed)", unnamed, unnamed == 1 ? "piece is" : "pieces are");
    }
    if (findings > 0 || check_moved_cuts(layout, moved, spacing_mm, all, diagnostics) > 0) return false;
    std::size_t next = 0;
    for (DesignPattern& design : layout.designs) {
        for (PatternPiece& piece : design.pattern.pieces) piece.cuts = std::move(all[next++]);
    }
    return true;
}

}  // namespace popup
