// What is nearest at each sample of a picture, a band of rows at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "output/still/camera.h"
#include "output/still/model.h"

namespace popup::still {

// What a sample sees: nothing (0), a face (its number and one), or an edge (a negative number).
using What = std::int32_t;

inline constexpr int kOver = 3;  // samples along a side of a pixel

// Samples of a pixel: bit 0 is the first of its first row, bit 8 the last of its last one.
using SampleSet = std::uint32_t;
inline constexpr int kSamples = kOver * kOver;  // of a pixel
inline constexpr SampleSet kAllSamples = (1U << kSamples) - 1U;

// How many they are; std::popcount() is a call where processors need not have it.
inline constexpr auto kSampleCounts = [] {
    std::array<std::uint8_t, kAllSamples + 1> counts{};
    for (std::size_t i = 1; i < counts.size(); ++i)
        counts[i] = static_cast<std::uint8_t>(counts[i / 2] + i % 2);
    return counts;
}();
constexpr int count_of(SampleSet samples) { return kSampleCounts[samples]; }

// Columns and rows of pixels, from `low` up to `high`, not with it.
struct PixelBox {
    int low_x = 0, low_y = 0, high_x = 0, high_y = 0;
};

// Where a sample of a pixel is: kOver columns and rows, of which one of each is in the middle.
inline constexpr int kMiddle = kOver / 2;
constexpr int column_of(int sample) { return sample % kOver; }
constexpr int row_of(int sample) { return sample / kOver; }

// How near a plane is that is seen at a pixel: in its middle, and by how much more a sample across and down.
struct Nearness {
    float middle = 0.0F, across = 0.0F, down = 0.0F;
    [[nodiscard]] float at(int sample) const {
        return middle + static_cast<float>(column_of(sample) - kMiddle) * across +
               static_cast<float>(row_of(sample) - kMiddle) * down;
    }
};

// What some samples of a pixel see.
struct Part {
    What what = 0;
    SampleSet samples = 0;  // may be none
    Nearness near;          // of a face
    std::int32_t next = 0;  // of the pixel's parts; -1: there is none
};

class Samples {
 public:
    // `camera` is one of samples. `width`, `height`: of the picture, pixels.
    Samples(const Model& model, const Camera& camera, int width, int height);

    // Where something is seen; all else sees nothing.
    [[nodiscard]] const PixelBox& box() const { return box_; }
    // Rows of pixels from `top` up to `bottom`, of those in the box. Cost: the pixels that triangles cover,
    // and the parts of those that several are seen in.
    void draw(int top, int bottom);
    // What all samples of a pixel see, nothing or a face; below 0: it has parts. Those of one row stand one
    // after another. Precondition, here and below: the pixel is in the box, and was drawn last.
    [[nodiscard]] const What& only(int x, int y) const { return only_[pixel(x, y)]; }
    // How near a pixel's middle is that sees one face only.
    [[nodiscard]] float middle(int x, int y) const { return middle_[pixel(x, y)]; }
    // Calls visit(part) for each part of a pixel; together they have all of its samples, each once.
    template <typename Visit>
    void each_part(int x, int y, const Visit& visit) const {
        for (std::int32_t i = parts_of(only_[pixel(x, y)]); i >= 0;) {
            const Part& part = parts_[static_cast<std::size_t>(i)];
            if (part.samples != 0) visit(part);
            i = part.next;
        }
    }

 private:
    // How a face lies in the picture.
    struct Seeing {
        std::size_t first = 0;                            // its points, of points_
        int low_y = 0, high_y = -1;                       // rows, both included; none: it is not seen
        double near_0 = 0.0, near_x = 0.0, near_y = 0.0;  // of its plane: near_0 + near_x x + near_y y
        [[nodiscard]] double near(double x, double y) const { return near_0 + near_x * x + near_y * y; }
        [[nodiscard]] Nearness at_pixel(int x, int y) const {
            return {static_cast<float>(near(kOver * (x + 0.5), kOver * (y + 0.5))),
                    static_cast<float>(near_x), static_cast<float>(near_y)};
        }
    };
    struct Line {
        Seen a, b;
        int low_y = 0, high_y = -1;
    };
    class LineDrawer;

    [[nodiscard]] std::size_t pixel(int x, int y) const {
        return static_cast<std::size_t>((y - top_) * (box_.high_x - box_.low_x) + x - box_.low_x);
    }
    // The first part of a pixel, from what only() says of it, and back.
    [[nodiscard]] static std::int32_t parts_of(What only) { return -1 - only; }
    void see(const Face& face);
    void see(const Edge& edge);
    void extend(double low_x, double low_y, double high_x, double high_y);
    void draw_face(std::size_t number);
    // Of a row of pixels those from `from` up to `to`, all of whose samples lie in a face.
    void draw_whole(std::size_t number, int y, int from, int to);
    // Of a pixel some samples, which lie in a face.
    void draw_samples(std::size_t number, int x, int y, SampleSet samples);
    // Those of `samples` at which a picture has paper.
    [[nodiscard]] SampleSet not_cut_out(std::size_t number, int x, int y, SampleSet samples) const;
    // Gives samples of a pixel to `what`, and takes them from its other parts.
    void give(std::size_t pixel, What what, SampleSet samples, const Nearness& near);

    const Model& model_;
    Camera camera_;
    int columns_, rows_;  // of the picture
    std::vector<Seeing> faces_;
    std::vector<Seen> points_;
    std::vector<Line> edges_;
    PixelBox box_;
    int top_ = 0, bottom_ = 0;  // of what was drawn last, rows of pixels
    // Of each pixel. Where it sees one face only, its Nearness; where it has parts no number, so that no
    // comparison holds.
    std::vector<float> middle_, across_, down_;
    std::vector<What> only_;
    std::vector<Part> parts_;
};

}  // namespace popup::still
