#include "output/viewer/scene_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "assembly/folded_sheets.h"
#include "base/text/base64.h"
#include "base/text/numbers.h"
#include "output/apart.h"
#include "output/examination_json.h"
#include "output/gltf_values.h"
#include "output/mesh.h"
#include "output/plate_edges.h"
#include "output/poses.h"
#include "output/space_mesh.h"
#include "output/still/camera.h"
#include "output/still/model.h"
#include "popup/image.h"

namespace popup {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostBytes = 400'000'000;
constexpr int kLengthDecimals = 6;
constexpr double kPerPointMm = 1e2;
constexpr double kPerTurn = 2e5;
constexpr double kPerPlace = 1e6;
constexpr double kPerLayer = 1e2;

std::int64_t in_steps(double value, double per_unit) {
    // Rounded before, so that the last bit of a number does not decide where it lies in the middle.
    return std::llround(rounded(value, 9) * per_unit);
}

// A list of numbers as scene_json.h says.
class NumberText {
 public:
    explicit NumberText(std::size_t stride) : last_(stride, 0) {}

    void add(std::int64_t value) {
        std::int64_t& last = last_[count_++ % last_.size()];
        const std::int64_t step = value - std::exchange(last, value);
        std::uint64_t rest = (static_cast<std::uint64_t>(std::abs(step)) << 1U) | (step < 0 ? 1U : 0U);
        do {
            const std::uint64_t digit = rest & 31U;
            rest >>= 5U;
            text_ += kDigits[digit + (rest > 0 ? 32U : 0U)];
        } while (rest > 0);
    }
    void add(Vec2 p) {
        add(in_steps(p.x, kPerPointMm));
        add(in_steps(p.y, kPerPointMm));
    }
    void add(Vec3 p) {
        add(Vec2{p.x, p.y});
        add(in_steps(p.z, kPerPointMm));
    }
    [[nodiscard]] std::string take() { return std::move(text_); }

 private:
    static constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<std::int64_t> last_;
    std::size_t count_ = 0;
    std::string text_;
};

Json lengths(std::initializer_list<double> values) {
    Json list = Json::array();
    for (const double value : values) list.push_back(rounded(value, kLengthDecimals));
    return list;
}

std::string root_name(const SceneCard& card) {
    std::string_view name = card.prefix;
    if (name.ends_with(':')) {
        name.remove_suffix(1);
    } else {
        name = card.assembly->stem;
    }
    if (name.empty()) return moves(*card.assembly) ? "card" : "parts";
    return valid_utf8(name);
}

class SceneText {
 public:
    SceneText(const still::Modeller& modeller, bool printed_backs)
        : modeller_(modeller), printed_backs_(printed_backs) {}

    Json add_card(const SceneCard& card, std::size_t number, const HingeTree& tree, const Track& track,
                  Orientation orientation) {
        number_ = number;
        Json row{{"name", root_name(card)}};
        if (orientation == Orientation::upright) row["upright"] = true;
        if (orientation == Orientation::stage) {
            const int ground = card.assembly->covers.back();
            row["ground"] = std::find(tree.order.begin(), tree.order.end(), ground) - tree.order.begin();
        }
        if (is_folded_sheet(*card.assembly)) row["settles"] = true;
        folds_ = folds_of_plates(*card.assembly);
        if (moves(*card.assembly)) add_moving(card, tree, track, row);
        Json standing = footings_of(card);
        if (!standing.empty()) row["standing"] = std::move(standing);
        return row;
    }

    Json take_pictures() { return std::move(pictures_); }
    Json take_lists() { return std::move(lists_); }

 private:
    // The number of a picture: the same for all that shows the same file.
    std::size_t picture(const Image& image) {
        const auto [at, is_new] = numbers_.try_emplace(*image.bytes, pictures_.size());
        if (is_new) {
            pictures_.push_back("data:" + std::string(mime_type(image.format)) + ";base64," +
                                base64(*image.bytes));
        }
        return at->second;
    }

    // Names a list: the same number for all that are equal. Empty ones are left out.
    void put(Json& row, const char* name, NumberText& numbers) {
        const auto [at, is_new] = list_numbers_.try_emplace(numbers.take(), lists_.size());
        if (at->first.empty()) {
            list_numbers_.erase(at);
            return;
        }
        if (is_new) lists_.push_back(at->first);
        row[name] = at->second;
    }

    void put_triangles(Json& row, const std::vector<std::uint32_t>& indices) {
        NumberText text(1);
        for (const std::uint32_t index : indices) text.add(index);
        put(row, "triangles", text);
    }

    Json paint(const Image* image, Color color) {
        Json row = Json::object();
        if (image != nullptr) {
            row["picture"] = picture(*image);
        } else if (!(color == Color{})) {
            row["color"] = to_string(color);
        }
        return row;
    }

    Json mesh(const MeshPart& part, Vec2 pivot) {
        Json row = paint(part.image, part.color);
        if (part.back) row["back"] = to_string(*part.back);
        if (part.lift_mm != 0.0) row["lift"] = rounded(part.lift_mm, kLengthDecimals);
        NumberText points(2);
        for (const Vec2 p : part.points) points.add(p);
        put(row, "points", points);
        put_triangles(row, part.indices);
        if (part.image != nullptr) {
            // Places in a picture are affine in the points.
            const std::vector<Vec2> at = pixels_at(*part.image, {{0, 0}, {1, 0}, {0, 1}}, pivot);
            const double width = part.image->width;
            const double height = part.image->height;
            Json place = Json::array();
            for (const double value :
                 {(at[1].x - at[0].x) / width, (at[2].x - at[0].x) / width, at[0].x / width,
                  (at[1].y - at[0].y) / height, (at[2].y - at[0].y) / height, at[0].y / height}) {
                place.push_back(rounded(value, 9));
            }
            row["place"] = std::move(place);
        }
        return row;
    }

    Json mesh(const SpaceMesh& one) {
        Json row = paint(one.image, one.color);
        if (one.back) row["back"] = to_string(*one.back);
        if (one.drawn) row["drawn"] = true;
        NumberText points(3);
        for (const Vec3 p : one.points) points.add(p);
        put(row, "points", points);
        put_triangles(row, one.indices);
        if (one.image != nullptr) {
            NumberText places(2);
            for (const Vec2 p : one.pixels) {
                places.add(in_steps(p.x / one.image->width, kPerPlace));
                places.add(in_steps(p.y / one.image->height, kPerPlace));
            }
            put(row, "places", places);
        }
        return row;
    }

    void add_moving(const SceneCard& card, const HingeTree& tree, const Track& track, Json& row) {
        const Assembly& assembly = *card.assembly;
        const std::size_t count = assembly.plates.size();
        std::vector<int> number(count, 0);  // of each plate, among the page's
        for (std::size_t i = 0; i < count; ++i) {
            number[static_cast<std::size_t>(tree.order[i])] = static_cast<int>(i);
        }
        Apart apart(card);
        const std::vector<double>& layers = apart.closed();
        const std::vector<OpenLayer>& open = apart.open();
        const std::vector<std::vector<double>> levels = levels_of(assembly, apart.sheet(), tree, track);
        Json plates = Json::array();
        std::map<std::pair<int, Lying>, int> lying;  // how many lie on this side of a plate so far
        for (const int which : tree.order) {
            const auto i = static_cast<std::size_t>(which);
            const Plate& plate = assembly.plates[i];
            Json one{{"name", valid_utf8(card.prefix + plate.name)}};
            if (plate.parent >= 0) one["parent"] = number[static_cast<std::size_t>(plate.parent)];
            const Vec3 offset = tree.offset[i];
            if (!(offset == Vec3{})) one["offset"] = lengths({offset.x, offset.y, offset.z});
            if (!(plate.pivot == Vec2{})) one["pivot"] = lengths({plate.pivot.x, plate.pivot.y});
            put_turns(track, count, i, one);
            if (!layers.empty()) one["layer"] = layers[i];
            if (!open.empty() && open[i].page >= 0) {
                one["page"] = number[static_cast<std::size_t>(open[i].page)];
                one["open"] = rounded(open[i].mm, 3);
            }
            if (!levels.empty()) put_levels(levels, i, one);
            if (plate.lying != Lying::free) {
                const int above = ++lying[{plate.parent, plate.lying}];
                one["above"] = plate.lying == Lying::on_front ? above : -above;
            }
            Json meshes = Json::array();
            for (const MeshPart& part : modeller_.mesh(number_, i)) {
                meshes.push_back(mesh(part, plate.pivot));
            }
            one["meshes"] = std::move(meshes);
            add_edges(plate, folds_[i], one);
            plates.push_back(std::move(one));
        }
        row["plates"] = std::move(plates);
        if (!levels.empty()) row["layer_mm"] = rounded(apart.sheet().layer_mm(), kLengthDecimals);
        if (!layers.empty()) row["cover"] = number[static_cast<std::size_t>(assembly.covers.front())];
        Json collisions = collisions_of(card, number);
        if (!collisions.empty()) row["collisions"] = std::move(collisions);
    }

    // By key: the levels of the panels of a folded sheet; empty: none ever lies on another.
    static std::vector<std::vector<double>> levels_of(const Assembly& assembly, SheetLayers& sheet,
                                                      const HingeTree& tree, const Track& track) {
        std::vector<std::vector<double>> levels;
        if (!sheet.any()) return levels;
        bool any = false;
        std::vector<Frame> frames(assembly.plates.size());
        for (std::size_t k = 0; k < track.angles_deg.size(); ++k) {
            frames_at_key(assembly, tree, track, k, frames);
            levels.push_back(sheet.at(track.angles_deg[k], frames));
            any = any || !levels.back().empty();
        }
        if (!any) levels.clear();
        return levels;
    }
    void put_levels(const std::vector<std::vector<double>>& levels, std::size_t plate, Json& row) {
        const auto level = [plate](const std::vector<double>& of) { return of.empty() ? 0.0 : of[plate]; };
        if (std::all_of(levels.begin(), levels.end(), [&](const auto& of) { return level(of) == 0.0; }))
            return;
        NumberText text(1);
        for (const std::vector<double>& of : levels) text.add(in_steps(level(of), kPerLayer));
        put(row, "levels", text);
    }

    // Each turn less the one before; what moves evenly differs little from key to key in that.
    void put_turns(const Track& track, std::size_t count, std::size_t plate, Json& row) {
        bool turns = false;
        for (std::size_t k = plate; k < track.turns.size(); k += count) {
            turns = turns || track.turns[k] != track.turns[plate];
        }
        NumberText text(4);
        std::array<std::int64_t, 4> last{};
        for (std::size_t k = plate; k < track.turns.size(); k += count) {
            for (std::size_t i = 0; i < 4; ++i) {
                const std::int64_t value = in_steps(track.turns[k].at(i), kPerTurn);
                text.add(value - std::exchange(last.at(i), value));
            }
            if (!turns) break;
        }
        put(row, "turns", text);
    }

    void add_edges(const Plate& plate, const std::vector<Segment>& folds, Json& row) {
        const PlateEdges edges = edges_of(plate, folds);
        const auto put_edges = [&](const char* name, const auto& list) {
            NumberText text(2);
            for (const auto& ends : list) {
                for (const std::uint32_t end : ends) text.add(edges.points[end] - plate.pivot);
            }
            put(row, name, text);
        };
        put_edges("cuts", edges.cuts);
        put_edges("folds", edges.folds);
    }

    static Json collisions_of(const SceneCard& card, const std::vector<int>& number) {
        Json list = Json::array();
        if (card.motion == nullptr || !card.motion->examination) return list;
        for (const Contact& contact : card.motion->examination->contacts) {
            list.push_back({{"plates",
                             {number.at(static_cast<std::size_t>(contact.a)),
                              number.at(static_cast<std::size_t>(contact.b))}},
                            {"from_deg", told_deg(contact.from_deg)},
                            {"to_deg", told_deg(contact.to_deg)},
                            {"deepest_deg", told_deg(contact.deepest_deg)},
                            {"depth_mm", told_mm(contact.depth_mm)}});
        }
        return list;
    }

    void add_lines(const Trace& trace, Json& row) {
        NumberText text(3);
        for (const std::vector<Vec3>& line : trace.lines) {
            for (std::size_t i = 1; i < line.size(); ++i) {
                text.add(line[i - 1]);
                text.add(line[i]);
            }
        }
        put(row, "lines", text);
    }

    // The edges of all plates of a piece, where they stand.
    void add_standing_edges(const Assembly& assembly, const std::vector<Vec3>& lifts, const Piece& piece,
                            Json& row) {
        NumberText cuts(3);
        NumberText folds(3);
        for (const int which : piece.plates) {
            const auto i = static_cast<std::size_t>(which);
            const Plate& plate = assembly.plates.at(i);
            if (!plate.stands) continue;
            const PlateEdges edges = edges_of(plate, folds_[i]);
            for (const auto& [list, text] :
                 {std::pair{&edges.cuts, &cuts}, std::pair{&edges.folds, &folds}}) {
                for (const auto& ends : *list) {
                    for (const std::uint32_t end : ends)
                        text->add(plate.stands->point(edges.points[end]) + lifts[i]);
                }
            }
        }
        put(row, "cuts", cuts);
        put(row, "folds", folds);
    }

    // A row a piece of what stands still, with the lines it was drawn with; then one for each other trace.
    Json footings_of(const SceneCard& card) {
        const Assembly& assembly = *card.assembly;
        Json rows = Json::array();
        auto trace = assembly.traces.begin();
        const std::vector<Vec3> lifts = layer_lifts(assembly);
        for (std::size_t i = 0; i < assembly.pieces.size(); ++i) {
            const Piece& piece = assembly.pieces[i];
            Json meshes = Json::array();
            for (const SpaceMesh& one : standing_meshes(assembly, lifts, piece, printed_backs_))
                meshes.push_back(mesh(one));
            const bool drawn = trace != assembly.traces.end() && trace->piece == static_cast<int>(i);
            if (meshes.empty() && !drawn) continue;
            Json row{{"name", valid_utf8(card.prefix + piece.name)}};
            if (!meshes.empty()) row["meshes"] = std::move(meshes);
            add_standing_edges(assembly, lifts, piece, row);
            if (drawn) add_lines(*trace++, row);
            rows.push_back(std::move(row));
        }
        for (; trace != assembly.traces.end(); ++trace) {
            Json row{{"name", valid_utf8(card.prefix + trace->name)}};
            add_lines(*trace, row);
            rows.push_back(std::move(row));
        }
        return rows;
    }

    const still::Modeller& modeller_;
    bool printed_backs_;
    std::size_t number_ = 0;                   // of the card in hand
    std::vector<std::vector<Segment>> folds_;  // of its plates
    std::map<std::string_view, std::size_t> numbers_;
    Json pictures_ = Json::array();
    std::map<std::string, std::size_t> list_numbers_;
    Json lists_ = Json::array();
};

}  // namespace

Json viewer_scene(std::span<const SceneCard> cards, const Keys& keys, const still::Modeller& modeller,
                  const OutputOptions& options) {
    Json scene = Json::object();
    if (!keys.angles_deg.empty()) {
        scene["opening"] = {{"from_deg", keys.range.from_deg},
                            {"to_deg", keys.range.to_deg},
                            {"rest_deg", rounded(modeller.best_deg(), 9)},
                            {"seconds", options.duration_s}};
        Json angles = Json::array();
        for (const double angle : keys.angles_deg) angles.push_back(rounded(angle, 9));
        scene["angles"] = std::move(angles);
    }
    if (options.still.paper_mm) scene["paper_mm"] = rounded(*options.still.paper_mm, kLengthDecimals);
    for (std::size_t i = 0; i < kViewNames.size(); ++i) {
        const Vec3 eye = still::eye_of(static_cast<View>(i));
        scene["views"][std::string(kViewNames.at(i))] = lengths({eye.x, eye.y, eye.z});
    }
    SceneText text(modeller, options.backs);
    const std::vector<Orientation> orientations = modeller.orientations();
    Json rows = Json::array();
    for (std::size_t i = 0; i < cards.size(); ++i) {
        rows.push_back(text.add_card(cards[i], i, keys.trees[i], keys.tracks[i], orientations.at(i)));
    }
    Json pictures = text.take_pictures();
    if (!pictures.empty()) scene["pictures"] = std::move(pictures);
    scene["cards"] = std::move(rows);
    scene["lists"] = text.take_lists();
    return scene;
}

std::string viewer_scene_text(const nlohmann::ordered_json& scene) {
    return scene.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

bool browsers_take(std::size_t bytes, Diagnostics& diagnostics) {
    if (bytes <= kMostBytes) return true;
    diagnostics
        .error("model-too-large", {},
               fmt::format("the page would be {:.0f} MB, {:.0f} MB are the most",
                           1e-6 * static_cast<double>(bytes), 1e-6 * static_cast<double>(kMostBytes)))
        .hint(
            "ask for fewer angles or fewer keys a second, take smaller pictures, or write fewer designs into "
            "one page");
    return false;
}

std::string viewer_title(std::span<const SceneCard> cards) {
    std::string title;
    for (std::size_t i = 0; i < cards.size() && i < 3; ++i) {
        title += (i > 0 ? ", " : "") + root_name(cards[i]);
    }
    return cards.size() > 3 ? title + " …" : title;
}

}  // namespace popup
