#include "cli/files/line_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/nth.h"

namespace popup {
namespace {

constexpr std::ptrdiff_t kContext = 3;
constexpr std::ptrdiff_t kEffort = 256;  // edits in a gap that are searched for before it is replaced whole

using Index = std::ptrdiff_t;

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
        lines.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return lines;
}

// Equal lines of both texts get equal numbers, so that comparing costs one machine word.
struct Numbered {
    std::vector<int> a, b;
    int kinds = 0;
};

Numbered number(const std::vector<std::string_view>& a, const std::vector<std::string_view>& b) {
    // Only looked up, never walked through: the order of hashing leaves no trace.
    std::unordered_map<std::string_view, int> seen;
    Numbered result;
    const auto add = [&seen](const std::vector<std::string_view>& lines, std::vector<int>& numbers) {
        numbers.reserve(lines.size());
        for (const std::string_view line : lines) {
            numbers.push_back(seen.emplace(line, static_cast<int>(seen.size())).first->second);
        }
    };
    add(a, result.a);
    add(b, result.b);
    result.kinds = static_cast<int>(seen.size());
    return result;
}

// Part of both texts that is still to be compared.
struct Gap {
    Index a0, a1, b0, b1;
};

class Comparer {
 public:
    explicit Comparer(const Numbered& lines)
        : a_(lines.a), b_(lines.b), removed_(lines.a.size(), true), added_(lines.b.size(), true) {
        const Gap rest = trimmed({0, static_cast<Index>(a_.size()), 0, static_cast<Index>(b_.size())});
        Gap gap = rest;
        for (const auto& [at_a, at_b] : anchors(rest, lines.kinds)) {
            gap.a1 = at_a;
            gap.b1 = at_b;
            search(gap);
            keep(at_a, at_b);
            gap.a0 = at_a + 1;
            gap.b0 = at_b + 1;
        }
        gap.a1 = rest.a1;
        gap.b1 = rest.b1;
        search(gap);
    }
    [[nodiscard]] bool removed(Index i) const { return nth(removed_, i); }
    [[nodiscard]] bool added(Index i) const { return nth(added_, i); }

 private:
    [[nodiscard]] bool same(Index i, Index j) const { return nth(a_, i) == nth(b_, j); }
    void keep(Index i, Index j) {
        nth(removed_, i) = false;
        nth(added_, j) = false;
    }

    // Keeps the common lines at both ends and returns what lies between them.
    Gap trimmed(Gap gap) {
        for (; gap.a0 < gap.a1 && gap.b0 < gap.b1 && same(gap.a0, gap.b0); ++gap.a0, ++gap.b0) {
            keep(gap.a0, gap.b0);
        }
        for (; gap.a0 < gap.a1 && gap.b0 < gap.b1 && same(gap.a1 - 1, gap.b1 - 1); --gap.a1, --gap.b1) {
            keep(gap.a1 - 1, gap.b1 - 1);
        }
        return gap;
    }

    // Lines that stand once in each part, the longest run of them that ascends in both ("patience").
    [[nodiscard]] std::vector<std::pair<Index, Index>> anchors(const Gap& gap, int kinds) const {
        struct Count {
            int in_a = 0, in_b = 0;
            Index at_b = 0;
        };
        std::vector<Count> counts(static_cast<std::size_t>(kinds));
        const auto count = [&](int line) -> Count& { return nth(counts, line); };
        for (Index i = gap.a0; i < gap.a1; ++i) ++count(nth(a_, i)).in_a;
        for (Index j = gap.b0; j < gap.b1; ++j) {
            Count& entry = count(nth(b_, j));
            ++entry.in_b;
            entry.at_b = j;
        }
        struct Link {
            Index a, b;
            Index previous;
        };
        std::vector<Link> links;
        std::vector<Index> piles;  // of each length, the run that ends earliest
        for (Index i = gap.a0; i < gap.a1; ++i) {
            const Count& entry = count(nth(a_, i));
            if (entry.in_a != 1 || entry.in_b != 1) continue;
            const auto pile =
                std::lower_bound(piles.begin(), piles.end(), entry.at_b,
                                 [&links](Index link, Index b) { return nth(links, link).b < b; });
            links.push_back({i, entry.at_b, pile == piles.begin() ? -1 : *(pile - 1)});
            const Index made = static_cast<Index>(links.size()) - 1;
            if (pile == piles.end()) {
                piles.push_back(made);
            } else {
                *pile = made;
            }
        }
        std::vector<std::pair<Index, Index>> result;
        for (Index link = piles.empty() ? -1 : piles.back(); link >= 0;) {
            const Link& at = nth(links, link);
            result.emplace_back(at.a, at.b);
            link = at.previous;
        }
        std::reverse(result.begin(), result.end());
        return result;
    }

    // Myers' greedy search for the shortest edit of one gap. A gap that needs more than kEffort edits stays
    // replaced as a whole, which is right, if not short.
    void search(Gap gap) {
        gap = trimmed(gap);
        const Index n = gap.a1 - gap.a0;
        const Index m = gap.b1 - gap.b0;
        if (n == 0 || m == 0) return;
        const Index most = std::min(kEffort, n + m);
        std::vector<std::vector<Index>> rounds;  // furthest reach on each diagonal -d … d, before each round
        std::vector<Index> reach(static_cast<std::size_t>(2 * most + 3), 0);
        const auto at = [most](Index diagonal) { return static_cast<std::size_t>(diagonal + most + 1); };
        for (Index d = 0; d <= most; ++d) {
            rounds.emplace_back(reach.begin() + static_cast<Index>(at(-d - 1)),
                                reach.begin() + static_cast<Index>(at(d + 1)) + 1);
            for (Index k = -d; k <= d; k += 2) {
                const bool down = k == -d || (k != d && reach[at(k - 1)] < reach[at(k + 1)]);
                Index x = down ? reach[at(k + 1)] : reach[at(k - 1)] + 1;
                while (x < n && x - k < m && x - k >= 0 && same(gap.a0 + x, gap.b0 + x - k)) ++x;
                reach[at(k)] = x;
                if (x >= n && x - k >= m) {
                    trace(gap, rounds, d);
                    return;
                }
            }
        }
    }

    void trace(const Gap& gap, const std::vector<std::vector<Index>>& rounds, Index d) {
        Index x = gap.a1 - gap.a0;
        Index y = gap.b1 - gap.b0;
        for (; d >= 0; --d) {
            const std::vector<Index>& reach = nth(rounds, d);
            const auto before = [&](Index diagonal) { return nth(reach, diagonal + d + 1); };
            const Index k = x - y;
            const bool down = k == -d || (k != d && before(k - 1) < before(k + 1));
            const Index from_k = down ? k + 1 : k - 1;
            const Index from_x = d == 0 ? 0 : before(from_k);
            const Index from_y = d == 0 ? 0 : from_x - from_k;
            while (x > from_x && y > from_y) {
                --x;
                --y;
                keep(gap.a0 + x, gap.b0 + y);
            }
            x = from_x;
            y = from_y;
        }
    }

    const std::vector<int>& a_;
    const std::vector<int>& b_;
    std::vector<bool> removed_;
    std::vector<bool> added_;
};

void append_line(std::string& text, char mark, std::string_view line) {
    text += mark;
    text += line;
    if (!line.ends_with('\n')) text += "\n\\ No newline at end of file\n";
}

std::string range(Index first, Index count) {
    // An empty range is named by the line before it.
    std::string text = std::to_string(count == 0 ? first : first + 1);
    if (count != 1) text += "," + std::to_string(count);
    return text;
}

}  // namespace

std::string unified_diff(std::string_view name, std::string_view before, std::string_view after) {
    if (before == after) return {};
    const std::vector<std::string_view> a = lines_of(before);
    const std::vector<std::string_view> b = lines_of(after);
    const Numbered lines = number(a, b);
    const Comparer compared(lines);
    const auto n = static_cast<Index>(a.size());
    const auto m = static_cast<Index>(b.size());

    // patch ends a name at its first blank, unless a tab ends it.
    const std::string_view end = name.find(' ') == std::string_view::npos ? "\n" : "\t\n";
    std::string text = fmt::format("--- {0}{1}+++ {0}{1}", name, end);
    std::string hunk;
    Index hunk_a = 0, hunk_b = 0;  // where the open hunk begins
    Index unchanged = 0;           // lines since the last change in it
    Index i = 0, j = 0;
    bool open = false;
    const auto begin = [&] {
        if (open) return;
        const Index lead = std::min(kContext, i);
        hunk.clear();
        hunk_a = i - lead;
        hunk_b = j - lead;
        for (Index line = hunk_a; line < i; ++line) append_line(hunk, ' ', nth(a, line));
        open = true;
    };
    const auto finish = [&] {
        text += "@@ -" + range(hunk_a, i - hunk_a) + " +" + range(hunk_b, j - hunk_b) + " @@\n" + hunk;
        open = false;
    };
    while (i < n || j < m) {
        if (i < n && compared.removed(i)) {
            begin();
            append_line(hunk, '-', nth(a, i++));
            unchanged = 0;
        } else if (j < m && compared.added(j)) {
            begin();
            append_line(hunk, '+', nth(b, j++));
            unchanged = 0;
        } else {
            if (open && unchanged == kContext) {
                // The hunk goes on when the next change is near enough to share the context.
                bool near = false;
                for (Index ahead = 0; ahead <= kContext && !near; ++ahead) {
                    near = (i + ahead < n && compared.removed(i + ahead)) ||
                           (j + ahead < m && compared.added(j + ahead));
                }
                if (near) {
                    unchanged = 0;
                } else {
                    finish();
                }
            }
            if (open) append_line(hunk, ' ', nth(a, i));
            ++unchanged;
            ++i;
            ++j;
        }
    }
    if (open) finish();
    return text;
}

}  // namespace popup
