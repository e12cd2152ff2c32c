// The rules of webOAcard, point by point: in which plane a point of the unfolded sheet lies.
//
// Slow and plain on purpose, so that the reader of such designs can be judged by it. It shares nothing with
// that reader, nor with any geometry of the library: it parses the file itself, asks of each point of a
// raster which contours it lies in, and floods the raster where the reader cuts polygons.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace popup::test {

// A plane of the open card: parallel to the back at a depth, or to the floor at a height. Back and floor are
// at 0.
struct OaPlane {
    bool upright = false;
    double offset = 0.0;
    friend bool operator==(const OaPlane&, const OaPlane&) = default;
};

class OaRules {
 public:
    // `json`: a file that is sound. The raster has cells of about that size.
    explicit OaRules(const std::string& json, double cell_mm = 0.5);

    [[nodiscard]] double width() const { return width_; }
    [[nodiscard]] double height() const { return height_; }
    // Cells along the gutter (X) and down the sheet (Y).
    [[nodiscard]] std::size_t columns() const { return columns_; }
    [[nodiscard]] std::size_t rows() const { return rows_; }
    // About the middle of a column, as X, and of a row, as Y.
    [[nodiscard]] double x(std::size_t column) const {
        return (static_cast<double>(column) + kMiddle) * width_ / static_cast<double>(columns_);
    }
    [[nodiscard]] double y(std::size_t row) const {
        return -height_ + (static_cast<double>(row) + kMiddle) * 2.0 * height_ / static_cast<double>(rows_);
    }
    [[nodiscard]] OaPlane plane(std::size_t column, std::size_t row) const {
        return planes_[row * columns_ + column];
    }
    // The same of all cells round it, by so many: rounding to the raster changes nothing there.
    [[nodiscard]] bool clear(std::size_t column, std::size_t row, std::size_t by) const;
    // Whether a hole is there, however deep.
    [[nodiscard]] bool in_hole(std::size_t column, std::size_t row) const;

 private:
    // Of a cell: no edge of a drawing runs through it.
    static constexpr double kMiddle = 0.51372;
    struct Point {
        double x, y;
    };
    using Ring = std::vector<Point>;
    struct Contour {
        Ring outer;
        std::vector<Ring> holes;
    };
    struct Face {
        int mode = 0;
        double depth = 0.0, time = 0.0;
        bool text = false;
        std::vector<Contour> contours;
    };
    using Mask = std::vector<char>;

    static bool inside(const Ring& ring, Point p);
    static bool inside(const Contour& contour, Point p);
    static bool inside(const Face& face, Point p);
    [[nodiscard]] bool stands(const Face& face, Point p) const;
    template <typename Which>
    [[nodiscard]] bool stands_at(double depth, Point p, const Which& which) const;
    [[nodiscard]] bool top_of_text(double depth, Point p) const;
    void run_back(double depth);
    template <typename IsUpper>
    void run_back(double depth, double edge, std::size_t row, const Mask& open, bool only_openings,
                  const IsUpper& is_upper);
    void flood_back(double depth, double y, std::size_t first, std::size_t last, std::size_t from,
                    std::size_t to);
    bool opening(const Mask& open, std::size_t column, std::size_t row, std::size_t& from,
                 std::size_t& to) const;

    double width_ = 0.0, height_ = 0.0;
    std::size_t columns_ = 0, rows_ = 0;
    std::vector<Face> faces_;
    std::vector<double> depths_;
    std::vector<Mask> standing_;  // by depth: faces and pulls
    std::vector<double> lying_;   // by cell: the height; less than 0: nothing lies there
    std::vector<OaPlane> planes_;
};

}  // namespace popup::test
