// What is nearest at each sample of a picture, a band of rows at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "output/still/camera.h"
#include "output/still/model.h"

namespace popup::still {

// What a sample sees: nothing (0), a face (its number and one), or an edge (a negative number).
using What = std::int32_t;

inline constexpr int kOver = 3;  // samples along a side of a pixel

// Columns and rows of pixels, from `low` up to `high`, not with it.
struct PixelBox {
    int low_x = 0, low_y = 0, high_x = 0, high_y = 0;
};

class Samples {
 public:
    // `camera` is one of samples. `width`, `height`: of the picture, pixels.
    Samples(const Model& model, const Camera& camera, int width, int height);

    // Where something is seen; all else sees nothing.
    [[nodiscard]] const PixelBox& box() const { return box_; }
    // Rows of pixels from `top` up to `bottom`, of those in the box. Cost: its samples, and the rows that
    // triangles cover.
    void draw(int top, int bottom);
    // What the sample in a column and a row of samples sees, and how near it is. Precondition: its pixel is
    // in the box, and was drawn last.
    [[nodiscard]] const What& what(int x, int y) const { return what_[index(x, y)]; }
    [[nodiscard]] float near(int x, int y) const { return near_[index(x, y)]; }
    // From one row of samples to the next.
    [[nodiscard]] std::ptrdiff_t stride() const { return kOver * (box_.high_x - box_.low_x); }

 private:
    // How a face lies in the picture.
    struct Seeing {
        std::size_t first = 0;                            // its points, of points_
        int low_y = 0, high_y = -1;                       // rows, both included; none: it is not seen
        double near_0 = 0.0, near_x = 0.0, near_y = 0.0;  // of its plane: near_0 + near_x x + near_y y
    };
    struct Line {
        Seen a, b;
        int low_y = 0, high_y = -1;
    };

    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>((y - top_) * stride() + x - kOver * box_.low_x);
    }
    void see(const Face& face);
    void see(const Edge& edge);
    void extend(double low_x, double low_y, double high_x, double high_y);
    void draw_face(std::size_t number);
    void draw_edge(std::size_t number);

    const Model& model_;
    Camera camera_;
    int columns_, rows_;  // of the picture
    std::vector<Seeing> faces_;
    std::vector<Seen> points_;
    std::vector<Line> edges_;
    PixelBox box_;
    int top_ = 0, bottom_ = 0;  // of what was drawn last, rows of samples
    std::vector<float> near_;
    std::vector<What> what_;
};

}  // namespace popup::still
