// Light from one direction, and what stands in its way.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "output/still/camera.h"
#include "output/still/model.h"

namespace popup::still {

// Where the light is seen from, a point has texels across and down, and mm towards the light. `place` brings
// a point there, `turned` a direction. Surfaces are flat, so what a shadow asks of one is found once:
//
//     const Sun sun(towards, model, framing.camera.target, framing.radius_mm, 600);
//     const Sun::Surface paper = sun.surface(normal, Sun::Softness::paper);
//     const double share = sun.lit(paper, sun.place(p)) / double{Sun::kRays};
class Sun {
 public:
    static constexpr int kTaps = 5;  // a side of the square of texels that is looked at
    static constexpr int kRays = kTaps * kTaps;

    // `towards`: where the light comes from. `radius_mm`: of a ball about the centre that holds the model.
    // `pixels`: the shorter side of the picture; small ones do with half as many texels a mm.
    Sun(Vec3 towards, const Model& model, Vec3 centre, double radius_mm, int pixels);

    [[nodiscard]] Vec3 towards() const { return back_; }
    [[nodiscard]] Vec3 place(Vec3 p) const {
        const Vec3 at = turned(p - centre_);
        return {at.x - first_x_, at.y - first_y_, at.z};
    }
    [[nodiscard]] Vec3 turned(Vec3 v) const {
        return {scale_ * dot(v, right_), -scale_ * dot(v, up_), dot(v, back_)};
    }

    enum class Softness { paper, ground };
    struct Surface {
        double slope = 0.0;  // how much of the light it has where nothing is in the way; 0: it is turned away
        Vec3 shift;          // away from what only the texels' size puts in its way
        std::array<float, kTaps> by_column{}, by_row{};  // how much nearer to the light it is at each tap
        int soft = 1;                                    // texels from one tap to the next
    };
    // `normal`: to where it is seen from.
    [[nodiscard]] Surface surface(Vec3 normal, Softness softness) const;
    // How many of kRays reach a place of a surface that is not turned away. Shadows have soft edges.
    [[nodiscard]] int lit(const Surface& surface, Vec3 place) const;
    // The rectangle of places beyond which nothing throws a shadow: low and high, z = 0.
    [[nodiscard]] std::array<Vec3, 2> shaded(const Surface& surface) const;
    // The point at such a place, z = 0, of a plane through `on`: where a ray to the light meets it.
    [[nodiscard]] Vec3 meets(Vec3 place, Vec3 on, Vec3 normal) const;

 private:
    void throw_shadow(std::span<const Seen> corners);

    Vec3 right_, up_, back_, centre_;
    double scale_ = 1.0;  // texels a mm
    double bias_mm_ = 0.0;
    int finer_ = 1;                         // times as many texels a mm as the coarsest map
    double first_x_ = 0.0, first_y_ = 0.0;  // of the map, where the centre is 0
    int columns_ = 0, rows_ = 0;            // of the map, with a border that nothing covers
    std::vector<float> nearest_;            // by texel: how near to the light something lies, mm
};

}  // namespace popup::still
