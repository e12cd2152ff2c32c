#include "motion/rates.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace popup {
namespace {

// Less than this of what was added up is rounding.
constexpr double kRounding = 1e-9;

std::size_t at(int line) { return static_cast<std::size_t>(line); }

// Of a column, from `row` on.
double square_below(const Screw& column, std::size_t row) {
    double sum = 0.0;
    for (std::size_t i = row; i < column.size(); ++i) sum += column.at(i) * column.at(i);
    return sum;
}

// Between 0.5 and 1.5, of either sign (splitmix64).
double unlike_others(std::size_t number) {
    std::uint64_t x = (number + 1) * 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    x ^= x >> 31U;
    const double size = 0.5 + static_cast<double>(x >> 12U) * 0x1p-52;
    return (x & 1U) != 0 ? size : -size;
}

}  // namespace

Rates::Rates(std::size_t lines) : all_(lines), column_of_(lines, -1), parts_(lines) {}

bool Rates::is_nought(int line) { return !is_open(line) && reduced(line).empty(); }

std::vector<double> Rates::example() {
    std::vector<double> values(all_.size());
    for (std::size_t i = 0; i < all_.size(); ++i) {
        if (all_[i].open) values[i] = unlike_others(i);
    }
    for (std::size_t i = 0; i < all_.size(); ++i) {
        if (all_[i].open) continue;
        for (const Term& term : reduced(static_cast<int>(i)))
            values[i] += term.factor * values[at(term.line)];
    }
    return values;
}

void Rates::add(int line, double factor) {
    Part& part = parts_[at(line)];
    if (!part.there) {
        part = {0.0, 0.0, true};
        there_.push_back(line);
        if (!is_open(line)) {
            waiting_.push_back({-all_[at(line)].decided, line});
            std::push_heap(waiting_.begin(), waiting_.end());
        }
    }
    part.factor += factor;
    part.most = std::max(part.most, std::abs(factor));
}

// What has been decided since is put in, the oldest first: it stands for what was decided later, if at all.
const std::vector<Rates::Term>& Rates::reduced(int line) {
    std::vector<Term>& terms = all_[at(line)].terms;
    if (std::all_of(terms.begin(), terms.end(), [this](const Term& t) { return is_open(t.line); }))
        return terms;
    for (const Term& term : terms) add(term.line, term.factor);
    while (!waiting_.empty()) {
        std::pop_heap(waiting_.begin(), waiting_.end());
        const int decided = waiting_.back()[1];
        waiting_.pop_back();
        const double factor = parts_[at(decided)].factor;
        for (const Term& term : all_[at(decided)].terms) add(term.line, factor * term.factor);
    }
    terms.clear();
    for (const int one : there_) {
        Part& part = parts_[at(one)];
        if (is_open(one) && std::abs(part.factor) > kRounding * std::max(part.most, 1.0))
            terms.push_back({one, part.factor});
        part.there = false;
    }
    there_.clear();
    return terms;
}

void Rates::gather(std::span<const LoopStep> loop) {
    lines_.clear();
    columns_.clear();
    largest_ = 0.0;
    const auto contribute = [this](int line, double factor, const Screw& screw) {
        int& column = column_of_[at(line)];
        if (column < 0) {
            column = static_cast<int>(columns_.size());
            columns_.emplace_back();
            lines_.push_back(line);
        }
        for (std::size_t i = 0; i < screw.size(); ++i) {
            const double part = factor * screw.at(i);
            columns_[at(column)].at(i) += part;
            largest_ = std::max(largest_, std::abs(part));
        }
    };
    for (const LoopStep& step : loop) {
        if (is_open(step.line)) {
            contribute(step.line, 1.0, step.screw);
            continue;
        }
        for (const Term& term : reduced(step.line)) contribute(term.line, term.factor, step.screw);
    }
    for (const int line : lines_) column_of_[at(line)] = -1;
}

// Householder's, with the largest column first; the rank.
std::size_t Rates::triangulate() {
    for (std::size_t row = 0; row < std::min(columns_.size(), Screw{}.size()); ++row) {
        std::size_t largest = row;
        double square = -1.0;
        for (std::size_t c = row; c < columns_.size(); ++c) {
            const double here = square_below(columns_[c], row);
            if (here <= square) continue;
            square = here;
            largest = c;
        }
        const double size = std::sqrt(square);
        if (!(size > kHolds * largest_)) return row;
        std::swap(columns_[row], columns_[largest]);
        std::swap(lines_[row], lines_[largest]);
        Screw mirror = columns_[row];
        const double diagonal = mirror.at(row) > 0.0 ? -size : size;
        mirror.at(row) -= diagonal;
        const double twice = 2.0 / square_below(mirror, row);
        for (std::size_t c = row; c < columns_.size(); ++c) {
            Screw& column = columns_[c];
            double along = 0.0;
            for (std::size_t i = row; i < column.size(); ++i) along += mirror.at(i) * column.at(i);
            along *= twice;
            for (std::size_t i = row; i < column.size(); ++i) column.at(i) -= along * mirror.at(i);
        }
    }
    return std::min(columns_.size(), Screw{}.size());
}

// The first `rank` lines, as sums of the others.
void Rates::decide(std::size_t rank) {
    ++loops_;
    for (std::size_t i = 0; i < rank; ++i) {
        Rate& rate = all_[at(lines_[i])];
        rate.open = false;
        rate.decided = loops_;
    }
    for (std::size_t c = rank; c < columns_.size(); ++c) {
        Screw x = columns_[c];
        for (std::size_t i = rank; i-- > 0;) {
            for (std::size_t k = i + 1; k < rank; ++k) x.at(i) -= columns_[k].at(i) * x.at(k);
            x.at(i) /= columns_[i].at(i);
            if (std::abs(x.at(i)) <= kRounding) continue;
            all_[at(lines_[i])].terms.push_back({lines_[c], -x.at(i)});
        }
    }
}

void Rates::close(std::span<const LoopStep> loop) {
    gather(loop);
    decide(triangulate());
}

}  // namespace popup
