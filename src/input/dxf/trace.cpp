#include "input/dxf/trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "base/nth.h"
#include "input/drawing/notation.h"
#include "input/drawing/style.h"
#include "input/drawing/tally.h"
#include "input/drawing/transform.h"
#include "input/drawing/vocabulary.h"
#include "input/text.h"

namespace popup::dxf {
namespace {

using drawing::Affine;
using drawing::Named;

// Of strokes that are printed: what CAD programs draw where nothing is said.
constexpr double kStrokeMm = 0.25;
// No number of a drawing in mm is larger, not even before it is moved.
constexpr double kBeyondMm = 1e9;
// Larger drawings have the wrong unit, mostly.
constexpr double kLargeMm = 5000.0;

struct Unit {
    int number;  // of $INSUNITS
    double mm;
    std::string_view name;
};
constexpr std::array<Unit, 12> kUnits{{{1, 25.4, "in"},
                                       {2, 304.8, "ft"},
                                       {4, 1.0, "mm"},
                                       {5, 10.0, "cm"},
                                       {6, 1000.0, "m"},
                                       {8, 25.4e-6, "µin"},
                                       {9, 25.4e-3, "mil"},
                                       {10, 914.4, "yd"},
                                       {12, 1e-6, "nm"},
                                       {13, 1e-3, "µm"},
                                       {14, 100.0, "dm"},
                                       {21, 1200.0 / 3937.0 * 1000.0, "ft"}}};

// What an insert hands down to the entities of its block.
struct Inherited {
    int layer = 0;
    Color color{0, 0, 0};
    int linetype = 0;
    bool hidden = false;
    int block = -1;  // the outermost, which names what it draws
};

struct Frame {
    const std::vector<Entity>* entities = nullptr;
    std::size_t next = 0;
    Affine map;
    Inherited inherited;
    // Of a block: which, and the rest of the grid that it is put on.
    std::size_t block = 0;
    const Insert* insert = nullptr;
    Affine around;
    long long copy = 0;
};

// The map of one of an insert's copies.
Affine map_of(const Insert& insert, Vec2 base, long long copy, const Affine& around) {
    const double c = std::cos(insert.turn);
    const double s = std::sin(insert.turn);
    const long long row = copy / insert.columns;
    const long long column = copy % insert.columns;
    const Vec2 off{insert.spacing.x * static_cast<double>(column),
                   insert.spacing.y * static_cast<double>(row)};
    const Vec2 at = insert.at + Vec2{c * off.x - s * off.y, s * off.x + c * off.y};
    Affine own{c * insert.scale.x, s * insert.scale.x, -s * insert.scale.y, c * insert.scale.y, 0.0, 0.0};
    const Vec2 moved = at - own(base);
    own.e = moved.x;
    own.f = moved.y;
    return around.after(own);
}

class Tracer {
 public:
    Tracer(const Document& document, const ReadOptions& options, Diagnostics& diagnostics)
        : document_(document), rules_(options.drawing.lines), diagnostics_(diagnostics) {
        for (std::size_t i = 0; i < document.blocks.size(); ++i)
            blocks_.try_emplace(document.blocks[i].name, i);
        active_.assign(document.blocks.size(), 0);
        said_.resize(document.layers.size());
        for (std::size_t i = 0; i < said_.size(); ++i) said_[i] = rules_.said_by(document.layers[i].name);
    }

    std::optional<drawing::Tracing> run() {
        find_unit();
        Frame frame;
        frame.entities = &document_.entities;
        frame.map = {unit_mm_, 0.0, 0.0, unit_mm_, 0.0, 0.0};
        stack_.push_back(frame);
        while (!stack_.empty() && !stopped_) step();
        tally_.tell(false, diagnostics_);
        rules_.tell_unused(out_.lines, diagnostics_);
        if (diagnostics_.has_errors_as_given()) return std::nullopt;
        tell_size();
        out_.ruler.origin = moved_;
        out_.ruler.per_mm = 1.0 / unit_mm_;
        out_.ruler.unit = unit_;
        out_.by_layers = true;
        out_.curves = CurveTable(flat_.curves);
        return std::move(out_);
    }

 private:
    // --- units

    void find_unit() {
        if (document_.units) {
            const auto* const row = std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& unit) {
                return unit.number == *document_.units;
            });
            if (row != kUnits.end()) {
                unit_mm_ = row->mm;
                unit_ = row->name;
                unit_said_ = true;
                return;
            }
        }
        if (document_.metric && !*document_.metric) {
            unit_mm_ = 25.4;
            unit_ = "in";
        }
    }

    void tell_size() {
        Box box;
        for (const drawing::TracedLine& line : out_.lines) {
            for (const Vec2 p : line.points) box.extend(p);
        }
        if (box.empty()) return;
        const Place place{document_.units_line, document_.units_line == 0 ? 0 : 1};
        const std::string size = fmt::format("{:.2f} × {:.2f} mm", box.width(), box.height());
        if (std::max(box.width(), box.height()) > kLargeMm) {
            diagnostics_
                .warning("dxf-size", place,
                         fmt::format("with {} for its unit the drawing is {}", unit_, size))
                .hint("the unit is $INSUNITS of the file; --scale 0.001 reads metres as millimetres");
        } else if (!unit_said_) {
            diagnostics_
                .remark("dxf-unit", place,
                        fmt::format("the drawing does not say its unit, which is taken for {}: {}",
                                    unit_ == "in" ? "inches" : "millimetres", size))
                .hint("set the units of the drawing, or use --scale");
        }
    }

    // --- the walk

    void step() {
        Frame& frame = stack_.back();
        if (frame.next < frame.entities->size()) {
            const Entity& entity = (*frame.entities)[frame.next++];
            const Frame around = frame;  // it may move
            return visit(entity, around);
        }
        if (frame.insert == nullptr) return stack_.pop_back();
        const long long copies = static_cast<long long>(frame.insert->columns) * frame.insert->rows;
        if (++frame.copy >= copies) {
            active_[frame.block] = 0;
            return stack_.pop_back();
        }
        if (!count_put((*frame.entities).empty() ? 0 : document_.entities.front().line)) return;
        frame.next = 0;
        frame.map = map_of(*frame.insert, document_.blocks[frame.block].base, frame.copy, frame.around);
    }

    bool count_put(int line) {
        if (++put_ <= kPutEntitiesLimit) return true;
        diagnostics_.error(
            "document-too-large", {line, line == 0 ? 0 : 1},
            fmt::format("blocks make more than {} entities of this drawing", kPutEntitiesLimit));
        stopped_ = true;
        return false;
    }

    void visit(const Entity& entity, const Frame& around) {
        if (around.insert != nullptr && !count_put(entity.line)) return;
        Inherited own = inherited_by(entity, around.inherited);
        const Layer& layer = nth(document_.layers, own.layer);
        const bool hidden = own.hidden || layer.off || layer.frozen;
        const Place place{entity.line, 1};
        if (entity.insert >= 0) {
            // What is put on a layer that is off has layers of its own.
            if (own.hidden || layer.frozen) return tally_.hidden(place);
            return put(entity, own, around);
        }
        if (hidden) return tally_.hidden(place);
        if (entity.skipped >= 0) {
            if (nth(said_, own.layer).named == Named::ignore) return;
            return tally_.skipped(nth(document_.kinds, entity.skipped), place);
        }
        draw(entity, own, around.map);
    }

    // By layer, by block, or by what it says itself.
    [[nodiscard]] Inherited inherited_by(const Entity& entity, const Inherited& around) const {
        Inherited own = around;
        if (entity.layer != 0 || around.block < 0) own.layer = entity.layer;
        const Layer& layer = nth(document_.layers, own.layer);
        if (entity.rgb) {
            own.color = *entity.rgb;
        } else if (entity.color == kByLayer) {
            own.color = layer.rgb ? *layer.rgb : index_color(layer.color);
        } else if (entity.color != kByBlock) {
            own.color = index_color(entity.color);
        }
        if (entity.linetype == kLinetypeByLayer) {
            own.linetype = layer.linetype;
        } else if (entity.linetype != kLinetypeByBlock) {
            own.linetype = entity.linetype;
        }
        own.hidden = around.hidden || entity.hidden;
        return own;
    }

    static Affine seen(const Entity& entity, const Affine& map) {
        return entity.mirrored ? map.after({-1.0, 0.0, 0.0, 1.0, 0.0, 0.0}) : map;
    }

    void put(const Entity& entity, Inherited own, const Frame& around) {
        const Insert& insert = nth(document_.inserts, entity.insert);
        const Place place{entity.line, 1};
        const auto found = blocks_.find(insert.block);
        const auto refuse = [&](std::string_view why) {
            diagnostics_.error("bad-reference", place,
                               fmt::format("the block \"{}\" {}", shown(insert.title), why));
        };
        if (found == blocks_.end()) return refuse("is not there");
        const std::size_t number = found->second;
        const Block& block = document_.blocks[number];
        if (block.elsewhere) return refuse("is in another file, which is not read");
        if (active_[number] != 0) {
            refuse("is put inside itself");
            stopped_ = true;
            return;
        }
        active_[number] = 1;
        if (own.block < 0) own.block = static_cast<int>(number);
        Frame frame;
        frame.entities = &block.entities;
        frame.inherited = own;
        frame.block = number;
        frame.insert = &insert;
        frame.around = seen(entity, around.map);
        frame.map = map_of(insert, block.base, 0, frame.around);
        stack_.push_back(frame);
    }

    // --- lines

    // Far from the origin digits are lost, and further out than CAD drawings may begin everything is a
    // mistake.
    [[nodiscard]] bool move(Path& path, Place place) {
        Box box;
        for (const Subpath& subpath : path.subpaths()) {
            box.extend(subpath.start);
            for (const PathStep& step : subpath.steps) box.extend(step.to);
        }
        if (box.empty()) return true;
        const auto within = [](Vec2 p) { return std::abs(p.x) <= kBeyondMm && std::abs(p.y) <= kBeyondMm; };
        if (!within(box.min) || !within(box.max)) {
            tell_far(place);
            return false;
        }
        if (out_.elements.empty() && std::max(std::abs(box.min.x), std::abs(box.min.y)) > kFarOffMm)
            moved_ = -Vec2{std::floor(box.min.x), std::floor(box.min.y)};
        if (moved_ != Vec2{}) path = path.mapped([this](Vec2 p) { return p + moved_; });
        return true;
    }

    void tell_far(Place place) {
        diagnostics_
            .error("bad-number", place,
                   fmt::format("with {} for the unit this reaches further than {:.0f} mm from the drawing",
                               unit_, kReachMm))
            .hint("see whether the units of the drawing, $INSUNITS, are what they should be");
    }

    void draw(const Entity& entity, const Inherited& own, const Affine& map) {
        const Place place{entity.line, 1};
        Path path = entity.path.mapped(seen(entity, map));
        if (!move(path, place)) return;
        flat_.lines.clear();
        switch (flatten(path, flat_)) {
            case FlatteningFault::none:
                break;
            case FlatteningFault::too_far:
                return tell_far(place);
            case FlatteningFault::too_many:
                diagnostics_.error("document-too-large", place,
                                   fmt::format("the drawing has more than {} points", kFlatPointsLimit));
                stopped_ = true;
                return;
        }
        if (flat_.lines.empty()) return;
        drawing::Style style;
        style.stroke = {drawing::Paint::Kind::color, own.color};
        style.dash = nth(document_.linetypes, std::max(0, own.linetype)).dash;
        out_.elements.push_back({"", group_of(own), place});
        for (Polyline& line : flat_.lines) {
            drawing::TracedLine made;
            made.points = std::move(line.points);
            made.closed = line.closed;
            // Many outlines end where they begin, and do not say that they are closed.
            constexpr std::size_t kLeast = 4;
            if (!made.closed && made.points.size() >= kLeast && made.points.front() == made.points.back()) {
                made.points.pop_back();
                made.closed = true;
            }
            made.use = drawing::use_of(style);
            made.element = static_cast<int>(out_.elements.size()) - 1;
            made.color = own.color;
            made.width_mm = kStrokeMm;
            made.dash = style.dash;
            rules_.say(nth(said_, own.layer), style.stroke, made);
            rules_.meet(nth(document_.layers, own.layer).name);
            out_.lines.push_back(std::move(made));
        }
    }

    // What names the part that a line is of: the block that was put there, or a layer whose name does not say
    // what lines are.
    [[nodiscard]] std::string group_of(const Inherited& own) const {
        if (own.block >= 0) {
            const std::string& name = nth(document_.blocks, own.block).title;
            return name.starts_with('*') ? std::string() : name;
        }
        return own.layer == 0 || nth(said_, own.layer).named != Named::nothing
                   ? std::string()
                   : nth(document_.layers, own.layer).name;
    }

    const Document& document_;
    drawing::LineRules rules_;
    Diagnostics& diagnostics_;
    std::map<std::string, std::size_t, std::less<>> blocks_;
    std::vector<char> active_;         // blocks that are being put
    std::vector<drawing::Said> said_;  // by the names of layers
    std::vector<Frame> stack_;
    drawing::Tally tally_;
    Flattened flat_;  // the lines of the entity at hand, the curves of all
    double unit_mm_ = 1.0;
    std::string unit_ = "mm";
    bool unit_said_ = false;
    int put_ = 0;
    Vec2 moved_;
    bool stopped_ = false;
    drawing::Tracing out_;
};

}  // namespace

std::optional<drawing::Tracing> trace(const Document& document, const ReadOptions& options,
                                      Diagnostics& diagnostics) {
    return Tracer(document, options, diagnostics).run();
}

}  // namespace popup::dxf
