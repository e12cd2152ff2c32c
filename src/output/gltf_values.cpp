#include "output/gltf_values.h"

#include <cmath>

#include "base/text/numbers.h"

namespace popup {
namespace {

constexpr double kMetre = 1000.0;
constexpr int kLengthDecimals = 6;

}  // namespace

float metres(double mm) { return static_cast<float>(rounded(mm, kLengthDecimals) / kMetre); }

std::vector<double> metres(Vec3 mm) {
    return {rounded(mm.x, kLengthDecimals) / kMetre, rounded(mm.y, kLengthDecimals) / kMetre,
            rounded(mm.z, kLengthDecimals) / kMetre};
}

double linear(std::uint8_t channel) {
    const double s = channel / 255.0;
    return rounded(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4), 6);
}

std::string valid_utf8(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = [&](std::size_t k) {
            return k < text.size() ? static_cast<unsigned>(static_cast<unsigned char>(text[k])) : 0U;
        };
        const unsigned lead = byte(i);
        const std::size_t size = lead < 0x80                   ? 1
                                 : lead >= 0xC2 && lead < 0xE0 ? 2
                                 : lead >= 0xE0 && lead < 0xF0 ? 3
                                 : lead >= 0xF0 && lead < 0xF5 ? 4
                                                               : 0;
        bool good = size > 0 && i + size <= text.size();
        for (std::size_t k = 1; good && k < size; ++k) good = (byte(i + k) & 0xC0U) == 0x80U;
        // Neither overlong forms nor surrogates nor what lies beyond U+10FFFF.
        if (good && lead == 0xE0) good = byte(i + 1) >= 0xA0;
        if (good && lead == 0xED) good = byte(i + 1) < 0xA0;
        if (good && lead == 0xF0) good = byte(i + 1) >= 0x90;
        if (good && lead == 0xF4) good = byte(i + 1) < 0x90;
        result += good ? text.substr(i, size) : std::string_view("\xEF\xBF\xBD");
        i += good ? size : 1;
    }
    return result;
}

}  // namespace popup
