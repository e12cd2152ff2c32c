#include "folded/sparse_factors.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/nth.h"
#include "folded/two.h"

namespace popup::folded {
namespace {

// A block takes in the next column, whose rows are not quite its own, while no more than this share of its
// entries is nought, or so few columns are in it.
constexpr double kNought = 0.2;
constexpr double kNarrow = 4.0;
// Columns that are taken from others together: more do not stay in registers.
constexpr std::size_t kTogether = 4;

// Of a triangle's columns, each from the diagonal on and behind the one before it: how many entries those
// before this one have.
std::size_t packed(std::size_t size, std::size_t column) { return column * size - column * (column - 1) / 2; }
std::size_t packed(std::size_t size) { return size * (size + 1) / 2; }

// A block's columns, and beside them what it adds to those after it: a triangle of as many columns as it has
// rows below. Of its own columns too the part from the diagonal on is looked at.
struct Front {
    double* values = nullptr;
    double* added = nullptr;
    std::size_t width = 0, height = 0;

    // With row i at [i].
    [[nodiscard]] double* column(std::size_t i) const {
        return i < width ? values + i * height : added + packed(height - width, i - width) - i;
    }
};

void zero(double* begin, std::size_t count) {
    std::size_t i = 0;
    for (; i + 2 <= count; i += 2) store(begin + i, Two{});
    if (i < count) begin[i] = 0.0;
}

// Columns of a block that lie side by side, and what they are multiplied with before they are taken from
// another.
template <std::size_t Count>
struct Taken {
    const double* columns;
    std::size_t height;
    double by[Count];

    Taken(const Front& front, std::size_t first, const double* pivots, std::size_t row)
        : columns(front.column(first)), height(front.height) {
        for (std::size_t k = 0; k < Count; ++k) by[k] = columns[k * height + row] * pivots[k];
    }
    [[nodiscard]] double at(std::size_t row) const {
        double sum = columns[row] * by[0];
        for (std::size_t k = 1; k < Count; ++k) sum += columns[k * height + row] * by[k];
        return sum;
    }
    [[nodiscard]] Two two_at(std::size_t row) const {
        Two sum = load(columns + row) * by[0];
        for (std::size_t k = 1; k < Count; ++k) sum += load(columns + k * height + row) * by[k];
        return sum;
    }
};

// From the row `from` on.
template <std::size_t Count>
void subtract(double* to, const Taken<Count>& taken, std::size_t from) {
    std::size_t i = from;
    for (; i + 2 <= taken.height; i += 2) store(to + i, load(to + i) - taken.two_at(i));
    if (i < taken.height) to[i] -= taken.at(i);
}

template <std::size_t Count>
void subtract_two(double* one, double* two, const Taken<Count>& of_one, const Taken<Count>& of_two,
                  std::size_t from) {
    const double* column[Count];
    for (std::size_t k = 0; k < Count; ++k) column[k] = of_one.columns + k * of_one.height;
    std::size_t i = from;
    for (; i + 2 <= of_one.height; i += 2) {
        const Two first = load(column[0] + i);
        Two by_one = first * of_one.by[0];
        Two by_two = first * of_two.by[0];
        for (std::size_t k = 1; k < Count; ++k) {
            const Two next = load(column[k] + i);
            by_one += next * of_one.by[k];
            by_two += next * of_two.by[k];
        }
        store(one + i, load(one + i) - by_one);
        store(two + i, load(two + i) - by_two);
    }
    if (i < of_one.height) {
        one[i] -= of_one.at(i);
        two[i] -= of_two.at(i);
    }
}

// Makes factors of `Count` columns, and takes what they add from all after them.
template <std::size_t Count>
bool eliminate(const Front& front, std::size_t first) {
    double pivots[kTogether];
    for (std::size_t k = 0; k < Count; ++k) {
        double* const own = front.column(first + k);
        if constexpr (Count > 1) {
            if (k == 1) subtract(own, Taken<1>(front, first, pivots, first + 1), first + 1);
        }
        if constexpr (Count > 2) {
            if (k == 2) subtract(own, Taken<2>(front, first, pivots, first + 2), first + 2);
        }
        if constexpr (Count > 3) {
            if (k == 3) subtract(own, Taken<3>(front, first, pivots, first + 3), first + 3);
        }
        pivots[k] = own[first + k];
        if (pivots[k] == 0.0) return false;
        for (std::size_t i = first + k + 1; i < front.height; ++i) own[i] /= pivots[k];
    }
    std::size_t i = first + Count;
    for (; i + 1 < front.height; i += 2) {
        const Taken<Count> of_one(front, first, pivots, i);
        double* const one = front.column(i);
        one[i] -= of_one.at(i);
        subtract_two(one, front.column(i + 1), of_one, Taken<Count>(front, first, pivots, i + 1), i + 1);
    }
    if (i < front.height) subtract(front.column(i), Taken<Count>(front, first, pivots, i), i);
    return true;
}

// A block's columns, as far as they are its own.
struct Columns {
    const double* values = nullptr;
    std::size_t width = 0, height = 0;

    [[nodiscard]] const double* at(std::size_t k) const { return values + k * height; }

    // Visits four columns at a time, and at the end those that are left.
    template <typename Visit>
    void by_fours(const Visit& visit) const {
        std::size_t k = 0;
        for (; k + kTogether <= width; k += kTogether) visit.template operator()<kTogether>(k);
        if (width - k == 3) visit.template operator()<3>(k);
        if (width - k == 2) visit.template operator()<2>(k);
        if (width - k == 1) visit.template operator()<1>(k);
    }
    // Adds columns times what is found in them to the sums of the rows below.
    template <std::size_t Count>
    void add(std::size_t first, const double* found, double* sums) const {
        const double* const below = at(first) + width;
        const std::size_t count = height - width;
        double by[Count];
        for (std::size_t k = 0; k < Count; ++k) by[k] = found[first + k];
        std::size_t i = 0;
        for (; i + 2 <= count; i += 2) {
            Two sum = load(below + i) * by[0];
            for (std::size_t k = 1; k < Count; ++k) sum += load(below + k * height + i) * by[k];
            store(sums + i, load(sums + i) + sum);
        }
        if (i < count) {
            double sum = below[i] * by[0];
            for (std::size_t k = 1; k < Count; ++k) sum += below[k * height + i] * by[k];
            sums[i] += sum;
        }
    }
    // Takes from columns what is found in the rows below: those of even number and those of odd summed on
    // their own.
    template <std::size_t Count>
    void take(std::size_t first, const double* found, double* from) const {
        const double* const below = at(first) + width;
        const std::size_t count = height - width;
        Two sums[Count] = {};
        std::size_t i = 0;
        for (; i + 2 <= count; i += 2) {
            const Two here = load(found + i);
            for (std::size_t k = 0; k < Count; ++k) sums[k] += load(below + k * height + i) * here;
        }
        for (std::size_t k = 0; k < Count; ++k) {
            double sum = sums[k][0] + sums[k][1];
            if (i < count) sum += below[k * height + i] * found[i];
            from[first + k] -= sum;
        }
    }
};

// By place: the first place after it that it adds to, -1 for none; `above`: by place, those before it that it
// has an entry with (Liu, The role of elimination trees in sparse factorization, 1990).
std::vector<int> elimination_tree(const std::vector<std::vector<int>>& above) {
    std::vector<int> parent(above.size(), -1);
    std::vector<int> leads(above.size(), -1);  // a shorter way up
    for (std::size_t i = 0; i < above.size(); ++i) {
        const int here = static_cast<int>(i);
        for (int at : above[i]) {
            while (at != here) {
                const int next = nth(leads, at);
                nth(leads, at) = here;
                if (next < 0) nth(parent, at) = here;
                if (next < 0) break;
                at = next;
            }
        }
    }
    return parent;
}

// The places in an order in which each follows all that add to it, one branch after the other.
std::vector<int> branch_by_branch(const std::vector<int>& parent) {
    const std::size_t count = parent.size();
    std::vector<int> first(count + 1, -1);  // child; of the last: the roots
    std::vector<int> next(count, -1);
    for (std::size_t i = count; i-- > 0;) {
        int& of = parent[i] < 0 ? first[count] : nth(first, parent[i]);
        next[i] = of;
        of = static_cast<int>(i);
    }
    std::vector<int> order;
    order.reserve(count);
    std::vector<int> open;
    for (int root = first[count]; root >= 0; root = nth(next, root)) {
        open.push_back(root);
        while (!open.empty()) {
            int& child = nth(first, open.back());
            if (child < 0) {
                order.push_back(open.back());
                open.pop_back();
                continue;
            }
            open.push_back(child);
            child = nth(next, child);
        }
    }
    return order;
}

std::vector<std::vector<int>> entries_above(const SparseFactors::Matrix& matrix,
                                            const std::vector<int>& place) {
    std::vector<std::vector<int>> above(place.size());
    for (int j = 0; j < static_cast<int>(place.size()); ++j) {
        for (SparseFactors::Matrix::InnerIterator at(matrix, j); at; ++at) {
            if (at.row() >= j) continue;
            const int a = nth(place, at.row());
            const int b = nth(place, j);
            nth(above, std::max(a, b)).push_back(std::min(a, b));
        }
    }
    return above;
}

}  // namespace

void SparseFactors::analyse(const Matrix& matrix, const std::vector<int>& order) {
    const auto count = static_cast<std::size_t>(matrix.cols());
    place_ = order;
    if (place_.empty()) {
        for (std::size_t i = 0; i < count; ++i) place_.push_back(static_cast<int>(i));
    }
    const std::vector<int> onwards = branch_by_branch(elimination_tree(entries_above(matrix, place_)));
    std::vector<int> column(count);
    for (std::size_t i = 0; i < count; ++i) nth(column, onwards[i]) = static_cast<int>(i);
    for (int& place : place_) place = nth(column, place);
    const std::vector<std::vector<int>> above = entries_above(matrix, place_);
    const std::vector<int> parent = elimination_tree(above);
    find_blocks(above, parent);
    place_values(matrix);
    ordered_.resize(static_cast<Eigen::Index>(count));
    analysed_ = true;
}

// From the first column to the last: rows of each are those of the matrix, and of the blocks that add to it.
void SparseFactors::find_blocks(const std::vector<std::vector<int>>& above, const std::vector<int>& parent) {
    const std::size_t count = above.size();
    std::vector<std::vector<int>> below(count);  // entries of the matrix, by column
    for (std::size_t i = 0; i < count; ++i) {
        for (const int at : above[i]) nth(below, at).push_back(static_cast<int>(i));
    }
    std::vector<std::vector<int>> rows_of;      // by block
    std::vector<std::vector<int>> from(count);  // by column: blocks whose rows below begin with it
    std::vector<int> seen(count, -1);
    double nought = 0.0;  // entries of the last block
    for (std::size_t i = 0; i < count; ++i) {
        const int here = static_cast<int>(i);
        std::vector<int> rows;
        const auto take = [&](const std::vector<int>& more) {
            for (const int row : more) {
                if (row == here || nth(seen, row) == here) continue;
                nth(seen, row) = here;
                rows.push_back(row);
            }
        };
        take(below[i]);
        for (const int block : from[i]) take(nth(rows_of, block));
        std::sort(rows.begin(), rows.end());
        const auto entries = static_cast<double>(rows.size() + 1);
        entry_count_ += entries;
        steps_ += entries * entries;
        const double width = blocks_.empty() ? 0.0 : static_cast<double>(blocks_.back().width);
        const double more =
            i == 0 ? 0.0 : nought + width * (entries - static_cast<double>(rows_of.back().size()));
        const double all = (width + 1.0) * (0.5 * width + entries);
        if (i > 0 && parent[i - 1] == here && (more <= kNought * all || width + 1.0 <= kNarrow)) {
            nought = more;
        } else {
            blocks_.emplace_back();
            blocks_.back().first = i;
            rows_of.emplace_back();
            nought = 0.0;
        }
        ++blocks_.back().width;
        const int block = static_cast<int>(blocks_.size()) - 1;
        block_of_.push_back(block);
        if (!rows.empty()) nth(from, rows.front()).push_back(block);
        rows_of.back() = std::move(rows);
    }
    lay_out(rows_of);
}

void SparseFactors::lay_out(const std::vector<std::vector<int>>& rows_of) {
    std::size_t values = 0;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        Block& block = blocks_[i];
        block.below = rows_of[i].size();
        block.rows = rows_.size();
        block.values = values;
        values += block.width * block.height();
        rows_.insert(rows_.end(), rows_of[i].begin(), rows_of[i].end());
    }
    values_.resize(values);
    std::size_t height = 0;
    std::size_t depth = 0;
    std::size_t deepest = 0;
    for (Block& block : blocks_) {
        deepest = std::max(deepest, depth + packed(block.below));
        for (const std::size_t child : block.from) depth -= packed(blocks_[child].below);
        depth += packed(block.below);
        height = std::max(height, block.below);
        if (block.below == 0) continue;
        Block& next = nth(blocks_, nth(block_of_, nth(rows_, block.rows)));
        next.from.push_back(static_cast<std::size_t>(&block - blocks_.data()));
        for (std::size_t i = 0; i < block.below; ++i) at_next_.push_back(row_in(next, rows_[block.rows + i]));
    }
    added_.resize(deepest);
    sums_.resize(height);
}

std::size_t SparseFactors::row_in(const Block& block, int row) const {
    const auto number = static_cast<std::size_t>(row);
    if (number < block.first + block.width) return number - block.first;
    const auto begin = rows_.begin() + static_cast<std::ptrdiff_t>(block.rows);
    const auto end = begin + static_cast<std::ptrdiff_t>(block.below);
    return block.width + static_cast<std::size_t>(std::lower_bound(begin, end, row) - begin);
}

void SparseFactors::place_values(const Matrix& matrix) {
    const auto each = [&](const auto& visit) {
        std::size_t entry = 0;
        for (int j = 0; j < matrix.cols(); ++j) {
            for (Matrix::InnerIterator at(matrix, j); at; ++at, ++entry) {
                if (at.row() > j) continue;
                const int a = nth(place_, at.row());
                const int b = nth(place_, j);
                visit(entry, nth(blocks_, nth(block_of_, std::min(a, b))), std::min(a, b), std::max(a, b));
            }
        }
    };
    each([](std::size_t, Block& block, int, int) { ++block.entries_end; });
    std::size_t count = 0;
    for (Block& block : blocks_) {
        block.entries = count;
        count += block.entries_end;
        block.entries_end = block.entries;
    }
    entries_.resize(count);
    each([&](std::size_t entry, Block& block, int column, int row) {
        const std::size_t at = static_cast<std::size_t>(column) - block.first;
        entries_[block.entries_end++] = {static_cast<int>(entry),
                                         static_cast<int>(at * block.height() + row_in(block, row))};
    });
}

// Block by block, for what was written last is at hand.
void SparseFactors::take_entries(const Block& block, const double* entries) {
    double* const values = values_.data() + block.values;
    zero(values, block.width * block.height());
    for (std::size_t i = block.entries; i < block.entries_end; ++i)
        values[entries_[i].target] += entries[entries_[i].entry];
}

bool SparseFactors::factorise(const Matrix& matrix) {
    double* top = added_.data();
    for (const Block& block : blocks_) {
        take_entries(block, matrix.valuePtr());
        const Front front{values_.data() + block.values, top, block.width, block.height()};
        const Columns columns{front.values, front.width, front.height};
        zero(top, packed(block.below));
        // What was added last lies on top.
        double* lowest = top;
        for (std::size_t i = block.from.size(); i-- > 0;) {
            const Block& child = blocks_[block.from[i]];
            lowest -= packed(child.below);
            const std::size_t* const rows = at_next_.data() + child.rows;
            const double* more = lowest;
            for (std::size_t k = 0; k < child.below; ++k) {
                double* const to = front.column(rows[k]);
                for (std::size_t m = k; m < child.below; ++m) to[rows[m]] += *more++;
            }
        }
        bool done = true;
        columns.by_fours(
            [&]<std::size_t Count>(std::size_t k) { done = done && eliminate<Count>(front, k); });
        if (!done) return false;
        if (lowest != top) std::copy(top, top + packed(block.below), lowest);
        top = lowest + packed(block.below);
    }
    return true;
}

void SparseFactors::solve_onwards(const Block& block) {
    double* const own = ordered_.data() + block.first;
    const Columns columns{values_.data() + block.values, block.width, block.height()};
    for (std::size_t k = 0; k < block.width; ++k) {
        const double here = own[k];
        for (std::size_t i = k + 1; i < block.width; ++i) own[i] -= columns.at(k)[i] * here;
    }
    std::fill(sums_.begin(), sums_.begin() + static_cast<std::ptrdiff_t>(block.below), 0.0);
    columns.by_fours([&]<std::size_t Count>(std::size_t k) { columns.add<Count>(k, own, sums_.data()); });
    const int* const rows = rows_.data() + block.rows;
    for (std::size_t i = 0; i < block.below; ++i) ordered_[rows[i]] -= sums_[i];
}

void SparseFactors::solve_back(const Block& block) {
    double* const own = ordered_.data() + block.first;
    const Columns columns{values_.data() + block.values, block.width, block.height()};
    const int* const rows = rows_.data() + block.rows;
    for (std::size_t i = 0; i < block.below; ++i) sums_[i] = ordered_[rows[i]];
    for (std::size_t k = 0; k < block.width; ++k) own[k] /= columns.at(k)[k];
    columns.by_fours([&]<std::size_t Count>(std::size_t k) { columns.take<Count>(k, sums_.data(), own); });
    for (std::size_t k = block.width; k-- > 0;) {
        double here = own[k];
        for (std::size_t i = k + 1; i < block.width; ++i) here -= columns.at(k)[i] * own[i];
        own[k] = here;
    }
}

void SparseFactors::solve(Eigen::VectorXd& x) {
    for (Eigen::Index i = 0; i < x.size(); ++i) ordered_[nth(place_, i)] = x[i];
    for (const Block& block : blocks_) solve_onwards(block);
    for (std::size_t i = blocks_.size(); i-- > 0;) solve_back(blocks_[i]);
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = ordered_[nth(place_, i)];
}

}  // namespace popup::folded
