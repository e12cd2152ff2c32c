#include "support/oa_rules.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

namespace popup::test {
namespace {

// To either side of an edge, well within a cell.
constexpr double kBeside = 1e-4;

}  // namespace

OaRules::OaRules(const std::string& json, double cell_mm) {
    const nlohmann::json root = nlohmann::json::parse(json);
    width_ = root["settings"]["cardW"];
    height_ = root["settings"]["cardH"];
    columns_ = static_cast<std::size_t>(width_ / cell_mm);
    rows_ = static_cast<std::size_t>(2.0 * height_ / cell_mm);
    const auto ring_of = [](const nlohmann::json& points) {
        Ring ring;
        for (const auto& p : points) ring.push_back({p["X"], p["Y"]});
        return ring;
    };
    for (const auto& one : root["faces"]) {
        Face face;
        face.mode = one.value("mode", 0);
        face.depth = one["t"];
        face.time = one.value("timestamp", 0.0);
        face.text = one.value("contoursType", "") == "expolygons";
        for (const auto& contour : one["contours"]) {
            Contour& made = face.contours.emplace_back();
            made.outer = ring_of(contour["outer"]);
            for (const auto& hole : contour["holes"]) made.holes.push_back(ring_of(hole));
        }
        faces_.push_back(std::move(face));
    }
    for (const Face& face : faces_) {
        if (face.mode != 1) depths_.push_back(face.depth);
    }
    std::sort(depths_.begin(), depths_.end());
    depths_.erase(std::unique(depths_.begin(), depths_.end()), depths_.end());

    const std::size_t cells = columns_ * rows_;
    for (const double depth : depths_) {
        Mask& mask = standing_.emplace_back(cells);
        for (std::size_t r = 0; r < rows_; ++r) {
            for (std::size_t c = 0; c < columns_; ++c)
                mask[r * columns_ + c] =
                    stands_at(depth, {x(c), y(r)}, [](const Face&) { return true; }) ? 1 : 0;
        }
    }
    lying_.assign(cells, -1.0);
    for (const double depth : depths_) run_back(depth);
    planes_.resize(cells);
    for (std::size_t r = 0; r < rows_; ++r) {
        for (std::size_t c = 0; c < columns_; ++c) {
            const std::size_t cell = r * columns_ + c;
            OaPlane& plane = planes_[cell];
            plane = {y(r) < 0.0, 0.0};
            for (std::size_t d = 0; d < depths_.size(); ++d) {
                const auto cut_out = [&](const Face& hole) {
                    return hole.mode == 1 && hole.text && depths_[d] <= hole.depth &&
                           inside(hole, {x(c), y(r)});
                };
                if (standing_[d][cell] != 0 && std::none_of(faces_.begin(), faces_.end(), cut_out))
                    plane = {true, depths_[d]};
            }
            if (lying_[cell] >= 0.0) plane = {false, lying_[cell]};
        }
    }
}

bool OaRules::clear(std::size_t column, std::size_t row, std::size_t by) const {
    if (column < by || row < by || column + by >= columns_ || row + by >= rows_) return false;
    const OaPlane here = plane(column, row);
    for (std::size_t r = row - by; r <= row + by; ++r) {
        for (std::size_t c = column - by; c <= column + by; ++c) {
            if (!(plane(c, r) == here)) return false;
        }
    }
    return true;
}

bool OaRules::in_hole(std::size_t column, std::size_t row) const {
    return std::any_of(faces_.begin(), faces_.end(), [&](const Face& face) {
        return face.mode == 1 && inside(face, {x(column), y(row)});
    });
}

bool OaRules::inside(const Ring& ring, Point p) {
    bool in = false;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const Point a = ring[i];
        const Point b = ring[j];
        if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) in = !in;
    }
    return in;
}

bool OaRules::inside(const Contour& contour, Point p) {
    return inside(contour.outer, p) &&
           std::none_of(contour.holes.begin(), contour.holes.end(),
                        [p](const Ring& hole) { return !hole.empty() && inside(hole, p); });
}

bool OaRules::inside(const Face& face, Point p) {
    return std::any_of(face.contours.begin(), face.contours.end(),
                       [p](const Contour& contour) { return inside(contour, p); });
}

bool OaRules::stands(const Face& face, Point p) const {
    if (face.mode == 1 || p.y > face.depth || !inside(face, p)) return false;
    if (p.x < 0.0 || p.x > width_ || p.y < -height_ || p.y > height_) return false;
    return std::none_of(faces_.begin(), faces_.end(), [&](const Face& hole) {
        if (hole.mode != 1 || hole.text || !inside(hole, p)) return false;
        if (face.depth != hole.depth) return face.depth < hole.depth;
        return face.time == 0.0 || face.time < hole.time;
    });
}

template <typename Which>
bool OaRules::stands_at(double depth, Point p, const Which& which) const {
    return std::any_of(faces_.begin(), faces_.end(), [&](const Face& face) {
        return face.depth == depth && which(face) && stands(face, p);
    });
}

// On the topmost edge of a text's contour.
bool OaRules::top_of_text(double depth, Point p) const {
    for (const Face& face : faces_) {
        if (face.mode != 0 || !face.text || face.depth != depth || !stands(face, {p.x, p.y + kBeside}))
            continue;
        for (const Contour& contour : face.contours) {
            double top = HUGE_VAL;
            for (std::size_t i = 0, j = contour.outer.size() - 1; i < contour.outer.size(); j = i++) {
                const Point a = contour.outer[i];
                const Point b = contour.outer[j];
                const Point middle{0.5 * (a.x + b.x), a.y};
                if (a.y == b.y && a.x != b.x && inside(contour.outer, {middle.x, middle.y + kBeside}) &&
                    !inside(contour.outer, {middle.x, middle.y - kBeside}))
                    top = std::min(top, a.y);
            }
            if (p.y == top && inside(contour, {p.x, p.y + kBeside})) return true;
        }
    }
    return false;
}

// From all upper edges of one depth.
void OaRules::run_back(double depth) {
    std::set<double> heights;  // Y of edges that may be upper ones
    for (const Face& face : faces_) {
        if (face.mode != 1 && face.depth != depth) continue;
        for (const Contour& contour : face.contours) {
            const auto note = [&heights](const Ring& ring) {
                for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
                    if (ring[i].y == ring[j].y) heights.insert(ring[i].y);
                }
            };
            note(contour.outer);
            for (const Ring& hole : contour.holes) note(hole);
        }
    }
    const auto plain = [](const Face& face) { return face.mode == 0 && !face.text; };
    const auto face_only = [](const Face& face) { return face.mode == 0; };
    // Where no face of the depth is; and of each pull, for nothing runs back from its outer edges, where that
    // is not.
    const auto open_of = [&](const auto& which) {
        Mask open(columns_ * rows_);
        for (std::size_t r = 0; r < rows_; ++r) {
            for (std::size_t c = 0; c < columns_; ++c)
                open[r * columns_ + c] = stands_at(depth, {x(c), y(r)}, which) ? 0 : 1;
        }
        return open;
    };
    const Mask open = open_of(face_only);
    std::vector<std::pair<const Face*, Mask>> pulls;
    for (const Face& face : faces_) {
        if (face.mode != 2 || face.depth != depth) continue;
        pulls.emplace_back(&face, open_of([&face](const Face& one) { return &one == &face; }));
    }
    for (const double edge : heights) {
        if (!(edge < depth) || edge <= -height_ || edge >= height_) continue;
        std::size_t row = 0;  // the last above the edge
        while (row + 1 < rows_ && y(row + 1) < edge) ++row;
        if (y(row) >= edge) continue;
        const auto upper_of_face = [&](std::size_t c) {
            const Point over{x(c), edge - kBeside};
            const Point under{x(c), edge + kBeside};
            if (stands_at(depth, over, face_only)) return false;
            return stands_at(depth, under, plain) || top_of_text(depth, {x(c), edge});
        };
        run_back(depth, edge, row, open, false, upper_of_face);
        for (const auto& [pull, open_pull] : pulls) {
            const auto upper_of_pull = [&, pull = pull](std::size_t c) {
                return stands(*pull, {x(c), edge + kBeside}) && !stands(*pull, {x(c), edge - kBeside});
            };
            run_back(depth, edge, row, open_pull, true, upper_of_pull);
        }
    }
}

// From the stretches of one edge that `is_upper` names, the row above which is `row`.
template <typename IsUpper>
void OaRules::run_back(double depth, double edge, std::size_t row, const Mask& open, bool only_openings,
                       const IsUpper& is_upper) {
    for (std::size_t c = 0; c < columns_; ++c) {
        if (!is_upper(c)) continue;
        std::size_t last = c;
        while (last + 1 < columns_ && is_upper(last + 1)) ++last;
        std::size_t from = c;
        std::size_t to = last;
        // Through an opening it is as wide as that.
        const bool through = opening(open, c, row, from, to);
        if (through || !only_openings) flood_back(depth, edge, c, last, from, to);
        c = last;
    }
}

// Whether the cell is in an opening that is closed all round; then from which column to which.
bool OaRules::opening(const Mask& open, std::size_t column, std::size_t row, std::size_t& from,
                      std::size_t& to) const {
    std::vector<std::size_t> waiting{row * columns_ + column};
    if (open[waiting[0]] == 0) return false;
    Mask seen(open.size());
    seen[waiting[0]] = 1;
    std::size_t least = column;
    std::size_t most = column;
    while (!waiting.empty()) {
        const std::size_t cell = waiting.back();
        waiting.pop_back();
        const std::size_t r = cell / columns_;
        const std::size_t c = cell % columns_;
        if (r == 0 || c == 0 || r + 1 == rows_ || c + 1 == columns_) return false;
        least = std::min(least, c);
        most = std::max(most, c);
        for (const std::size_t next : {cell - 1, cell + 1, cell - columns_, cell + columns_}) {
            if (open[next] == 0 || seen[next] != 0) continue;
            seen[next] = 1;
            waiting.push_back(next);
        }
    }
    from = least;
    to = most;
    return true;
}

void OaRules::flood_back(double depth, double edge, std::size_t first, std::size_t last, std::size_t from,
                         std::size_t to) {
    const auto free = [&](std::size_t c, std::size_t r) {
        if (c < from || c > to || y(r) > edge || y(r) < edge - depth) return false;
        for (std::size_t d = 0; d < depths_.size(); ++d) {
            if (standing_[d][r * columns_ + c] == 0) continue;
            if (depths_[d] >= depth || y(r) < edge - (depth - depths_[d])) return false;
        }
        return true;
    };
    std::size_t row = rows_;  // the first below the edge
    for (std::size_t r = 0; r < rows_ && row == rows_; ++r) {
        if (y(r) > edge) row = r;
    }
    if (row == 0) return;
    std::vector<std::size_t> waiting;
    Mask seen(columns_ * rows_);
    const auto visit = [&](std::size_t c, std::size_t r) {
        if (!free(c, r) || seen[r * columns_ + c] != 0) return;
        seen[r * columns_ + c] = 1;
        waiting.push_back(r * columns_ + c);
    };
    for (std::size_t c = first; c <= last; ++c) visit(c, row - 1);
    while (!waiting.empty()) {
        const std::size_t cell = waiting.back();
        waiting.pop_back();
        lying_[cell] = std::max(lying_[cell], depth - edge);
        const std::size_t r = cell / columns_;
        const std::size_t c = cell % columns_;
        if (c > 0) visit(c - 1, r);
        if (c + 1 < columns_) visit(c + 1, r);
        if (r > 0) visit(c, r - 1);
        if (r + 1 < rows_) visit(c, r + 1);
    }
}

}  // namespace popup::test
