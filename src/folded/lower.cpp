#include "folded/lower.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "assembly/folded_sheets.h"
#include "base/nth.h"
#include "folded/carton/names.h"

namespace popup::folded {
namespace {

constexpr double kAsLarge = 0.01;  // areas that differ by less are one
// A bottom is somewhat smaller than the top, by what the board takes from what is tucked in first.
constexpr double kAsLargeAsTop = 0.05;

// By piece; of areas that are equal but for rounding the first counts.
std::vector<int> largest_panels(const Sheet& sheet) {
    std::vector<int> found(sheet.cuts.size(), -1);
    std::vector<double> largest(sheet.cuts.size(), 0.0);
    for (std::size_t i = 0; i < sheet.panels.size(); ++i) {
        const double own = area(sheet.outline_of(sheet.panels[i]));
        const int piece = sheet.panels[i].piece;
        if (nth(found, piece) >= 0 && own <= nth(largest, piece) * (1.0 + 1e-9)) continue;
        nth(found, piece) = static_cast<int>(i);
        nth(largest, piece) = own;
    }
    return found;
}

// By piece: what a carton stands on, by the names of its panels; of others the largest.
std::vector<int> grounds(const Sheet& sheet, const std::vector<std::string>& names,
                         const std::vector<int>& largest) {
    const std::vector<std::vector<int>> folds = folds_by_panel(sheet);
    // Nothing stands on its top that has a bottom.
    const auto rank = [&](int panel) {
        return std::pair{nth(names, panel) != kTopName, nth(folds, panel).size()};
    };
    std::vector<int> found = largest;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto panel = static_cast<int>(i);
        const int piece = sheet.panels[i].piece;
        int& best = nth(found, piece);
        if (names[i].empty() || best < 0 || nth(names, best) == kBaseName) continue;
        const auto own = [&](int one) { return area(sheet.outline_of(nth(sheet.panels, one))); };
        const bool turned = names[i] == kBottomName && nth(names, best) == kTopName;
        const bool as_large =
            own(panel) >= own(nth(largest, piece)) * (1.0 - (turned ? kAsLargeAsTop : kAsLarge));
        if (names[i] == kBaseName || (as_large && rank(panel) > rank(best))) best = panel;
    }
    return found;
}

Tree tree_from(const std::vector<int>& roots, const Sheet& sheet) {
    const std::vector<std::vector<int>> folds = folds_by_panel(sheet);
    Tree tree;
    tree.fold_of.assign(sheet.panels.size(), -1);
    tree.plate_of.assign(sheet.panels.size(), -1);
    for (const int first : roots) {
        if (first < 0) continue;
        std::size_t done = tree.order.size();
        nth(tree.plate_of, first) = static_cast<int>(tree.order.size());
        tree.order.push_back(first);
        for (; done < tree.order.size(); ++done) {
            const int panel = tree.order[done];
            for (const int number : nth(folds, panel)) {
                const Fold& fold = nth(sheet.folds, number);
                const int other = fold.left == panel ? fold.right : fold.left;
                if (nth(tree.plate_of, other) >= 0) continue;
                nth(tree.plate_of, other) = static_cast<int>(tree.order.size());
                nth(tree.fold_of, other) = number;
                tree.order.push_back(other);
            }
        }
    }
    return tree;
}

}  // namespace

std::vector<std::vector<int>> folds_by_panel(const Sheet& sheet) {
    std::vector<std::vector<int>> folds(sheet.panels.size());
    for (std::size_t i = 0; i < sheet.folds.size(); ++i) {
        nth(folds, sheet.folds[i].left).push_back(static_cast<int>(i));
        nth(folds, sheet.folds[i].right).push_back(static_cast<int>(i));
    }
    return folds;
}

Tree make_tree(const CreasePattern& pattern, const Sheet& sheet) {
    const std::vector<int> largest = largest_panels(sheet);
    const Tree tree = tree_from(largest, sheet);
    const std::vector<int> roots = grounds(sheet, name_panels(pattern, sheet, tree), largest);
    return roots == largest ? tree : tree_from(roots, sheet);
}

Assembly assembly_of_panels(const CreasePattern& pattern, const Sheet& sheet, const Tree& tree) {
    Assembly out;
    out.file = pattern.file;
    out.stem = pattern.stem;
    out.curves = pattern.curves;
    for (std::size_t i = 0; i < sheet.cuts.size(); ++i) {
        Piece piece;
        piece.name = sheet.cuts.size() == 1 ? "sheet" : fmt::format("sheet-{}", i + 1);
        out.pieces.push_back(std::move(piece));
        for (const Stretch cut : sheet.cuts[i])
            out.lines.push_back({LineKind::cut, sheet.segment(cut), static_cast<int>(i), -1, -1});
    }
    const std::vector<std::string> names = name_panels(pattern, sheet, tree);
    std::vector<int> numbers(out.pieces.size(), 0);
    for (std::size_t i = 0; i < tree.order.size(); ++i) {
        const Panel& from = nth(sheet.panels, tree.order[i]);
        Plate plate;
        plate.piece = from.piece;
        const int number = ++nth(numbers, from.piece);
        const std::string& guessed = nth(names, tree.order[i]);
        plate.name = fmt::format("{}/{}", nth(out.pieces, from.piece).name,
                                 guessed.empty() ? std::to_string(number) : guessed);
        plate.outline = sheet.outline_of(from);
        plate.uncut = plate.outline.outer;
        nth(out.pieces, from.piece).plates.push_back(static_cast<int>(i));
        out.plates.push_back(std::move(plate));
    }
    return out;
}

}  // namespace popup::folded
