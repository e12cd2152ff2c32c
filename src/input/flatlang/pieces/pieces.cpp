#include "input/flatlang/pieces/pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/geometry/regions.h"
#include "input/flatlang/pieces/outlines.h"
#include "input/flatlang/pieces/pen_lines.h"
#include "input/flatlang/pieces/strokes.h"
#include "input/flatlang/pieces/unfold_faces.h"

namespace popup::flatlang {
namespace {

std::size_t at(int number) { return static_cast<std::size_t>(number); }

// A name on one line.
std::string clean(const std::string& name) {
    std::string result;
    for (const char c : name) {
        const auto code = static_cast<unsigned char>(c);
        const bool space = code <= 0x20 || code == 0x7F;
        if (!space) {
            result += c;
        } else if (!result.empty() && result.back() != ' ') {
            result += ' ';
        }
    }
    while (result.ends_with(' ')) result.pop_back();
    return result;
}

// Gives each name once: of equal ones the second is "gear 2". A name that a part was given by its program is
// never made up for another.
class Names {
 public:
    explicit Names(const Trail& trail) {
        for (const TrailPart& part : trail.parts) taken_.insert(clean(part.name));
    }

    std::string fresh(std::string name) {
        if (name.empty()) name = "piece";
        int& number = last_[name];
        if (++number == 1) {
            taken_.insert(name);
            return name;
        }
        std::string made;
        do {
            made = fmt::format("{} {}", name, number++);
        } while (!taken_.insert(made).second);
        --number;
        return made;
    }

 private:
    std::set<std::string> taken_;
    std::map<std::string, int> last_;
};

// A line that ends near where it began: an outline that was missed by a slip.
struct Gap {
    double inches = 0.0;
    std::size_t lines = 0;
    int part = 0;
};

// The narrowest of each part, up to 0.05 inches.
std::vector<Gap> gaps(const Trail& trail, const PenLines& lines) {
    constexpr double kClosed = 1e-4;
    constexpr double kSlip = 0.05;
    std::vector<Gap> found;
    for (std::size_t i = 0; i < trail.segments.size();) {
        const int part = trail.segments[i].part;
        std::vector<std::size_t> open;
        for (; i < trail.segments.size() && trail.segments[i].part == part; ++i) {
            if (lines.face[i] == PenLines::kOpen) open.push_back(i);
        }
        Gap narrowest{kSlip, 0, part};
        for (const std::vector<Vec3>& line : chained(trail, open)) {
            const double gap = distance(line.front(), line.back()) / kMmPerInch;
            if (line.size() >= 4 && gap > kClosed && gap <= narrowest.inches) {
                narrowest = {gap, line.size() - 1, part};
            }
        }
        if (narrowest.lines > 0) found.push_back(narrowest);
    }
    return found;
}

class PartMaker {
 public:
    PartMaker(Trail trail, Diagnostics& diagnostics)
        : in_(std::move(trail)), diagnostics_(diagnostics), names_(in_) {}

    std::optional<FlatParts> run() {
        const bool joined = join_strokes();
        auto outlines = find_outlines(in_, work_, diagnostics_);
        if (!outlines) return std::nullopt;
        outlines_ = std::move(*outlines);
        name_faces(joined);
        if (outlines_.faces.empty()) {
            tell_empty();
            return std::nullopt;
        }
        part_of_face_.assign(outlines_.faces.size(), -1);
        for (std::size_t begin = 0; begin < outlines_.faces.size();) {
            std::size_t end = begin;
            while (end < outlines_.faces.size() && outlines_.faces[end].part == outlines_.faces[begin].part) {
                ++end;
            }
            if (!add_part(begin, end)) return std::nullopt;
            begin = end;
        }
        tell_lost_parts();
        tell_open_lines();
        add_lines();
        return std::move(list_);
    }

 private:
    // What was drawn in several strokes is an outline as well as what was drawn in one.
    bool join_strokes() {
        // A loop may have points that no line leads to.
        if (!std::all_of(in_.segments.begin(), in_.segments.end(),
                         [](const TrailSegment& one) { return is_near(one.from) && is_near(one.to); }) ||
            !std::all_of(in_.polygons.begin(), in_.polygons.end(), [](const TrailPolygon& one) {
                return std::all_of(one.points.begin(), one.points.end(), is_near);
            })) {
            return false;
        }
        Outlines polygons{{}, std::vector<int>(in_.polygons.size())};
        std::iota(polygons.polygon_face.begin(), polygons.polygon_face.end(), 0);
        lines_ = sort_segments(in_, polygons);
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < lines_.face.size(); ++i) {
            if (lines_.face[i] == PenLines::kOpen) open.push_back(i);
        }
        std::vector<TrailPolygon> loops = loops_of_strokes(in_, open);
        in_.polygons.insert(in_.polygons.end(), std::make_move_iterator(loops.begin()),
                            std::make_move_iterator(loops.end()));
        return !loops.empty();
    }

    // The lines' polygons are known. Where no loop was added, and none is without an area, so are their
    // faces.
    void name_faces(bool joined) {
        const std::vector<int>& face = outlines_.polygon_face;
        if (joined || std::any_of(face.begin(), face.end(), [](int one) { return one < 0; })) {
            lines_ = sort_segments(in_, outlines_);
            return;
        }
        for (int& one : lines_.face) {
            if (one != PenLines::kOpen) one = face[at(one)];
        }
    }

    void tell_empty() {
        if (outlines_.covered > 0) {
            diagnostics_.error("flatlang-no-parts", {},
                               "there is no part to cut: of all outlines the loops in them, which are holes, "
                               "leave nothing");
            return;
        }
        const bool drew = !in_.segments.empty();
        Diagnostic& told = diagnostics_.error(
            "flatlang-no-parts", {},
            drew ? fmt::format(
                       "the program draws no closed outline, so there is no part to cut: none of its {} "
                       "line{} goes round anything",
                       in_.segments.size(), in_.segments.size() == 1 ? "" : "s")
                 : std::string("the program draws nothing with the pen down, so there is no part to cut"));
        if (!drew) {
            told.hint("functions draw when they are called; down() puts the pen down");
            return;
        }
        const std::vector<Gap> slips = gaps(in_, lines_);
        if (slips.empty()) {
            told.hint("go back to where the outline began, with the pen down");
        } else {
            told.hint(fmt::format("a line ends {:.4f} inches from where it began; 0.0001 is the most",
                                  slips.front().inches));
        }
    }

    // --- the faces of one part of the trail

    bool add_part(std::size_t begin, std::size_t end) {
        const int number = outlines_.faces[begin].part;
        const std::span<const Face> faces(&outlines_.faces[begin], end - begin);
        auto pieces = unfold_faces(faces, number > 0, work_);
        if (!pieces) {
            diagnostics_.error("document-too-large", in_.parts[at(number)].place,
                               "the drawing is too much work: its faces touch one another too often");
            return false;
        }
        std::map<int, std::size_t> in_plane;  // parts of what is flat and not folded, by planes
        for (Unfolded& piece : *pieces) {
            std::size_t part = list_.parts.size();
            if (number > 0) {
                const bool flat = std::all_of(piece.faces.begin(), piece.faces.end(), [&](const auto& one) {
                    return faces[at(one.face)].plane == faces[at(piece.faces.front().face)].plane;
                });
                if (flat)
                    part =
                        in_plane.try_emplace(faces[at(piece.faces.front().face)].plane, part).first->second;
            }
            if (part == list_.parts.size()) begin_part(number);
            if (!add_piece(std::move(piece), part, static_cast<int>(begin))) return false;
        }
        return true;
    }

    void begin_part(int number) {
        const TrailPart& from = in_.parts[at(number)];
        FlatPart part;
        part.name = names_.fresh(clean(from.name));
        part.place = from.place;
        list_.parts.push_back(std::move(part));
    }

    bool add_piece(Unfolded piece, std::size_t number, int first_face) {
        FlatPart& part = list_.parts[number];
        for (const Polygon& region : piece.paper) {
            for (const Vec2 p : region.outer) {
                if (std::abs(p.x) <= kFarthestMm && std::abs(p.y) <= kFarthestMm) continue;
                diagnostics_
                    .error("flatlang-bad-outline", part.place,
                           fmt::format("part \"{}\" reaches further than {:.0f} m from the middle when it is "
                                       "unfolded",
                                       part.name, kFarthestMm / 1e3))
                    .hint("lengths are in inches");
                return false;
            }
        }
        part.paper.insert(part.paper.end(), std::make_move_iterator(piece.paper.begin()),
                          std::make_move_iterator(piece.paper.end()));
        for (const Crease& crease : piece.creases) {
            FlatLine line;
            line.kind = crease.angle < 0.0 ? LineKind::mountain : LineKind::valley;
            line.points = {crease.from, crease.to};
            if (crease.angle != 0.0) line.fold_angle = std::abs(crease.angle);
            part.lines.push_back(std::move(line));
        }
        for (const Segment& slit : piece.slits) part.slits.push_back({slit.a, slit.b});
        for (UnfoldedFace& face : piece.faces) {
            part_of_face_[at(first_face + face.face)] = static_cast<int>(number);
            for (Polygon& region : face.paper) part.faces.push_back({std::move(region), face.frame});
        }
        return true;
    }

    // --- lines

    // A part of which nothing is cut may not be missed on the sheets.
    void tell_lost_parts() {
        std::vector<std::size_t> lines(in_.parts.size(), 0);
        for (const TrailSegment& one : in_.segments) ++lines[at(one.part)];
        for (const Face& face : outlines_.faces) lines[at(face.part)] = 0;
        for (std::size_t i = 1; i < lines.size(); ++i) {
            if (lines[i] == 0) continue;
            const std::string name = clean(in_.parts[i].name);
            diagnostics_
                .warning(
                    "flatlang-open-lines", in_.parts[i].place,
                    fmt::format("{} has {} line{} and no closed outline, so it is not cut",
                                name.empty() ? std::string("this part") : fmt::format("part \"{}\"", name),
                                lines[i], lines[i] == 1 ? "" : "s"))
                .hint("go back to where the outline began, with the pen down");
        }
    }

    void tell_open_lines() {
        if (lines_.open == 0) return;
        diagnostics_.remark(
            "flatlang-open-lines", {},
            fmt::format(
                "{} line{} {} on no closed outline ({:.1f} mm, {:.2f} inches, altogether) and {} not cut",
                lines_.open, lines_.open == 1 ? "" : "s", lines_.open == 1 ? "is" : "are",
                lines_.open_inches * kMmPerInch, lines_.open_inches, lines_.open == 1 ? "is" : "are"));
        for (const Gap& one : gaps(in_, lines_)) {
            const TrailPart& part = in_.parts[at(one.part)];
            diagnostics_
                .warning(
                    "flatlang-open-lines", part.place,
                    fmt::format(
                        "{} has an outline of {} lines that ends {:.4f} inches from where it began, and is "
                        "not cut",
                        one.part == 0 ? std::string("what is drawn before the first part")
                                      : fmt::format("part \"{}\"", clean(part.name)),
                        one.lines, one.inches))
                .hint("0.0001 inches are the most that count as closed");
        }
    }

    void add_lines() {
        std::vector<int> first_part(in_.parts.size(), -1);
        for (std::size_t i = outlines_.faces.size(); i-- > 0;) {
            first_part[at(outlines_.faces[i].part)] = part_of_face_[i];
        }
        std::vector<std::vector<std::size_t>> of_part(list_.parts.size());
        std::vector<std::vector<std::size_t>> of_none(in_.parts.size());
        for (std::size_t i = 0; i < in_.segments.size(); ++i) {
            const int face = lines_.face[i];
            const int drawn_in = in_.segments[i].part;
            const int part = face >= 0       ? part_of_face_[at(face)]
                             : drawn_in == 0 ? -1
                                             : first_part[at(drawn_in)];
            if (part >= 0) {
                of_part[at(part)].push_back(i);
            } else {
                of_none[at(drawn_in)].push_back(i);
            }
        }
        for (std::size_t i = 0; i < of_part.size(); ++i) list_.parts[i].traces = chained(in_, of_part[i]);
        for (std::size_t i = 0; i < of_none.size(); ++i) {
            std::vector<std::vector<Vec3>> lines = chained(in_, of_none[i]);
            if (lines.empty()) continue;
            const std::string name = i == 0 ? std::string() : clean(in_.parts[i].name);
            list_.traces.push_back({names_.fresh(name.empty() ? "trail" : name), -1, std::move(lines)});
        }
    }

    Trail in_;
    Diagnostics& diagnostics_;
    Names names_;
    Work work_;
    Outlines outlines_;
    PenLines lines_;
    std::vector<int> part_of_face_;
    FlatParts list_;
};

}  // namespace

std::optional<FlatParts> make_parts(const Trail& trail, Diagnostics& diagnostics) {
    return PartMaker(trail, diagnostics).run();
}

}  // namespace popup::flatlang
