// Where what is drawn on a piece's page lies on a sheet.
#pragma once

#include "popup/layout.h"

namespace popup {

// From the page of a placed piece, or of the sheet itself, to a view of the sheet, and back.
class Carrier {
 public:
    // A back is seen with the sheet turned over about its upright axis.
    Carrier(const Placement& placement, double sheet_width_mm, bool back)
        : back_(back),
          width_(sheet_width_mm),
          offset_(placement.offset),
          angle_(placement.angle.rad()),
          x_(placement.apply({1, 0}) - placement.offset),
          y_(placement.apply({0, 1}) - placement.offset) {}

    [[nodiscard]] Vec2 at(Vec2 page) const {
        const Vec2 q = offset_ + page.x * x_ + page.y * y_;
        return back_ ? Vec2{width_ - q.x, q.y} : q;
    }
    // The point of the page that at() takes there, up to rounding.
    [[nodiscard]] Vec2 page(Vec2 sheet) const {
        const Vec2 q = (back_ ? Vec2{width_ - sheet.x, sheet.y} : sheet) - offset_;
        return {dot(q, x_), dot(q, y_)};
    }
    [[nodiscard]] bool back() const { return back_; }
    // By how much the page is turned, in radians.
    [[nodiscard]] double angle() const { return angle_; }

 private:
    bool back_;
    double width_;
    Vec2 offset_;
    double angle_;
    Vec2 x_, y_;
};

}  // namespace popup
