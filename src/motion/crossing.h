// Where two plates go through each other in one pose.
#pragma once

#include <optional>
#include <vector>

#include "motion/furthest_inside.h"
#include "motion/nearness.h"

namespace popup {

struct Crossing {
    Vec3 point;              // of both, in a's page coordinates: the one furthest inside the edges of both
    double inside_mm = 0.0;  // how far that is
    double inside_at_most_mm =
        0.0;                 // no common point is further; larger by a five-hundredth or 1e-6 mm, seldom more
    double sine = 0.0;       // of the angle between the planes
    double excess_mm = 0.0;  // how far one reaches beyond the other's plane, on its own paper, of the two the
                             // one that reaches less far
    bool b_is_longer = false;  // which one that is

    // How far a circle of paper round the point reaches to both sides of the other plate, the largest circle
    // that lies on both. This tells crossing from touching, whatever way plates touch.
    [[nodiscard]] double firmness_mm() const { return inside_mm * sine; }
    [[nodiscard]] bool firm() const { return inside_mm > kTouchMm && firmness_mm() > kFirmMm; }
};

// Sine of the angle between the planes of two plates.
double sine_between(const Frame& b_in_a);

// Memory is kept for the next pair; one caller at a time.
class CrossingTest {
 public:
    // Nothing when the plates have no point in common, or their planes are parallel. Cost: corners of both.
    std::optional<Crossing> operator()(const PlateShape& a, const PlateShape& b, const Frame& b_in_a);

    // Where an outline passes the line of both planes, and how far it reaches from there to either side
    // before it comes back.
    struct Passage {
        double along = 0.0;
        double reach_right = 0.0, reach_left = 0.0;
    };
    struct Stretch {
        double from = 0.0, to = 0.0;
    };

 private:
    std::vector<Passage> of_a_, of_b_;
    std::vector<Stretch> runs_;
    std::vector<int> edges_;
    FurthestInside furthest_;
};

}  // namespace popup
