// Machine order of every sample by every profile of a machine, against lines that this test places and adds
// up itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "popup/compile.h"
#include "support/machine_lines.h"

namespace popup {
namespace {

namespace fs = std::filesystem;
using test::drawn;
using test::expect_order;
using test::expected_lines;
using test::lengths_of;
using test::Line;
using test::lines_of;
using test::machine_profiles;
using test::turn_of;

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

double way_of(const std::vector<Line>& lines) {
    double sum = 0.0;
    Vec2 at;
    for (const Line& line : lines) {
        sum += distance(at, line.points.front());
        at = line.closed ? line.points.front() : line.points.back();
    }
    return sum;
}

bool lies_in(Vec2 p, const std::vector<Vec2>& ring) {
    bool inside = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i];
        const Vec2 b = ring[(i + 1) % ring.size()];
        if ((a.y <= p.y) != (b.y <= p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

// A piece that lies in a hole of another is cut out before the hole is: in machine order its outer cut is an
// inner one.
std::vector<Line> sunk(std::vector<Line> lines) {
    const std::vector<Line> all = lines;
    for (Line& line : lines) {
        const auto holds = [&line](const Line& other) {
            return other.operation == Operation::inner_cut && other.closed &&
                   lies_in(line.points.front(), other.points);
        };
        if (line.operation == Operation::outer_cut && std::any_of(all.begin(), all.end(), holds))
            line.operation = Operation::inner_cut;
    }
    return lines;
}

TEST(MachineOrderOfSamples, HasTheSameLinesAsThePatternOfEverySample) {
    ASSERT_GE(sample_layouts().size(), 13U);
    for (Profile profile : machine_profiles()) {
        // With one kerf no outline moves because it lies in a hole.
        profile.pens[static_cast<std::size_t>(Operation::outer_cut)].kerf_mm =
            profile.pen(Operation::inner_cut).kerf_mm;
        for (const auto& [name, layout] : sample_layouts()) {
            for (int sheet = 0; sheet < static_cast<int>(layout.sheets.size()); ++sheet) {
                SCOPED_TRACE(profile.name + " " + name + " sheet " + std::to_string(sheet + 1));
                std::vector<Line> expected = expected_lines(layout, profile, sheet);
                if (profile.machine_order) expected = sunk(std::move(expected));
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

TEST(MachineOrderOfSamples, DoesWhatLiesInsideFirstInEverySample) {
    for (const Profile& profile : machine_profiles()) {
        for (const auto& [name, layout] : sample_layouts()) {
            for (int sheet = 0; sheet < static_cast<int>(layout.sheets.size()); ++sheet) {
                SCOPED_TRACE(profile.name + " " + name + " sheet " + std::to_string(sheet + 1));
                expect_order(lines_of(drawn(layout, profile, sheet)));
            }
        }
    }
}

TEST(MachineOrderOfSamples, GoesLessFarBetweenLinesThanPieceByPiece) {
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
TEST(MachineOrderOfSamples, GoesNoFurtherBetweenLinesThanByNearestNeighbours) {
    std::size_t compared = 0;
    double all = 0.0;
    double all_by_nearest = 0.0;
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
                    // Equally near ones may be taken in another order, which of few lines makes a difference.
                    const double by_nearest = way_by_nearest(stretch, begin);
                    EXPECT_LE(way, 1.1 * by_nearest + 1e-6);
                    all += way;
                    all_by_nearest += by_nearest;
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
    EXPECT_LE(all, all_by_nearest);
}

// A perforated line stays one shape, its cuts in their order from either end.
TEST(MachineOrderOfSamples, FollowsPerforationsFromEndToEnd) {
    const Profile& profile = *find_profile("silhouette");
    for (const auto& [name, layout] : sample_layouts()) {
        const SheetDrawing drawing = drawn(layout, profile);
        for (const SheetShape& shape : drawing.shapes) {
            if (shape.operation != Operation::perforation) continue;
            const auto runs = drawing.runs_of(shape);
            const Vec2 begin = drawing.points_of(runs.front()).front();
            double last = -1.0;
            for (const popup::Run& run : runs) {
                ASSERT_GE(run.count, 2U);
                for (const Vec2 p : drawing.points_of(run)) {
                    EXPECT_GT(distance(begin, p), last);
                    last = distance(begin, p);
                }
            }
        }
    }
}

}  // namespace
}  // namespace popup
