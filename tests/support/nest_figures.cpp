#include "support/nest_figures.h"

#include <algorithm>
#include <array>
#include <utility>

namespace popup::test {
namespace {

constexpr std::nullopt_t kNone = std::nullopt;

const std::array<StripFigures, 15> kStrips{{
    {"strip/albano", 89.48, 89.82, 87.55, 87.47, 87.57, 86.0, 83.88, 76.42},
    {"strip/blaz1", 84.68, 86.22, 83.02, 82.40, 81.49, kNone, kNone, 69.67},
    {"strip/dagli", 89.26, 90.17, 87.50, 87.06, 85.87, kNone, kNone, 80.91},
    {"strip/fu", 92.23, 92.40, 91.95, 90.68, 89.02, kNone, kNone, 86.35},
    {"strip/gardeyn0", kNone, kNone, kNone, kNone, kNone, kNone, kNone, 80.26},
    {"strip/gardeyn1", kNone, kNone, kNone, kNone, kNone, kNone, kNone, 76.60},
    {"strip/jakobs1", 89.08, 89.25, 89.09, 88.90, 89.06, 82.7, 81.66, 75.39},
    {"strip/jakobs2", 84.77, 87.72, 83.56, 81.14, 80.39, kNone, kNone, 68.92},
    {"strip/mao", 86.14, 86.87, 83.76, 82.93, 84.69, kNone, kNone, kNone},
    {"strip/marques", 90.93, 92.02, 89.97, 89.40, 88.67, kNone, kNone, kNone},
    {"strip/shapes0", 68.60, 69.98, 68.73, 67.26, 65.39, 63.8, 54.65, 52.50},
    {"strip/shapes1", 75.68, 76.72, 75.86, 73.79, 71.23, kNone, kNone, kNone},
    {"strip/shirts", 89.66, 90.92, 87.62, 87.59, 86.74, 86.0, kNone, 79.42},
    {"strip/swim", 78.26, 79.83, 74.29, 74.49, 74.62, 72.7, 63.31, 60.88},
    {"strip/trousers", 91.74, 92.62, 90.48, 89.02, 89.72, 88.8, kNone, 77.55},
}};

const std::array<std::pair<const char*, int>, 9> kLibnest2dSheets{{{"bins/TA001", 4},
                                                                   {"bins/TA001C5", 4},
                                                                   {"bins/TB002", 10},
                                                                   {"bins/TD003", 4},
                                                                   {"bins/TH004", 14},
                                                                   {"bins/TL001C5", 4},
                                                                   {"bins/TM005", 7},
                                                                   {"bins/TS002C5", 3},
                                                                   {"bins/TX001C8C5", 4}}};

}  // namespace

const StripFigures* strip_figures(const std::string& name) {
    const auto* const it = std::find_if(kStrips.begin(), kStrips.end(),
                                        [&](const StripFigures& figures) { return figures.name == name; });
    return it == kStrips.end() ? nullptr : it;
}

std::optional<int> libnest2d_sheets(const std::string& name) {
    for (const auto& [bins, sheets] : kLibnest2dSheets) {
        if (bins == name) return sheets;
    }
    return std::nullopt;
}

}  // namespace popup::test
