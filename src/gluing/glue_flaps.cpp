#include "gluing/glue_flaps.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/nth.h"
#include "popup/gluing.h"
#include "popup/motion.h"

namespace popup {
namespace {

constexpr std::string_view kName = "glue-flap";
constexpr double kUnderPanelMm = 3.0;
constexpr double kParallel = 0.995;      // cosine
constexpr double kOnPanelMm = 0.05;      // nearer they lie in one plane
constexpr double kBackDeg = 0.5;         // steps back to where it comes from
constexpr double kMiddleWithinMm = 0.5;  // precision of middles

class Finder {
 public:
    explicit Finder(const Assembly& assembly) : in_(assembly), steps_(folding_steps(assembly)) {}

    std::vector<GlueFlap> run() {
        std::vector<GlueFlap> found;
        if (steps_.empty()) return found;
        std::vector<int> flaps;
        for (std::size_t i = 0; i < in_.plates.size(); ++i) {
            if (in_.plates[i].name.find(kName) != std::string::npos) flaps.push_back(static_cast<int>(i));
        }
        const auto end = frames_at(in_.sweep.from_deg);
        if (flaps.empty() || !end) return found;
        for (const int flap : flaps) found.push_back(of(flap, *end));
        return found;
    }

 private:
    using Frames = std::vector<Frame>;
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

    [[nodiscard]] GlueFlap of(int flap, const Frames& end) const {
        GlueFlap one;
        one.flap = flap;
        for (std::size_t i = 0; i < in_.plates.size(); ++i) {
            const auto panel = static_cast<int>(i);
            if (panel == flap || hangs_on(flap, panel) || !lies_on(flap, panel, end)) continue;
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
