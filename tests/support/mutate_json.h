// JSON texts as nobody would write them, for tests of readers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "support/random.h"

namespace popup::test {

using Json = nlohmann::ordered_json;

// Bytes taken out, doubled, cut off, or made strange.
inline std::string mutated_bytes(std::string text, Random& random) {
    constexpr std::array<std::string_view, 16> kPieces{
        "{", "}", "[", "]", ",", ":", "\"", "null", "true", "1e99", "-0.0", "\\u0", "\0", "\xFF", "[[", "\n"};
    const std::size_t changes = 1 + random.below(4);
    for (std::size_t i = 0; i < changes && !text.empty(); ++i) {
        const std::size_t at = random.below(text.size());
        const std::size_t length = std::min(random.below(30), text.size() - at);
        switch (random.below(4)) {
            case 0:
                text.erase(at, length);
                break;
            case 1:
                text.insert(random.below(text.size() + 1), text.substr(at, length));
                break;
            case 2:
                text.resize(at);
                break;
            default:
                text.replace(at, length, kPieces.at(random.below(kPieces.size())));
        }
    }
    return text;
}

// All values of a document.
inline void collect(Json& value, std::vector<Json*>& all) {
    all.push_back(&value);
    if (!value.is_structured()) return;
    for (Json& inside : value) collect(inside, all);
}

// Still JSON: values exchanged, taken out, doubled, or made strange.
inline std::string mutated_values(const std::string& text, Random& random) {
    Json whole = Json::parse(text);
    const std::size_t changes = 1 + random.below(6);
    for (std::size_t i = 0; i < changes; ++i) {
        std::vector<Json*> all;
        collect(whole, all);
        Json& one = *all[random.below(all.size())];
        const Json other = *all[random.below(all.size())];
        constexpr std::array<double, 14> kNumbers{0.0, 1.0,  -1.0,    2.0,   1e-12, 1e6,  1e300,
                                                  0.1, -0.0, -1e-300, -50.0, 20.0,  30.0, 20.0000004};
        switch (random.below(7)) {
            case 0:
                one = other;
                break;
            case 1:
                if (one.is_array() && !one.empty()) one.erase(random.below(one.size()));
                break;
            case 2:
                if (one.is_array() && !one.empty()) one.push_back(one[random.below(one.size())]);
                break;
            case 3:
                if (one.is_array()) std::reverse(one.begin(), one.end());
                break;
            default:
                if (one.is_number()) {
                    const double value = one.get<double>();
                    one = random.below(2) == 0
                              ? kNumbers.at(random.below(kNumbers.size()))
                              : value + (random.unit() - 0.5) * std::pow(10.0, -8.0 * random.unit() + 2.0);
                }
        }
    }
    return whole.dump();
}

}  // namespace popup::test
