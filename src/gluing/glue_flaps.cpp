#include "gluing/glue_flaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "assembly/folded_sheets.h"
#include "base/nth.h"
#include "popup/gluing.h"
#include "popup/motion.h"

namespace popup {
namespace {

constexpr std::array kNames{kGlueFlapName, kGlueCornerName};
constexpr std::string_view kEndFlap = "-flap-";  // "sheet/bottom-flap-left"
constexpr double kUnderPanelMm = 10.5;           // the kit's thickest board, and a little
constexpr double kParallel = 0.995;              // cosine
constexpr double kOnPanelMm = 0.05;              // nearer they lie in one plane
constexpr double kBackDeg = 0.5;                 // steps back to where it comes from
constexpr double kMiddleWithinMm = 0.5;          // precision of middles

class Finder {
 public:
    explicit Finder(const Assembly& assembly) : in_(assembly), steps_(folding_steps(assembly)) {}

    std::vector<GlueFlap> run() {
        std::vector<GlueFlap> found;
        if (steps_.empty()) return found;
        const std::vector<int> named = named_flaps();
        const std::vector<int> of_ends = is_bag() ? end_flaps() : std::vector<int>{};
        if (named.empty() && of_ends.empty()) return found;
        const auto end = frames_at(in_.sweep.from_deg);
        if (!end) return found;
        for (const int flap : named) {
            found.push_back(of(flap, *end, [](int) { return true; }));
        }
        add_ends(of_ends, *end, found);
        std::sort(found.begin(), found.end(),
                  [](const GlueFlap& a, const GlueFlap& b) { return a.flap < b.flap; });
        return found;
    }

 private:
    using Frames = std::vector<Frame>;

    [[nodiscard]] std::vector<int> named_flaps() const {
        std::vector<int> flaps;
        for (std::size_t i = 0; i < in_.plates.size(); ++i) {
            const std::string& name = in_.plates[i].name;
            const auto is_in = [&](std::string_view one) { return name.find(one) != std::string::npos; };
            if (std::any_of(kNames.begin(), kNames.end(), is_in)) flaps.push_back(static_cast<int>(i));
        }
        return flaps;
    }
    // Walls with a crease in their middle go in when the sheet is laid flat, as a bag is to be: no tucked
    // flap would let it, or carry what is in it.
    [[nodiscard]] bool is_bag() const {
        static constexpr std::array<std::string_view, 4> kParted{"/front-1", "/right-1", "/back-1",
                                                                 "/left-1"};
        return std::any_of(in_.plates.begin(), in_.plates.end(), [](const Plate& plate) {
            return std::any_of(kParted.begin(), kParted.end(),
                               [&](std::string_view wall) { return plate.name.ends_with(wall); });
        });
    }
    [[nodiscard]] std::vector<int> end_flaps() const {
        std::vector<int> flaps;
        for (std::size_t i = 0; i < in_.plates.size(); ++i) {
            if (in_.plates[i].name.find(kEndFlap) != std::string::npos) flaps.push_back(static_cast<int>(i));
        }
        return flaps;
    }
    // "sheet/bottom" of "sheet/bottom-flap-left".
    [[nodiscard]] std::string_view end_of(int flap) const {
        const std::string_view name = nth(in_.plates, flap).name;
        return name.substr(0, name.find(kEndFlap));
    }

    // Hems lie on walls, and are left out.
    void add_ends(const std::vector<int>& flaps, const Frames& end, std::vector<GlueFlap>& found) const {
        const std::set<int> all(flaps.begin(), flaps.end());
        std::vector<GlueFlap> own;
        own.reserve(flaps.size());
        for (const int flap : flaps) {
            own.push_back(of(
                flap, end, [&](int panel) { return all.contains(panel) && end_of(panel) == end_of(flap); }));
        }
        for (const GlueFlap& one : own) {
            const bool again = std::any_of(own.begin(), own.end(), [&](const GlueFlap& other) {
                return other.flap == one.panel && other.panel == one.flap && turns_last(other.flap, one.flap);
            });
            if (one.panel >= 0 && !again) found.push_back(one);
        }
    }
    // Whether one plate turns last after another does; of those that turn together the first does.
    [[nodiscard]] bool turns_last(int one, int other) const {
        const int own = last_turn(one);
        const int others = last_turn(other);
        return own != others ? own > others : one < other;
    }
    [[nodiscard]] int last_turn(int plate) const {
        int last = -1;
        for (std::size_t i = 0; i < steps_.size(); ++i) {
            const std::vector<int>& plates = steps_[i].plates;
            if (std::find(plates.begin(), plates.end(), plate) != plates.end()) last = static_cast<int>(i);
        }
        return last;
    }

    [[nodiscard]] std::optional<Frames> frames_at(double opening_deg) const {
        Frames frames(in_.plates.size());
        if (!place(in_, Angle::degrees(opening_deg), frames)) return std::nullopt;
        return frames;
    }
    [[nodiscard]] Vec2 middle(int plate) const {
        return inner_point(nth(in_.plates, plate).outline, kMiddleWithinMm).at;
    }
    // How far the flap's middle is before the front of the panel.
    [[nodiscard]] double before(int flap, int panel, const Frames& frames) const {
        const Frame& on = nth(frames, panel);
        return dot(nth(frames, flap).point(middle(flap)) - on.origin, on.normal());
    }
    [[nodiscard]] bool lies_on(int flap, int panel, const Frames& frames) const {
        const Frame& on = nth(frames, panel);
        if (std::abs(dot(on.normal(), nth(frames, flap).normal())) < kParallel) return false;
        if (std::abs(before(flap, panel, frames)) > kUnderPanelMm) return false;
        const Vec3 away = nth(frames, flap).point(middle(flap)) - on.origin;
        return contains(nth(in_.plates, panel).outline, {dot(away, on.axes[0]), dot(away, on.axes[1])});
    }
    [[nodiscard]] bool hangs_on(int flap, int panel) const {
        return std::any_of(in_.hinges.begin(), in_.hinges.end(), [&](const Hinge& hinge) {
            return (hinge.a == flap && hinge.b == panel) || (hinge.b == flap && hinge.a == panel);
        });
    }

    // On the nearest of the panels that may be.
    template <typename MayBe>
    [[nodiscard]] GlueFlap of(int flap, const Frames& end, MayBe may_be) const {
        GlueFlap one;
        one.flap = flap;
        for (std::size_t i = 0; i < in_.plates.size(); ++i) {
            const auto panel = static_cast<int>(i);
            if (panel == flap || !may_be(panel)) continue;
            if (hangs_on(flap, panel) || !lies_on(flap, panel, end)) continue;
            if (one.panel < 0 || std::abs(before(flap, panel, end)) < std::abs(before(flap, one.panel, end)))
                one.panel = panel;
        }
        one.step = static_cast<int>(steps_.size()) - 1;
        if (one.panel < 0) return one;
        one.inside = is_inside(one, end);
        while (one.step > 0) {
            const auto frames = frames_at(steps_[static_cast<std::size_t>(one.step) - 1].to_deg);
            if (!frames || !lies_on(flap, one.panel, *frames)) break;
            --one.step;
        }
        return one;
    }

    // A panel's inner side is that of the middle of all panels.
    [[nodiscard]] bool is_inside(const GlueFlap& one, const Frames& end) const {
        Vec3 sum{};
        double paper = 0.0;
        for (std::size_t i = 0; i < in_.plates.size(); ++i) {
            const double share = area(in_.plates[i].outline);
            sum = sum + share * end[i].point(middle(static_cast<int>(i)));
            paper += share;
        }
        const Frame& on = nth(end, one.panel);
        const double inner = dot((1.0 / paper) * sum - on.origin, on.normal());
        double flap = before(one.flap, one.panel, end);
        const Sweep& sweep = in_.sweep;
        for (double opening = sweep.from_deg + kBackDeg;
             std::abs(flap) < kOnPanelMm && opening < sweep.to_deg; opening += kBackDeg) {
            if (const auto frames = frames_at(opening)) flap = before(one.flap, one.panel, *frames);
        }
        return flap * inner >= 0.0;
    }

    const Assembly& in_;
    std::vector<FoldingStep> steps_;
};

}  // namespace

std::vector<GlueFlap> glue_flaps(const Assembly& assembly) { return Finder(assembly).run(); }

}  // namespace popup
