// SVG path data: where it faults is in the text, and what it encloses has corners within reach.
#include "popup/path.h"

#include <cmath>

#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_path(std::string_view bytes) {
    Path path;
    const auto fault = parse_path(bytes, path);
    if (fault) expect(fault->at <= bytes.size(), "a fault is in the text");
    Flattened flat;
    if (flatten(path, flat) == FlatteningFault::none) {
        for (const Polyline& line : flat.lines) {
            expect(line.points.size() >= 2, "a line has two points");
            for (const Vec2 point : line.points)
                expect(std::abs(point.x) <= kReachMm + 1 && std::abs(point.y) <= kReachMm + 1,
                       "points are in reach");
        }
    }
    Enclosed inside;
    enclose(path, inside);
}

}  // namespace popup::fuzz
