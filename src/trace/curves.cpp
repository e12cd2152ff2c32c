#include <potracelib.h>

#include <memory>
#include <new>

#include "trace/contours.h"

namespace popup {
namespace {

struct Free {
    void operator()(potrace_state_t* state) const { potrace_state_free(state); }
    void operator()(potrace_param_t* parameters) const { potrace_param_free(parameters); }
};

Vec2 point(const potrace_dpoint_t& p) { return {p.x, p.y}; }

// A corner is two lines that meet in it. Between two corners the end of the first lies on a straight line,
// and is left out.
Path path_of(const potrace_curve_t& curve) {
    const auto is_corner = [&curve](int i) { return curve.tag[i % curve.n] == POTRACE_CORNER; };
    Path path;
    path.move(point(is_corner(0) && is_corner(curve.n - 1) ? curve.c[0][1] : curve.c[curve.n - 1][2]));
    for (int i = 0; i < curve.n; ++i) {
        const potrace_dpoint_t* points = curve.c[i];
        if (!is_corner(i)) {
            path.cubic(point(points[0]), point(points[1]), point(points[2]));
            continue;
        }
        if (i > 0 || !is_corner(curve.n - 1)) path.line(point(points[1]));
        if (!is_corner(i + 1)) path.line(point(points[2]));
    }
    path.close();
    return path;
}

}  // namespace

std::vector<CellContour> curves_of(const CellGrid& cells, Closeness closeness, double tolerance) {
    constexpr int kBits = 8 * sizeof(potrace_word);
    potrace_bitmap_t bitmap{};
    bitmap.w = cells.width - 2;
    bitmap.h = cells.height - 2;
    bitmap.dy = (bitmap.w + kBits - 1) / kBits;
    std::vector<potrace_word> words(static_cast<std::size_t>(bitmap.dy) * static_cast<std::size_t>(bitmap.h));
    bitmap.map = words.data();
    for (int y = 0; y < bitmap.h; ++y) {
        // Rows from the bottom; the first cell of a word is its highest bit.
        potrace_word* const line = bitmap.map + static_cast<std::ptrdiff_t>(bitmap.dy) * (bitmap.h - 1 - y);
        for (int x = 0; x < bitmap.w; ++x) {
            if (cells.inside[cells.at(x + 1, y + 1)] != 0)
                line[x / kBits] |= potrace_word{1} << (kBits - 1 - x % kBits);
        }
    }
    const std::unique_ptr<potrace_param_t, Free> parameters(potrace_param_default());
    if (!parameters) throw std::bad_alloc();
    parameters->turdsize = 0;
    parameters->turnpolicy = POTRACE_TURNPOLICY_BLACK;
    parameters->opticurve = closeness == Closeness::smooth ? 1 : 0;
    parameters->opttolerance = tolerance;
    if (closeness == Closeness::straight) parameters->alphamax = 0.0;
    const std::unique_ptr<potrace_state_t, Free> state(potrace_trace(parameters.get(), &bitmap));
    if (!state || state->status != POTRACE_STATUS_OK) throw std::bad_alloc();
    std::vector<CellContour> contours;
    for (const potrace_path_t* path = state->plist; path != nullptr; path = path->next) {
        contours.push_back({path_of(path->curve), path->sign == '+' ? path->area : -path->area});
    }
    return contours;
}

}  // namespace popup
