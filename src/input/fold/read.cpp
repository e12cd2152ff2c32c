#include "input/fold/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/nth.h"
#include "base/text/json_tree.h"
#include "base/text/number_scanner.h"
#include "base/text/place_at.h"
#include "base/text/shown.h"
#include "input/fold/carry.h"
#include "input/text.h"

namespace popup::fold {
namespace {

// No sheet is larger, mm.
constexpr double kLargestPatternMm = 100'000.0;
// Corners this far out of their plane, as a share of the pattern, lie in it.
constexpr double kOutOfPlane = 1e-6;
// So many findings have their place looked up; beyond that it is left out.
constexpr std::size_t kToldPlaces = 1000;
constexpr double kFoldedDeg = 180.0;

struct Unit {
    std::string_view name;
    double mm;
};
constexpr std::array kUnits = std::to_array<Unit>({{"in", 25.4},
                                                   {"pt", 25.4 / 72.0},
                                                   {"m", 1000.0},
                                                   {"cm", 10.0},
                                                   {"mm", 1.0},
                                                   {"um", 1e-3},
                                                   {"nm", 1e-6}});

struct Edge {
    int a = 0, b = 0;
    std::size_t at = 0;  // byte of the file
};

class Reader {
 public:
    Reader(const Source& source, const ReadOptions& options, Diagnostics& diagnostics)
        : text_(source.text), options_(options), diagnostics_(diagnostics) {
        out_.file = source.name;
    }

    std::optional<CreasePattern> run(const JsonValue& root) {
        if (root.object() == nullptr) {
            wrong(root, "the file", "an object with \"vertices_coords\" and \"edges_vertices\"");
            return std::nullopt;
        }
        tell_version(root);
        if (!list_frames(root) || !choose_frame() || !read_corners() || !read_edges()) return std::nullopt;
        read_uses();
        if (!sound_) return std::nullopt;
        set_size();
        make_lines();
        carry_keys(root);
        return std::move(out_);
    }

 private:
    Place place(std::size_t at) { return ++told_ <= kToldPlaces ? place_at(text_, at) : Place{}; }

    bool wrong(const JsonValue& json, std::string_view path, std::string_view wanted) {
        sound_ = false;
        diagnostics_.error("fold-value", place(json.at), fmt::format("{} must be {}", path, wanted));
        return false;
    }

    // Some programs write the version as a text.
    void tell_version(const JsonValue& root) {
        constexpr std::array kKnown{1.0, 1.1, 1.2};
        const JsonValue* version = root.member("file_spec");
        if (version == nullptr || version->null()) return;
        const double* number = version->number();
        const std::string* text = version->text();
        std::vector<double> said;
        if (number != nullptr) said = {*number};
        if (text != nullptr) said = parse_numbers(*text).value_or(std::vector<double>{});
        if (said.size() == 1 && std::find(kKnown.begin(), kKnown.end(), said[0]) != kKnown.end()) return;
        const std::string shown_as = number != nullptr ? fmt::format(" {:g}", *number)
                                     : text != nullptr ? fmt::format(" \"{}\"", shown(*text))
                                                       : std::string();
        diagnostics_
            .remark(
                "fold-version", place(version->at),
                fmt::format("its file_spec{} is none of 1, 1.1 and 1.2; it was read as FOLD 1.2", shown_as))
            .hint("export it as one of these: what another version says in another way is misread");
    }

    // --- frames

    bool list_frames(const JsonValue& root) {
        frames_.push_back(&root);
        const JsonValue* more = root.member("file_frames");
        if (more == nullptr) return true;
        if (more->list() == nullptr) return wrong(*more, "file_frames", "a list of frames");
        for (const JsonValue& frame : *more->list()) {
            if (frame.object() == nullptr) return wrong(frame, "a frame of file_frames", "an object");
            frames_.push_back(&frame);
        }
        return true;
    }

    // The frame that this one inherits from; -1: none.
    [[nodiscard]] int parent_of(int frame) const {
        const JsonValue* inherit = nth(frames_, frame)->member("frame_inherit");
        if (inherit == nullptr || inherit->flag() == nullptr || !*inherit->flag()) return -1;
        const JsonValue* parent = nth(frames_, frame)->member("frame_parent");
        const double* number = parent == nullptr ? nullptr : parent->number();
        if (number == nullptr || *number < 0.0 || *number >= static_cast<double>(frames_.size())) return -1;
        return static_cast<int>(*number);
    }

    // The member of a frame, or of what it inherits from.
    [[nodiscard]] const JsonValue* member(int frame, std::string_view name) const {
        for (std::size_t depth = 0; frame >= 0 && depth < frames_.size(); ++depth) {
            if (const JsonValue* own = nth(frames_, frame)->member(name); own != nullptr && !own->null())
                return own;
            frame = parent_of(frame);
        }
        return nullptr;
    }
    [[nodiscard]] const JsonValue* member(std::string_view name) const { return member(frame_, name); }

    [[nodiscard]] bool has_class(int frame, std::string_view name) const {
        const JsonValue* classes = nth(frames_, frame)->member("frame_classes");
        if (classes == nullptr || classes->list() == nullptr) return false;
        return std::any_of(classes->list()->begin(), classes->list()->end(), [&](const JsonValue& one) {
            return one.text() != nullptr && *one.text() == name;
        });
    }

    // Whether all its corners have one height.
    // The coordinate that is the same at all corners, to the size's rounding: 2 is height, as in the format's
    // own drawings, and 1 that of programs whose y goes up, among them Origami Simulator.
    [[nodiscard]] std::optional<std::size_t> across_plane(int frame) const {
        const JsonValue* coords = member(frame, "vertices_coords");
        if (coords == nullptr || coords->list() == nullptr || coords->list()->empty()) return std::nullopt;
        std::array<double, 3> low{HUGE_VAL, HUGE_VAL, HUGE_VAL};
        std::array<double, 3> high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
        double size = 0.0;
        for (const JsonValue& corner : *coords->list()) {
            const JsonList* c = corner.list();
            if (c == nullptr || c->size() < 2) return 2;  // told of when it is read
            std::array<double, 3> at{};
            for (std::size_t i = 0; i < c->size(); ++i) {
                const double* number = (*c)[i].number();
                if (number == nullptr) return 2;
                size = std::max(size, std::abs(*number));
                if (i < at.size()) at.at(i) = *number;
            }
            for (std::size_t i = 0; i < at.size(); ++i) {
                low.at(i) = std::min(low.at(i), at.at(i));
                high.at(i) = std::max(high.at(i), at.at(i));
            }
        }
        for (const std::size_t axis : {2U, 1U}) {
            if (high.at(axis) - low.at(axis) <= kOutOfPlane * size) return axis;
        }
        return std::nullopt;
    }
    [[nodiscard]] bool is_plane(int frame) const { return across_plane(frame).has_value(); }

    bool choose_frame() {
        if (options_.frame) {
            frame_ = *options_.frame;
            if (frame_ >= 0 && frame_ < static_cast<int>(frames_.size())) {
                if (is_plane(frame_)) return true;
                return no_pattern(
                    fmt::format("frame {} is folded: its corners do not lie in one plane", frame_));
            }
            return no_pattern(fmt::format("there is no frame {}; the file has {}", frame_, frames_.size()));
        }
        const auto is_pattern = [this](int frame) {
            return member(frame, "vertices_coords") != nullptr && !has_class(frame, "foldedForm") &&
                   is_plane(frame);
        };
        if (is_pattern(0)) return true;
        for (int i = 1; i < static_cast<int>(frames_.size()); ++i) {
            if (!is_pattern(i)) continue;
            frame_ = i;
            diagnostics_
                .remark("fold-frame", place(nth(frames_, i)->at),
                        fmt::format("the first frame is no crease pattern; frame {} is, and is read", i))
                .hint("--frame chooses another");
            return true;
        }
        // A form that is folded into a plane is read if there is nothing else: then its layers cross.
        if (member(0, "vertices_coords") == nullptr) return no_pattern("the file has no vertices_coords");
        return no_pattern("the file has folded forms only, and no crease pattern");
    }

    bool no_pattern(std::string what) {
        sound_ = false;
        diagnostics_.error("fold-no-pattern", {}, std::move(what))
            .hint("a crease pattern has its corners in one plane; export the flat sheet");
        return false;
    }

    // --- corners and edges

    bool read_corners() {
        const JsonValue* coords = member("vertices_coords");
        if (coords == nullptr || coords->list() == nullptr)
            return coords == nullptr ? no_pattern("the frame has no vertices_coords")
                                     : wrong(*coords, "vertices_coords", "a list of corners");
        const bool y_is_up = across_plane(frame_) == 1U;
        for (const JsonValue& corner : *coords->list()) {
            const JsonList* c = corner.list();
            if (c == nullptr || c->size() < 2 || (*c)[0].number() == nullptr || (*c)[1].number() == nullptr)
                return wrong(corner, "a corner of vertices_coords", "a list of two or three numbers");
            // Seen from where y goes up, z comes down the page.
            if (y_is_up && c->size() > 2) {
                corners_.push_back({*(*c)[0].number(), -*(*c)[2].number()});
            } else {
                corners_.push_back({*(*c)[0].number(), *(*c)[1].number()});
            }
        }
        return true;
    }

    // A corner's number.
    std::optional<int> corner(const JsonValue& json, std::string_view path) {
        const double* number = json.number();
        if (number != nullptr && *number >= 0.0 && *number < static_cast<double>(corners_.size()) &&
            *number == std::floor(*number))
            return static_cast<int>(*number);
        wrong(json, path, fmt::format("the number of a corner, from 0 to {}", corners_.size() - 1));
        return std::nullopt;
    }

    bool read_edges() {
        const JsonValue* faces = member("faces_vertices");
        if (faces != nullptr && !read_faces(*faces)) return false;
        const JsonValue* edges = member("edges_vertices");
        if (edges == nullptr) {
            if (faces == nullptr)
                return no_pattern("the frame has neither edges_vertices nor faces_vertices");
            for (const auto& [ends, side] : sides_) edges_.push_back({ends.first, ends.second, side.at});
            return true;
        }
        if (edges->list() == nullptr) return wrong(*edges, "edges_vertices", "a list of edges");
        for (const JsonValue& edge : *edges->list()) {
            const JsonList* ends = edge.list();
            if (ends == nullptr || ends->size() != 2)
                return wrong(edge, "an edge of edges_vertices", "a list of two corners");
            const auto a = corner((*ends)[0], "an end of an edge");
            const auto b = a ? corner((*ends)[1], "an end of an edge") : std::nullopt;
            if (!b) return false;
            edges_.push_back({*a, *b, edge.at});
        }
        return true;
    }

    struct Side {
        int faces = 0;
        std::size_t at = 0;
    };

    bool read_faces(const JsonValue& faces) {
        if (faces.list() == nullptr) return wrong(faces, "faces_vertices", "a list of faces");
        for (const JsonValue& face : *faces.list()) {
            const JsonList* of = face.list();
            if (of == nullptr) return wrong(face, "a face of faces_vertices", "a list of corners");
            std::vector<int>& ring = faces_.emplace_back();
            for (const JsonValue& one : *of) {
                const auto number = corner(one, "a corner of a face");
                if (!number) return false;
                ring.push_back(*number);
            }
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const auto ends = std::minmax(ring[i], ring[(i + 1) % ring.size()]);
                Side& side = sides_.try_emplace({ends.first, ends.second}, Side{0, face.at}).first->second;
                ++side.faces;
            }
        }
        return true;
    }

    // --- what edges are

    void read_uses() {
        uses_.assign(edges_.size(), CreaseUse::fold);
        angles_.assign(edges_.size(), std::nullopt);
        const JsonValue* letters = member("edges_assignment");
        if (letters == nullptr) {
            guess_uses();
        } else if (letters->list() == nullptr || letters->list()->size() != edges_.size()) {
            wrong(*letters, "edges_assignment",
                  fmt::format("a list of {} letters, one an edge", edges_.size()));
        } else {
            for (std::size_t i = 0; i < edges_.size(); ++i) read_letter((*letters->list())[i], i);
        }
        const JsonValue* angles = member("edges_foldAngle");
        if (angles == nullptr) angles = member("edges_foldAngles");
        if (angles == nullptr) return;
        if (angles->list() == nullptr || angles->list()->size() != edges_.size()) {
            wrong(*angles, "edges_foldAngle", fmt::format("a list of {} angles, one an edge", edges_.size()));
            return;
        }
        for (std::size_t i = 0; i < edges_.size(); ++i) read_angle((*angles->list())[i], i);
        read_flat_folds(*angles->list());
    }

    void read_letter(const JsonValue& json, std::size_t edge) {
        const std::string* letter = json.text();
        // Small letters are those of early Rabbit Ear.
        const std::string_view known = "BCMVUFJbcmvufj";
        if (letter == nullptr || letter->size() != 1 ||
            known.find(letter->front()) == std::string_view::npos) {
            wrong(json, "an edge's assignment", "one of B, C, M, V, U, F and J");
            return;
        }
        constexpr std::array kUses{CreaseUse::cut,  CreaseUse::cut,  CreaseUse::mountain, CreaseUse::valley,
                                   CreaseUse::fold, CreaseUse::flat, CreaseUse::flat};
        uses_[edge] = kUses.at(known.find(letter->front()) % kUses.size());
    }

    void guess_uses() {
        if (sides_.empty()) return;  // what is around everything is taken for cuts where it is looked at
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            const auto ends = std::minmax(edges_[i].a, edges_[i].b);
            const auto side = sides_.find({ends.first, ends.second});
            if (side == sides_.end() || side->second.faces < 2) uses_[i] = CreaseUse::cut;
        }
    }

    void read_angle(const JsonValue& json, std::size_t edge) {
        if (json.null()) return;
        const double* angle = json.number();
        if (angle == nullptr || std::abs(*angle) > 360.0) {
            wrong(json, "an edge's fold angle", "null or a number from -360 to 360");
            return;
        }
        CreaseUse& use = uses_[edge];
        if (use == CreaseUse::cut || use == CreaseUse::flat || *angle == 0.0) return;
        if (use == CreaseUse::fold) use = *angle > 0.0 ? CreaseUse::valley : CreaseUse::mountain;
        if ((*angle > 0.0) != (use == CreaseUse::valley)) {
            diagnostics_
                .warning(
                    "fold-angle-sign", place(json.at),
                    fmt::format("this edge is a {}, and its angle of {:g}° is that of a {}; it is folded "
                                "as the {}",
                                use == CreaseUse::valley ? "valley" : "mountain", *angle,
                                use == CreaseUse::valley ? "mountain" : "valley",
                                use == CreaseUse::valley ? "valley" : "mountain"))
                .hint("angles of valleys are positive, those of mountains negative");
        }
        angles_[edge] = std::min(std::abs(*angle), kFoldedDeg);
    }

    // Mountains and valleys of 0 are scored and lie flat, where others are folded. Where none is, the file
    // shows the flat sheet, and says nothing.
    void read_flat_folds(const std::vector<JsonValue>& angles) {
        const bool folded = std::any_of(angles_.begin(), angles_.end(),
                                        [](const auto& angle) { return angle && *angle > 0.0; });
        for (std::size_t i = 0; folded && i < edges_.size(); ++i) {
            const double* angle = angles[i].number();
            if (angle != nullptr && *angle == 0.0 &&
                (uses_[i] == CreaseUse::mountain || uses_[i] == CreaseUse::valley))
                angles_[i] = 0.0;
        }
    }

    // --- size and lines

    void set_size() {
        Box box;
        for (const Edge& edge : edges_) {
            box.extend(nth(corners_, edge.a));
            box.extend(nth(corners_, edge.b));
        }
        const double longer = std::max(box.width(), box.height());
        double mm = 0.0;
        const JsonValue* unit = member("frame_unit");
        if (unit != nullptr && unit->text() != nullptr) {
            for (const Unit& one : kUnits) {
                if (one.name == *unit->text()) mm = one.mm;
            }
            if (mm > 0.0) out_.ruler.unit = *unit->text();
        }
        if (mm == 0.0) {
            mm = longer > 0.0 ? kSheetMm / longer : 1.0;
            out_.ruler.unit = "";
            const std::string* other = unit == nullptr ? nullptr : unit->text();
            const std::string why =
                other == nullptr || other->empty() || *other == "unit"
                    ? std::string("the pattern has no unit")
                    : fmt::format("its frame_unit \"{}\" is none that FOLD has", shown(*other));
            diagnostics_
                .remark("fold-size", {},
                        fmt::format("{}: its longer side was made {:g} mm long", why, kSheetMm))
                .hint("say \"frame_unit\": \"mm\" in the file");
        }
        out_.ruler.origin = {};
        out_.ruler.per_mm = 1.0 / mm;
        if (longer * mm > kLargestPatternMm) {
            sound_ = false;
            diagnostics_
                .error("fold-value", {},
                       fmt::format("the pattern is {:.0f} mm long; {:.0f} mm is the most", longer * mm,
                                   kLargestPatternMm))
                .hint("look at its frame_unit");
        }
        for (Vec2& corner : corners_) corner = mm * corner;
    }

    void make_lines() {
        std::vector<std::size_t> order(edges_.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(),
                         [this](std::size_t a, std::size_t b) { return edges_[a].at < edges_[b].at; });
        std::vector<Place> places(edges_.size());
        PlaceWalk walk(text_);
        for (const std::size_t i : order) places[i] = walk.to(edges_[i].at);
        out_.fold_deg = kFoldedDeg;
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            const Vec2 a = nth(corners_, edges_[i].a);
            const Vec2 b = nth(corners_, edges_[i].b);
            if (a == b) continue;
            out_.lines.push_back({{a, b}, false, uses_[i], angles_[i], places[i], std::to_string(i)});
        }
        if (!sound_) out_.lines.clear();
    }

    void carry_keys(const JsonValue& root) {
        std::vector<const JsonValue*> chain;
        for (int frame = frame_; frame >= 0 && chain.size() < frames_.size(); frame = parent_of(frame))
            chain.push_back(nth(frames_, frame));
        const std::size_t edges = member("edges_vertices") == nullptr ? 0 : edges_.size();
        CarriedKeys& out = out_.carried;
        out = carry(text_, root, chain, {corners_.size(), edges, faces_.size()});
        out.other_frames = frames_.size() - 1;
        const bool orders = std::any_of(out.members.begin(), out.members.end(),
                                        [](const auto& member) { return member.key == "faceOrders"; });
        if (out.vertices.empty() && out.edges.empty() && out.faces.empty() && !orders) return;
        out.corners = std::move(corners_);
        for (const Edge& edge : edges_) out.edge_corners.push_back({edge.a, edge.b});
        out.face_corners = std::move(faces_);
    }

    std::string_view text_;
    const ReadOptions& options_;
    Diagnostics& diagnostics_;
    bool sound_ = true;
    std::size_t told_ = 0;
    std::vector<const JsonValue*> frames_;
    int frame_ = 0;
    std::vector<Vec2> corners_;
    std::vector<std::vector<int>> faces_;
    std::vector<Edge> edges_;
    std::map<std::pair<int, int>, Side> sides_;  // of faces, by their ends
    std::vector<CreaseUse> uses_;                // by edge
    std::vector<std::optional<double>> angles_;
    CreasePattern out_;
};

}  // namespace

std::optional<CreasePattern> read(const Source& source, const ReadOptions& options,
                                  Diagnostics& diagnostics) {
    const std::optional<JsonValue> tree = read_json(source.text, "fold-syntax", diagnostics);
    if (!tree) return std::nullopt;
    std::optional<CreasePattern> pattern = Reader(source, options, diagnostics).run(*tree);
    if (!pattern || diagnostics.has_errors_as_given()) return std::nullopt;
    pattern->stem = source.stem();
    return pattern;
}

bool recognises(std::string_view text) {
    text = trimmed(text);
    if (!text.starts_with('{')) return false;
    // Of the keys that such a file has, one stands near its beginning.
    const std::string_view begin = text.substr(0, 400);
    return begin.find("\"file_spec\"") != std::string_view::npos ||
           begin.find("\"vertices_coords\"") != std::string_view::npos ||
           begin.find("\"edges_vertices\"") != std::string_view::npos;
}

}  // namespace popup::fold
