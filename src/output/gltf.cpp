#include "output/gltf.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "assembly/orientation_names.h"
#include "base/nth.h"
#include "base/text/numbers.h"
#include "output/apart.h"
#include "output/examination_json.h"
#include "output/gltf_meshes.h"
#include "output/gltf_values.h"
#include "output/keys.h"
#include "output/orientation.h"
#include "output/plate_edges.h"
#include "output/poses.h"
#include "output/space_mesh.h"

namespace popup {
namespace {

constexpr double kHalfRoot = 0.7071067811865476;  // sin and cos of 45°: half of a quarter turn
constexpr int kLengthDecimals = 6;
constexpr double kMovedMm = 1e-6;
constexpr int kTurnDecimals = 9;
constexpr double kMostBytes = std::numeric_limits<std::int32_t>::max();  // what the library's numbers hold

class SceneBuilder {
 public:
    explicit SceneBuilder(const OutputOptions& options)
        : options_(options), meshes_(model_, {options.backs, options.edge_lines}) {}

    tinygltf::Model build(std::span<const SceneCard> cards, Keys keys) {
        model_.asset.version = "2.0";
        model_.asset.generator = "popupc " POPUP_VERSION;
        add_times(keys);
        best_deg_ = keys.best_deg;
        tinygltf::Scene scene;
        double left = 0.0;  // where the next card may begin
        for (std::size_t i = 0; i < cards.size(); ++i) {
            double shift = 0.0;
            const Stance& stance = keys.stances[i];
            if (cards.size() > 1) {
                const auto [low, high] =
                    extent(*cards[i].assembly, stance.orientation, keys.trees[i], keys.tracks[i]);
                if (i > 0) shift = left - low;
                left = shift + high + kCardGapMm;
            }
            scene.nodes.push_back(add_card(cards[i], stance, keys.trees[i], keys.tracks[i], shift));
            keys.tracks[i] = {};
        }
        model_.scenes.push_back(std::move(scene));
        model_.defaultScene = 0;
        if (!animation_.channels.empty()) add_animation(keys.angles_deg);
        meshes_.finish();
        return std::move(model_);
    }

 private:
    void add_times(const Keys& keys) {
        const double from = keys.range.from_deg;
        const double width = keys.range.to_deg - from;
        for (const double angle : keys.angles_deg) {
            times_.push_back(static_cast<float>(rounded((angle - from) / width, 9) * options_.duration_s));
        }
    }

    // How far any corner gets to the left and to the right at any key, in mm; the spine of what moves is at
    // 0.
    static std::pair<double, double> extent(const Assembly& assembly, Orientation orientation,
                                            const HingeTree& tree, const Track& track) {
        const std::size_t count = assembly.plates.size();
        std::vector<Frame> frames(count);
        std::pair<double, double> result{0.0, 0.0};
        if (!moves(assembly)) result = {HUGE_VAL, -HUGE_VAL};
        const auto take = [&result](Vec3 p) {
            result = {std::min(result.first, p.x), std::max(result.second, p.x)};
        };
        for (std::size_t k = 0; k < track.angles_deg.size(); ++k) {
            frames_at_key(assembly, tree, track, k, frames);
            stand(orientation, assembly, frames);
            for (std::size_t i = 0; i < count; ++i) {
                for (const Vec2 p : assembly.plates[i].outline.outer) take(frames[i].point(p));
            }
        }
        for (const Plate& plate : assembly.plates) {
            if (!plate.stands) continue;
            for (const Vec2 p : plate.outline.outer) take(plate.stands->point(p));
        }
        for (const Trace& trace : assembly.traces) {
            for (const std::vector<Vec3>& line : trace.lines) std::for_each(line.begin(), line.end(), take);
        }
        if (result.first > result.second) return {0.0, 0.0};
        return {rounded(result.first, kLengthDecimals), rounded(result.second, kLengthDecimals)};
    }

    // What each plate's node says of the plates it crosses.
    static std::vector<tinygltf::Value::Array> collisions_of(const SceneCard& card) {
        const std::vector<Plate>& plates = card.assembly->plates;
        std::vector<tinygltf::Value::Array> all(plates.size());
        if (card.motion == nullptr || !card.motion->examination) return all;
        for (const Contact& contact : card.motion->examination->contacts) {
            const auto tell = [&](int own, int other) {
                const std::string& name = plates.at(static_cast<std::size_t>(other)).name;
                tinygltf::Value::Object row{{"with", tinygltf::Value(valid_utf8(card.prefix + name))},
                                            {"from_deg", tinygltf::Value(told_deg(contact.from_deg))},
                                            {"to_deg", tinygltf::Value(told_deg(contact.to_deg))},
                                            {"depth_mm", tinygltf::Value(told_mm(contact.depth_mm))}};
                all.at(static_cast<std::size_t>(own)).emplace_back(std::move(row));
            };
            tell(contact.a, contact.b);
            tell(contact.b, contact.a);
        }
        return all;
    }

    // The number of the node that all of a card's are below.
    int add_root(const SceneCard& card, const Stance& stance, const Track& track, double shift) {
        tinygltf::Node node;
        std::string_view name = card.prefix;
        if (name.ends_with(':')) {
            name.remove_suffix(1);
        } else {
            name = card.assembly->stem;
        }
        node.name = valid_utf8(name);
        if (node.name.empty()) node.name = moves(*card.assembly) ? "card" : "parts";
        if (shift != 0.0) node.translation = metres(Vec3{shift, 0.0, 0.0});
        if (stance.orientation == Orientation::flat) node.rotation = {-kHalfRoot, 0.0, 0.0, kHalfRoot};
        if (stance.orientation == Orientation::stage) {
            const auto turn = stage_turn(*card.assembly, track, rest_key(*card.assembly, track));
            node.rotation.assign(turn.begin(), turn.end());
        }
        tinygltf::Value::Object extras{
            {"orientation", tinygltf::Value(std::string(nth(kOrientationNames, stance.orientation)))}};
        if (stance.is_guessed) extras.emplace("orientation_guessed", tinygltf::Value(true));
        node.extras = tinygltf::Value(std::move(extras));
        model_.nodes.push_back(std::move(node));
        return static_cast<int>(model_.nodes.size()) - 1;
    }

    // The number of the card's node; below it stands what moves and what stands still, each in its order.
    int add_card(const SceneCard& card, const Stance& stance, const HingeTree& tree, const Track& track,
                 double shift) {
        const int root = add_root(card, stance, track, shift);
        if (stance.orientation == Orientation::stage) {
            turns_.clear();
            for (std::size_t k = 0; k < track.angles_deg.size(); ++k)
                turns_.push_back(stage_turn(*card.assembly, track, k));
            add_channel(root);
        }
        if (moves(*card.assembly)) add_moving(card, tree, track, root);
        add_standing(card, root);
        return root;
    }

    // The key at which the card rests.
    [[nodiscard]] std::size_t rest_key(const Assembly& assembly, const Track& track) const {
        const double there = std::clamp(best_deg_, assembly.sweep.from_deg, assembly.sweep.to_deg);
        const auto at = std::lower_bound(track.angles_deg.begin(), track.angles_deg.end(), there);
        return static_cast<std::size_t>(at - track.angles_deg.begin());
    }

    // What keeps a stage's ground level: the ground's own turn undone, then its normal turned up, and its
    // page's y to the right.
    static std::array<float, 4> stage_turn(const Assembly& assembly, const Track& track, std::size_t key) {
        const std::size_t count = assembly.plates.size();
        Quaternion turn{-0.5, -0.5, -0.5, 0.5};
        for (int plate = assembly.covers.back(); plate >= 0; plate = nth(assembly.plates, plate).parent) {
            const auto& own = track.turns[key * count + static_cast<std::size_t>(plate)];
            turn = product(turn, {-double{own[0]}, -double{own[1]}, -double{own[2]}, double{own[3]}});
        }
        std::array<float, 4> told{};
        for (std::size_t i = 0; i < told.size(); ++i)
            told.at(i) = static_cast<float>(rounded(turn.at(i), kTurnDecimals));
        return told;
    }

    // The number of a new node below `root`, of the mesh's name.
    int add_space_node(tinygltf::Mesh mesh, int root) {
        tinygltf::Node node;
        node.name = mesh.name;
        if (!mesh.primitives.empty()) {
            node.mesh = static_cast<int>(model_.meshes.size());
            model_.meshes.push_back(std::move(mesh));
        }
        const int number = static_cast<int>(model_.nodes.size());
        model_.nodes.push_back(std::move(node));
        model_.nodes[static_cast<std::size_t>(root)].children.push_back(number);
        return number;
    }

    // A node a piece of what stands still, with the lines it was drawn with; then one for each other trace.
    void add_standing(const SceneCard& card, int root) {
        const Assembly& assembly = *card.assembly;
        auto trace = assembly.traces.begin();
        const std::vector<Vec3> lifts = layer_lifts(assembly);
        const auto folds = folds_of_plates(assembly);
        for (std::size_t i = 0; i < assembly.pieces.size(); ++i) {
            const std::vector<SpaceMesh> parts =
                standing_meshes(assembly, lifts, assembly.pieces[i], options_.backs);
            const bool is_traced = trace != assembly.traces.end() && trace->piece == static_cast<int>(i);
            if (parts.empty() && !is_traced) continue;
            tinygltf::Mesh mesh;
            mesh.name = valid_utf8(card.prefix + assembly.pieces[i].name);
            meshes_.add_standing(assembly, lifts, folds, assembly.pieces[i], parts, mesh);
            if (is_traced) meshes_.add_trail(*trace++, mesh);
            const std::string name = mesh.name;
            const int node = add_space_node(std::move(mesh), root);
            if (!parts.empty()) {
                model_.nodes[static_cast<std::size_t>(node)].extras =
                    tinygltf::Value({{"part", tinygltf::Value(name)}});
            }
        }
        for (; trace != assembly.traces.end(); ++trace) {
            tinygltf::Mesh mesh;
            mesh.name = valid_utf8(card.prefix + trace->name);
            meshes_.add_trail(*trace, mesh);
            add_space_node(std::move(mesh), root);
        }
    }

    // The nodes of plates that move follow `root` in the assembly's order.
    void add_moving(const SceneCard& card, const HingeTree& tree, const Track& track, int root) {
        const Assembly& assembly = *card.assembly;
        const std::size_t rest = rest_key(assembly, track);
        const std::size_t count = assembly.plates.size();
        const auto folds = folds_of_plates(assembly);
        std::vector<std::string> pieces;
        for (const Piece& piece : assembly.pieces) pieces.push_back(valid_utf8(card.prefix + piece.name));
        const std::vector<tinygltf::Value::Array> collisions = collisions_of(card);
        Lifted lifted = lifted_at_keys(card, tree, track);
        for (std::size_t i = 0; i < count; ++i) {
            const Plate& plate = assembly.plates[i];
            tinygltf::Node one;
            one.name = valid_utf8(card.prefix + plate.name);
            one.mesh = meshes_.add(plate, assembly.pieces.at(static_cast<std::size_t>(plate.piece)), folds[i],
                                   one.name, !collisions[i].empty());
            if (const Vec3 at = place_of(tree, lifted, i, rest); !(at == Vec3{}))
                one.translation = metres(at);
            const auto& turn = track.turns[rest * count + i];
            one.rotation.assign(turn.begin(), turn.end());
            tinygltf::Value::Object extras{
                {"plate", tinygltf::Value(one.name)},
                {"piece", tinygltf::Value(pieces.at(static_cast<std::size_t>(plate.piece)))}};
            if (!collisions[i].empty()) extras.emplace("collisions", tinygltf::Value(collisions[i]));
            one.extras = tinygltf::Value(std::move(extras));
            model_.nodes.push_back(std::move(one));
            add_channel(track, count, i, root + 1 + static_cast<int>(i));
            add_places(tree, lifted, i, root + 1 + static_cast<int>(i));
        }
        for (const int i : tree.order) {
            const int parent = root + 1 + assembly.plates[static_cast<std::size_t>(i)].parent;
            model_.nodes[static_cast<std::size_t>(parent)].children.push_back(root + 1 + i);
        }
    }

    // Where plates that lie on one another are shown beside their places.
    struct Lifted {
        std::map<std::size_t, std::vector<Vec3>>
            by;                         // of each plate, in its parent's directions, at such keys
        std::vector<std::size_t> keys;  // those, the keys next to them, and the ends
        int times = -1;                 // their accessor
    };
    Lifted lifted_at_keys(const SceneCard& card, const HingeTree& tree, const Track& track) {
        const Assembly& assembly = *card.assembly;
        Lifted lifted;
        Apart apart(card);
        if (apart.none_in_models()) return lifted;
        std::vector<Frame> frames(assembly.plates.size());
        const std::size_t last = track.angles_deg.size() - 1;
        std::set<std::size_t> keys{0, last};
        for (std::size_t k = 0; k <= last; ++k) {
            frames_at_key(assembly, tree, track, k, frames);
            std::vector<Vec3> lifts =
                apart.lifts({.frames = frames, .opening_deg = track.angles_deg[k], .in_model = true});
            if (std::all_of(lifts.begin(), lifts.end(), [](Vec3 lift) { return lift == Vec3{}; })) continue;
            lifted.by.emplace(k, against_parents(assembly, frames, lifts));
            keys.insert({k - std::min<std::size_t>(k, 1), k, std::min(k + 1, last)});
        }
        lifted.keys.assign(keys.begin(), keys.end());
        return lifted;
    }
    // What a plate is moved by more than what it hangs on, in the directions of that.
    static std::vector<Vec3> against_parents(const Assembly& assembly, std::span<const Frame> frames,
                                             std::span<const Vec3> lifts) {
        std::vector<Vec3> own(lifts.begin(), lifts.end());
        for (std::size_t i = 0; i < own.size(); ++i) {
            const int parent = assembly.plates[i].parent;
            if (parent < 0) continue;
            const Vec3 more = lifts[i] - nth(lifts, parent);
            const auto& axes = nth(frames, parent).axes;
            own[i] = {dot(more, axes[0]), dot(more, axes[1]), dot(more, axes[2])};
        }
        return own;
    }
    static Vec3 place_of(const HingeTree& tree, const Lifted& lifted, std::size_t plate, std::size_t key) {
        const auto at = lifted.by.find(key);
        if (at == lifted.by.end()) return tree.offset[plate];
        const Vec3 place = tree.offset[plate] + at->second[plate];
        return {rounded(place.x, kLengthDecimals), rounded(place.y, kLengthDecimals),
                rounded(place.z, kLengthDecimals)};
    }
    // The places of a plate's node, where it is moved at any key.
    void add_places(const HingeTree& tree, Lifted& lifted, std::size_t plate, int node) {
        const auto stays = [&](const auto& at) { return length(at.second[plate]) < kMovedMm; };
        if (std::all_of(lifted.by.begin(), lifted.by.end(), stays)) return;
        if (lifted.times < 0) {
            std::vector<float> times;
            for (const std::size_t key : lifted.keys) times.push_back(times_[key]);
            lifted.times = meshes_.add_times(times);
        }
        std::vector<std::array<float, 3>> places;
        for (const std::size_t key : lifted.keys) {
            const Vec3 at = place_of(tree, lifted, plate, key);
            places.push_back({metres(at.x), metres(at.y), metres(at.z)});
        }
        add_channel(node, "translation", lifted.times, meshes_.add_places(places));
    }

    void add_channel(const Track& track, std::size_t plates, std::size_t plate, int node) {
        turns_.clear();
        for (std::size_t k = plate; k < track.turns.size(); k += plates) turns_.push_back(track.turns[k]);
        add_channel(node);
    }

    // Of the node's turns at all keys, `turns_`, where they differ.
    void add_channel(int node) {
        if (std::all_of(turns_.begin(), turns_.end(),
                        [this](const auto& turn) { return turn == turns_.front(); }))
            return;
        const int times = time_accessor();
        add_channel(node, "rotation", times, meshes_.add_turns(turns_));
    }
    void add_channel(int node, const char* path, int times, int values) {
        tinygltf::AnimationSampler sampler;
        sampler.input = times;
        sampler.interpolation = "LINEAR";
        sampler.output = values;
        tinygltf::AnimationChannel channel;
        channel.sampler = static_cast<int>(animation_.samplers.size());
        channel.target_node = node;
        channel.target_path = path;
        animation_.samplers.push_back(std::move(sampler));
        animation_.channels.push_back(std::move(channel));
    }

    int time_accessor() {
        if (time_accessor_ < 0) time_accessor_ = meshes_.add_times(times_);
        return time_accessor_;
    }

    void add_animation(const std::vector<double>& angles_deg) {
        tinygltf::Value::Array angles;
        for (const double angle : angles_deg) angles.emplace_back(angle);
        animation_.name = "open";
        animation_.extras = tinygltf::Value({{"angles_deg", tinygltf::Value(std::move(angles))}});
        model_.animations.push_back(std::move(animation_));
    }

    const OutputOptions& options_;
    tinygltf::Model model_;
    GltfMeshes meshes_;
    tinygltf::Animation animation_;
    std::vector<float> times_;
    double best_deg_ = 90.0;
    std::vector<std::array<float, 4>> turns_;  // of one node; kept for its memory
    int time_accessor_ = -1;
};

std::optional<std::string> write(std::span<const SceneCard> cards, const OutputOptions& options,
                                 Diagnostics& diagnostics, bool binary) {
    POPUP_INVARIANT(!cards.empty() && options.duration_s > 0.0);
    auto keys = choose_keys(cards, options, diagnostics);
    if (!keys) return std::nullopt;
    const tinygltf::Model model = SceneBuilder(options).build(cards, std::move(*keys));
    const double bytes = model.buffers.empty() ? 0.0 : static_cast<double>(model.buffers[0].data.size());
    // The JSON of a large model is about half as long as its numbers; the text form needs a third more for
    // them.
    if (1.5 * bytes > kMostBytes) {
        diagnostics
            .error("model-too-large", {},
                   fmt::format("the model would be {:.0f} MB, {:.0f} MB are the most", 1.5e-6 * bytes,
                               1e-6 * kMostBytes))
            .hint("ask for fewer angles or fewer keys a second, or write fewer designs into one model");
        return std::nullopt;
    }
    StringBuffer buffer;
    std::ostream stream(&buffer);
    tinygltf::TinyGLTF writer;
    const bool written = writer.WriteGltfSceneToStream(&model, stream, true, binary);
    POPUP_INVARIANT(written && stream.good());
    return std::move(buffer.text);
}

}  // namespace

std::optional<std::string> write_glb(std::span<const SceneCard> cards, const OutputOptions& options,
                                     Diagnostics& diagnostics) {
    return write(cards, options, diagnostics, true);
}

std::optional<std::string> write_gltf(std::span<const SceneCard> cards, const OutputOptions& options,
                                      Diagnostics& diagnostics) {
    return write(cards, options, diagnostics, false);
}

}  // namespace popup
