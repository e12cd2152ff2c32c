#include "motion/opening_order.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string_view>
#include <variant>

#include "assembly/folded_sheets.h"
#include "base/nth.h"
#include "popup/joints.h"

namespace popup {
namespace {

constexpr double kAsMuch = 1e-6;    // of the area: parts that differ by less move as much
constexpr double kHemDeg = 170.0;   // what is folded further closes nothing
constexpr double kParallel = 1e-3;  // sine of the angle between lines that are called parallel

BoxPart part_called(std::string_view name) {
    name.remove_prefix(name.rfind('/') + 1);  // none: 0
    name = name.substr(0, name.find('-'));
    return name == kLidName || name == kTopName ? BoxPart::lid
           : name == kBottomName                ? BoxPart::bottom
                                                : BoxPart::walls;
}

const Folded* single_fold(const Assembly& assembly, const OrderedPart& part) {
    return part.joints.size() == 1 ? std::get_if<Folded>(&nth(assembly.joints, part.joints.front()).how)
                                   : nullptr;
}

// By the line that each of some parts turns about: of parallel ones the number of the first. What turns about
// several has a number of its own.
std::vector<std::size_t> ways_of(const Assembly& assembly, std::span<const OrderedPart> parts,
                                 std::span<const Frame> closed, std::span<const int> group) {
    std::vector<std::optional<Vec3>> lines;
    std::vector<std::size_t> ways(parts.size(), 0);
    for (std::size_t i = 0; i < group.size(); ++i) {
        const Folded* const fold = single_fold(assembly, nth(parts, group[i]));
        std::optional<Vec3>& line = lines.emplace_back();
        std::size_t way = i;
        if (fold != nullptr) {
            const Frame& base = nth(closed, fold->base);
            line = base.point(fold->dir) - base.origin;
            for (std::size_t k = 0; k < i && way == i; ++k) {
                if (lines[k] &&
                    length(cross(*lines[k], *line)) <= kParallel * length(*lines[k]) * length(*line))
                    way = k;
            }
        }
        nth(ways, group[i]) = way;
    }
    return ways;
}

}  // namespace

OfBox of_box(const Assembly& assembly, const OrderedPart& part) {
    OfBox found;
    for (const int joint : part.joints) {
        const auto* const fold = std::get_if<Folded>(&nth(assembly.joints, joint).how);
        if (fold == nullptr || std::abs(fold->law.front().y) > kHemDeg) continue;
        // The lid may be the panel that stays, on which all the others hang.
        const BoxPart plate = part_called(nth(assembly.plates, fold->plate).name);
        const BoxPart base = part_called(nth(assembly.plates, fold->base).name);
        const OfBox one{std::max(plate, base), plate != base};
        if (one.part > found.part) found = one;
        if (one.part == found.part) found.closes = found.closes || one.closes;
    }
    return found;
}

std::vector<std::vector<int>> rolled_over_by(const Assembly& assembly, std::span<const OrderedPart> parts) {
    const auto name_of = [&](std::size_t part) -> std::string_view {
        const Folded* const fold = single_fold(assembly, parts[part]);
        return fold == nullptr ? std::string_view() : nth(assembly.plates, fold->plate).name;
    };
    std::vector<std::size_t> linings;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (name_of(i).ends_with(kLining)) linings.push_back(i);
    }
    std::vector<std::vector<int>> over(parts.size());
    if (linings.empty()) return over;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (const std::size_t lining : linings) {
            if (is_rolled_over(name_of(i), name_of(lining))) over[i].push_back(static_cast<int>(lining));
        }
    }
    return over;
}

std::vector<int> opening_order(const Assembly& assembly, std::span<const OrderedPart> parts,
                               std::span<const Frame> closed, OpenFirst first) {
    std::vector<int> order(parts.size());
    std::iota(order.begin(), order.end(), 0);
    const auto area_of = [&](int part) { return nth(parts, part).area; };
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return first == OpenFirst::large ? area_of(a) > area_of(b) : area_of(a) < area_of(b);
    });
    for (std::size_t begin = 0; begin < order.size();) {
        std::size_t end = begin + 1;
        while (end < order.size() &&
               std::abs(area_of(order[end]) - area_of(order[begin])) <= kAsMuch * area_of(order[begin]))
            ++end;
        const std::span<int> group(order.data() + begin, end - begin);
        std::sort(group.begin(), group.end());
        const std::vector<std::size_t> ways = ways_of(assembly, parts, closed, group);
        std::stable_sort(group.begin(), group.end(),
                         [&](int a, int b) { return nth(ways, a) < nth(ways, b); });
        begin = end;
    }
    if (first == OpenFirst::lids) {
        std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
            return of_box(assembly, nth(parts, a)).part > of_box(assembly, nth(parts, b)).part;
        });
    }
    return order;
}

}  // namespace popup
