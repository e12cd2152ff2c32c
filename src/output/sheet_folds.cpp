#include "output/sheet_folds.h"

#include <algorithm>
#include <utility>

#include "fabrication/broken_score.h"

namespace popup {
namespace {

// The lines of an operation, by their numbers in the piece, and the folds that they are.
struct Folds {
    std::vector<std::size_t> numbers;
    std::vector<Segment> at;
    std::vector<std::vector<FoldWay>> ways;
};

bool is_alike(const PatternLine& a, const PatternLine& b) {
    return a.plate == b.plate && a.fold_angle == b.fold_angle;
}

Folds find_folds(const PatternPiece& piece, Operation operation, const Profile& profile) {
    Folds folds;
    for (std::size_t i = 0; i < piece.lines.size(); ++i) {
        const PatternLine& line = piece.lines[i];
        if (line.kind == LineKind::mark || operation_of(line, profile) != operation) continue;
        folds.numbers.push_back(i);
        folds.at.push_back(line.at);
    }
    const auto line_of = [&](const FoldWay& way) -> const PatternLine& {
        return piece.lines[folds.numbers[way.line]];
    };
    for (std::vector<FoldWay>& whole : folds_of(folds.at)) {
        if (profile.machine_order || profile.perforates(operation)) {
            folds.ways.push_back(std::move(whole));
            continue;
        }
        for (std::size_t i = 0; i < whole.size(); ++i) {
            if (i == 0 || !is_alike(line_of(whole[i - 1]), line_of(whole[i]))) folds.ways.emplace_back();
            folds.ways.back().push_back(whole[i]);
        }
    }
    // A line by itself runs as it is given.
    for (std::vector<FoldWay>& ways : folds.ways) {
        if (ways.size() == 1) ways.front().back = false;
    }
    return folds;
}

FoldToDraw fold_of(const PatternPiece& piece, const Folds& folds, const std::vector<FoldWay>& ways) {
    const auto number = [&](const FoldWay& way) { return folds.numbers[way.line]; };
    const PatternLine& front = piece.lines[number(ways.front())];
    FoldToDraw made{{}, number(ways.front()), front.plate, front.fold_angle};
    for (const FoldWay& way : ways) {
        const PatternLine& line = piece.lines[number(way)];
        if (made.points.empty()) made.points.push_back(way.back ? line.at.b : line.at.a);
        made.points.push_back(way.back ? line.at.a : line.at.b);
        made.first = std::min(made.first, number(way));
        if (line.plate != front.plate) made.plate = -1;
        if (line.fold_angle != front.fold_angle) made.fold_angle.reset();
    }
    return made;
}

void sort(std::vector<FoldToDraw>& folds) {
    std::sort(folds.begin(), folds.end(),
              [](const FoldToDraw& a, const FoldToDraw& b) { return a.first < b.first; });
}

}  // namespace

std::vector<FoldToDraw> folds_to_draw(const PatternPiece& piece, Operation operation,
                                      const Profile& profile) {
    const Folds folds = find_folds(piece, operation, profile);
    std::vector<FoldToDraw> all;
    all.reserve(folds.ways.size());
    for (const std::vector<FoldWay>& ways : folds.ways) all.push_back(fold_of(piece, folds, ways));
    sort(all);
    return all;
}

std::vector<FoldToDraw> broken_folds(const PatternPiece& piece, Operation operation, const Profile& profile) {
    const Folds folds = find_folds(piece, operation, profile);
    const std::vector<FoldPart> parts = parts_of_folds(folds.at);
    std::vector<FoldToDraw> all;
    for (const std::vector<FoldWay>& ways : folds.ways) {
        FoldToDraw& made = all.emplace_back(fold_of(piece, folds, ways));
        for (const FoldWay& way : ways) {
            for (const Segment& scored : broken_score(folds.at[way.line], parts[way.line])) {
                const bool goes_on = !made.parts.empty() && made.parts.back().back() == scored.a;
                if (!goes_on) made.parts.push_back({scored.a});
                made.parts.back().push_back(scored.b);
            }
        }
        if (made.parts.empty()) all.pop_back();
    }
    sort(all);
    return all;
}

}  // namespace popup
