#include "input/drawing/trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "input/drawing/conditions.h"
#include "input/drawing/dashes.h"
#include "input/drawing/fold_angles.h"
#include "input/drawing/label.h"
#include "input/drawing/notation.h"
#include "input/drawing/placing.h"
#include "input/drawing/shapes.h"
#include "input/drawing/size.h"
#include "input/drawing/style.h"
#include "input/drawing/tally.h"
#include "input/drawing/use_sizes.h"
#include "input/drawing/viewport.h"
#include "input/drawing/vocabulary.h"
#include "input/text.h"
#include "input/xml/encoding.h"
#include "input/xml/tree.h"

namespace popup::drawing {
namespace {

using xml::Offset;

// What an element hands down to those in it.
struct Context {
    Affine to_mm;
    Style style;
    Vec2 view;          // size of the viewport in user units, for percentages
    int group = -1;     // index into names: of the group around
    int instance = -1;  // of the use element that stands for what is here
    Layer layer = Layer::none;
    int owner = 0;
    Said said;
    std::optional<double> fold_deg;  // of all folds in it that do not say their own
};

// Elements [next, end) that are still to be looked at.
struct Frame {
    Offset next = 0, end = 0;
    Context context;
    Offset used = 0;  // the element that a use stands for; 0: none
    WantedSize wanted = {};
    bool one_of = false;  // the first that is drawn, and no other
};

class Tracer {
 public:
    Tracer(const xml::Located& located, const ReadOptions& options, Diagnostics& diagnostics)
        : located_(located),
          strict_(options.strict),
          folded_(options.drawing.as == DrawnAs::folded),
          rules_(options.drawing.lines),
          diagnostics_(diagnostics) {}

    std::optional<Tracing> run() {
        if (!find_prefix()) return std::nullopt;
        collect();
        Context context;
        if (diagnostics_.has_errors_as_given() || !root(context)) return std::nullopt;
        active_.assign(located_.elements.size(), 0);
        stack_.push_back({1, located_.elements[0].after, context});
        while (!stack_.empty() && !stopped_) step();
        // Where nothing has a stroke the shapes are contours, whose fills nobody prints.
        const bool contours = std::none_of(out_.lines.begin(), out_.lines.end(),
                                           [](const TracedLine& line) { return line.use == Use::cut; });
        for (const auto& [place, without_stroke] : unprinted_) {
            if (!without_stroke || !contours) tally_.fill(place);
        }
        tally_.tell(strict_, diagnostics_);
        rules_.tell_unused(out_.lines, diagnostics_);
        if (diagnostics_.has_errors_as_given()) return std::nullopt;
        out_.curves = CurveTable(flat_.curves);
        return std::move(out_);
    }

 private:
    // --- before the walk

    bool find_prefix() {
        const auto prefix = svg_prefix(located_);
        if (!prefix) {
            diagnostics_
                .error("wrong-root", located_.elements[0].place,
                       fmt::format("the root element is <{}>, not <svg>", shown(located_.name(0))))
                .hint("--from xml reads a popup document whatever its name");
            return false;
        }
        prefix_ = *prefix;
        return true;
    }

    [[nodiscard]] std::string_view text(Offset begin, Offset length) const {
        return located_.text.substr(begin, length);
    }
    [[nodiscard]] std::size_t attributes_end(Offset element) const {
        return element + 1 < located_.elements.size() ? located_.elements[element + 1].first_attribute
                                                      : located_.attributes.size();
    }
    // The element's name in SVG; empty when it is of another language.
    [[nodiscard]] std::string_view tag_of(Offset element) const {
        const std::string_view name = located_.name(element);
        if (!name.starts_with(prefix_)) return {};
        const std::string_view local = name.substr(prefix_.size());
        return local.find(':') == std::string_view::npos ? local : std::string_view{};
    }

    // Ids and style sheets, which count for what stands before them, too.
    void collect() {
        bool hides = false;
        for (Offset i = 0; i < located_.elements.size(); ++i) {
            for (std::size_t a = located_.elements[i].first_attribute; a < attributes_end(i); ++a) {
                const xml::LocatedAttribute& attribute = located_.attributes[a];
                if (text(attribute.name, attribute.name_length) == "id") {
                    ids_.try_emplace(trimmed(text(attribute.value, attribute.value_length)), i);
                }
            }
            if (tag_of(i) != "style") continue;
            const auto tree = xml::Tree::parse(located_, i, xml::Tree::Extent::shell, diagnostics_);
            if (!tree) return;
            const Attributes attributes(tree->root().attributes());
            if (!is_style_for_us(attributes.value("media"), attributes.value("type"))) {
                sheet_.leave_out();
                continue;
            }
            for (const xml::Text& part : tree->root().texts()) {
                sheet_.add(part.decoded);
                hides = hides || part.decoded.find("display") != std::string_view::npos;
            }
        }
        if (!hides) use_sizes_.emplace(located_, prefix_, ids_);
        tell_style_sheets(sheet_, located_.text.substr(0, located_.elements[0].begin),
                          located_.elements[0].place, diagnostics_);
    }

    // Finds out what a unit of the drawing is.
    bool root(Context& context) {
        const auto tree = xml::Tree::parse(located_, 0, xml::Tree::Extent::tag, diagnostics_);
        if (!tree) return false;
        Attributes attributes(tree->root().attributes(), entities_, located_.text);
        const Place place = located_.elements[0].place;
        Declarations declared = declarations("svg", attributes, true);
        if (!take_style(declared, place, context) || !inherit_angle(attributes, context)) return false;
        for (const auto& [name, value] : declared.geometry()) {
            // On a page it may fill what is around it.
            if (!value.ends_with('%')) attributes.put(name, value, place);
        }
        const auto size = [&](std::string_view name) -> double {
            const std::string_view value = attributes.value(name);
            if (value.empty() || value == "auto" || value.ends_with('%')) return 0.0;
            const auto length = parse_length(value, 0.0);
            if (length && *length > 0.0) return *length;
            diagnostics_.error(
                "bad-number", attributes.find(name)->place,
                fmt::format("the drawing's {} is \"{}\", which is no length above zero", name, shown(value)));
            return 0.0;
        };
        double width = size("width");
        double height = size("height");
        const bool sized = width > 0.0 || height > 0.0;
        std::optional<ViewBox> box;
        if (const xml::Attribute* given = attributes.find("viewBox")) {
            box = parse_view_box(given->value.decoded);
            if (!box) {
                diagnostics_
                    .error("bad-number", given->place,
                           fmt::format("the viewBox is \"{}\"", shown(given->value.decoded)))
                    .hint("it is four numbers: left, top, width, height, the last two above zero");
            }
        }
        if (diagnostics_.has_errors_as_given()) return false;
        if (box) {
            if (!sized) width = box->width;
            if (width == 0.0) width = height / box->height * box->width;
            if (height == 0.0) height = width / box->width * box->height;
        }
        const bool has_unit =
            has_real_unit(attributes.value("width")) || has_real_unit(attributes.value("height"));
        constexpr double k = kMmPerPixel;
        out_.page = {k * width, k * height};
        tell_size(place, out_.page, {sized, has_unit, is_by_illustrator(located_.text)}, diagnostics_);
        out_.ruler = {{0.0, out_.page.y}, 1.0, true};
        const std::string_view preserve = attributes.value("preserveAspectRatio");
        context.to_mm = {k, 0.0, 0.0, -k, 0.0, k * height};
        if (box) context.to_mm = context.to_mm.after(fitted(*box, width, height, preserve));
        context.view = box ? Vec2{box->width, box->height} : Vec2{width, height};
        const std::string* transform = declared.find(Property::transform);
        if (transform != nullptr && !sets_nothing(*transform) && parse_transform(*transform) != Affine{})
            tally_.not_read("transform", place);
        return true;
    }

    // --- the walk

    void step() {
        Frame& frame = stack_.back();
        if (frame.next >= frame.end) {
            if (frame.used != 0) {
                active_[frame.used] = 0;
                --uses_;
            }
            stack_.pop_back();
            return;
        }
        const Offset element = frame.next;
        frame.next = located_.elements[element].after;
        const Context context = frame.context;  // the frame may move
        visit(element, context);
    }

    void visit(Offset element, const Context& around) {
        const std::string_view tag = tag_of(element);
        if (tag.empty()) return;
        const xml::LocatedElement& at = located_.elements[element];
        Role kind = role_of(tag);
        // A symbol is drawn where it is used, and there alone.
        if (tag == "symbol" && stack_.back().used == element) kind = Role::container;
        if (kind == Role::silent) return;
        if (kind == Role::unknown) return tally_.unknown(tag, at.place);
        if (uses_ > 0 && !count_used(used_, {1, at.tag_end - at.begin}, at.place)) return;
        const auto tree = xml::Tree::parse(located_, element, xml::Tree::Extent::tag, diagnostics_);
        if (!tree) {
            stopped_ = true;
            return;
        }
        Attributes attributes(tree->root().attributes(), entities_, located_.text);
        if (!conditions_hold(attributes)) {
            if (kind != Role::skipped) tally_.hidden(at.place);
            return;
        }
        if (stack_.back().one_of) stack_.back().next = stack_.back().end;
        Context context = around;
        Declarations declared = declarations(tag, attributes, false);
        if (!take_style(declared, at.place, context)) return;
        for (const auto& [name, value] : declared.geometry()) attributes.put(name, value, at.place);
        const std::string_view caption = attributes.value("inkscape:label");
        rules_.follow({caption, attributes.value("class"), attributes.value("id")}, context.said,
                      tag == "g" && caption.empty() ? 3 : 2);
        if (!context.style.displayed) return tally_.hidden(at.place);
        for (const Property property : {Property::clip, Property::mask}) {
            const std::string* value = declared.find(property);
            if (value != nullptr && *value != "none") tally_.clipped(at.place);
        }
        if (!apply_transform(declared, attributes, at.place, context)) return;
        if (kind != Role::shape && !inherit_angle(attributes, context)) return;
        switch (kind) {
            case Role::shape:
                return shape(tag, attributes, at.place, context);
            case Role::container:
                return container(element, tag, attributes, context);
            case Role::use:
                return use(attributes, at.place, context);
            case Role::skipped:
                if (context.owner > 0 && context.layer == Layer::label && tag == "text") {
                    return label(element, attributes, context);
                }
                if (context.said.named == Named::ignore) return;  // notes are not for cutting
                return tally_.skipped(tag, at.place);
            case Role::silent:
            case Role::unknown:
                return;
        }
    }

    // Of an element; what is declared gets its variables put in. False: of too many.
    bool take_style(Declarations& declared, Place place, Context& context) {
        for (const std::string& name : context.style.take(declared)) tally_.not_set(name, place);
        declared_variables_ += declared.variable_count();
        if (declared_variables_ <= kDeclaredVariablesLimit) return true;
        diagnostics_.error("document-too-large", place,
                           fmt::format("more than {} variables are set", kDeclaredVariablesLimit));
        stopped_ = true;
        return false;
    }

    Declarations declarations(std::string_view tag, const Attributes& attributes, bool is_root) const {
        Declarations all;
        for (const xml::Attribute& attribute : attributes.all()) {
            if (const auto property = find_property(attribute.name)) {
                all.set(*property, attribute.value.decoded, Declarations::kAttribute, 0);
            } else if (attribute.name == "style") {
                all.set_all(attribute.value.decoded, Declarations::kElement, 0);
            }
        }
        sheet_.apply(tag, attributes.value("id"), attributes.value("class"), is_root, all);
        return all;
    }

    bool apply_transform(const Declarations& declared, const Attributes& attributes, Place place,
                         Context& context) {
        const Placing made = placing_of(declared, attributes, context.view);
        for (const std::string_view name : made.not_read) tally_.not_read(name, place);
        context.to_mm = context.to_mm.after(made.map);
        if (made.fault == nullptr) return true;
        diagnostics_
            .error("bad-transform", made.fault->place,
                   fmt::format("the transform \"{}\" cannot be read", shown(made.fault->value.decoded)))
            .hint("it is a list of matrix, translate, scale, rotate, skewX and skewY");
        return false;
    }

    bool inherit_angle(const Attributes& attributes, Context& context) {
        std::optional<ShapeProblem> problem;
        context.fold_deg = inherited_angle(attributes, context.fold_deg, problem);
        if (problem) tell(*problem);
        return !problem;
    }

    // False: uses stand for too much.
    bool count_used(UseSizes::Size& used, const UseSizes::Size& more, Place place) {
        used = {used.elements + more.elements, used.bytes + more.bytes};
        if (used.elements <= kUsedElementsLimit && used.bytes <= kUsedBytesLimit) return true;
        diagnostics_.error("document-too-large", place,
                           fmt::format("use elements make more than {} elements, or {} MiB, of this drawing",
                                       kUsedElementsLimit, kUsedBytesLimit >> 20U));
        stopped_ = true;
        return false;
    }

    int add_name(std::string_view name) {
        if (name.empty()) return -1;
        names_.push_back(short_name(name));
        return static_cast<int>(names_.size()) - 1;
    }

    static std::string_view name_of(const Attributes& attributes) {
        const std::string_view id = attributes.value("id");
        return id.empty() ? attributes.value("inkscape:label") : id;
    }

    void container(Offset element, std::string_view tag, const Attributes& attributes, Context context) {
        if (tag == "g") {
            if (const int name = add_name(attributes.value("id")); name >= 0) context.group = name;
            read_layer(element, attributes, context);
        } else if (tag == "svg") {
            const Frame& frame = stack_.back();
            if (!new_viewport(attributes, frame.used == element ? frame.wanted : WantedSize{}, context))
                return;
        }
        stack_.push_back({element + 1, located_.elements[element].after, context});
        stack_.back().one_of = tag == "switch";
    }

    // Whose the lines are, in a sheet that this program has made.
    void read_layer(Offset element, const Attributes& attributes, Context& context) {
        if (attributes.value("inkscape:groupmode") == "layer") {
            context.layer = layer_named(attributes.value("inkscape:label"));
        }
        if (attributes.find("data-piece") == nullptr) return;
        out_.own_sheet = true;
        if (context.layer == Layer::none) context.layer = Layer::machine;
        if (context.layer == Layer::machine) return;
        std::string key;
        for (const std::string_view name : {"data-design", "data-piece", "data-copy"}) {
            key += attributes.value(name);
            key += '\n';
        }
        const auto [row, fresh] = owners_.try_emplace(key, static_cast<int>(out_.owners.size()));
        if (fresh) {
            out_.owners.push_back(
                {short_name(attributes.value("data-piece")), located_.elements[element].place});
        }
        context.owner = row->second;
    }

    // False: nothing is drawn in it.
    bool new_viewport(const Attributes& attributes, const WantedSize& wanted, Context& context) {
        std::optional<ShapeProblem> problem;
        const auto made = viewport_of(attributes, context.view, wanted, problem);
        if (problem) tell(*problem);
        if (!made) return false;
        context.to_mm = context.to_mm.after(made->from_inside);
        context.view = made->view;
        return true;
    }

    void use(const Attributes& attributes, Place place, Context context) {
        const xml::Attribute* href = attributes.find("href");
        if (href == nullptr) href = attributes.find("xlink:href");
        if (href == nullptr) return;
        const std::string_view target = trimmed(href->value.decoded);
        const auto found = target.starts_with('#') ? ids_.find(target.substr(1)) : ids_.end();
        if (found == ids_.end()) {
            diagnostics_.error(
                "bad-reference", href->place,
                target.starts_with('#')
                    ? fmt::format("nothing has the id \"{}\"", shown(target.substr(1)))
                    : fmt::format("\"{}\" is in another file, which is not read", shown(target)));
            return;
        }
        const Offset element = found->second;
        if (active_[element] != 0 || element == 0) {
            diagnostics_.error("bad-reference", place,
                               fmt::format("\"{}\" is used inside itself", shown(target.substr(1))));
            stopped_ = true;
            return;
        }
        if (uses_ == 0 && use_sizes_ && !count_used(promised_, use_sizes_->of(element), place)) return;
        std::optional<ShapeProblem> problem;
        const Vec2 at{length_of(attributes, "x", context.view.x, 0.0, problem),
                      length_of(attributes, "y", context.view.y, 0.0, problem)};
        const auto wanted = [&](std::string_view name, double whole) {
            const double length = length_of(attributes, name, whole, HUGE_VAL, problem);
            return std::isfinite(length) ? std::optional(length) : std::nullopt;
        };
        const WantedSize size{wanted("width", context.view.x), wanted("height", context.view.y)};
        if (problem) return tell(*problem);
        context.to_mm = context.to_mm.after({1.0, 0.0, 0.0, 1.0, at.x, at.y});
        if (const int name = add_name(name_of(attributes)); name >= 0) context.instance = name;
        if (tag_of(element) == "symbol") {
            const auto tree = xml::Tree::parse(located_, element, xml::Tree::Extent::tag, diagnostics_);
            if (!tree ||
                !new_viewport(Attributes(tree->root().attributes(), entities_, located_.text), size, context))
                return;
        }
        active_[element] = 1;
        ++uses_;
        stack_.push_back({element, located_.elements[element].after, context, element, size});
    }

    void shape(std::string_view tag, const Attributes& attributes, Place place, const Context& context) {
        const Style& style = context.style;
        if (!style.visible) return tally_.hidden(place);
        Path path;
        if (const auto problem = make_shape(tag, attributes, context.view, path)) return tell(*problem);
        path = path.mapped(context.to_mm);
        flat_.lines.clear();
        switch (flatten(path, flat_)) {
            case FlatteningFault::none:
                break;
            case FlatteningFault::too_far:
                diagnostics_
                    .error("bad-number", place,
                           fmt::format("this shape reaches further than {:.0f} mm", kReachMm))
                    .hint("see whether its transforms and the drawing's size are what they should be");
                return;
            case FlatteningFault::too_many:
                diagnostics_.error("document-too-large", place,
                                   fmt::format("the drawing has more than {} points", kFlatPointsLimit));
                stopped_ = true;
                return;
        }
        if (flat_.lines.empty()) return;
        std::vector<Polyline> lines = std::exchange(flat_.lines, {});
        std::optional<ShapeProblem> problem;
        fold_angles_ = fold_angles(attributes, lines.size(), path, context.fold_deg, problem);
        if (problem) return tell(*problem);
        out_.elements.push_back(
            {context.instance >= 0 ? name_at(context.instance) : short_name(name_of(attributes)),
             name_at(context.group), place});
        if (context.owner > 0) return add_by_layer(std::move(lines), context);
        add_by_style(std::move(lines), context);
    }

    [[nodiscard]] std::string name_at(int number) const {
        return number < 0 ? std::string() : names_[static_cast<std::size_t>(number)];
    }

    void add_lines(std::vector<Polyline>&& lines, Use use, const Context& context) {
        if (!fold_angles_.sides.empty() && use != Use::shape) lines = std::move(fold_angles_.sides);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            Polyline& line = lines[i];
            out_.lines.push_back({std::move(line.points), line.closed, use,
                                  static_cast<int>(out_.elements.size()) - 1, context.owner,
                                  context.style.stroke.color, context.style.width * context.to_mm.growth(),
                                  context.style.dash});
            out_.lines.back().dash_mm = context.style.dash_length * context.to_mm.growth();
            out_.lines.back().gap_mm = context.style.gap_length * context.to_mm.growth();
            out_.lines.back().of_machine = context.layer == Layer::machine;
            out_.lines.back().opacity = context.style.opacity * context.style.stroke_opacity;
            if (i < fold_angles_.deg.size()) out_.lines.back().fold_deg = fold_angles_.deg[i];
            rules_.say(context.said, context.style.stroke, out_.lines.back());
        }
    }

    void add_fill(const std::vector<Polyline>& lines, bool without_stroke, const Context& context) {
        TracedFill fill;
        for (const Polyline& line : lines) {
            if (line.points.size() >= 3) fill.rings.push_back(line.points);
        }
        if (fill.rings.empty()) return;
        fill.even_odd = context.style.even_odd;
        fill.without_stroke = without_stroke;
        fill.color = context.style.fill.color;
        fill.is_printed = context.style.fill.kind == Paint::Kind::color;
        if (!fill.is_printed) unprinted_.emplace_back(out_.elements.back().place, without_stroke);
        fill.element = static_cast<int>(out_.elements.size()) - 1;
        fill.owner = context.owner;
        out_.fills.push_back(std::move(fill));
    }

    void add_by_layer(std::vector<Polyline>&& lines, const Context& context) {
        switch (context.layer) {
            case Layer::fill:
                return add_fill(lines, false, context);
            case Layer::valley:
                return add_lines(std::move(lines), Use::valley, context);
            case Layer::mountain:
                return add_lines(std::move(lines), Use::mountain, context);
            case Layer::seam:
                return add_lines(std::move(lines), Use::seam, context);
            case Layer::cut:
                return add_lines(std::move(lines), Use::cut, context);
            default:
                return add_lines(std::move(lines), Use::print, context);
        }
    }

    void add_by_style(std::vector<Polyline>&& lines, const Context& context) {
        const Style& style = context.style;
        const bool filled = style.fill.kind != Paint::Kind::none && style.opacity * style.fill_opacity > 0.0;
        // Of folded sheets opacity says how far lines are folded.
        const bool stroked =
            style.stroke.kind != Paint::Kind::none && (folded_ || style.opacity * style.stroke_opacity > 0.0);
        if (!stroked) {
            if (!filled) {
                ++out_.invisible;
                return;
            }
            add_fill(lines, true, context);
            for (Polyline& line : lines) line.closed = line.points.size() >= 3;
            std::erase_if(lines, [](const Polyline& line) { return !line.closed; });
            if (lines.empty()) ++out_.invisible;
            return add_lines(std::move(lines), Use::shape, context);
        }
        const Use use = use_of(style);
        if (use == Use::cut && filled && style.fill_written) add_fill(lines, false, context);
        add_lines(std::move(lines), use, context);
        // Gradients are no colours of lines that are to be folded.
        if (style.stroke.kind == Paint::Kind::other && out_.lines.back().named == Named::nothing &&
            !lower(style.stroke_text).starts_with("url("))
            tally_.color(style.stroke_text, out_.elements.back().place);
    }

    void label(Offset element, const Attributes& attributes, const Context& context) {
        const auto tree = xml::Tree::parse(located_, element, xml::Tree::Extent::shell, diagnostics_);
        auto text = tree ? label_of(tree->root(), attributes, context.to_mm) : std::nullopt;
        if (!text) return tally_.skipped("text", located_.elements[element].place);
        out_.texts.push_back({*std::move(text), context.owner});
    }

    // --- findings

    void tell(const ShapeProblem& problem) {
        Place place = problem.attribute->place;
        // An exact place costs a pass over the text: not for the hundredth mistake.
        constexpr int kExactPlaces = 10;
        const TextRange raw = problem.attribute->value.raw;
        if (problem.at && raw.present() && *problem.at <= raw.length && exact_places_++ < kExactPlaces &&
            located_.text.substr(raw.offset, raw.length).find_first_of("&\r") == std::string_view::npos)
            place = xml::PlaceCounter(located_.text).at(raw.offset + *problem.at);
        diagnostics_.error(problem.code, place, problem.message);
        if (problem.code == "document-too-large") stopped_ = true;
    }

    const xml::Located& located_;
    Entities entities_{located_.text.substr(0, located_.elements[0].begin)};
    bool strict_, folded_;
    LineRules rules_;
    Diagnostics& diagnostics_;
    std::string_view prefix_;
    std::unordered_map<std::string_view, Offset> ids_;
    StyleSheet sheet_;
    std::vector<Frame> stack_;
    std::vector<char> active_;            // elements that a use now stands for
    std::size_t uses_ = 0;                // of these, how many there are
    UseSizes::Size used_, promised_;      // what uses have stood for, and what those begun will
    std::optional<UseSizes> use_sizes_;   // none where a style sheet may hide what they stand for
    std::size_t declared_variables_ = 0;  // by all elements
    std::vector<std::string> names_;
    std::map<std::string, int, std::less<>> owners_;
    Tally tally_;
    std::vector<std::pair<Place, bool>> unprinted_;  // fills that are no colour; true: without a stroke
    Flattened flat_;                                 // the lines of the shape at hand, the curves of all
    FoldAngles fold_angles_;                         // of these lines
    int exact_places_ = 0;
    bool stopped_ = false;
    Tracing out_;
};

}  // namespace

std::optional<Tracing> trace(const xml::Located& located, const ReadOptions& options,
                             Diagnostics& diagnostics) {
    std::optional<Tracing> made = Tracer(located, options, diagnostics).run();
    if (made) join_dashes(*made, diagnostics);
    return made;
}

}  // namespace popup::drawing
