// Cells that hang together: union-find whose sets are known by their first member.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace popup {

// At most 2³² cells.
class CellSets {
 public:
    explicit CellSets(std::size_t count) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), 0U);
    }

    // The least member of the set that has `cell`.
    std::size_t first(std::size_t cell) {
        while (parents_[cell] != cell) {
            parents_[cell] = parents_[parents_[cell]];
            cell = parents_[cell];
        }
        return cell;
    }
    void join(std::size_t a, std::size_t b) {
        a = first(a);
        b = first(b);
        if (a < b) {
            parents_[b] = static_cast<std::uint32_t>(a);
        } else {
            parents_[a] = static_cast<std::uint32_t>(b);
        }
    }

 private:
    std::vector<std::uint32_t> parents_;
};

}  // namespace popup
