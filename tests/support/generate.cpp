// Random designs of every element on every kind of fold.
#include <cmath>
#include <numbers>

#include "support/designs.h"
#include "support/proposals.h"

namespace popup::test {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

SitePoint polar(double s, int dir, double angle, double radius) {
    return {s + dir * radius * std::cos(angle), radius * std::sin(angle)};
}

Proposal propose(Dice& random, const Fold& fold) {
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

}  // namespace

Design generate(std::uint64_t seed, int elements, double width_mm, double height_mm) {
    Dice random{seed * 0x2545f4914f6cdd1dull + 1};
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
