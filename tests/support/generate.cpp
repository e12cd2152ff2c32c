// Random designs of every element on every kind of fold.
#include <array>
#include <cmath>
#include <numbers>

#include "mechanism/builder.h"
#include "mechanism/site.h"
#include "popup/mechanism.h"
#include "support/designs.h"

namespace popup::test {
namespace {

// splitmix64: the same numbers on every machine.
struct Random {
    std::uint64_t state;
    std::uint64_t next() {
        state += 0x9e3779b97f4a7c15ull;
        std::uint64_t z = state;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }
    double uniform(double lo, double hi) {
        return lo + (hi - lo) * static_cast<double>(next() >> 11) * 0x1p-53;
    }
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() % n); }
    bool chance(double p) { return uniform(0, 1) < p; }
};

Site site_on(const Fold& fold) {
    Site site;
    site.left = {fold.on_left.a, unit(fold.on_left.b - fold.on_left.a)};
    site.right = {fold.on_right.a, unit(fold.on_right.b - fold.on_right.a)};
    site.left_page = fold.left_page;
    site.right_page = fold.right_page;
    return site;
}

struct Proposal {
    std::string type;
    std::vector<std::pair<Side, SitePoint>> on;  // in the row's order
    std::vector<Vec2> extra;
};

constexpr double kDeg = std::numbers::pi / 180.0;

SitePoint polar(double s, int dir, double angle, double radius) {
    return {s + dir * radius * std::cos(angle), radius * std::sin(angle)};
}

Proposal propose(Random& random, const Fold& fold) {
    const double size = fold.length();
    const bool mountain = fold.closed_deg == 360;
    const double lo = random.uniform(0.05, 0.6) * size;
    const double hi = random.uniform(lo / size + 0.1, 0.97) * size;
    const double reach = random.uniform(0.1, 0.6) * size;
    const bool even = random.chance(0.4);
    const double p = reach * random.uniform(0.4, 1.0);
    const double q = even ? p : reach * random.uniform(0.4, 1.0);
    const int dir = random.chance(0.5) ? 1 : -1;
    const double a = random.uniform(20, 84) * kDeg;
    const double b = even ? a : random.uniform(20, 84) * kDeg;
    const double apex = 0.5 * (lo + hi);
    Proposal made;
    switch (random.below(fold.seam ? 2 : 5)) {
        case 0: {  // v-fold
            made.type = dir > 0 ? "v-fold" : "inverted-v-fold";
            made.on = {{Side::left, polar(apex, dir, a, p)},
                       {Side::left, {apex, 0}},
                       {Side::right, polar(apex, dir, b, q)}};
            const double sum = random.uniform((a + b) / kDeg + 12.0, 348.0 - (a + b) / kDeg) * kDeg;
            const Vec2 e{random.uniform(-20, 20), -30};
            const Vec2 g = e + rotated({0, p}, 0.5 * sum);
            const Vec2 h = e + rotated({0, q}, -0.5 * sum);
            const double up =
                random.uniform(0.4, 1.2) * reach + std::max(0.0, std::max(e.y - g.y, e.y - h.y)) + 5.0;
            made.extra = {g, e, h, h + Vec2{0, up + random.uniform(0, 10)}, g + Vec2{0, up}};
            break;
        }
        case 1: {  // tent
            made.type = "tent";
            const double shift = even ? 0.0 : random.uniform(-0.1, 0.1) * (hi - lo);
            made.on = {{Side::left, {lo, p}},
                       {Side::left, {hi, p}},
                       {Side::right, {lo + shift, q}},
                       {Side::right, {hi + shift, q}}};
            const double width = (p + q) * random.uniform(1.0, 1.6);
            made.extra = {
                {-0.5 * width, lo}, {-0.5 * width, hi}, {0.5 * width, lo + shift}, {0.5 * width, hi + shift}};
            break;
        }
        case 2: {
            made.type = mountain ? "inverted-step" : "step";
            const double tilt = even ? 0.0 : random.uniform(-0.2, 0.2) * (hi - lo);
            made.on = {{Side::left, {lo, p}},
                       {Side::left, {hi, p}},
                       {Side::right, {lo + tilt, q}},
                       {Side::right, {hi + tilt, q}}};
            break;
        }
        case 3:
            made.type = mountain ? "inverted-beak" : "beak";
            made.on = {{Side::left, {apex, 0}},
                       {Side::left, polar(apex, dir, a, p)},
                       {Side::right, polar(apex, dir, b, q)}};
            break;
        default: {
            made.type = mountain ? "inverted-angled-step" : "angled-step";
            const double inner = random.uniform(0.3, 0.7);
            made.on = {{Side::left, polar(apex, dir, a, inner * p)},
                       {Side::left, polar(apex, dir, a, p)},
                       {Side::right, polar(apex, dir, b, inner * q)},
                       {Side::right, polar(apex, dir, b, q)}};
            break;
        }
    }
    return made;
}

bool stands_on(const ElementInfo& info, const Fold& fold) {
    return fold.seam ? info.grounds.seam : info.grounds.fold;
}

// Points of any element that stands on folds, from its row alone: even ones as likely as not, each letter
// further out or along than the one before. check() then mends them into an element.
Proposal propose_of(Random& random, const Fold& fold, const ElementInfo& info) {
    const double size = fold.length();
    const double middle = random.uniform(0.25, 0.75) * size;
    const double reach = random.uniform(0.1, 0.5) * size;
    const bool even = random.chance(0.5);
    Proposal made;
    made.type = info.name;
    std::vector<SitePoint> at(info.points.size());
    std::array<double, 2> along{-0.2 * size, -0.2 * size};
    for (std::size_t i = 0; i < at.size(); ++i) {
        const PointInfo& point = info.points[i];
        const auto partner = static_cast<std::size_t>(info.partners[i]);
        double& s = along[point.page == PointPage::extra ? 1 : 0];
        if (point.side == 'R' && partner < i) {
            at[i] = even ? at[partner] : SitePoint{at[partner].s, at[partner].w * random.uniform(0.7, 1.4)};
        } else {
            at[i] = {s, point.side == '-' ? 0.0 : reach * random.uniform(0.5, 1.0)};
            s += random.uniform(0.1, 0.4) * size;
        }
    }
    for (std::size_t i = 0; i < at.size(); ++i) {
        const bool right = info.points[i].side == 'R';
        if (info.points[i].page == PointPage::extra) {
            made.extra.push_back({right ? at[i].w : -at[i].w, at[i].s});
        } else {
            made.on.emplace_back(right ? Side::right : Side::left, SitePoint{middle + at[i].s, at[i].w});
        }
    }
    return made;
}

void put(Design& design, const Fold& fold, const Proposal& made) {
    const Site site = site_on(fold);
    std::vector<Vec2> points;
    for (const auto& [side, at] : made.on) points.push_back(site.on_page(side, at));
    points.insert(points.end(), made.extra.begin(), made.extra.end());
    Structure& structure = add(design, made.type, points, fold.on_left.a, fold.on_left.b, fold.left_page);
    structure.id = "e" + std::to_string(design.structures.size());
    for (std::size_t i = 0; i < made.on.size(); ++i) {
        const int page = made.on[i].first == Side::left ? site.left_page : site.right_page;
        if (page != fold.left_page) structure.points[i].page = page;
    }
}

}  // namespace

Design generate_of(const ElementInfo& info, std::uint64_t seed, int elements) {
    Random random{seed * 0x2545f4914f6cdd1dull + 7};
    Design design = card(279.4, 215.9);
    design.version = info.since;
    Diagnostics first;
    auto checked = check(design, {}, first);
    for (int tries = 60 * elements; tries > 0 && static_cast<int>(design.structures.size()) < elements;
         --tries) {
        const auto& folds = checked->skeleton().folds;
        const Fold& fold = folds[random.below(folds.size())];
        if (fold.closed_deg == 180 || fold.length() < 14.0 || !stands_on(info, fold)) continue;
        Design trial = design;
        put(trial, fold, propose_of(random, fold, info));
        Diagnostics mended;
        auto repaired = check(trial, {}, mended);
        if (!repaired) continue;
        Diagnostics diagnostics;
        auto result = check(repaired->design(), {}, diagnostics);
        if (!result || diagnostics.has_findings()) continue;
        design = repaired->design();
        checked = std::move(result);
    }
    return design;
}

Design generate(std::uint64_t seed, int elements, double width_mm, double height_mm) {
    Random random{seed * 0x2545f4914f6cdd1dull + 1};
    Design design = card(width_mm, height_mm);
    Diagnostics first;
    auto checked = check(design, {}, first);
    for (int tries = 60 * elements; tries > 0 && static_cast<int>(design.structures.size()) < elements;
         --tries) {
        const auto& folds = checked->skeleton().folds;
        // Half of the time a young fold, so that towers grow as well as rows.
        const std::size_t pick = random.chance(0.5)
                                     ? folds.size() - 1 - random.below(std::min<std::size_t>(folds.size(), 6))
                                     : random.below(folds.size());
        const Fold& fold = folds[pick];
        if (fold.closed_deg == 180 || fold.length() < 14.0) continue;
        Design trial = design;
        put(trial, fold, propose(random, fold));
        Diagnostics diagnostics;
        auto result = check(trial, {}, diagnostics);
        if (!result || diagnostics.has_findings()) continue;
        design = std::move(trial);
        checked = std::move(result);
    }
    return design;
}

}  // namespace popup::test
