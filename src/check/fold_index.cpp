#include "check/fold_index.h"

#include <algorithm>
#include <cmath>

namespace popup {

Vec2 RigidMove::apply(Vec2 p) const {
    if (identity) return p;
    const Vec2 q = p - from;
    return to + Vec2{c * q.x - s * q.y, s * q.x + c * q.y};
}

Vec2 RigidMove::undone(Vec2 p) const {
    if (identity) return p;
    const Vec2 q = p - to;
    return from + Vec2{c * q.x + s * q.y, c * q.y - s * q.x};
}

RigidMove move_of(const Segment& before, const Segment& after) {
    const Vec2 u = before.b - before.a;
    const Vec2 v = after.b - after.a;
    const double size = length(u) * length(v);
    RigidMove move{false, before.a, after.a, 1.0, 0.0};
    if (size > 0.0) {
        move.c = dot(u, v) / size;
        move.s = cross(u, v) / size;
    }
    return move;
}

int FoldIndex::insert(int page, const Segment& line, Entry entry) {
    while (pages_.size() <= static_cast<std::size_t>(page)) pages_.emplace_back();
    PageFolds& folds = pages_[static_cast<std::size_t>(page)];
    folds.lines.insert(line, false);
    folds.entries.push_back(entry);
    return folds.lines.size() - 1;
}

void FoldIndex::add(int fold, const Fold& exact, const FoldLine& authored, bool ghost, double rounding_mm) {
    const auto moved = [](const Segment& a, const Segment& b) {
        return std::max(distance(a.a, b.a), distance(a.b, b.b));
    };
    const bool has_moved = std::max(moved(authored.on_left, exact.on_left),
                                    moved(authored.on_right, exact.on_right)) > rounding_mm;
    struct Numbers {
        int left = -1, right = -1;
    };
    const auto put = [&](const FoldLine& line, const RigidMove& left, const RigidMove& right,
                         const Numbers& twins) {
        Numbers made;
        made.left = insert(exact.left_page, line.on_left, {fold, ghost, false, left, right, twins.left});
        if (exact.seam)
            made.right =
                insert(exact.right_page, line.on_right, {fold, ghost, true, left, right, twins.right});
        return made;
    };
    const Numbers is = put({exact.on_left, exact.on_right}, {}, {}, {});
    if (!has_moved) return;
    const Numbers was = put(authored, move_of(authored.on_left, exact.on_left),
                            move_of(authored.on_right, exact.on_right), is);
    const auto entry = [this](int page, int number) -> Entry& {
        return pages_[static_cast<std::size_t>(page)].entries[static_cast<std::size_t>(number)];
    };
    entry(exact.left_page, is.left).twin = was.left;
    if (exact.seam) entry(exact.right_page, is.right).twin = was.right;
}

// How a line lies to the one that is given.
struct FoldIndex::Beside {
    double off = 0.0;
    bool reversed = false;
};

// nullopt: it is no line that may be meant.
std::optional<FoldIndex::Beside> FoldIndex::beside(const Segment& line, Vec2 begin, Vec2 end, double reach) {
    const Vec2 dir = unit(end - begin);
    const double size = distance(begin, end);
    const double along = distance(line.a, line.b);
    if (along <= 0.0) return std::nullopt;
    // Compare where both are: on the stretch of the given line that lies beside the fold.
    const double ta = dot(dir, line.a - begin);
    const double tb = dot(dir, line.b - begin);
    const double lo = std::max(0.0, std::min(ta, tb));
    const double hi = std::min(size, std::max(ta, tb));
    if (lo > hi + reach) return std::nullopt;
    const auto off_at = [&](double t) {
        return std::abs(cross(line.b - line.a, begin + t * dir - line.a)) / along;
    };
    const double off = std::max(off_at(lo), off_at(std::max(lo, hi)));
    if (off > reach || std::abs(cross(dir, line.b - line.a)) > 0.3 * along) return std::nullopt;
    return Beside{off, tb < ta};
}

std::vector<FoldMatch> FoldIndex::matches(int page, Vec2 begin, Vec2 end, const Box& place,
                                          double reach) const {
    std::vector<FoldMatch> result;
    if (page < 0 || static_cast<std::size_t>(page) >= pages_.size()) return result;
    const PageFolds& folds = pages_[static_cast<std::size_t>(page)];
    const auto step = [](double off) { return std::floor(off / 0.02); };
    std::vector<int> found;
    folds.lines.query({place.min - Vec2{reach, reach}, place.max + Vec2{reach, reach}}, found);
    for (const int number : found) {
        const auto lies = beside(folds.lines[number], begin, end, reach);
        if (!lies) continue;
        const Entry& entry = folds.entries[static_cast<std::size_t>(number)];
        if (entry.twin >= 0) {
            // Else an element would stand on another place of one fold as it is moved along it.
            const auto twin = beside(folds.lines[entry.twin], begin, end, reach);
            if (twin && step(twin->off) < step(lies->off)) continue;
        }
        FoldMatch match;
        match.fold = entry.fold;
        match.ghost = entry.ghost;
        match.right_page = entry.right_page;
        match.reversed = lies->reversed;
        match.off = lies->off;
        match.left = entry.left;
        match.right = entry.right;
        result.push_back(match);
    }
    // An author's own place of a fold counts before the one a repair gave it; of equals the youngest lies on
    // top.
    std::reverse(result.begin(), result.end());
    std::stable_sort(result.begin(), result.end(),
                     [step](const FoldMatch& a, const FoldMatch& b) { return step(a.off) < step(b.off); });
    return result;
}

std::optional<FoldMatch> FoldIndex::moved_from(int page, Vec2 begin, Vec2 end, double reach,
                                               const std::function<bool(int)>& suits) const {
    if (page < 0 || static_cast<std::size_t>(page) >= pages_.size()) return std::nullopt;
    constexpr double kSameLengthMm = 2e-3;
    constexpr double kClearlyNearer = 1.5;
    const PageFolds& folds = pages_[static_cast<std::size_t>(page)];
    Box place;
    place.extend(begin);
    place.extend(end);
    std::vector<int> found;
    folds.lines.query({place.min - Vec2{reach, reach}, place.max + Vec2{reach, reach}}, found);
    std::optional<FoldMatch> best;
    double second = HUGE_VAL;
    for (const int number : found) {
        const Segment& line = folds.lines[number];
        const double size = distance(begin, end);
        if (std::abs(distance(line.a, line.b) - size) > kSameLengthMm) continue;
        const bool reversed = dot(line.b - line.a, end - begin) < 0.0;
        const Segment along = reversed ? Segment{line.b, line.a} : line;
        if (std::abs(cross(along.b - along.a, end - begin)) > 0.3 * size * size) continue;
        const double off = std::max(distance(along.a, begin), distance(along.b, end));
        const Entry& entry = folds.entries[static_cast<std::size_t>(number)];
        if (off > reach || !entry.left.identity || !entry.right.identity) continue;
        if (entry.ghost || !suits(entry.fold)) continue;
        if (best && off >= best->off) {
            if (entry.fold != best->fold) second = std::min(second, off);
            continue;
        }
        if (best && entry.fold != best->fold) second = best->off;
        best.emplace();
        best->fold = entry.fold;
        best->right_page = entry.right_page;
        best->reversed = reversed;
        best->off = off;
        best->left = best->right = move_of({begin, end}, along);
    }
    if (!best || second < kClearlyNearer * best->off) return std::nullopt;
    return best;
}

std::vector<FoldMatch> FoldIndex::crossed(int page, const Box& box) const {
    std::vector<FoldMatch> result;
    if (page < 0 || static_cast<std::size_t>(page) >= pages_.size() || box.empty()) return result;
    const PageFolds& folds = pages_[static_cast<std::size_t>(page)];
    std::vector<int> found;
    folds.lines.query(box, found);
    for (const int number : found) {
        const Entry& entry = folds.entries[static_cast<std::size_t>(number)];
        FoldMatch match;
        match.fold = entry.fold;
        match.ghost = entry.ghost;
        match.right_page = entry.right_page;
        match.left = entry.left;
        match.right = entry.right;
        result.push_back(match);
    }
    std::reverse(result.begin(), result.end());
    return result;
}

std::optional<FoldIndex::Nearest> FoldIndex::nearest(int page, Vec2 begin, Vec2 end, double limit) const {
    if (page < 0 || static_cast<std::size_t>(page) >= pages_.size()) return std::nullopt;
    const PageFolds& folds = pages_[static_cast<std::size_t>(page)];
    const Vec2 middle = 0.5 * (begin + end);
    const double reach = folds.lines.clearance(middle, limit);
    if (reach >= limit) return std::nullopt;
    const double around = reach + 1e-6;
    std::vector<int> found;
    folds.lines.query({middle - Vec2{around, around}, middle + Vec2{around, around}}, found);
    std::optional<Nearest> best;
    for (const int number : found) {
        const double off = distance(middle, folds.lines[number]);
        const Entry& entry = folds.entries[static_cast<std::size_t>(number)];
        if (!best || off < best->distance) best = Nearest{entry.fold, entry.ghost, off};
    }
    return best;
}

}  // namespace popup
