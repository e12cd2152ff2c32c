// Random numbers for generated inputs: splitmix64, the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>

namespace popup::test {

class Random {
 public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    // 0 to n - 1; 0 for n = 0.
    std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(next() % n); }
    double unit() { return static_cast<double>(next() >> 11U) * 0x1p-53; }  // [0, 1)

 private:
    std::uint64_t next() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
        z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31U);
    }
    std::uint64_t state_;
};

}  // namespace popup::test
