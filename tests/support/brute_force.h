// Collisions by brute force: every pair of plates, triangle against triangle, at one angle after another.
//
// Slow and plain on purpose, so that the library's own search can be judged by it. It shares nothing with
// that search but place(): outlines are shrunk by GEOS, triangulated by CGAL and compared by CGAL's exact
// predicates. Needs CGAL (libcgal-dev); where the build has none, available() says so and nothing else may be
// used.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "popup/assembly.h"

namespace popup::test {

// The contract's numbers (see popup::Contact): plates cross where a common point lies further than kInsideMm
// inside the edges of both, and the largest circle of paper round it that lies on both stands more than
// kThroughMm out of the other plate on either side. Contact goes on until that is kEndMm.
inline constexpr double kInsideMm = 0.01;
inline constexpr double kThroughMm = 0.0025;
inline constexpr double kEndMm = 0.0001;
// Below 1° everything shrinks as the angle does.
inline double end_mm(double deg) { return kEndMm * (deg < 1.0 ? deg : 1.0); }

// Plates a < b that cross at an angle.
struct BruteContact {
    int a = 0, b = 0;
};

class BruteForce {
 public:
    // Whether the build has CGAL.
    static bool available();
    // The word to skip a test with where it has not.
    static constexpr const char* kMissing =
        "built without CGAL (libcgal-dev): no brute force to compare with";

    // The assembly must outlive this object. Precondition of all that follows: its linkages reach the angle.
    explicit BruteForce(const Assembly& assembly);
    ~BruteForce();
    BruteForce(BruteForce&&) noexcept;
    BruteForce& operator=(BruteForce&&) = delete;

    // All pairs that cross at this opening angle, by a, then b. Cost: plates squared, and for pairs near each
    // other the product of their triangles.
    [[nodiscard]] std::vector<BruteContact> crossing_at(double deg) const;
    // Whether two plates cross at this angle.
    [[nodiscard]] bool crosses(int a, int b, double deg) const;
    // How far the largest circle of paper round a common point, one that lies on both plates, stands out of
    // the other plate on either side, in mm, to 1e-6 mm; 0 when they have no common point.
    [[nodiscard]] double through(int a, int b, double deg) const;
    // First and last angle, within [0°, 180°] and to 1e-4°, of the contact that holds at `deg`: through() is
    // more than kEndMm. nullopt when it is not at `deg`. A gap of less than 0.01° may go unseen.
    [[nodiscard]] std::optional<std::pair<double, double>> contact_around(int a, int b, double deg) const;
    // Distance of two plates in mm, as they are (not shrunk); 0 where they meet. nullopt when one of them has
    // no area.
    [[nodiscard]] std::optional<double> closest(int a, int b, double deg) const;
    // Whether two plates have a common point, also of their edges, when b is moved by that. `shrunk`: a point
    // further than kInsideMm inside the edges of both.
    [[nodiscard]] bool meet_when_moved(int a, int b, double deg, Vec3 b_by, bool shrunk) const;
    // Exact tests of two triangles made so far.
    [[nodiscard]] std::size_t triangle_tests() const;

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace popup::test
