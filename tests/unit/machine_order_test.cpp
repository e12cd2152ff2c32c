// Machine order: every sample by every profile of a machine, against lines that this test places and adds up
// itself; and small layouts made by hand.
#include "output/machine_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "output/sheet_drawing.h"
#include "popup/compile.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

namespace fs = std::filesystem;
using test::rectangle;

constexpr double kTinyMm = 0.02;

// --- layouts

struct NamedLayout {
    std::string name;
    Layout layout;
};

// Every sample, on sheets with 2 mm between pieces. Compiled once.
const std::vector<NamedLayout>& sample_layouts() {
    static const std::vector<NamedLayout> all = [] {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(fs::path(POPUP_SOURCE_DIR) / "samples")) {
            const std::string suffix = entry.path().extension();
            if (suffix == ".xml" || suffix == ".svg") files.push_back(entry.path());
        }
        std::sort(files.begin(), files.end());
        std::vector<NamedLayout> layouts;
        for (const fs::path& file : files) {
            Diagnostics unheard;
            const std::optional<Source> source = read_source(file, unheard);
            CompileOptions options;
            options.motion.angles = {Angle::degrees(0), Angle::degrees(180)};
            const Compilation run = compile({source.value()}, options, {});
            layouts.push_back({file.filename(), run.layout.value()});
        }
        return layouts;
    }();
    return all;
}

std::vector<Profile> machine_profiles() {
    std::vector<Profile> all;
    for (const Profile& row : profile_table()) {
        if (row.machine_order) all.push_back(row);
    }
    // Every kind of line at once, slits too.
    Profile every = *find_profile("lightburn");
    every.name = "every kind";
    every.folds = FoldStyle::both;
    every.pens[static_cast<std::size_t>(Operation::inner_cut)].kerf_mm = 0.1;
    all.push_back(every);
    // Folds that no two pens draw alike.
    Profile workshop = *find_profile("workshop");
    workshop.name = "workshop in machine order";
    workshop.machine_order = true;
    all.push_back(workshop);
    return all;
}

Pen& pen_of(Profile& profile, Operation operation) {
    return profile.pens[static_cast<std::size_t>(operation)];
}

// A machine that cuts and scores, every kind in a layer of its own.
Profile plain_machine() {
    Profile profile = *find_profile("lightburn");
    pen_of(profile, Operation::mountain) = {"mountain", {1, 2, 3}, 0.1};
    return profile;
}

SheetDrawing drawn(const Layout& layout, const Profile& profile, int sheet = 0) {
    OutputOptions options;
    options.profile = profile;
    SheetView view;
    view.sheet = sheet;
    return draw_sheet(layout, options, view);
}

// --- lines

struct Line {
    Operation operation = Operation::outer_cut;
    bool closed = false;
    std::vector<Vec2> points;

    [[nodiscard]] std::vector<Segment> segments() const {
        std::vector<Segment> all;
        for (std::size_t i = 1; i < points.size(); ++i) all.push_back({points[i - 1], points[i]});
        if (closed) all.push_back({points.back(), points.front()});
        return all;
    }
    [[nodiscard]] double length() const {
        double sum = 0.0;
        for (const Segment& one : segments()) sum += std::hypot(one.b.x - one.a.x, one.b.y - one.a.y);
        return sum;
    }
};

// What a machine does on a sheet, straight from the pattern.
std::vector<Line> expected_lines(const Layout& layout, const Profile& profile, int sheet) {
    std::vector<Line> all;
    const bool slits = profile.pen(Operation::inner_cut).kerf_mm > 0.0;
    for (const Placement& placement : layout.placements) {
        if (placement.sheet != sheet) continue;
        const double turn = placement.angle.deg * std::acos(-1.0) / 180.0;
        const auto placed = [&](Vec2 p) {
            return Vec2{std::cos(turn) * p.x - std::sin(turn) * p.y + placement.offset.x,
                        std::sin(turn) * p.x + std::cos(turn) * p.y + placement.offset.y};
        };
        const PatternPiece& piece = layout.designs[static_cast<std::size_t>(placement.design)]
                                        .pattern.pieces[static_cast<std::size_t>(placement.piece)];
        for (const Contour& cut : piece.cuts) {
            Line& line = all.emplace_back();
            line.closed = cut.closed;
            line.operation = !cut.closed && slits            ? Operation::slit
                             : !cut.closed || cut.depth != 0 ? Operation::inner_cut
                                                             : Operation::outer_cut;
            for (const Vec2 p : cut.points) line.points.push_back(placed(p));
        }
        for (const PatternLine& fold : piece.lines) {
            if (fold.kind == LineKind::mark) continue;
            // Where another piece is glued on nothing is folded, but for those who fold by eye.
            if (fold.kind == LineKind::seam && fold.glued_on && profile.folds != FoldStyle::dashed) continue;
            const Operation operation = fold.kind == LineKind::valley     ? Operation::valley
                                        : fold.kind == LineKind::mountain ? Operation::mountain
                                                                          : Operation::seam;
            if (profile.folds != FoldStyle::perforated)
                all.push_back({operation, false, {placed(fold.at.a), placed(fold.at.b)}});
            if (profile.folds == FoldStyle::perforated || profile.folds == FoldStyle::both) {
                for (const Segment& cut : perforated(fold.at, profile.perforation))
                    all.push_back({Operation::perforation, false, {placed(cut.a), placed(cut.b)}});
            }
        }
    }
    return all;
}

// What it does in the drawing, in its order.
std::vector<Line> lines_of(const SheetDrawing& drawing) {
    std::vector<Line> all;
    for (const SheetShape& shape : drawing.shapes) {
        if (is_printed(shape.operation)) continue;
        for (const popup::Run& run : drawing.runs_of(shape)) {
            const auto points = drawing.points_of(run);
            all.push_back({shape.operation, run.closed, {points.begin(), points.end()}});
        }
    }
    return all;
}

std::map<Operation, double> lengths_of(const std::vector<Line>& lines) {
    std::map<Operation, double> all;
    for (const Line& line : lines) all[line.operation] += line.length();
    return all;
}

// Segments by where their middles are, to take out those that are the same.
class Segments {
 public:
    void add(const Segment& one) { cells_[cell(one, 0, 0)].push_back(one); }
    // Whichever way round it runs.
    bool take(const Segment& one) {
        constexpr double kSame = 1e-7;
        for (int x = -1; x <= 1; ++x) {
            for (int y = -1; y <= 1; ++y) {
                const auto found = cells_.find(cell(one, x, y));
                if (found == cells_.end()) continue;
                const auto same =
                    std::find_if(found->second.begin(), found->second.end(), [&one](const Segment& other) {
                        return (distance(one.a, other.a) < kSame && distance(one.b, other.b) < kSame) ||
                               (distance(one.a, other.b) < kSame && distance(one.b, other.a) < kSame);
                    });
                if (same == found->second.end()) continue;
                found->second.erase(same);
                return true;
            }
        }
        return false;
    }
    [[nodiscard]] std::size_t count() const {
        std::size_t sum = 0;
        for (const auto& [where, some] : cells_) sum += some.size();
        return sum;
    }

 private:
    static std::pair<int, int> cell(const Segment& one, int x, int y) {
        const Vec2 middle = 0.5 * (one.a + one.b);
        return {static_cast<int>(std::floor(middle.x)) + x, static_cast<int>(std::floor(middle.y)) + y};
    }
    std::map<std::pair<int, int>, std::vector<Segment>> cells_;
};

// Folds, perforations, slits, inner cuts, outer cuts.
int turn_of(Operation operation) {
    if (is_fold(operation)) return 0;
    return static_cast<int>(operation);
}

bool lies_in(const Line& inner, const Line& outer) {
    const Box a = bounds(inner.points);
    const Box b = bounds(outer.points);
    if (a.min.x < b.min.x || a.min.y < b.min.y || a.max.x > b.max.x || a.max.y > b.max.y) return false;
    // Crossings of a ray from a corner upwards.
    const Vec2 p = inner.points.front();
    bool inside = false;
    for (const Segment& edge : outer.segments()) {
        if ((edge.a.x > p.x) == (edge.b.x > p.x)) continue;
        if (edge.a.y + (p.x - edge.a.x) / (edge.b.x - edge.a.x) * (edge.b.y - edge.a.y) > p.y)
            inside = !inside;
    }
    return inside;
}

void expect_order(const std::vector<Line>& lines) {
    for (std::size_t i = 1; i < lines.size(); ++i)
        EXPECT_LE(turn_of(lines[i - 1].operation), turn_of(lines[i].operation));
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!is_cut(lines[i].operation) || !lines[i].closed) continue;
        for (std::size_t j = i + 1; j < lines.size(); ++j) {
            if (!is_cut(lines[j].operation)) continue;
            EXPECT_FALSE(lies_in(lines[j], lines[i])) << "line " << j << " lies in line " << i;
        }
    }
}

double way_of(const std::vector<Line>& lines) {
    double sum = 0.0;
    Vec2 at;
    for (const Line& line : lines) {
        sum += distance(at, line.points.front());
        at = line.closed ? line.points.front() : line.points.back();
    }
    return sum;
}

// --- tests

TEST(MachineOrder, HasTheSameLinesAsThePatternOfEverySample) {
    ASSERT_GE(sample_layouts().size(), 13U);
    for (const Profile& profile : machine_profiles()) {
        for (const auto& [name, layout] : sample_layouts()) {
            for (int sheet = 0; sheet < static_cast<int>(layout.sheets.size()); ++sheet) {
                SCOPED_TRACE(profile.name + " " + name + " sheet " + std::to_string(sheet + 1));
                const std::vector<Line> expected = expected_lines(layout, profile, sheet);
                const std::vector<Line> found = lines_of(drawn(layout, profile, sheet));
                const auto wanted = lengths_of(expected);
                const auto lengths = lengths_of(found);
                EXPECT_EQ(lengths.size(), wanted.size());
                for (const auto& [operation, mm] : wanted) {
                    ASSERT_EQ(lengths.count(operation), 1U) << to_string(operation);
                    EXPECT_NEAR(lengths.at(operation), mm, 1e-6 * mm) << to_string(operation);
                }
                Segments left;
                for (const Line& line : expected) {
                    for (const Segment& one : line.segments()) left.add(one);
                }
                for (const Line& line : found) {
                    for (const Segment& one : line.segments())
                        EXPECT_TRUE(left.take(one)) << one.a.x << " " << one.a.y;
                }
                EXPECT_EQ(left.count(), 0U);
            }
        }
    }
}

TEST(MachineOrder, DoesWhatLiesInsideFirstInEverySample) {
    for (const Profile& profile : machine_profiles()) {
        for (const auto& [name, layout] : sample_layouts()) {
            for (int sheet = 0; sheet < static_cast<int>(layout.sheets.size()); ++sheet) {
                SCOPED_TRACE(profile.name + " " + name + " sheet " + std::to_string(sheet + 1));
                expect_order(lines_of(drawn(layout, profile, sheet)));
            }
        }
    }
}

TEST(MachineOrder, GoesLessFarBetweenLinesThanPieceByPiece) {
    for (Profile profile : machine_profiles()) {
        double in_order = 0.0;
        double piece_by_piece = 0.0;
        for (const auto& [name, layout] : sample_layouts()) {
            for (int sheet = 0; sheet < static_cast<int>(layout.sheets.size()); ++sheet) {
                profile.machine_order = true;
                in_order += way_of(lines_of(drawn(layout, profile, sheet)));
                profile.machine_order = false;
                piece_by_piece += way_of(lines_of(drawn(layout, profile, sheet)));
            }
        }
        EXPECT_LT(in_order, 0.8 * piece_by_piece) << profile.name;
    }
}

// A shape from its first point to its last.
struct Whole {
    std::pair<int, int> stretch;  // those of one may change places
    bool closed = false;
    std::vector<Vec2> points;
};

std::vector<Whole> wholes_of(const SheetDrawing& drawing) {
    std::vector<Whole> all;
    for (const SheetShape& shape : drawing.shapes) {
        if (is_printed(shape.operation)) continue;
        Whole& line = all.emplace_back();
        line.stretch = {turn_of(shape.operation), shape.depth};
        for (const popup::Run& run : drawing.runs_of(shape)) {
            line.closed = run.closed;
            const auto points = drawing.points_of(run);
            line.points.insert(line.points.end(), points.begin(), points.end());
        }
    }
    return all;
}

double way_by_nearest(std::vector<Whole> left, Vec2 from) {
    double sum = 0.0;
    while (!left.empty()) {
        std::size_t best = 0;
        double least = HUGE_VAL;
        Vec2 to;
        const auto look = [&](std::size_t i, Vec2 begin, Vec2 end) {
            if (distance(from, begin) >= least) return;
            least = distance(from, begin);
            best = i;
            to = end;
        };
        for (std::size_t i = 0; i < left.size(); ++i) {
            const std::vector<Vec2>& points = left[i].points;
            if (left[i].closed) {
                for (const Vec2 p : points) look(i, p, p);
            } else {
                look(i, points.front(), points.back());
                look(i, points.back(), points.front());
            }
        }
        sum += least;
        from = to;
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
    }
    return sum;
}

// Each stretch of lines that may change places, from where the one before it ends.
TEST(MachineOrder, GoesNoFurtherBetweenLinesThanByNearestNeighbours) {
    std::size_t compared = 0;
    for (const char* name : {"lightburn", "silhouette"}) {
        for (const auto& [sample, layout] : sample_layouts()) {
            SCOPED_TRACE(name + (" " + sample));
            std::vector<Whole> stretch;
            Vec2 begin;
            Vec2 at;
            double way = 0.0;
            const auto compare = [&] {
                // Of very fine contours not all corners are looked at.
                if (std::all_of(stretch.begin(), stretch.end(),
                                [](const Whole& line) { return line.points.size() <= 64; })) {
                    // Equally near ones may be taken in another order.
                    EXPECT_LE(way, 1.02 * way_by_nearest(stretch, begin) + 1e-6);
                    ++compared;
                }
                stretch.clear();
                begin = at;
                way = 0.0;
            };
            for (const Whole& line : wholes_of(drawn(layout, *find_profile(name)))) {
                if (!stretch.empty() && stretch.back().stretch != line.stretch) compare();
                stretch.push_back(line);
                way += distance(at, line.points.front());
                at = line.closed ? line.points.front() : line.points.back();
            }
            compare();
        }
    }
    EXPECT_GE(compared, 60U);
}

PatternPiece piece_of(const std::string& name, std::vector<Contour> cuts) {
    PatternPiece piece;
    piece.name = name;
    piece.cuts = std::move(cuts);
    piece.silhouette = {{piece.cuts.back().points, {}}};
    piece.bounds = bounds(piece.cuts.back().points);
    return piece;
}

Layout layout_of(std::vector<PatternPiece> pieces, const std::vector<Vec2>& offsets) {
    Layout layout;
    layout.margin_mm = 5;
    layout.sheets = {{300, 300, 0.5, {200, 200}}};
    layout.designs = {{"hand.xml", "hand", {}}};
    layout.designs[0].pattern.pieces = std::move(pieces);
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        Placement placement;
        placement.piece = static_cast<int>(i);
        placement.offset = offsets[i];
        layout.placements.push_back(placement);
    }
    return layout;
}

// A ring; in its hole a smaller ring with a slit; in the hole of that a square.
Layout nested_layout() {
    // Which way round a contour runs does not matter.
    Ring clockwise = rectangle(-30, -30, 30, 30);
    std::reverse(clockwise.begin(), clockwise.end());
    return layout_of({piece_of("ring", {{clockwise, true, 1}, {rectangle(-50, -50, 50, 50), true, 0}}),
                      piece_of("inner ring", {{{{-18, -14}, {-14, -18}}, false, 1},
                                              {rectangle(-10, -10, 10, 10), true, 1},
                                              {rectangle(-20, -20, 20, 20), true, 0}}),
                      piece_of("square", {{rectangle(-5, -5, 5, 5), true, 0}})},
                     {{100, 100}, {101, 99}, {102, 98}});
}

TEST(MachineOrder, CutsPiecesInHolesOfOthersBeforeTheHoles) {
    for (const Profile& profile : machine_profiles()) {
        SCOPED_TRACE(profile.name);
        const SheetDrawing drawing = drawn(nested_layout(), profile);
        const std::vector<Line> lines = lines_of(drawing);
        ASSERT_EQ(lines.size(), 6U);
        expect_order(lines);
        // What falls out of a hole is not the outermost of the sheet.
        std::vector<std::pair<double, int>> closed;  // length and depth, in their order
        for (const SheetShape& shape : drawing.shapes) {
            if (!drawing.runs_of(shape).front().closed) continue;
            closed.emplace_back(drawing.length_of(shape), shape.depth);
            EXPECT_EQ(shape.operation, shape.depth == 0 ? Operation::outer_cut : Operation::inner_cut);
            EXPECT_EQ(shape.color, profile.pen(shape.operation).color);
            EXPECT_EQ(shape.width_mm, profile.pen(shape.operation).width_mm);
        }
        EXPECT_EQ(closed,
                  (std::vector<std::pair<double, int>>{{40, 4}, {80, 3}, {160, 2}, {240, 1}, {400, 0}}));
    }
}

TEST(MachineOrder, KeepsOuterCutsWhereInnerOnesAreLeftOut) {
    Profile profile = plain_machine();
    pen_of(profile, Operation::inner_cut).layer.clear();
    for (const Line& line : lines_of(drawn(nested_layout(), profile)))
        EXPECT_EQ(line.operation, Operation::outer_cut);
}

TEST(MachineOrder, TellsAHoleFromPaperThatOnlyReachesRoundAPiece) {
    // A hook round a square: its box holds the square, its paper and its hole do not.
    const Ring hook{{0, 0}, {60, 0}, {60, 60}, {50, 60}, {50, 10}, {0, 10}};
    const Layout layout = layout_of(
        {piece_of("hook", {{{{52, 2}, {58, 2}, {58, 58}, {56, 58}, {56, 4}, {2, 4}, {2, 2}}, true, 1},
                           {hook, true, 0}}),
         piece_of("square", {{rectangle(0, 0, 10, 10), true, 0}})},
        {{10, 10}, {30, 30}});
    const SheetDrawing drawing = drawn(layout, plain_machine());
    int outer = 0;
    for (const SheetShape& shape : drawing.shapes) outer += shape.operation == Operation::outer_cut ? 1 : 0;
    EXPECT_EQ(outer, 2);
}

// Every other pair touches: a row of three, and one above that touches two of them in part.
TEST(MachineOrder, CutsWhatPiecesLaidEdgeToEdgeShareOnce) {
    for (const double gap : {0.0, 0.005}) {
        for (const double turn : {0.0, 90.0, 33.0}) {
            Layout layout = layout_of({piece_of("square", {{rectangle(0, 0, 20, 20), true, 0}}),
                                       piece_of("square", {{rectangle(0, 0, 20, 20), true, 0}}),
                                       piece_of("square", {{rectangle(0, 0, 20, 20), true, 0}}),
                                       piece_of("square", {{rectangle(0, 0, 20, 20), true, 0}})},
                                      {{0, 0}, {20 + gap, 0}, {40 + 2 * gap, 0}, {10, 20 + gap}});
            for (Placement& placement : layout.placements) {
                placement.angle = Angle::degrees(turn);
                placement.offset = rotated(placement.offset, placement.angle.rad()) + Vec2{100, 100};
            }
            const std::vector<Line> expected = expected_lines(layout, plain_machine(), 0);
            const std::vector<Line> found = lines_of(drawn(layout, plain_machine()));
            EXPECT_NEAR(lengths_of(expected).at(Operation::outer_cut), 320.0, 1e-9);
            EXPECT_NEAR(lengths_of(found).at(Operation::outer_cut), 320.0 - 3 * 20.0, 4 * gap + 1e-6);
            for (const Line& line : expected) {
                for (const Segment& one : line.segments()) {
                    for (int i = 0; i <= 40; ++i) {
                        double least = HUGE_VAL;
                        for (const Line& other : found) {
                            for (const Segment& drawn_one : other.segments())
                                least = std::min(least, distance(lerp(one.a, one.b, i / 40.0), drawn_one));
                        }
                        EXPECT_LE(least, 0.01);
                    }
                }
            }
        }
    }
}

TEST(MachineOrder, LeavesAFoldThatLiesOnACut) {
    Layout layout = layout_of({piece_of("square", {{rectangle(0, 0, 20, 20), true, 0}})}, {{50, 50}});
    layout.designs[0].pattern.pieces[0].lines = {{LineKind::valley, {{0, 0}, {20, 0}}}};
    const auto lengths = lengths_of(lines_of(drawn(layout, plain_machine())));
    EXPECT_NEAR(lengths.at(Operation::valley), 20.0, 1e-9);
    EXPECT_NEAR(lengths.at(Operation::outer_cut), 80.0, 1e-9);
}

TEST(MachineOrder, HasNoTinySegmentsAndMovesNothingFar) {
    // A disc in steps of 0.003 to 0.03 mm, and an open wave likewise.
    Ring disc;
    double angle = 0.0;
    while (angle < 6.28) {
        disc.push_back({15.0 * std::cos(angle), 15.0 * std::sin(angle)});
        angle += 0.001 + 0.0009 * std::sin(40 * angle);
    }
    disc.push_back({15.0 * std::cos(-0.0007), 15.0 * std::sin(-0.0007)});  // a hair from where it begins
    std::vector<Vec2> wave;
    for (int i = 0; i <= 1003; ++i) wave.push_back({-8.0 + 0.015 * i, std::sin(0.01 * i)});
    const Ring dot{{0, 5}, {0.008, 5}, {0.008, 5.008}, {0, 5.008}};
    const Layout layout =
        layout_of({piece_of("disc", {{wave, false, 1}, {dot, true, 1}, {disc, true, 0}})}, {{50, 50}});
    const std::vector<Line> expected = expected_lines(layout, plain_machine(), 0);
    const std::vector<Line> found = lines_of(drawn(layout, plain_machine()));
    ASSERT_EQ(found.size(), expected.size());
    std::size_t segments = 0;
    for (const Line& line : found) {
        const bool is_dot = line.length() < 0.1;
        // So small a hole is drawn as it is.
        if (is_dot) {
            EXPECT_EQ(line.points.size(), 4U);
            continue;
        }
        for (const Segment& one : line.segments()) {
            ++segments;
            EXPECT_GE(distance(one.a, one.b), kTinyMm);
        }
    }
    EXPECT_LT(segments, 5600U);
    EXPECT_GT(segments, 4000U);
    for (const Line& line : expected) {
        for (const Vec2 p : line.points) {
            double least = HUGE_VAL;
            for (const Line& other : found) {
                if (other.closed != line.closed) continue;
                for (const Segment& one : other.segments()) least = std::min(least, distance(p, one));
            }
            EXPECT_LE(least, kTinyMm);
        }
    }
    // Ends of open lines stay.
    for (const Line& line : found) {
        if (line.closed) continue;
        std::vector<Vec2> ends{line.points.front(), line.points.back()};
        if (ends[0].x > ends[1].x) std::swap(ends[0], ends[1]);
        EXPECT_LE(distance(ends[0], wave.front() + Vec2{50, 50}), 1e-9);
        EXPECT_LE(distance(ends[1], wave.back() + Vec2{50, 50}), 1e-9);
    }
}

// Two parts of one piece in the same hole are no deeper than one would be.
TEST(MachineOrder, CountsTheHoleRoundAPieceOfSeveralPartsOnce) {
    const Layout layout = layout_of(
        {piece_of("ring", {{rectangle(-30, -30, 30, 30), true, 1}, {rectangle(-50, -50, 50, 50), true, 0}}),
         piece_of("pair", {{rectangle(-20, -20, -5, 20), true, 0}, {rectangle(5, -20, 20, 20), true, 0}})},
        {{100, 100}, {100, 100}});
    const SheetDrawing drawing = drawn(layout, plain_machine());
    for (const SheetShape& shape : drawing.shapes) {
        if (shape.piece != 1) continue;
        EXPECT_EQ(shape.depth, 2);
    }
}

// A perforated line stays one shape, its cuts in their order from either end.
TEST(MachineOrder, FollowsPerforationsFromEndToEnd) {
    const Profile& profile = *find_profile("silhouette");
    for (const auto& [name, layout] : sample_layouts()) {
        const SheetDrawing drawing = drawn(layout, profile);
        for (const SheetShape& shape : drawing.shapes) {
            if (shape.operation != Operation::perforation) continue;
            const auto runs = drawing.runs_of(shape);
            const Vec2 begin = drawing.points_of(runs.front()).front();
            double last = -1.0;
            for (const popup::Run& run : runs) {
                ASSERT_EQ(run.count, 2U);
                for (const Vec2 p : drawing.points_of(run)) {
                    EXPECT_GT(distance(begin, p), last);
                    last = distance(begin, p);
                }
            }
        }
    }
}

TEST(MachineOrder, LeavesWhatIsPrintedAsItIs) {
    Profile profile = *find_profile("silhouette");
    const Layout layout = test::example_layout();
    const SheetDrawing ordered = drawn(layout, profile);
    profile.machine_order = false;
    const SheetDrawing plain = drawn(layout, profile);
    const auto printed = [](const SheetDrawing& drawing) {
        std::vector<std::vector<Vec2>> all;
        for (const SheetShape& shape : drawing.shapes) {
            if (!is_printed(shape.operation)) continue;
            for (const popup::Run& run : drawing.runs_of(shape)) {
                const auto points = drawing.points_of(run);
                all.emplace_back(points.begin(), points.end());
            }
        }
        return all;
    };
    EXPECT_GE(printed(plain).size(), 5U);
    EXPECT_EQ(printed(ordered), printed(plain));
    EXPECT_EQ(ordered.texts.size(), plain.texts.size());
}

}  // namespace
}  // namespace popup
