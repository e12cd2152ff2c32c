#include "support/nest_libnest2d.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <libnest2d/common.hpp>
#include <random>
#include <stdexcept>

// The library is older than C++20, by whose rules its comparison of radians has two meanings.
namespace libnest2d {
inline bool operator!=(const Radians& a, const Radians& b) {
    return static_cast<double>(a) != static_cast<double>(b);
}
}  // namespace libnest2d
#include <libnest2d/libnest2d.hpp>

namespace popup::test {
namespace {

namespace sl = libnest2d::shapelike;
using Item = libnest2d::Item;
using BinBox = libnest2d::Box;
using Placer = libnest2d::NfpPlacer;
using Alignment = Placer::Config::Alignment;
using Clock = std::chrono::steady_clock;

// Its coordinates are whole numbers, whose products must fit into 64 bits.
constexpr double kLargest = 1e9;
// Turning cuts off fractions there, so turned hulls are kept this many units apart.
constexpr libnest2d::Coord kTurningGap = 4;

enum class Selector { first_fit, djd, filler };
enum class Goal {
    middle,  // its own: near the middle of the sheet
    corner,  // near the lower left corner, in the sheet all the while
    length   // as little of the length as can be, then low
};
struct Settings {
    Selector selector = Selector::first_fit;
    Goal goal = Goal::middle;
    Alignment start = Alignment::CENTER;
    float accuracy = 0.65F;

    [[nodiscard]] std::string words() const {
        const char* selectors[] = {"first fit", "DJD", "filler"};
        const char* goals[] = {"middle", "corner", "length"};
        return fmt::format("{}, goal {}, start {}, accuracy {}", selectors[static_cast<int>(selector)],
                           goals[static_cast<int>(goal)],
                           start == Alignment::CENTER ? "in the middle" : "lower left", accuracy);
    }
};

std::vector<Settings> all_settings(bool strip) {
    std::vector<Settings> result;
    for (const float accuracy : {0.65F, 1.0F}) {
        for (const Selector selector : {Selector::first_fit, Selector::djd, Selector::filler}) {
            for (const Goal goal : {Goal::middle, Goal::corner, Goal::length}) {
                for (const Alignment start : {Alignment::CENTER, Alignment::BOTTOM_LEFT}) {
                    // One sheet for all: filling one after the other is first fit.
                    if (strip && selector == Selector::filler) continue;
                    result.push_back({selector, goal, start, accuracy});
                }
            }
        }
    }
    return result;
}

Item hull(const NestKind& kind, double units) {
    libnest2d::PathImpl points;
    for (const Polygon& polygon : kind.outline) {
        for (const Vec2 p : polygon.outer) {
            points.emplace_back(std::llround(p.x * units), std::llround(p.y * units));
        }
    }
    points.push_back(points.front());
    return Item(sl::convexHull(libnest2d::PolygonImpl(points)));
}

// What a goal looks at: the box of what is placed already.
struct Pile {
    BinBox box;
    bool empty = true;
};

void set_goal(Placer::Config& config, Goal goal, const BinBox& bin) {
    if (goal == Goal::middle) return;
    auto pile = std::make_shared<Pile>();
    config.before_packing = [pile](const libnest2d::nfp::Shapes<libnest2d::PolygonImpl>& merged, const auto&,
                                   const auto&) {
        pile->empty = merged.empty();
        if (!pile->empty) pile->box = sl::boundingBox(merged);
    };
    const double norm = std::sqrt(sl::area(bin));
    config.object_function = [pile, goal, bin, norm](const Item& item) {
        const BinBox own = item.boundingBox();
        const BinBox all = pile->empty ? own : sl::boundingBox(pile->box, own);
        const auto x = [](const BinBox& box, bool high) {
            return static_cast<double>(high ? box.maxCorner().X : box.minCorner().X);
        };
        const auto y = [](const BinBox& box, bool high) {
            return static_cast<double>(high ? box.maxCorner().Y : box.minCorner().Y);
        };
        const double over_x = std::max(0.0, static_cast<double>(all.width() - bin.width()));
        const double over_y = std::max(0.0, static_cast<double>(all.height() - bin.height()));
        const double out = std::max({0.0, x(bin, false) - x(own, false), y(bin, false) - y(own, false),
                                     x(own, true) - x(bin, true), y(own, true) - y(bin, true)});
        if (goal == Goal::corner) {
            return (x(own, true) + y(own, true) + 1000.0 * (out + over_x + over_y)) / norm;
        }
        return (static_cast<double>(all.width()) + 0.01 * y(own, true) + 0.02 * x(own, false) +
                1000.0 * (over_x + over_y)) /
               norm;
    };
}

class Run {
 public:
    Run(const NestInstance& instance, Clock::time_point end) : instance_(instance), end_(end) {
        const NestStock& stock = instance.job.stock.front();
        while (10.0 * units_ * std::max(stock.width, stock.height) <= kLargest) units_ *= 10.0;
        const libnest2d::Coord width = std::llround(stock.width * units_);
        const libnest2d::Coord height = std::llround(stock.height * units_);
        bin_ = BinBox(width, height, {width / 2, height / 2});
        for (const NestKind& kind : instance.job.kinds) {
            hulls_.push_back(hull(kind, units_));
            // Its turns are the same for all pieces; so are those of the instances.
            turns_ = kind.turns;
        }
    }

    // nullopt when the time was up, or not all pieces were placed.
    std::optional<ForeignLayout> operator()(const Settings& settings, const std::vector<int>& priorities) {
        switch (settings.selector) {
            case Selector::first_fit:
                return run<libnest2d::FirstFitSelection>(settings, priorities);
            case Selector::djd:
                return run<libnest2d::DJDHeuristic>(settings, priorities);
            case Selector::filler:
                return run<libnest2d::FillerSelection>(settings, priorities);
        }
        return std::nullopt;
    }

 private:
    template <class Selection>
    std::optional<ForeignLayout> run(const Settings& settings, const std::vector<int>& priorities) {
        const auto start = Clock::now();
        std::vector<Item> items;
        for (const NestItem& item : instance_.job.items) {
            items.push_back(hulls_[static_cast<std::size_t>(item.kind)]);
        }
        for (std::size_t i = 0; i < priorities.size(); ++i) items[i].priority(priorities[i]);
        Placer::Config config;
        config.rotations.clear();
        for (const Angle turn : turns_) config.rotations.emplace_back(turn.rad());
        config.alignment = Alignment::BOTTOM_LEFT;
        config.starting_point = settings.start;
        config.accuracy = settings.accuracy;
        config.parallel = false;  // a thread for each corner of each piece costs more than it saves
        set_goal(config, settings.goal, bin_);
        const bool turning = turns_.size() > 1 || !(turns_.front() == Angle{});
        std::optional<ForeignLayout> layout;
        try {
            libnest2d::_Nester<Placer, Selection> nester(bin_, turning ? kTurningGap : 0, config);
            // Asked to stop, some selectors go round for ever: an exception gets out of all of them.
            nester.stopCondition([this]() -> bool {
                if (Clock::now() > end_) throw std::runtime_error("time is up");
                return false;
            });
            nester.execute(items.begin(), items.end());
            if (Clock::now() <= end_) layout = plan(items, nester.lastResult());
        } catch (const std::exception&) {
            return std::nullopt;
        }
        if (!layout) return std::nullopt;
        layout->settings = settings.words();
        layout->seconds = std::chrono::duration<double>(Clock::now() - start).count();
        return layout;
    }

    template <class Groups>
    std::optional<ForeignLayout> plan(const std::vector<Item>& items, const Groups& groups) const {
        ForeignLayout layout;
        layout.plan.spots.resize(items.size(), {-1, {}, {}});
        for (const auto& group : groups) {
            if (group.empty()) continue;
            const auto sheet = static_cast<int>(layout.plan.sheets.size());
            layout.plan.sheets.push_back(0);
            for (const Item& item : group) {
                const auto i = static_cast<std::size_t>(&item - items.data());
                layout.plan.spots[i] = {sheet,
                                        {static_cast<double>(item.translation().X) / units_,
                                         static_cast<double>(item.translation().Y) / units_},
                                        turn_of(item)};
            }
        }
        const bool all = std::all_of(layout.plan.spots.begin(), layout.plan.spots.end(),
                                     [](const NestSpot& spot) { return spot.sheet >= 0; });
        if (!all) return std::nullopt;
        align(layout.plan);
        return layout;
    }

    [[nodiscard]] Angle turn_of(const Item& item) const {
        const double deg = static_cast<double>(item.rotation()) * 180.0 / std::numbers::pi;
        return *std::min_element(turns_.begin(), turns_.end(), [deg](Angle a, Angle b) {
            const auto off = [deg](Angle turn) { return std::abs(std::remainder(turn.deg - deg, 360.0)); };
            return off(a) < off(b);
        });
    }

    // Outlines, not hulls with a gap round them, go to the lower left corner of each sheet.
    void align(NestPlan& plan) const {
        std::vector<Box> boxes(plan.sheets.size());
        const auto each_corner = [&](const auto& visit) {
            for (std::size_t i = 0; i < plan.spots.size(); ++i) {
                const NestSpot& spot = plan.spots[i];
                for (const Polygon& polygon :
                     instance_.job.kinds[static_cast<std::size_t>(instance_.job.items[i].kind)].outline) {
                    for (const Vec2 p : polygon.outer) {
                        visit(static_cast<std::size_t>(spot.sheet),
                              rotated(p, spot.angle.rad()) + spot.offset);
                    }
                }
            }
        };
        each_corner([&](std::size_t sheet, Vec2 p) { boxes[sheet].extend(p); });
        for (NestSpot& spot : plan.spots) {
            const Vec2 at = spot.offset - boxes[static_cast<std::size_t>(spot.sheet)].min;
            spot.offset = {std::round(at.x * 1e6) / 1e6, std::round(at.y * 1e6) / 1e6};
        }
        plan.used.assign(plan.sheets.size(), {});
        each_corner([&](std::size_t sheet, Vec2 p) {
            plan.used[sheet] = {std::max(plan.used[sheet].x, p.x), std::max(plan.used[sheet].y, p.y)};
        });
        // The shortest one is the last.
        const auto shortest =
            std::min_element(plan.used.begin(), plan.used.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; }) -
            plan.used.begin();
        const auto last = static_cast<int>(plan.used.size()) - 1;
        for (NestSpot& spot : plan.spots) {
            if (spot.sheet == last) {
                spot.sheet = static_cast<int>(shortest);
            } else if (spot.sheet == static_cast<int>(shortest)) {
                spot.sheet = last;
            }
        }
        std::swap(plan.used[static_cast<std::size_t>(last)], plan.used[static_cast<std::size_t>(shortest)]);
    }

    const NestInstance& instance_;
    Clock::time_point end_;
    double units_ = 1.0;  // a mm
    BinBox bin_;
    std::vector<Item> hulls_;
    std::vector<Angle> turns_;
};

bool better(const NestPlan& a, const NestPlan& b) {
    if (a.sheets.size() != b.sheets.size()) return a.sheets.size() < b.sheets.size();
    return a.used.back().x < b.used.back().x;
}

// Large pieces still tend to be first: areas, each taken up to a third larger or smaller.
std::vector<int> random_order(const NestInstance& instance, std::mt19937_64& dice) {
    std::vector<int> priorities;
    for (const NestItem& item : instance.job.items) {
        double size = 0.0;
        for (const Polygon& polygon : instance.job.kinds[static_cast<std::size_t>(item.kind)].outline) {
            size += area(polygon);
        }
        const double share = static_cast<double>(dice() >> 11) / 9007199254740992.0;
        priorities.push_back(
            static_cast<int>(1e6 * size / instance.area * (1.0 + (2.0 * share - 1.0) / 3.0)) + 1);
    }
    return priorities;
}

}  // namespace

ForeignBest libnest2d_best(const NestInstance& instance, double seconds,
                           const std::function<void(const std::string&)>& progress) {
    const auto start = Clock::now();
    const auto end =
        start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    ForeignBest best;
    Run run(instance, end);
    Settings best_settings;
    const auto say = [&](const ForeignLayout& layout, const char* how) {
        if (!progress) return;
        progress(fmt::format("{} sheets, last {:.4g} mm, {:.2f} s: {}{}", layout.plan.sheets.size(),
                             layout.plan.used.back().x, layout.seconds, layout.settings, how));
    };
    for (const Settings& settings : all_settings(instance.form == NestInstance::Form::strip)) {
        if (Clock::now() >= end) break;
        auto layout = run(settings, {});
        if (!layout) continue;
        ++best.settings_tried;
        say(*layout, "");
        if (best.settled && !better(layout->plan, best.settled->plan)) continue;
        best.settled = std::move(layout);
        best_settings = settings;
    }
    best.shuffled = best.settled;
    // Only first fit takes an order from outside.
    best_settings.selector = Selector::first_fit;
    std::mt19937_64 dice(1);
    while (best.settled && Clock::now() < end) {
        auto layout = run(best_settings, random_order(instance, dice));
        if (!layout) continue;
        ++best.orders_tried;
        if (!better(layout->plan, best.shuffled->plan)) continue;
        layout->settings += ", a random order";
        say(*layout, "");
        best.shuffled = std::move(layout);
    }
    return best;
}

}  // namespace popup::test
