#include "output/fold.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/numbers.h"
#include "output/fold_json.h"
#include "output/fold_mesh.h"
#include "output/fold_sources.h"
#include "output/poses.h"
#include "popup/crease_pattern.h"

namespace popup {
namespace {

constexpr int kDecimals = FoldJson::kDecimals;
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

bool is_flat_fold(double angle_deg, const FoldMesh& mesh, int side) {
    const char letter = mesh.letter[at(side)];
    return std::abs(angle_deg) < kNearFlatDeg && (letter == 'M' || letter == 'V');
}

// Of the side's edge: how far its faces are from flat, positive for a valley.
double fold_angle(const FoldMesh& mesh, std::span<const Frame> frames, int side) {
    const int twin = mesh.twin[at(side)];
    const char letter = mesh.letter[at(side)];
    if (twin < 0 || (letter != 'M' && letter != 'V' && letter != 'F')) return 0.0;
    // The side's own face lies on its left.
    const Frame& left = frames[at(mesh.plate(side))];
    const Frame& right = frames[at(mesh.plate(twin))];
    const Vec3 direction = left.direction(unit(mesh.place(mesh.next(side)) - mesh.place(side)));
    const double angle =
        std::atan2(dot(direction, cross(right.normal(), left.normal())), dot(left.normal(), right.normal())) *
        180.0 / std::numbers::pi;
    if (letter == 'F') return angle;  // a panel that bends
    const double sign = letter == 'V' ? 1.0 : -1.0;
    if (std::abs(angle) > 180.0 - kNearFlatDeg) return sign * std::abs(angle);
    if (std::abs(angle) < kNearFlatDeg) return sign * std::max(0.0, sign * angle);
    return angle;
}

struct Card {
    const SceneCard* scene;
    FoldMesh mesh;
    FoldMesh sheet;             // with its slits drawn
    std::vector<Vec2> origins;  // of each piece's page, in the crease pattern
    std::vector<Frame> frames;
    double shift = 0.0;  // of the folded card, along x
};
using Mesh = FoldMesh Card::*;

bool stands(const Assembly& assembly) {
    return !moves(assembly) && std::all_of(assembly.plates.begin(), assembly.plates.end(),
                                           [](const Plate& plate) { return plate.stands.has_value(); });
}

// Places the plates; false: they do not get there. A plate of which nothing says where it stands lies as it
// is drawn.
bool place_at(Card& card, double angle_deg, Diagnostics& diagnostics) {
    const Assembly& assembly = *card.scene->assembly;
    if (moves(assembly)) return place_card(assembly, angle_deg, card.frames, diagnostics);
    std::transform(assembly.plates.begin(), assembly.plates.end(), card.frames.begin(),
                   [](const Plate& plate) { return plate.stands.value_or(Frame{}); });
    return true;
}
// Whether that place is reached is told of where it is asked for.
bool place_at(Card& card, double angle_deg) {
    Diagnostics unheard;
    return place_at(card, angle_deg, unheard);
}

// Where it is folded as far as it goes.
bool place_last(Card& card) { return place_at(card, card.scene->assembly->sweep.from_deg); }

// Folds that do not say which way they go have the letter of the way they went, those that went none F.
void name_folds(Card& card) {
    const Sweep& sweep = card.scene->assembly->sweep;
    FoldMesh& mesh = card.mesh;
    // Half a turn has no sign: the middle of the motion has.
    for (const double deg : {0.5 * (sweep.from_deg + sweep.to_deg), sweep.from_deg}) {
        if (!place_at(card, deg)) return;
        for (const int side : mesh.edge_side) {
            if (mesh.letter[at(side)] != 'U') continue;
            mesh.letter[at(side)] = 'V';
            const double angle = fold_angle(mesh, card.frames, side);
            char letter = angle < 0.0 ? 'M' : 'V';
            if (std::abs(angle) < kNearFlatDeg) letter = deg == sweep.from_deg ? 'F' : 'U';
            mesh.letter[at(side)] = mesh.letter[at(mesh.twin[at(side)])] = letter;
        }
    }
}

bool has_letter(const FoldMesh& mesh, char letter) {
    return std::find(mesh.letter.begin(), mesh.letter.end(), letter) != mesh.letter.end();
}

class FoldText : private FoldJson {
 public:
    FoldText(std::span<const SceneCard> scenes, FoldDialect dialect, Diagnostics& diagnostics)
        : diagnostics_(diagnostics) {
        const bool strict = dialect == FoldDialect::strict;
        double left = 0.0;
        for (const SceneCard& scene : scenes) {
            const Assembly& assembly = *scene.assembly;
            Card card{&scene, fold_mesh(assembly), {}, {}, {}};
            card.origins = laid_out(assembly, card.mesh, left);
            card.frames.resize(assembly.plates.size());
            angles_known_ = place_last(card) && (moves(assembly) || stands(assembly)) && angles_known_;
            if (!strict) {
                std::replace(card.mesh.letter.begin(), card.mesh.letter.end(), 'J', 'F');
                name_folds(card);
            }
            if (strict) card.sheet = fold_mesh(assembly, FoldSlits::drawn);
            if (has_letter(card.sheet, 'C')) key_mesh_ = &Card::sheet;
            vertices_ += card.mesh.vertex_corner.size();
            if (scene.motion != nullptr) {
                for (const Angle angle : scene.motion->angles)
                    angles_.push_back(rounded(angle.deg, kDecimals));
            }
            cards_.push_back(std::move(card));
        }
        if (cards_.size() == 1 && scenes.front().creases != nullptr)
            carried_ = &scenes.front().creases->carried;
        take_carried_orders();
        std::sort(angles_.begin(), angles_.end());
        angles_.erase(std::unique(angles_.begin(), angles_.end()), angles_.end());
        still_ = std::all_of(scenes.begin(), scenes.end(),
                             [](const SceneCard& scene) { return stands(*scene.assembly); });
        if (still_) angles_ = {0.0};
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
        write_key_frame();
        folded_attributes_ = attributes(&Card::mesh, "3D");
        const bool slit = key_mesh_ != &Card::mesh;
        if (slit || !angles_.empty()) {
            begin_key(1, "file_frames");
            begin_list();
            if (slit) {
                next_row(2);
                write_cut_open();
            }
            for (const double angle : angles_) {
                if (!place_all(angle)) return std::nullopt;
                next_row(2);
                write_folded(angle, slit ? 1 : 0);
            }
            end_rows(1);
        }
        tell_left_out();
        append("\n}\n");
        return text();
    }

 private:
    // --- the cards in the world

    bool place_all(double angle_deg) {
        return std::all_of(cards_.begin(), cards_.end(),
                           [&](Card& card) { return place_at(card, angle_deg, diagnostics_); });
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
        if (!is_carried("file_title")) text_key(1, "file_title", title);
        words_key("file_classes", {cards_.size() > 1 ? "multiModel" : "singleModel"});
        for (const CarriedKeys::Member& member : carried_->members) {
            if (member.key.starts_with("file_")) member_key(member);
        }
    }

    [[nodiscard]] bool is_carried(std::string_view key) const {
        return std::any_of(carried_->members.begin(), carried_->members.end(),
                           [key](const CarriedKeys::Member& member) { return member.key == key; });
    }

    void member_key(const CarriedKeys::Member& member) {
        for (const std::string_view merged :
             {"file_classes", "frame_classes", "frame_attributes", "faceOrders"}) {
            if (member.key == merged) return;
        }
        begin_key(1, member.key);
        append(member.json);
    }

    // What popupc says under this key of the key frame, and after it what the file said in other names.
    void words_key(std::string_view key, std::vector<std::string_view> words) {
        const std::vector<std::string> more = own_words(*carried_, key);
        words.insert(words.end(), more.begin(), more.end());
        list_key(1, key, words);
    }

    // What frames say of themselves, but for how many dimensions they have.
    [[nodiscard]] std::vector<std::string_view> attributes(Mesh which, std::string_view dimensions) const {
        bool joins = false;
        bool cuts = false;
        bool convex = true;
        for (const Card& card : cards_) {
            joins = joins || has_letter(card.*which, 'J');
            cuts = cuts || has_letter(card.*which, 'C');
            convex = convex && all_convex(card.*which);
        }
        return {dimensions,
                "manifold",
                "orientable",
                cuts ? "cuts" : "noCuts",
                joins ? "joins" : "noJoins",
                convex ? "convexFaces" : "nonConvexFaces"};
    }

    void write_key_frame() {
        if (!is_carried("frame_title")) text_key(1, "frame_title", "crease pattern");
        words_key("frame_classes", {"creasePattern"});
        words_key("frame_attributes", attributes(key_mesh_, "2D"));
        text_key(1, "frame_unit", "mm");
        for (const CarriedKeys::Member& member : carried_->members) {
            if (!member.key.starts_with("file_")) member_key(member);
        }
        write_pattern(key_mesh_, 1);
        if (carried_orders_) write_orders(*carried_orders_, 1);
    }

    // The pattern again with its slits open, for folded frames to inherit.
    void write_cut_open() {
        begin_object();
        text_key(3, "frame_title", "crease pattern, slits open");
        list_key(3, "frame_classes", {"creasePattern"});
        list_key(3, "frame_attributes", attributes(&Card::mesh, "2D"));
        begin_key(3, "frame_parent");
        append("0");
        begin_key(3, "frame_inherit");
        append("true");
        write_pattern(&Card::mesh, 3);
        end_object(2);
    }

    void write_pattern(Mesh which, std::size_t depth) {
        begin_key(depth, "vertices_coords");
        begin_list();
        for (const Card& card : cards_) {
            const FoldMesh& mesh = card.*which;
            for (const int corner : mesh.vertex_corner) {
                const int piece = card.scene->assembly->plates[at(mesh.plate(corner))].piece;
                const Vec2 p = mesh.place(corner) + card.origins[at(piece)];
                next_row(depth + 1);
                numbers({p.x, p.y});
            }
        }
        end_rows(depth);
        write_edges(which, depth);
        write_faces(which, depth);
        if (carried_->vertices.empty() && carried_->edges.empty() && carried_->faces.empty()) return;
        const FoldSources sources = fold_sources(cards_.front().*which, *carried_);
        write_columns(carried_->vertices, sources.vertices, depth);
        write_columns(carried_->edges, sources.edges, depth);
        write_columns(carried_->faces, sources.faces, depth);
    }

    void write_columns(const std::vector<CarriedKeys::Column>& columns, const std::vector<int>& sources,
                       std::size_t depth) {
        for (const CarriedKeys::Column& column : columns) {
            begin_key(depth, column.key);
            begin_list();
            for (const int source : sources) {
                next_row(depth + 1);
                append(source < 0 ? "null" : std::string_view(column.json[at(source)]));
            }
            end_rows(depth);
        }
    }

    void write_edges(Mesh which, std::size_t depth) {
        begin_key(depth, "edges_vertices");
        begin_list();
        std::vector<std::size_t> corners;
        each_edge(which, [&](const Card& card, int side, std::size_t vertex) {
            const FoldMesh& mesh = card.*which;
            next_row(depth + 1);
            corners = {vertex + at(mesh.vertex[at(side)]), vertex + at(mesh.vertex[at(mesh.next(side))])};
            indices(corners);
        });
        end_rows(depth);
        begin_key(depth, "edges_assignment");
        begin_list();
        each_edge(which, [&](const Card& card, int side, std::size_t) {
            next_item();
            const char letter = (card.*which).letter[at(side)];
            quoted({&letter, 1});
        });
        end_items();
        if (!angles_known_) return;
        for (Card& card : cards_) place_last(card);
        write_fold_angles(which, depth, true);
    }

    // `asked`: folds that stay flat have the angle that their pattern asks for.
    void write_fold_angles(Mesh which, std::size_t depth, bool asked) {
        begin_key(depth, "edges_foldAngle");
        begin_list();
        for (const Card& card : cards_) {
            const FoldMesh& mesh = card.*which;
            std::vector<double> angles;
            bool flat = false;
            for (const int side : mesh.edge_side) {
                const bool bends = mesh.letter[at(side)] == 'F';
                angles.push_back(asked && bends ? 0.0 : fold_angle(mesh, card.frames, side));
                flat = flat || is_flat_fold(angles.back(), mesh, side);
            }
            if (asked && flat && card.scene->creases != nullptr) {
                const std::vector<double> wanted = asked_angles(mesh, *card.scene->creases);
                for (std::size_t i = 0; i < angles.size(); ++i) {
                    const int side = mesh.edge_side[i];
                    if (is_flat_fold(angles[i], mesh, side))
                        angles[i] = mesh.letter[at(side)] == 'M' ? -wanted[i] : wanted[i];
                }
            }
            for (const double angle : angles) {
                next_item();
                number(angle);
            }
        }
        end_items();
    }

    void write_faces(Mesh which, std::size_t depth) {
        begin_key(depth, "faces_vertices");
        begin_list();
        std::size_t vertex = 0;
        std::vector<std::size_t> corners;
        for (const Card& card : cards_) {
            const FoldMesh& mesh = card.*which;
            for (std::size_t f = 0; f < mesh.face_plate.size(); ++f) {
                next_row(depth + 1);
                corners.clear();
                for (std::size_t i = mesh.first[f]; i < mesh.first[f + 1]; ++i)
                    corners.push_back(vertex + at(mesh.vertex[i]));
                indices(corners);
            }
            vertex += mesh.vertex_corner.size();
        }
        end_rows(depth);
        // Both meshes have the same faces, and frames inherit their names.
        if (which != key_mesh_) return;
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

    void write_folded(double angle_deg, int parent) {
        begin_object();
        text_key(3, "frame_title",
                 still_ ? "as it stands" : "open " + number_text(angle_deg, kDecimals) + "°");
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
        folded_attributes_.front() = level ? "2D" : "3D";
        list_key(3, "frame_attributes", folded_attributes_);
        begin_key(3, "frame_parent");
        append(fmt::format("{}", parent));
        begin_key(3, "frame_inherit");
        append("true");
        if (!still_) {
            begin_key(3, "popupc:angle_deg");
            number(angle_deg);
        }
        begin_key(3, "vertices_coords");
        begin_list();
        for (const Vec3 p : places) {
            next_row(4);
            numbers({p.x, p.y, p.z});
        }
        end_rows(3);
        write_fold_angles(&Card::mesh, 3, false);
        write_face_orders(3);
        end_object(2);
    }

    [[nodiscard]] bool has_layers() const {
        return std::any_of(cards_.begin(), cards_.end(),
                           [](const Card& card) { return !card.scene->assembly->layers.empty(); });
    }

    void write_face_orders(std::size_t depth) {
        if (!has_layers()) return;
        std::vector<std::array<int, 3>> orders;
        int face = 0;
        for (const Card& card : cards_) {
            const Assembly& assembly = *card.scene->assembly;
            std::vector<std::vector<int>> faces(assembly.plates.size());
            for (const int plate : card.mesh.face_plate) faces[at(plate)].push_back(face++);
            for (const PlateOrder& order : assembly.layers) {
                for (const int above : faces[at(order.plate)]) {
                    for (const int base : faces[at(order.base)])
                        orders.push_back({above, base, order.on_front ? 1 : -1});
                }
            }
        }
        write_orders(orders, depth);
    }

    void write_orders(const std::vector<std::array<int, 3>>& orders, std::size_t depth) {
        begin_key(depth, "faceOrders");
        begin_list();
        for (const auto& [above, base, side] : orders) {
            next_row(depth + 1);
            numbers({static_cast<double>(above), static_cast<double>(base), static_cast<double>(side)});
        }
        end_rows(depth);
    }

    // Those of the file, if each of its faces is one of the sheet's, and no other order was found.
    void take_carried_orders() {
        if (has_layers()) return;
        const auto orders = std::find_if(carried_->members.begin(), carried_->members.end(),
                                         [](const auto& member) { return member.key == "faceOrders"; });
        if (orders == carried_->members.end()) return;
        const FoldMesh& mesh = cards_.front().mesh;
        carried_orders_ = face_orders(mesh, *carried_, fold_sources(mesh, *carried_), orders->json);
    }

    // What the files that were read say and this one does not.
    void tell_left_out() {
        for (const Card& card : cards_) {
            if (card.scene->creases == nullptr) continue;
            const CarriedKeys& carried = card.scene->creases->carried;
            const std::string& file = card.scene->creases->file;
            std::vector<std::string> what = carried.left_out;
            if (is_carried("faceOrders") && !carried_orders_) what.emplace_back("faceOrders");
            if (cards_.size() > 1) {
                for (const CarriedKeys::Member& member : carried.members) what.push_back(member.key);
                for (const auto* columns : {&carried.vertices, &carried.edges, &carried.faces}) {
                    for (const CarriedKeys::Column& column : *columns) what.push_back(column.key);
                }
            }
            if (carried.other_frames > 0)
                what.push_back(fmt::format("{} of its frames", carried.other_frames));
            if (what.empty()) continue;
            diagnostics_
                .remark("fold-left-out", {},
                        fmt::format("of {} these are not written: {}", file, fmt::join(what, ", ")))
                .hint("\"popupc explain fold-left-out\" says why, and what is kept");
        }
    }

    // Calls visit(card, the edge's side, number of the card's first vertex) for each edge.
    template <typename Visit>
    void each_edge(Mesh which, const Visit& visit) const {
        std::size_t vertex = 0;
        for (const Card& card : cards_) {
            const FoldMesh& mesh = card.*which;
            for (const int side : mesh.edge_side) visit(card, side, vertex);
            vertex += mesh.vertex_corner.size();
        }
    }

    Diagnostics& diagnostics_;
    std::vector<Card> cards_;
    std::vector<double> angles_;
    std::size_t vertices_ = 0;
    Mesh key_mesh_ = &Card::mesh;  // of the key frame
    std::vector<std::string_view> folded_attributes_;
    bool angles_known_ = true;  // at the end of the motion
    bool still_ = false;        // nothing moves, and it is known where it stands
    CarriedKeys none_carried_;
    const CarriedKeys* carried_ = &none_carried_;
    std::optional<std::vector<std::array<int, 3>>> carried_orders_;
};

}  // namespace

std::optional<std::string> write_fold(std::span<const SceneCard> cards, const OutputOptions& options,
                                      Diagnostics& diagnostics) {
    POPUP_INVARIANT(!cards.empty());
    return FoldText(cards, options.fold_dialect, diagnostics).write();
}

}  // namespace popup
