// Light from one direction, and what stands in its way.
#pragma once

#include <vector>

#include "output/still/model.h"

namespace popup::still {

class Sun {
 public:
    // `towards`: where the light comes from. `radius_mm`: of a ball about the centre that holds the model.
    Sun(Vec3 towards, const Model& model, Vec3 centre, double radius_mm);

    [[nodiscard]] Vec3 towards() const { return back_; }
    // How much of it reaches a point of a surface, 0 to 1; `normal` points to where it is seen from. Shadows
    // are soft at their edges; `soft` is how soft, in texels of the map: wider costs no more.
    [[nodiscard]] double reaches(Vec3 p, Vec3 normal, int soft) const;

 private:
    static constexpr int kSide = 1024;
    [[nodiscard]] Seen see(Vec3 p) const;

    Vec3 right_, up_, back_, centre_;
    double scale_ = 1.0;  // texels a mm
    double bias_mm_ = 0.0;
    int first_x_ = kSide, last_x_ = -1, first_y_ = kSide, last_y_ = -1;  // of texels that the model covers
    std::vector<float> nearest_;  // by texel: how near to the sun something lies, mm from the centre
};

}  // namespace popup::still
