#include "gluing/flat_pieces.h"

#include <algorithm>
#include <utility>

#include "base/geometry/edge_index.h"
#include "base/geometry/pages.h"
#include "base/geometry/regions.h"
#include "base/nth.h"

namespace popup {
namespace {

constexpr double kBesideWallMm = 0.5;   // what is nearer to an edge of the paper may stand beside it
constexpr double kWallMm = 1.0;         // a shorter one bends aside
constexpr double kSharedMm2 = 1.0;      // of two flat pieces
constexpr std::size_t kMostNear = 200;  // earlier pieces that one is held against

double length_inside(const Segment& line, const Polygon& paper) {
    double length = 0.0;
    for (const std::vector<Vec2>& part : clip_line({line.a, line.b}, paper))
        length += distance(part.front(), part.back());
    return length;
}

// What lies flat on one side of one plate.
struct Bed {
    struct Flat {
        int piece = 0;
        bool is_on_it = false;  // and not on something else that is
        Polygon paper;          // on the page of the plate
    };
    std::vector<Flat> flats;
    EdgeIndex boxes;  // of their paper, by their diagonals

    [[nodiscard]] std::vector<int> near(const Box& box) const {
        std::vector<int> found;
        boxes.query(box, found);
        return found;
    }
};

class FlatBefore {
 public:
    FlatBefore(const Assembly& assembly, const GluingOrder& order, const GluePoses& poses)
        : in_(assembly), order_(order), frames_(poses.reach) {
        for (std::size_t i = 0; i < in_.plates.size(); ++i) add_flat(static_cast<int>(i));
    }

    std::map<int, std::set<int>> run(const std::vector<Bond>& bonds) {
        for (const Bond& bond : bonds) {
            if (bond.kind == Bond::Kind::tab && !bond.theirs) add_wall(bond);
        }
        for (const auto& [of, bed] : beds_) add_collage(bed);
        return std::move(before_);
    }

 private:
    // On what it lies on, and on what that lies on.
    void add_flat(int number) {
        const Polygon& outline = nth(in_.plates, number).outline;
        const int piece = nth(in_.plates, number).piece;
        if (outline.outer.empty()) return;
        bool is_on_it = true;
        for (int one = number;; one = nth(in_.plates, one).parent) {
            const Plate& plate = nth(in_.plates, one);
            const bool on_back = plate.lying == Lying::on_back;
            if ((plate.lying != Lying::on_front && !on_back) || plate.rivet || plate.parent < 0 ||
                nth(in_.plates, plate.parent).piece == piece)
                return;
            Bed& bed = beds_[{plate.parent, on_back}];
            bed.flats.push_back(
                {piece, is_on_it, on_other_page(outline, nth(frames_, number), nth(frames_, plate.parent))});
            const Box box = bounds(bed.flats.back().paper.outer);
            bed.boxes.insert({box.min, box.max}, false);
            if (on_back) return;
            is_on_it = false;
        }
    }
    [[nodiscard]] int member(int piece, int ground) const {
        while (piece >= 0 && nth(order_.bearers, piece) != ground) piece = nth(order_.bearers, piece);
        return piece;
    }
    void add(int first, int then) {
        const int ground = nth(order_.bearers, then);
        if (ground < 0) return;
        const int one = member(first, ground);
        if (one >= 0 && one != then) before_[then].insert(one);
    }

    void add_wall(const Bond& bond) {
        const auto bed = beds_.find({bond.mate, bond.on_back});
        if (bed == beds_.end()) return;
        const Plate& wall = nth(in_.plates, bond.plate);
        if (wall.lying != Lying::free && wall.parent == bond.mate) return;
        const Segment& seam = nth(in_.glue, bond.number).on_base;
        if (distance(seam.a, seam.b) <= kWallMm) return;
        const Vec2 aside = kBesideWallMm * left_of(unit(seam.b - seam.a));
        for (const int number : bed->second.near(bounds({seam.a, seam.b}))) {
            const Bed::Flat& flat = nth(bed->second.flats, number);
            if (flat.piece == wall.piece) continue;
            if (length_inside({seam.a + aside, seam.b + aside}, flat.paper) > kWallMm &&
                length_inside({seam.a - aside, seam.b - aside}, flat.paper) > kWallMm)
                add(flat.piece, wall.piece);
        }
    }

    void add_collage(const Bed& bed) {
        for (std::size_t i = 0; i < bed.flats.size(); ++i) {
            const Bed::Flat& flat = bed.flats[i];
            if (!flat.is_on_it || !is_pasted(flat.piece)) continue;
            std::vector<int> earlier = bed.near(bounds(flat.paper.outer));
            std::erase_if(earlier, [&](int number) {
                const Bed::Flat& other = nth(bed.flats, number);
                return other.piece >= flat.piece || !other.is_on_it || !is_pasted(other.piece);
            });
            if (earlier.size() > kMostNear)
                earlier.erase(earlier.begin(), earlier.end() - static_cast<std::ptrdiff_t>(kMostNear));
            for (const int number : earlier) {
                const Bed::Flat& other = nth(bed.flats, number);
                if (area(intersect({flat.paper}, {other.paper})) > kSharedMm2) add(other.piece, flat.piece);
            }
        }
    }
    // Over an area. Straps that lie on both planes of a ridge are glued by tabs beside them.
    [[nodiscard]] bool is_pasted(int piece) {
        if (pasted_.empty()) {
            pasted_.assign(in_.pieces.size(), 0);
            for (const GluedArea& glued : in_.glued_areas)
                nth(pasted_, nth(in_.plates, glued.plate).piece) = 1;
        }
        return nth(pasted_, piece) != 0;
    }

    const Assembly& in_;
    const GluingOrder& order_;
    const std::vector<Frame>& frames_;
    std::map<std::pair<int, bool>, Bed> beds_;  // by plate and side
    std::vector<char> pasted_;
    std::map<int, std::set<int>> before_;
};

}  // namespace

std::map<int, std::set<int>> flat_before(const Assembly& assembly, const std::vector<Bond>& bonds,
                                         const GluingOrder& order, const GluePoses& poses) {
    if (poses.empty()) return {};
    return FlatBefore(assembly, order, poses).run(bonds);
}

}  // namespace popup
