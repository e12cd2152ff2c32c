// Where paper is thin. Each cell knows how far it is from the ground. Where the cells of a shape are put in
// from the farthest to the nearest, its wide parts appear first, and a neck is the cell that joins two of
// them: it is the widest way from one to the other.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "trace/cell_sets.h"
#include "trace/cells.h"

namespace popup {
namespace {

// The square of the distance to the nearest cell of the ground, in columns and then in rows: A. Meijster,
// J. Roerdink, W. Hesselink, "A general algorithm for computing distance transforms in linear time" (2000).
class Distances {
 public:
    explicit Distances(const CellGrid& cells) : cells_(cells), squares_(cells.inside.size()) {
        for (int x = 0; x < cells.width; ++x) column(x);
        for (int y = 0; y < cells.height; ++y) row(y);
    }
    [[nodiscard]] std::int64_t operator[](std::size_t i) const { return squares_[i]; }

 private:
    void column(int x) {
        std::int64_t steps = 0;
        for (int y = 0; y < cells_.height; ++y) {
            const std::size_t i = cells_.at(x, y);
            steps = cells_.inside[i] != 0 ? steps + 1 : 0;
            squares_[i] = static_cast<std::int32_t>(steps);
        }
        steps = 0;
        for (int y = cells_.height; y-- > 0;) {
            const std::size_t i = cells_.at(x, y);
            steps = cells_.inside[i] != 0 ? steps + 1 : 0;
            squares_[i] = static_cast<std::int32_t>(std::min<std::int64_t>(squares_[i], steps));
        }
    }
    // From here on the parabola of column `b` is lower than that of column `a`, which stands left of it.
    [[nodiscard]] std::int64_t from(std::int64_t a, std::int64_t b) const {
        const std::int64_t of_a = line_[static_cast<std::size_t>(a)];
        const std::int64_t of_b = line_[static_cast<std::size_t>(b)];
        const std::int64_t above = b * b - a * a + of_b * of_b - of_a * of_a;
        const std::int64_t below = 2 * (b - a);
        return (above >= 0 ? above / below : -((-above + below - 1) / below)) + 1;
    }
    [[nodiscard]] std::int64_t square(std::int64_t x, std::int64_t of) const {
        const std::int64_t up = line_[static_cast<std::size_t>(of)];
        return (x - of) * (x - of) + up * up;
    }
    void row(int y) {
        const std::size_t begin = cells_.at(0, y);
        const auto width = static_cast<std::int64_t>(cells_.width);
        line_.assign(squares_.begin() + static_cast<std::ptrdiff_t>(begin),
                     squares_.begin() + static_cast<std::ptrdiff_t>(begin) + cells_.width);
        lowest_.clear();
        for (std::int64_t x = 0; x < width; ++x) {
            while (!lowest_.empty() &&
                   square(lowest_.back().begin, lowest_.back().column) > square(lowest_.back().begin, x)) {
                lowest_.pop_back();
            }
            const std::int64_t at = lowest_.empty() ? 0 : from(lowest_.back().column, x);
            if (at < width) lowest_.push_back({x, std::max<std::int64_t>(at, 0)});
        }
        for (std::int64_t x = width; x-- > 0;) {
            squares_[begin + static_cast<std::size_t>(x)] =
                static_cast<std::int32_t>(square(x, lowest_.back().column));
            if (lowest_.back().begin == x) lowest_.pop_back();
        }
    }

    struct Stretch {
        std::int64_t column = 0;
        std::int64_t begin = 0;
    };
    const CellGrid& cells_;
    std::vector<std::int32_t> squares_;
    std::vector<std::int32_t> line_;
    std::vector<Stretch> lowest_;
};

// Along a tip that narrows slowly, steps of pixels make it wider and narrower by less than this, in cells of
// depth; where the least width is a few cells, a share of it is taken, so that necks are told there.
constexpr double kDeeper = 1.5;
constexpr double kDeeperShare = 0.15;
// From so many cells on, a cell less than the least width is no matter.
constexpr double kFineCells = 10.0;

// A strip of n cells is (n + 1) / 2 cells deep, rounded down.
double width_at(std::int64_t square) { return 2.0 * std::sqrt(static_cast<double>(square)) - 0.5; }

class Joining {
 public:
    Joining(const CellGrid& cells, double least)
        : cells_(cells), distances_(cells), sets_(cells.inside.size()), peaks_(cells.inside.size()) {
        // No cell is deeper than half the grid.
        const double deepest = 0.5 * std::min(cells.width, cells.height) + 1.0;
        // Strips of an even number of cells are as wide as twice their depth, others a cell less.
        const double unsure = least < kFineCells ? 0.5 : 0.0;
        const double depth = std::clamp(0.5 * (least + unsure), 1.0, deepest);
        deeper_ = std::min(kDeeper, kDeeperShare * least);
        wide_ = static_cast<std::int64_t>(std::ceil(depth * depth));
    }

    ThinPaper result() {
        const std::vector<std::size_t> thin = put_in_wide();
        for (const std::size_t cell : thin) put_in(cell);
        for (std::size_t i = 0; i < peaks_.size(); ++i) {
            if (cells_.inside[i] == 0 || sets_.first(i) != i) continue;
            const std::size_t widest = peaks_[i];
            if (distances_[widest] < wide_) found_.shapes.push_back(place(widest));
        }
        const auto narrower = [](const ThinPlace& a, const ThinPlace& b) { return a.width < b.width; };
        std::ranges::stable_sort(found_.necks, narrower);
        std::ranges::stable_sort(found_.shapes, narrower);
        return std::move(found_);
    }

 private:
    [[nodiscard]] ThinPlace place(std::size_t cell) const {
        const auto width = static_cast<std::size_t>(cells_.width);
        return {static_cast<int>(cell % width), static_cast<int>(cell / width), width_at(distances_[cell])};
    }
    // The others, from the deepest, by where they are.
    std::vector<std::size_t> put_in_wide() {
        std::vector<std::size_t> starts(static_cast<std::size_t>(wide_) + 1);
        for (std::size_t i = 0; i < peaks_.size(); ++i) {
            peaks_[i] = static_cast<std::uint32_t>(i);
            if (cells_.inside[i] != 0 && distances_[i] < wide_)
                ++starts[static_cast<std::size_t>(wide_ - distances_[i])];
        }
        for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
        std::vector<std::size_t> thin(starts.back());
        for (std::size_t i = 0; i < peaks_.size(); ++i) {
            if (cells_.inside[i] == 0) continue;
            if (distances_[i] >= wide_) {
                put_in(i);
            } else {
                thin[starts[static_cast<std::size_t>(wide_ - distances_[i]) - 1]++] = i;
            }
        }
        return thin;
    }
    void put_in(std::size_t cell) {
        const auto width = static_cast<std::size_t>(cells_.width);
        for (const std::size_t beside : {cell - width, cell - 1, cell + 1, cell + width}) {
            if (cells_.inside[beside] == 0 || !is_in(beside, cell)) continue;
            const std::size_t a = sets_.first(cell);
            const std::size_t b = sets_.first(beside);
            if (a == b) continue;
            const std::int64_t of_a = distances_[peaks_[a]];
            const std::int64_t of_b = distances_[peaks_[b]];
            if (is_neck(distances_[cell], std::min(of_a, of_b))) found_.necks.push_back(place(cell));
            const std::uint32_t peak =
                of_a > of_b || (of_a == of_b && peaks_[a] < peaks_[b]) ? peaks_[a] : peaks_[b];
            sets_.join(a, b);
            peaks_[std::min(a, b)] = peak;
        }
    }
    // Between two parts of which the narrower one has this peak.
    [[nodiscard]] bool is_neck(std::int64_t here, std::int64_t peak) const {
        if (here >= wide_ || peak < wide_) return false;
        return std::sqrt(static_cast<double>(peak)) >= std::sqrt(static_cast<double>(here)) + deeper_;
    }
    // Whether the cell beside was put in before: wide ones by where they are, then the others by depth.
    [[nodiscard]] bool is_in(std::size_t beside, std::size_t cell) const {
        const std::int64_t there = std::min(distances_[beside], wide_);
        const std::int64_t here = std::min(distances_[cell], wide_);
        return there > here || (there == here && beside < cell);
    }

    const CellGrid& cells_;
    Distances distances_;
    CellSets sets_;
    std::vector<std::uint32_t> peaks_;  // by the first cell of a set, its deepest cell
    std::int64_t wide_ = 1;             // squares from here on are wide
    double deeper_ = kDeeper;           // by which parts are deeper than a neck between them
    ThinPaper found_;
};

}  // namespace

ThinPaper thin_paper(const CellGrid& cells, double least) { return Joining(cells, least).result(); }

}  // namespace popup
