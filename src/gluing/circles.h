// Orders under wants, and what to do where these run in a circle.
#pragma once

#include <map>
#include <set>
#include <vector>

namespace popup {

// Of each number, from 0, those that come before it. What runs in a circle is broken at its least number,
// which then comes first. Cost: near linear.
void break_circles(std::vector<std::set<int>>& before);
// All numbers in an order in which each comes after those; the least of several first. Precondition: there is
// no circle.
std::vector<int> grounds_first(const std::vector<std::set<int>>& before);

struct Wants {
    std::map<int, std::set<int>> must;   // of each those that come before it; no circle
    std::map<int, std::set<int>> wants;  // likewise, as far as it can be
};
// `by_rank` in the order in which they stand, but for what must be, and for all wants that are in no circle
// of musts and wants. Within a circle the one with the fewest open wants comes next; then each is moved, with
// what must stay on that side of it, where it meets more wants within 64 places. Cost: near linear.
std::vector<int> ordered(const std::vector<int>& by_rank, const Wants& wants);

}  // namespace popup
