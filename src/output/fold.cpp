#include "output/fold.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/numbers.h"
#include "output/fold_mesh.h"
#include "output/poses.h"

namespace popup {
namespace {

constexpr int kDecimals = 6;
constexpr double kPieceGapMm = 10.0;
constexpr double kConvexMm = 2e-6;     // by so much a corner may point inwards and its face be convex
constexpr double kNearFlatDeg = 1e-3;  // this near to 0° or 180° rounding may turn the sign of a fold angle
constexpr double kMostBytes = std::numeric_limits<std::int32_t>::max();
constexpr double kBytesPerVertex = 48.0;  // of a folded frame, its share of the fold angles with it

std::size_t at(int number) { return static_cast<std::size_t>(number); }

// Where each piece's page has its origin in the crease pattern; `left` is where the first may begin, and then
// where one after the last may.
std::vector<Vec2> laid_out(const Assembly& assembly, const FoldMesh& mesh, double& left) {
    std::vector<Box> boxes(assembly.pieces.size());
    for (std::size_t i = 0; i < mesh.point.size(); ++i) {
        const int corner = static_cast<int>(i);
        boxes[at(assembly.plates[at(mesh.plate(corner))].piece)].extend(mesh.place(corner));
    }
    std::vector<Vec2> origins(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (boxes[i].empty()) continue;
        origins[i] = {rounded(left - boxes[i].min.x, kDecimals), rounded(-boxes[i].min.y, kDecimals)};
        left += boxes[i].width() + kPieceGapMm;
    }
    return origins;
}

bool all_convex(const FoldMesh& mesh) {
    for (std::size_t i = 0; i < mesh.point.size(); ++i) {
        const int b = mesh.next(static_cast<int>(i));
        const Vec2 in = mesh.place(b) - mesh.place(static_cast<int>(i));
        const Vec2 out = mesh.place(mesh.next(b)) - mesh.place(b);
        if (cross(in, out) < -kConvexMm * std::max(length(in), length(out))) return false;
    }
    return true;
}

// Of the side's edge: how far its faces are from flat, positive for a valley.
double fold_angle(const FoldMesh& mesh, std::span<const Frame> frames, int side) {
    const int twin = mesh.twin[at(side)];
    const char letter = mesh.letter[at(side)];
    if (twin < 0 || (letter != 'M' && letter != 'V')) return 0.0;
    // The side's own face lies on its left.
    const Frame& left = frames[at(mesh.plate(side))];
    const Frame& right = frames[at(mesh.plate(twin))];
    const Vec3 direction = left.direction(unit(mesh.place(mesh.next(side)) - mesh.place(side)));
    const double angle =
        std::atan2(dot(direction, cross(right.normal(), left.normal())), dot(left.normal(), right.normal())) *
        180.0 / std::numbers::pi;
    const double sign = letter == 'V' ? 1.0 : -1.0;
    if (std::abs(angle) > 180.0 - kNearFlatDeg) return sign * std::abs(angle);
    if (std::abs(angle) < kNearFlatDeg) return sign * std::max(0.0, sign * angle);
    return angle;
}

struct Card {
    const SceneCard* scene;
    FoldMesh mesh;
    std::vector<Vec2> origins;  // of each piece's page, in the crease pattern
    std::vector<Frame> frames;
    double shift = 0.0;  // of the folded card, along x
};

class FoldText {
 public:
    FoldText(std::span<const SceneCard> scenes, Diagnostics& diagnostics) : diagnostics_(diagnostics) {
        double left = 0.0;
        for (const SceneCard& scene : scenes) {
            const Assembly& assembly = *scene.assembly;
            Card card{&scene, fold_mesh(assembly), {}, {}};
            card.origins = laid_out(assembly, card.mesh, left);
            card.frames.resize(assembly.plates.size());
            vertices_ += card.mesh.vertex_corner.size();
            if (scene.motion != nullptr) {
                for (const Angle angle : scene.motion->angles)
                    angles_.push_back(rounded(angle.deg, kDecimals));
            }
            cards_.push_back(std::move(card));
        }
        std::sort(angles_.begin(), angles_.end());
        angles_.erase(std::unique(angles_.begin(), angles_.end()), angles_.end());
    }

    std::optional<std::string> write() {
        const double bytes =
            kBytesPerVertex * static_cast<double>(vertices_) * static_cast<double>(angles_.size() + 1);
        if (bytes > kMostBytes) {
            diagnostics_
                .error("model-too-large", {},
                       fmt::format("the model would be {:.0f} MB, {:.0f} MB are the most", 1e-6 * bytes,
                                   1e-6 * kMostBytes))
                .hint("ask for fewer angles, or write fewer designs into one model");
            return std::nullopt;
        }
        if (cards_.size() > 1 && !set_side_by_side()) return std::nullopt;
        write_file_keys();
        write_pattern();
        if (!angles_.empty()) {
            begin_key(1, "file_frames");
            begin_list();
            for (const double angle : angles_) {
                if (!place_all(angle)) return std::nullopt;
                next_row(2);
                write_folded(angle);
            }
            end_rows(1);
        }
        append("\n}\n");
        return fmt::to_string(out_);
    }

 private:
    // --- the cards in the world

    bool place_all(double angle_deg) {
        return std::all_of(cards_.begin(), cards_.end(), [&](Card& card) {
            return place_card(*card.scene->assembly, angle_deg, card.frames, diagnostics_);
        });
    }

    static Vec3 folded(const Card& card, int corner) {
        Vec3 p = card.frames[at(card.mesh.plate(corner))].point(card.mesh.place(corner));
        p.x += card.shift;
        return p;
    }

    bool set_side_by_side() {
        std::vector<std::pair<double, double>> extents(cards_.size(), {HUGE_VAL, -HUGE_VAL});
        for (const double angle : angles_) {
            if (!place_all(angle)) return false;
            for (std::size_t i = 0; i < cards_.size(); ++i) {
                auto& [low, high] = extents[i];
                for (const int corner : cards_[i].mesh.vertex_corner) {
                    const double x = folded(cards_[i], corner).x;
                    low = std::min(low, x);
                    high = std::max(high, x);
                }
            }
        }
        for (std::size_t i = 1; i < cards_.size() && !angles_.empty(); ++i) {
            const double left = cards_[i - 1].shift + extents[i - 1].second + kCardGapMm;
            cards_[i].shift = rounded(left - extents[i].first, kDecimals);
        }
        return true;
    }

    // --- what is written

    void write_file_keys() {
        std::string title;
        for (const Card& card : cards_) {
            title += (title.empty() ? "" : ", ") + card.scene->assembly->stem;
        }
        append("{\n  \"file_spec\": 1.2");
        text_key(1, "file_creator", "popupc " POPUP_VERSION);
        text_key(1, "file_title", title);
        list_key(1, "file_classes", {cards_.size() > 1 ? "multiModel" : "singleModel"});
    }

    // What frames say of themselves, but for how many dimensions they have.
    std::vector<std::string_view> attributes(std::string_view dimensions) const {
        bool joins = false;
        bool convex = true;
        for (const Card& card : cards_) {
            const auto& letters = card.mesh.letter;
            joins = joins || std::find(letters.begin(), letters.end(), 'J') != letters.end();
            convex = convex && all_convex(card.mesh);
        }
        return {dimensions,
                "manifold",
                "orientable",
                "noCuts",
                joins ? "joins" : "noJoins",
                convex ? "convexFaces" : "nonConvexFaces"};
    }

    void write_pattern() {
        text_key(1, "frame_title", "crease pattern");
        list_key(1, "frame_classes", {"creasePattern"});
        attributes_ = attributes("2D");
        list_key(1, "frame_attributes", attributes_);
        text_key(1, "frame_unit", "mm");
        begin_key(1, "vertices_coords");
        begin_list();
        for (const Card& card : cards_) {
            for (const int corner : card.mesh.vertex_corner) {
                const int piece = card.scene->assembly->plates[at(card.mesh.plate(corner))].piece;
                const Vec2 p = card.mesh.place(corner) + card.origins[at(piece)];
                next_row(2);
                numbers({p.x, p.y});
            }
        }
        end_rows(1);
        write_edges();
        write_faces();
    }

    void write_edges() {
        begin_key(1, "edges_vertices");
        begin_list();
        each_edge([this](const Card& card, int side, std::size_t vertex) {
            next_row(2);
            fmt::format_to(std::back_inserter(out_), "[{}, {}]", vertex + at(card.mesh.vertex[at(side)]),
                           vertex + at(card.mesh.vertex[at(card.mesh.next(side))]));
        });
        end_rows(1);
        begin_key(1, "edges_assignment");
        begin_list();
        each_edge([this](const Card& card, int side, std::size_t) {
            next_item();
            const char letter = card.mesh.letter[at(side)];
            quoted({&letter, 1});
        });
        end_items();
    }

    void write_faces() {
        begin_key(1, "faces_vertices");
        begin_list();
        std::size_t vertex = 0;
        for (const Card& card : cards_) {
            const FoldMesh& mesh = card.mesh;
            for (std::size_t f = 0; f < mesh.face_plate.size(); ++f) {
                next_row(2);
                std::string_view before = "[";
                for (std::size_t i = mesh.first[f]; i < mesh.first[f + 1]; ++i) {
                    fmt::format_to(std::back_inserter(out_), "{}{}", before, vertex + at(mesh.vertex[i]));
                    before = ", ";
                }
                append("]");
            }
            vertex += mesh.vertex_corner.size();
        }
        end_rows(1);
        face_names("faces_popupc:plate", [](const Assembly&, const Plate& plate) { return plate.name; });
        face_names("faces_popupc:piece", [](const Assembly& assembly, const Plate& plate) {
            return assembly.pieces[at(plate.piece)].name;
        });
    }

    template <typename Name>
    void face_names(std::string_view key, const Name& name) {
        begin_key(1, key);
        begin_list();
        for (const Card& card : cards_) {
            const Assembly& assembly = *card.scene->assembly;
            for (const int plate : card.mesh.face_plate) {
                next_row(2);
                quoted(card.scene->prefix + name(assembly, assembly.plates[at(plate)]));
            }
        }
        end_rows(1);
    }

    void write_folded(double angle_deg) {
        append("{");
        first_ = true;
        text_key(3, "frame_title", "open " + number_text(angle_deg, kDecimals) + "°");
        list_key(3, "frame_classes", {"foldedForm"});
        std::vector<Vec3> places;
        places.reserve(vertices_);
        bool level = true;
        for (const Card& card : cards_) {
            for (const int corner : card.mesh.vertex_corner) {
                places.push_back(folded(card, corner));
                level = level && rounded(places.back().z, kDecimals) == 0.0;
            }
        }
        attributes_.front() = level ? "2D" : "3D";
        list_key(3, "frame_attributes", attributes_);
        begin_key(3, "frame_parent");
        append("0");
        begin_key(3, "frame_inherit");
        append("true");
        begin_key(3, "popupc:angle_deg");
        append_number(out_, angle_deg, kDecimals);
        begin_key(3, "vertices_coords");
        begin_list();
        for (const Vec3 p : places) {
            next_row(4);
            numbers({p.x, p.y, p.z});
        }
        end_rows(3);
        begin_key(3, "edges_foldAngle");
        begin_list();
        each_edge([this](const Card& card, int side, std::size_t) {
            next_item();
            append_number(out_, fold_angle(card.mesh, card.frames, side), kDecimals);
        });
        append("]\n    }");
        first_ = false;
    }

    // Calls visit(card, the edge's side, number of the card's first vertex) for each edge.
    template <typename Visit>
    void each_edge(const Visit& visit) const {
        std::size_t vertex = 0;
        for (const Card& card : cards_) {
            for (const int side : card.mesh.edge_side) visit(card, side, vertex);
            vertex += card.mesh.vertex_corner.size();
        }
    }

    // --- JSON

    void append(std::string_view text) { out_.append(text.data(), text.data() + text.size()); }
    void quoted(std::string_view text) {
        append(nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    }
    void next_item() {
        if (!first_) append(", ");
        first_ = false;
    }
    void next_row(std::size_t depth) {
        if (!first_) append(",");
        first_ = false;
        append("\n");
        append(std::string(2 * depth, ' '));
    }
    void begin_key(std::size_t depth, std::string_view key) {
        next_row(depth);
        quoted(key);
        append(": ");
    }
    void begin_list() {
        append("[");
        first_ = true;
    }
    void end_items() {
        append("]");
        first_ = false;
    }
    void end_rows(std::size_t depth) {
        append("\n");
        append(std::string(2 * depth, ' '));
        end_items();
    }
    void text_key(std::size_t depth, std::string_view key, std::string_view text) {
        begin_key(depth, key);
        quoted(text);
    }
    void list_key(std::size_t depth, std::string_view key, const std::vector<std::string_view>& texts) {
        begin_key(depth, key);
        begin_list();
        for (const std::string_view text : texts) {
            next_item();
            quoted(text);
        }
        end_items();
    }
    void numbers(std::initializer_list<double> values) {
        std::string_view before = "[";
        for (const double value : values) {
            append(before);
            append_number(out_, value, kDecimals);
            before = ", ";
        }
        append("]");
    }

    Diagnostics& diagnostics_;
    std::vector<Card> cards_;
    std::vector<double> angles_;
    std::size_t vertices_ = 0;
    std::vector<std::string_view> attributes_;
    fmt::memory_buffer out_;
    bool first_ = false;  // nothing stands yet in the list or object that is open
};

}  // namespace

std::optional<std::string> write_fold(std::span<const SceneCard> cards, const OutputOptions& /*options*/,
                                      Diagnostics& diagnostics) {
    POPUP_INVARIANT(!cards.empty());
    return FoldText(cards, diagnostics).write();
}

}  // namespace popup
