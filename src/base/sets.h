// Sets of numbers that are united.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace popup {

//     Sets sets(3);
//     sets.unite(2, 1);  // true: they were two
//     sets.find(2);      // 1: the least of its set stands for it
class Sets {
 public:
    // Each of 0 to count - 1 is a set of its own.
    explicit Sets(std::size_t count) : of_(count) { std::iota(of_.begin(), of_.end(), 0); }
    int find(int one) {
        while (at(one) != one) one = at(one) = at(at(one));
        return one;
    }
    // False: they are in one set already.
    bool unite(int a, int b) {
        a = find(a);
        b = find(b);
        at(std::max(a, b)) = std::min(a, b);
        return a != b;
    }

 private:
    int& at(int number) { return of_[static_cast<std::size_t>(number)]; }
    std::vector<int> of_;
};

}  // namespace popup
