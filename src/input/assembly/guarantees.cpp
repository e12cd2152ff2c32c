#include "input/assembly/guarantees.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string_view>
#include <utility>

#include "base/geometry/regions.h"
#include "base/geometry/tolerances.h"
#include "input/text.h"
#include "parts/work.h"
#include "popup/image.h"

namespace popup {
namespace {

using Of = AssemblyFault::Of;

constexpr std::size_t kMostFaults = 100;
// Axes of a frame are square, and of unit length, to this.
constexpr double kSquare = 1e-8;
constexpr double kFullTurn = 360.0;

class Examiner {
 public:
    explicit Examiner(const Assembly& assembly) : in_(assembly) {}

    std::vector<AssemblyFault> run() {
        if (in_.pieces.empty()) fault(Of::assembly, 0, "there are no pieces");
        names(in_.pieces, Of::piece, "piece");
        names(in_.plates, Of::plate, "plate");
        pieces();
        each(in_.plates, [&](std::size_t i, const Plate& plate) { check(i, plate); });
        each(in_.lines, [&](std::size_t i, const Line& line) { check(i, line); });
        each(in_.hinges, [&](std::size_t i, const Hinge& hinge) { check(i, hinge); });
        each(in_.glue, [&](std::size_t i, const Glue& glue) { check(i, glue); });
        each(in_.glued_areas, [&](std::size_t i, const GluedArea& area) { check(i, area); });
        each(in_.layers, [&](std::size_t i, const PlateOrder& order) { check(i, order); });
        every_seam_has_glue();
        joints();
        whole();
        return std::move(faults_);
    }

 private:
    void fault(Of part, std::size_t number, std::string what) {
        if (faults_.size() < kMostFaults) faults_.push_back({part, number, std::move(what)});
    }
    template <typename T, typename Check>
    void each(const std::vector<T>& all, const Check& check) {
        for (std::size_t i = 0; i < all.size() && faults_.size() < kMostFaults; ++i) check(i, all[i]);
    }
    [[nodiscard]] std::string plate_name(int plate) const {
        return fmt::format("\"{}\"", shown(in_.plates[static_cast<std::size_t>(plate)].name));
    }
    [[nodiscard]] int piece_of(int plate) const { return in_.plates[static_cast<std::size_t>(plate)].piece; }

    // --- what can be asked of points

    static bool near(Vec2 p) {
        return std::abs(p.x) <= kAssemblyReachMm && std::abs(p.y) <= kAssemblyReachMm;
    }
    static bool near(const Segment& s) { return near(s.a) && near(s.b); }
    static bool near(const std::vector<Vec2>& points) {
        return std::all_of(points.begin(), points.end(), [](Vec2 p) { return near(p); });
    }
    static bool near(const Polygon& polygon) {
        return near(polygon.outer) && std::all_of(polygon.holes.begin(), polygon.holes.end(),
                                                  [](const Ring& hole) { return near(hole); });
    }
    static bool near(const Print& print) {
        if (const auto* area = std::get_if<Area>(&print)) return near(area->shape);
        if (const auto* stroke = std::get_if<Stroke>(&print)) {
            return near(stroke->points) && stroke->points.size() >= 2 && stroke->width_mm >= 0.0 &&
                   stroke->width_mm <= kAssemblyReachMm;
        }
        if (const auto* text = std::get_if<Text>(&print)) {
            return near(text->at) && text->height_mm > 0.0 && text->height_mm <= kAssemblyReachMm;
        }
        const auto& image = std::get<Image>(print);
        const bool whole = std::abs(cross(image.place.x, image.place.y)) > 1e-12;
        return whole && near(outline_of(image)) &&
               std::all_of(image.clip.begin(), image.clip.end(), [](const Polygon& p) { return near(p); });
    }
    // What is wrong with regions that must not overlap; empty: nothing.
    std::string fault_of(const std::vector<Polygon>& regions) {
        std::vector<Ring> rings;
        double sum = 0.0;
        double around = 0.0;
        for (const Polygon& region : regions) {
            if (!near(region))
                return fmt::format("an outline reaches further out than {:.0f} mm", kAssemblyReachMm);
            if (region.outer.size() < 3) return "an outline has fewer than three corners";
            if (!(signed_area(region.outer) > 0.0))
                return "an outline does not run counter-clockwise round an area";
            for (const Ring& hole : region.holes) {
                if (!(signed_area(hole) < 0.0)) return "a hole does not run clockwise round an area";
            }
            sum += signed_area(region.outer);
            rings.push_back(region.outer);
            for (const Ring& hole : region.holes) {
                sum += signed_area(hole);
                rings.push_back(hole);
            }
        }
        for (const Ring& ring : rings) {
            for (std::size_t i = 0; i < ring.size(); ++i)
                around += distance(ring[i], ring[(i + 1) % ring.size()]);
        }
        if (!work_.sweep(regions)) return "there are too many edges side by side to examine them";
        const double painted = area(filled(rings, FillRule::non_zero));
        const double off = std::abs(painted - sum);
        // What rounding to the grid may make of it.
        if (off <= 1e-6 * sum + kOnGridLineMm * around) return {};
        return fmt::format(
            "the areas cross or overlap: they cover {:.4f} mm², and their rings enclose {:.4f} mm²", painted,
            sum);
    }

    // --- part by part

    template <typename T>
    void names(const std::vector<T>& all, Of part, std::string_view word) {
        std::set<std::string_view> seen;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (all[i].name.empty()) fault(part, i, fmt::format("a {} has no name", word));
            if (!seen.insert(all[i].name).second)
                fault(part, i, fmt::format("there are two {}s \"{}\"", word, shown(all[i].name)));
        }
    }

    void pieces() {
        std::vector<int> listed(in_.plates.size(), -1);
        each(in_.pieces, [&](std::size_t i, const Piece& piece) {
            const auto say = [&](std::string_view what) {
                fault(Of::piece, i, fmt::format("piece \"{}\" {}", shown(piece.name), what));
            };
            std::vector<Polygon> plates;
            for (const int plate : piece.plates) {
                int& in = listed[static_cast<std::size_t>(plate)];
                if (piece_of(plate) != static_cast<int>(i) || in >= 0)
                    return say(fmt::format("lists plate {}, which is not its own or listed before",
                                           plate_name(plate)));
                in = static_cast<int>(i);
                plates.push_back(in_.plates[static_cast<std::size_t>(plate)].outline);
            }
            if (piece.plates.empty() && piece.paper.empty()) return say("has neither plates nor paper");
            if (const std::string wrong = fault_of(piece.paper); !wrong.empty())
                return say("has wrong paper: " + wrong);
            if (piece.paper.empty()) {
                if (const std::string wrong = fault_of(plates); !wrong.empty())
                    return say("has wrong plates: " + wrong);
            }
            for (const std::vector<Vec2>& slit : piece.slits) {
                if (slit.size() < 2 || !near(slit)) return say("has a slit of one point, or far out");
            }
            if (!std::all_of(piece.prints.begin(), piece.prints.end(),
                             [](const Print& p) { return near(p); }))
                say("has a print that has no extent, or is far out");
        });
        each(in_.plates, [&](std::size_t i, const Plate& plate) {
            if (listed[i] < 0)
                fault(Of::plate, i,
                      fmt::format("plate \"{}\" is not among the plates of its piece", shown(plate.name)));
        });
    }

    void check(std::size_t number, const Plate& plate) {
        const auto say = [&](std::string_view what) {
            fault(Of::plate, number, fmt::format("plate \"{}\" {}", shown(plate.name), what));
        };
        // Where the piece has paper of its own, its plates were not looked at with it.
        if (const std::string wrong = fault_of({plate.outline}); !wrong.empty())
            return say("is wrong: " + wrong);
        if (!plate.uncut.empty()) {
            if (const std::string wrong = fault_of({Polygon{plate.uncut, {}}}); !wrong.empty())
                return say("is wrong before its cut-outs: " + wrong);
        }
        if (!std::all_of(plate.prints.begin(), plate.prints.end(), [](const Print& p) { return near(p); }))
            say("has a print that has no extent, or is far out");
        if (plate.parent >= 0 && !moves(in_)) return say("hangs on another, and no joint moves it");
        if (!plate.stands) return;
        const Frame& frame = *plate.stands;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 made = cross(frame.axes.at((i + 1) % 3), frame.axes.at((i + 2) % 3));
            if (std::abs(length(frame.axes.at(i)) - 1.0) > kSquare ||
                distance(made, frame.axes.at(i)) > kSquare)
                return say("stands in axes that are not three unit vectors square to each other");
        }
        if (!(length(frame.origin) <= kAssemblyReachMm)) say("stands far out");
    }

    void check(std::size_t number, const Line& line) {
        const auto say = [&](std::string_view what) {
            fault(Of::line, number, fmt::format("a line {}", what));
        };
        if (!near(line.at)) return say("is far out");
        for (const int plate : {line.plate, line.other_plate}) {
            if (plate >= 0 && piece_of(plate) != line.piece)
                return say(fmt::format("names plate {}, which is of another piece", plate_name(plate)));
        }
        const bool fold = line.kind == LineKind::mountain || line.kind == LineKind::valley;
        if (fold && moves(in_) && (line.plate < 0 || line.other_plate < 0))
            return say("is a fold, and does not name its two plates");
        if (line.kind == LineKind::seam && moves(in_) && line.plate < 0)
            return say("is a seam, and does not name its plate");
        if (line.fold_angle && !(*line.fold_angle >= 0.0 && *line.fold_angle <= kHalfTurn))
            say("is folded by no angle from 0 to 180 degrees");
    }

    void check(std::size_t number, const Hinge& hinge) {
        const auto say = [&](std::string_view what) {
            fault(Of::hinge, number,
                  fmt::format("the hinge of {} and {} {}", plate_name(hinge.a), plate_name(hinge.b), what));
        };
        if (hinge.a == hinge.b) return say("joins a plate to itself");
        if (!near(hinge.a_line) || !near(hinge.b_line)) return say("is far out");
        const double a = distance(hinge.a_line.a, hinge.a_line.b);
        const double b = distance(hinge.b_line.a, hinge.b_line.b);
        if (!(a > kGridMm)) return say("has no length");
        if (std::abs(a - b) > kOnGridLineMm)
            return say(fmt::format("is {:.6f} mm long on the one and {:.6f} mm on the other", a, b));
        const bool one_piece = piece_of(hinge.a) == piece_of(hinge.b);
        if (hinge.glued) return;
        if (!one_piece) return say("is a fold, but they are of two pieces");
        if (distance(hinge.a_line.a, hinge.b_line.a) > kOnGridLineMm ||
            distance(hinge.a_line.b, hinge.b_line.b) > kOnGridLineMm)
            say("is a fold, but not the same line on both");
    }

    void check(std::size_t number, const Glue& glue) {
        const auto say = [&](std::string_view what) {
            fault(Of::glue, number,
                  fmt::format("the tab of {} on {} {}", plate_name(glue.piece_plate),
                              plate_name(glue.base_plate), what));
        };
        if (!near(glue.on_piece) || !near(glue.on_base)) return say("is far out");
        const double piece = distance(glue.on_piece.a, glue.on_piece.b);
        const double base = distance(glue.on_base.a, glue.on_base.b);
        if (!(piece > kGridMm) || std::abs(piece - base) > kOnGridLineMm)
            say(fmt::format("is {:.6f} mm long on the one and {:.6f} mm on the other", piece, base));
    }

    void check(std::size_t number, const GluedArea& area) {
        const auto say = [&](std::string_view what) {
            fault(Of::glued_area, number,
                  fmt::format("the glue between {} and {} {}", plate_name(area.plate),
                              plate_name(area.base_plate), what));
        };
        if (area.plate == area.base_plate) return say("glues a plate to itself");
        if (area.on_base.empty()) return say("covers nothing");
        if (const std::string wrong = fault_of(area.on_base); !wrong.empty()) say("is wrong: " + wrong);
    }

    static std::pair<int, int> pair_of(int a, int b) { return std::minmax({a, b}); }

    void every_seam_has_glue() {
        std::map<std::pair<int, int>, int> left;
        for (const Glue& glue : in_.glue) ++left[pair_of(glue.piece_plate, glue.base_plate)];
        each(in_.hinges, [&](std::size_t i, const Hinge& hinge) {
            if (!hinge.glued || left[pair_of(hinge.a, hinge.b)]-- > 0) return;
            fault(Of::hinge, i,
                  fmt::format("the seam of {} and {} has no glue", plate_name(hinge.a), plate_name(hinge.b)));
        });
    }

    // --- what moves

    void joints() {
        std::set<std::pair<int, int>> hinged;
        for (const Hinge& hinge : in_.hinges) hinged.insert(pair_of(hinge.a, hinge.b));
        std::vector<bool> placed(in_.plates.size());
        each(in_.joints, [&](std::size_t i, const Joint& joint) {
            const auto say = [&](std::string_view what) {
                fault(Of::joint, i,
                      fmt::format("the {} joint of \"{}\": {}", kJointNames.at(joint.how.index()),
                                  shown(joint.name), what));
            };
            const JointPlates plates = plates_of(joint);
            for (const int plate : plates.needs) {
                if (!placed[static_cast<std::size_t>(plate)])
                    say(fmt::format("it needs plate {}, which no joint before it places", plate_name(plate)));
            }
            for (const PlacedPlate& one : plates.places) {
                if (placed[static_cast<std::size_t>(one.plate)])
                    say(fmt::format("it places plate {}, which is placed already", plate_name(one.plate)));
                placed[static_cast<std::size_t>(one.plate)] = true;
            }
            if (const auto wrong = popup::fault_of(joint)) return say(*wrong);
            for (const PlacedPlate& one : plates.places) {
                if (one.parent < 0 || one.lying != Lying::free) continue;
                if (!hinged.contains(pair_of(one.plate, one.parent)))
                    return say(fmt::format("plates {} and {} have no hinge", plate_name(one.plate),
                                           plate_name(one.parent)));
            }
        });
        if (!moves(in_)) return;
        each(in_.plates, [&](std::size_t i, const Plate& plate) {
            if (!placed[i])
                fault(Of::plate, i, fmt::format("no joint places plate \"{}\"", shown(plate.name)));
            if (plate.stands)
                fault(Of::plate, i,
                      fmt::format("plate \"{}\" stands still, and a joint moves it", shown(plate.name)));
        });
    }

    void check(std::size_t number, const PlateOrder& order) {
        const auto say = [&](std::string_view what) {
            fault(Of::layer, number,
                  fmt::format("of plates that lie on each other, {} and {} {}", plate_name(order.plate),
                              plate_name(order.base), what));
        };
        const auto stands = [this](int plate) {
            return in_.plates[static_cast<std::size_t>(plate)].stands.has_value();
        };
        if (order.plate == order.base) return say("are one plate");
        if (!stands(order.plate) || !stands(order.base)) return say("do not both stand still");
        if (!ordered_.insert(std::minmax(order.plate, order.base)).second) say("are named twice");
    }

    void whole() {
        const Sweep& sweep = in_.sweep;
        if (!(sweep.from_deg >= 0.0 && sweep.from_deg < sweep.to_deg && sweep.to_deg <= kFullTurn))
            fault(
                Of::assembly, 0,
                fmt::format("the sweep goes from {} to {} degrees; it begins at 0 or more, goes up, and ends "
                            "at 360 at most",
                            sweep.from_deg, sweep.to_deg));
        std::set<int> covers;
        for (const int cover : in_.covers) {
            if (!covers.insert(cover).second)
                fault(Of::assembly, 0, fmt::format("plate {} covers twice", plate_name(cover)));
        }
        for (const Trace& trace : in_.traces) {
            const auto far = [](Vec3 p) { return !(length(p) <= kAssemblyReachMm); };
            for (const std::vector<Vec3>& line : trace.lines) {
                if (line.size() < 2 || std::any_of(line.begin(), line.end(), far))
                    return fault(
                        Of::assembly, 0,
                        fmt::format("trace \"{}\" has a line of one point, or far out", shown(trace.name)));
            }
        }
        for (const FlatCurve& curve : in_.curves.curves()) {
            const auto inside = [](const FlatCurve::Corner& c) {
                return near(c.at) && c.t >= 0.0 && c.t <= 1.0;
            };
            const Cubic& c = curve.cubic;
            if (!near(std::vector<Vec2>{c.from, c.control_1, c.control_2, c.to}) ||
                !std::all_of(curve.corners.begin(), curve.corners.end(), inside))
                return fault(Of::assembly, 0, "a curve is far out, or has a corner beyond its ends");
        }
    }

    static constexpr double kHalfTurn = std::numbers::pi + 1e-9;

    const Assembly& in_;
    Work work_;
    std::set<std::pair<int, int>> ordered_;
    std::vector<AssemblyFault> faults_;
};

}  // namespace

std::vector<AssemblyFault> faults_of(const Assembly& assembly) { return Examiner(assembly).run(); }

}  // namespace popup
