#include "fabrication/perforate.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

std::vector<std::vector<Vec2>> perforated_along(std::span<const Vec2> chain, const Perforation& perforation) {
    std::vector<std::vector<Vec2>> cuts;
    if (chain.size() == 2) {
        for (const Segment& cut : perforated({chain[0], chain[1]}, perforation))
            cuts.push_back({cut.a, cut.b});
        return cuts;
    }
    double whole = 0.0;
    for (std::size_t i = 1; i < chain.size(); ++i) whole += distance(chain[i - 1], chain[i]);
    std::size_t chord = 1;  // that ends at this corner
    double before = 0.0;    // mm of the chain before it
    const auto go_to = [&](double at, std::vector<Vec2>* cut) {
        double length = distance(chain[chord - 1], chain[chord]);
        while (chord + 1 < chain.size() && before + length <= at) {
            if (cut != nullptr) cut->push_back(chain[chord]);
            before += length;
            length = distance(chain[chord], chain[chord + 1]);
            ++chord;
        }
        return length > 0.0 ? lerp(chain[chord - 1], chain[chord], std::min(1.0, (at - before) / length))
                            : chain[chord];
    };
    // Laid out straight the fold is as long.
    for (const Segment& straight : perforated({{0.0, 0.0}, {whole, 0.0}}, perforation)) {
        std::vector<Vec2> cut{go_to(straight.a.x, nullptr)};
        const Vec2 end = go_to(straight.b.x, &cut);
        if (cut.back() != end) cut.push_back(end);
        cuts.push_back(std::move(cut));
    }
    return cuts;
}

}  // namespace popup
