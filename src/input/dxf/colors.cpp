#include "input/dxf/colors.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace popup::dxf {
namespace {

constexpr std::array<Color, 10> kNamed{{{0, 0, 0},
                                        {255, 0, 0},
                                        {255, 255, 0},
                                        {0, 255, 0},
                                        {0, 255, 255},
                                        {0, 0, 255},
                                        {255, 0, 255},
                                        {0, 0, 0},
                                        {128, 128, 128},
                                        {192, 192, 192}}};
constexpr std::array<std::uint8_t, 6> kGreys{51, 80, 105, 130, 190, 255};

}  // namespace

// From 10 on, ten indices a hue in steps of 15°: five brightnesses, each pure and then half way to grey. From
// 250 on greys.
Color index_color(int index) {
    if (index < 1 || index > 255) return {0, 0, 0};
    if (index < 10) return kNamed.at(static_cast<std::size_t>(index));
    if (index >= 250) {
        const std::uint8_t grey = kGreys.at(static_cast<std::size_t>(index - 250));
        return {grey, grey, grey};
    }
    constexpr std::array<int, 5> kBrightness{255, 165, 127, 76, 38};
    const int most = kBrightness.at(static_cast<std::size_t>(index % 10 / 2));
    const bool pale = index % 2 == 1;
    const int hue = index / 10 - 1;  // of 24
    // Quarters of a channel that is red at hue 0 and falls to nothing from hue 4 to 8.
    const auto channel = [&](int from) {
        const int off = (hue - from + 24) % 24;
        const int away = off > 12 ? 24 - off : off;
        const int quarters = away <= 4 ? 4 : away >= 8 ? 0 : 8 - away;
        return static_cast<std::uint8_t>(pale ? most * (4 + quarters) / 8 : most * quarters / 4);
    };
    return {channel(0), channel(8), channel(16)};
}

}  // namespace popup::dxf
