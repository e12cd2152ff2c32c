#include <algorithm>
#include <cmath>

#include "popup/profile.h"

namespace popup {

std::vector<Segment> perforated(const Segment& line, const Perforation& perforation) {
    const double length = distance(line.a, line.b);
    const auto part = [&](double from, double to) {
        return Segment{lerp(line.a, line.b, from / length), lerp(line.a, line.b, to / length)};
    };
    const double room = length - 2.0 * perforation.clear_mm;
    if (room < perforation.cut_mm) return {part(length / 3.0, 2.0 * length / 3.0)};
    const double period = perforation.cut_mm + perforation.gap_mm;
    const double cuts = std::max(1.0, std::round((room + perforation.gap_mm) / period));
    const double scale = room / (cuts * period - perforation.gap_mm);
    std::vector<Segment> segments;
    segments.reserve(static_cast<std::size_t>(cuts));
    for (double i = 0.0; i < cuts; i += 1.0) {
        const double from = perforation.clear_mm + i * period * scale;
        segments.push_back(part(from, from + perforation.cut_mm * scale));
    }
    return segments;
}

}  // namespace popup
