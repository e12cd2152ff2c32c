// What is printed, sorted by kinds, for tests.
#pragma once

#include <variant>
#include <vector>

#include "popup/pattern.h"
#include "popup/print.h"

namespace popup::test {

// Those of a kind, in their order.
template <typename T>
std::vector<T> prints_of(const std::vector<Print>& prints) {
    std::vector<T> found;
    for (const Print& print : prints) {
        if (const T* one = std::get_if<T>(&print)) found.push_back(*one);
    }
    return found;
}

template <typename T>
struct OnPlate {
    T print;
    int plate = -1;
};
template <typename T>
std::vector<OnPlate<T>> prints_of(const std::vector<PatternPrint>& prints) {
    std::vector<OnPlate<T>> found;
    for (const PatternPrint& print : prints) {
        if (const T* one = std::get_if<T>(&print.print)) found.push_back({*one, print.plate});
    }
    return found;
}

}  // namespace popup::test
