#include <array>
#include <cstddef>

#include "popup/trace.h"

namespace popup {
namespace {

// Of opacity: as much as from which a pixel belongs to the figure.
constexpr int kHalf = 128;

using Histogram = std::array<std::int64_t, 256>;

// The values below the threshold are one class. Sums are whole numbers that doubles hold exactly, so equally
// good thresholds are equal to the last bit.
int separate(const Histogram& counts) {
    double all = 0.0;
    double sum = 0.0;
    for (std::size_t value = 0; value < counts.size(); ++value) {
        all += static_cast<double>(counts[value]);
        sum += static_cast<double>(counts[value]) * static_cast<double>(value);
    }
    double below = 0.0;
    double sum_below = 0.0;
    double best = 0.0;
    int first = 1;
    int last = 1;
    for (int threshold = 1; threshold < 256; ++threshold) {
        const auto value = static_cast<std::size_t>(threshold - 1);
        below += static_cast<double>(counts[value]);
        sum_below += static_cast<double>(counts[value]) * static_cast<double>(value);
        const double above = all - below;
        if (below == 0.0 || above == 0.0) continue;
        const double apart = sum_below / below - (sum - sum_below) / above;
        const double between = (below / all) * (above / all) * apart * apart;
        if (between > best) {
            best = between;
            first = threshold;
        }
        if (between == best) last = threshold;
    }
    return (first + last) / 2;
}

// Brightness on white paper.
int brightness(const std::uint8_t* rgba) {
    const int value = (299 * rgba[0] + 587 * rgba[1] + 114 * rgba[2]) / 1000;
    return 255 - (255 - value) * rgba[3] / 255;
}

// Whether the clear pixels are so few that they are no ground, as the corners of a window in a screenshot,
// and what is opaque is dark here and light there.
bool is_drawn_on_white(const ImagePixels& pixels) {
    constexpr std::size_t kFewIn = 100;
    constexpr std::size_t kSomeIn = 1000;
    const std::size_t count = pixels.rgba.size() / 4;
    std::size_t clear = 0;
    std::size_t dark = 0;
    std::size_t light = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* rgba = &pixels.rgba[4 * i];
        if (rgba[3] < kHalf) {
            ++clear;
            continue;
        }
        const int value = brightness(rgba);
        if (value <= 85) ++dark;
        if (value >= 170) ++light;
    }
    return clear * kFewIn < count && dark * kSomeIn >= count && light * kSomeIn >= count;
}

}  // namespace

PixelMask mask_of(const ImagePixels& pixels, const MaskOptions& options) {
    const std::size_t count = pixels.rgba.size() / 4;
    PixelMask mask;
    mask.width = pixels.width;
    mask.height = pixels.height;
    mask.few_clear = !pixels.opaque && is_drawn_on_white(pixels);
    mask.by_alpha = !pixels.opaque && !mask.few_clear;
    mask.inside.resize(count);
    Histogram counts{};
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* rgba = &pixels.rgba[4 * i];
        const int value = mask.by_alpha ? rgba[3] : brightness(rgba);
        mask.inside[i] = static_cast<std::uint8_t>(value);
        ++counts[static_cast<std::size_t>(value)];
    }
    for (const std::int64_t of_value : counts) {
        if (of_value == static_cast<std::int64_t>(count)) mask.even = true;
    }
    mask.threshold = options.threshold ? *options.threshold : mask.by_alpha ? kHalf : separate(counts);
    for (std::uint8_t& one : mask.inside) {
        const bool reached = one >= mask.threshold;
        one = (reached == mask.by_alpha) != options.invert ? 1 : 0;
    }
    return mask;
}

}  // namespace popup
