// Parts that do not move, as pieces.
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "base/geometry/edge_index.h"
#include "base/text/numbers.h"
#include "pattern/chain.h"
#include "pattern/labels.h"
#include "popup/pattern.h"

namespace popup {
namespace {

constexpr std::array kFoldKinds{LineKind::mountain, LineKind::valley, LineKind::seam};
// Folds whose angles, in radians, are the same to so many decimals are one where they meet in line.
constexpr int kAngleDecimals = 6;

void add_segments(const std::vector<Vec2>& points, int tag, std::vector<TaggedSegment>& segments) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i) segments.push_back({{points[i], points[i + 1]}, tag});
}

void add_lines(const Part& part, PatternPiece& piece) {
    for (const LineKind kind : kFoldKinds) {
        std::vector<TaggedSegment> segments;
        // Tags are numbers of angles, so that folds by different angles stay apart.
        std::vector<double> angles;
        std::map<double, int> numbers;
        for (const PartLine& line : part.lines) {
            if (line.kind != kind) continue;
            int tag = -1;
            if (line.fold_angle) {
                const double angle = rounded(*line.fold_angle, kAngleDecimals);
                const auto [place, fresh] = numbers.try_emplace(angle, static_cast<int>(angles.size()));
                if (fresh) angles.push_back(*line.fold_angle);
                tag = place->second;
            }
            add_segments(line.points, tag, segments);
        }
        for (const TaggedSegment& one : merged(std::move(segments))) {
            PatternLine& line = piece.lines.emplace_back();
            line.kind = kind;
            line.at = one.at;
            if (one.tag >= 0) line.fold_angle = angles[static_cast<std::size_t>(one.tag)];
        }
    }
    for (const PartLine& line : part.lines) {
        if (line.kind != LineKind::mark) continue;
        for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
            piece.lines.push_back({line.kind, {line.points[i], line.points[i + 1]}, -1});
        }
    }
}

void add_cuts(const Part& part, PatternPiece& piece) {
    for (const Polygon& paper : part.paper) {
        piece.cuts.push_back({paper.outer, true});
        for (const Ring& hole : paper.holes) piece.cuts.push_back({hole, true});
    }
    for (const std::vector<Vec2>& slit : part.slits) piece.cuts.push_back({slit, false});
    put_in_order(piece.cuts);
}

// The name goes on the largest piece of paper that has room for it.
void add_name(const Part& part, PatternPiece& piece) {
    constexpr std::size_t kTried = 3;
    std::vector<std::pair<double, std::size_t>> largest;
    for (std::size_t i = 0; i < part.paper.size(); ++i) {
        largest.emplace_back(-std::round(1e3 * area(part.paper[i])), i);
    }
    std::sort(largest.begin(), largest.end());
    std::vector<Segment> lines;
    for (const PatternLine& line : piece.lines) lines.push_back(line.at);
    for (const std::vector<Vec2>& slit : part.slits) {
        for (std::size_t i = 0; i + 1 < slit.size(); ++i) lines.push_back({slit[i], slit[i + 1]});
    }
    std::vector<Segment> drawn;
    double half_width = 0.0;
    for (const Stroke& stroke : part.strokes) {
        for (std::size_t i = 0; i + 1 < stroke.points.size(); ++i) {
            drawn.push_back({stroke.points[i], stroke.points[i + 1]});
        }
        half_width = std::max(half_width, 0.5 * stroke.width_mm);
    }
    const Drawing drawing{EdgeIndex({}, drawn), half_width};
    for (std::size_t i = 0; i < std::min(kTried, largest.size()); ++i) {
        const Polygon& paper = part.paper[largest[i].second];
        const EdgeIndex edges(edges_of(paper), lines);
        const auto spot = place_on_plate(edges, drawing, bounds(paper.outer), part.name);
        if (!spot) continue;
        piece.labels.push_back({LabelKind::piece, part.name, spot->at, spot->height, spot->angle});
        return;
    }
}

PatternPiece piece_of(const Part& part) {
    PatternPiece piece;
    piece.name = part.name;
    piece.silhouette = part.paper;
    for (const Polygon& paper : part.paper) {
        for (const Vec2 p : paper.outer) piece.bounds.extend(p);
    }
    add_cuts(part, piece);
    add_lines(part, piece);
    for (const PartFill& fill : part.fills) piece.fills.push_back({fill.area, fill.color, -1});
    for (const Stroke& stroke : part.strokes) piece.strokes.push_back({stroke, -1});
    for (const PartText& text : part.texts) {
        piece.labels.push_back({LabelKind::piece, text.text, text.at, text.height_mm, text.angle});
    }
    if (part.texts.empty()) add_name(part, piece);
    return piece;
}

}  // namespace

std::optional<Pattern> make_pattern(const PartList& list, const PatternOptions& /*options*/,
                                    Diagnostics& /*diagnostics*/) {
    Pattern pattern;
    pattern.curves = list.curves;
    pattern.pieces.reserve(list.parts.size());
    for (const Part& part : list.parts) pattern.pieces.push_back(piece_of(part));
    return pattern;
}

}  // namespace popup
