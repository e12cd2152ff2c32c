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
    const double period = perforation.cut_mm + perforation.gap_mm;
    const double cuts = std::round((room + perforation.gap_mm) / period);
    if (cuts < 2.0) {
        const double half = 0.5 * std::min(perforation.cut_mm, length / 3.0);
        return {part(0.5 * length - half, 0.5 * length + half)};
    }
    const double scale = room / (cuts * period - perforation.gap_mm);
    std::vector<Segment> segments;
    segments.reserve(static_cast<std::size_t>(cuts));
    for (int i = 0; i < static_cast<int>(cuts); ++i) {
        const double from = perforation.clear_mm + i * period * scale;
        segments.push_back(part(from, from + perforation.cut_mm * scale));
    }
    return segments;
}

}  // namespace popup
