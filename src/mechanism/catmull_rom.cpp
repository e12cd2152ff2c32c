#include "mechanism/catmull_rom.h"

#include <vector>

namespace popup {

std::optional<Path> catmull_rom(std::span<const Vec2> points) {
    constexpr double kOneTouchMm = 0.01;
    Ring through;
    for (const Vec2 p : points) {
        if (through.empty() || distance(through.back(), p) > kOneTouchMm) through.push_back(p);
    }
    while (through.size() > 1 && distance(through.back(), through.front()) <= kOneTouchMm) through.pop_back();
    const std::size_t n = through.size();
    if (n < 3) return std::nullopt;
    Path path;
    path.move(through.front());
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 before = through[(i + n - 1) % n];
        const Vec2 from = through[i];
        const Vec2 to = through[(i + 1) % n];
        const Vec2 after = through[(i + 2) % n];
        const double a = distance(before, from);
        const double b = distance(from, to);
        const double c = distance(to, after);
        const Vec2 control_1 = (1.0 / (3.0 * a * (a + b))) *
                               (a * a * to - b * b * before + (2.0 * a * a + 3.0 * a * b + b * b) * from);
        const Vec2 control_2 = (1.0 / (3.0 * c * (c + b))) *
                               (c * c * from - b * b * after + (2.0 * c * c + 3.0 * c * b + b * b) * to);
        path.cubic(control_1, control_2, to);
    }
    path.close();
    return path;
}

}  // namespace popup
