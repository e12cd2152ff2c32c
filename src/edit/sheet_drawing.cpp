#include "edit/sheet_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "base/nth.h"
#include "edit/element_moves.h"
#include "input/drawing/fold_angles.h"
#include "input/drawing/shapes.h"
#include "input/drawing/size.h"
#include "input/drawing/transform.h"
#include "input/xml/locate.h"
#include "input/xml/read.h"
#include "input/xml/tree.h"
#include "popup/path.h"

namespace popup::edit {
namespace {

using drawing::Affine;
using drawing::Attributes;
using xml::Offset;

constexpr double kSameShapeMm = 1e-4;

std::string point(Vec2 at) { return shown_number(at.x) + "," + shown_number(at.y); }

std::optional<Affine> inverse(const Affine& map) {
    const double whole = map.a * map.d - map.b * map.c;
    if (std::abs(whole) < 1e-12) return std::nullopt;
    Affine made{map.d / whole, -map.b / whole, -map.c / whole, map.a / whole, 0.0, 0.0};
    const Vec2 origin = made({map.e, map.f});
    made.e = -origin.x;
    made.f = -origin.y;
    return made;
}

std::string path_text(const Path& path) {
    std::string text;
    for (const Subpath& subpath : path.subpaths()) {
        text += (text.empty() ? "M " : " M ") + point(subpath.start);
        char last = 'M';
        for (const PathStep& step : subpath.steps) {
            const char now = step.curve ? 'C' : 'L';
            text += ' ';
            if (now != last && !(last == 'M' && now == 'L')) text += std::string{now, ' '};
            last = step.curve ? 'C' : 'L';
            if (step.curve) text += point(step.control_1) + " " + point(step.control_2) + " ";
            text += point(step.to);
        }
        if (subpath.closed) text += " Z";
    }
    return text;
}

// Whether a style sheet has the word as one of its own, and not as a part of another ("direction"), a class
// or an id.
bool selects(std::string_view sheet, std::string_view word) {
    const auto of_word = [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return (byte >= '0' && byte <= '9') || ((byte | 0x20U) >= 'a' && (byte | 0x20U) <= 'z') || c == '-' ||
               c == '_' || byte >= 0x80;
    };
    for (std::size_t at = sheet.find(word); at != sheet.npos; at = sheet.find(word, at + 1)) {
        const char before = at > 0 ? sheet[at - 1] : ' ';
        const std::size_t end = at + word.size();
        const char after = end < sheet.size() ? sheet[end] : ' ';
        if (!of_word(before) && before != '.' && before != '#' && !of_word(after)) return true;
    }
    return false;
}

class Writer {
 public:
    Writer(const Source& source, const xml::Located& located, const CreasePattern& pattern,
           const EditedSheet& edited, Diagnostics& diagnostics)
        : source_(source), located_(located), diagnostics_(diagnostics) {
        for (std::size_t i = 0; i < pattern.lines.size(); ++i) {
            const Place place = pattern.lines[i].place;
            moves_[{place.line, place.column}].add(pattern.lines[i], edited.lines[i]);
            for (const Vec2 p : pattern.lines[i].points) before_.extend(p);
            for (const Vec2 p : edited.lines[i].points) after_.extend(p);
        }
        for (auto& [place, moves] : moves_) moves.sort();
    }

    std::optional<std::string> run() {
        if (!read_page()) return std::nullopt;
        std::vector<Offset> around;  // open elements
        for (Offset i = 1; i < located_.elements.size(); ++i) {
            while (!around.empty() && nth(located_.elements, around.back()).after <= i) around.pop_back();
            const Place place = located_.elements[i].place;
            const auto found = moves_.find({place.line, place.column});
            const bool changes =
                found != moves_.end() && (found->second.moved() || found->second.has_angles());
            if (changes && !rewrite(i, around, found->second)) return std::nullopt;
            around.push_back(i);
        }
        grow_page();
        std::sort(changes_.begin(), changes_.end(),
                  [](const xml::PatchEdit& a, const xml::PatchEdit& b) { return a.begin < b.begin; });
        return xml::patched(source_.text, changes_);
    }

 private:
    bool refuse(Place place, std::string why, std::string hint) {
        diagnostics_.error("edit-refused", place, std::move(why)).hint(std::move(hint));
        return false;
    }

    void replace(const xml::Attribute& attribute, std::string text) {
        const TextRange raw = attribute.value.raw;
        changes_.push_back({raw.offset, raw.offset + raw.length, std::move(text)});
    }

    bool read_page() {
        const auto tree = xml::Tree::parse(located_, 0, xml::Tree::Extent::tag, diagnostics_);
        if (!tree) return false;
        const Attributes root(tree->root().attributes());
        const auto size = [&](std::string_view name) {
            const std::string_view value = root.value(name);
            if (value.empty() || value == "auto" || value.ends_with('%')) return 0.0;
            return drawing::parse_length(value, 0.0).value_or(0.0);
        };
        Vec2 page{size("width"), size("height")};
        const xml::Attribute* given = root.find("viewBox");
        if (given != nullptr) box_ = drawing::parse_view_box(given->value.decoded);
        if (box_) {
            if (page.x == 0.0 && page.y == 0.0) page.x = box_->width;
            if (page.x == 0.0) page.x = page.y / box_->height * box_->width;
            if (page.y == 0.0) page.y = page.x / box_->width * box_->height;
        }
        page_ = page;
        constexpr double k = drawing::kMmPerPixel;
        to_mm_ = {k, 0.0, 0.0, -k, 0.0, k * page.y};
        if (box_)
            to_mm_ = to_mm_.after(drawing::fitted(*box_, page.x, page.y, root.value("preserveAspectRatio")));
        view_ = box_ ? Vec2{box_->width, box_->height} : page;
        return true;
    }

    // A drawing that was within its page stays so, as far from its edges as it was.
    void grow_page() {
        constexpr double k = drawing::kMmPerPixel;
        const Vec2 page = k * page_;
        const auto over = [](double was, double is) {
            return was >= -kSameShapeMm && is < was - kSameShapeMm && is < 0.0 ? was - is : 0.0;
        };
        const double left = over(before_.min.x, after_.min.x);
        const double bottom = over(before_.min.y, after_.min.y);
        const double right = over(page.x - before_.max.x, page.x - after_.max.x);
        const double top = over(page.y - before_.max.y, page.y - after_.max.y);
        if (left + bottom + right + top <= 0.0) return;
        const auto tree = xml::Tree::parse(located_, 0, xml::Tree::Extent::tag, diagnostics_);
        if (!tree) return;
        const Attributes root(tree->root().attributes());
        const double per_x = box_ ? box_->width / page.x : 0.0;
        const double per_y = box_ ? box_->height / page.y : 0.0;
        const bool has_width = root.find("width") != nullptr;
        const bool can =
            box_ && std::abs(per_x - per_y) < 1e-6 * per_x && has_width == (root.find("height") != nullptr);
        if (!can) {
            diagnostics_
                .remark("page-outgrown", located_.elements.front().place,
                        fmt::format("the drawing is now {:.2f} × {:.2f} mm, and leaves its page of {:.2f} × "
                                    "{:.2f} mm",
                                    after_.max.x - after_.min.x, after_.max.y - after_.min.y, page.x, page.y))
                .hint("give the picture a viewBox, a width and a height that are as large");
            return;
        }
        replace(*root.find("viewBox"), fmt::format("{} {} {} {}", shown_number(box_->corner.x - left * per_x),
                                                   shown_number(box_->corner.y - top * per_y),
                                                   shown_number(box_->width + (left + right) * per_x),
                                                   shown_number(box_->height + (top + bottom) * per_y)));
        if (!has_width) return;
        grow(*root.find("width"), (page.x + left + right) / page.x);
        grow(*root.find("height"), (page.y + top + bottom) / page.y);
    }
    // A length in its own unit.
    void grow(const xml::Attribute& length, double by) {
        const std::string_view value = length.value.decoded;
        const std::size_t unit = std::min(value.find_last_of("0123456789.") + 1, value.size());
        const double pixels = drawing::parse_length(value, 0.0).value_or(0.0);
        const double one = drawing::parse_length("1" + std::string(value.substr(unit)), 0.0).value_or(1.0);
        replace(length, shown_number(pixels / one * by) + std::string(value.substr(unit)));
    }

    // The map of an element's own coordinates to mm; nullopt after an error. What groups around say of the
    // angles of folds is noted.
    std::optional<Affine> map_of(Offset element, const std::vector<Offset>& around, Attributes& own) {
        Affine map = to_mm_;
        around_deg_.reset();
        std::optional<drawing::ShapeProblem> unheard;
        for (std::size_t i = 0; i <= around.size(); ++i) {
            const Offset one = i < around.size() ? around[i] : element;
            auto tree = xml::Tree::parse(located_, one, xml::Tree::Extent::tag, diagnostics_);
            if (!tree) return std::nullopt;
            Attributes attributes(tree->root().attributes());
            if (i < around.size() && !is_plain(tree->root().name())) {
                refuse(nth(located_.elements, element).place,
                       fmt::format("this element moves, and is drawn within <{}>, elsewhere than it stands",
                                   tree->root().name()),
                       "draw it in the picture itself");
                return std::nullopt;
            }
            if (const xml::Attribute* transform = attributes.find("transform"); transform != nullptr) {
                if (const auto inner = drawing::parse_transform(transform->value.decoded))
                    map = map.after(*inner);
            }
            if (i == around.size())
                own = std::move(attributes);
            else
                around_deg_ = drawing::inherited_angle(attributes, around_deg_, unheard);
            trees_.push_back(std::move(*tree));
        }
        return map;
    }
    static std::string_view local_name(std::string_view tag) { return tag.substr(tag.find(':') + 1); }
    static bool is_plain(std::string_view tag) {
        const std::string_view local = local_name(tag);
        return local == "g" || local == "a" || local == "switch";
    }

    // The folds of an element that does not move have other angles, and it draws elsewhere than it stands.
    bool is_drawn_elsewhere(Offset element, const std::vector<Offset>& around) {
        return !drawing::is_shape(local_name(located_.name(element))) ||
               std::any_of(around.begin(), around.end(),
                           [&](Offset one) { return !is_plain(located_.name(one)); });
    }
    void tell_unsaid(Place place, std::string why, std::string hint) {
        diagnostics_.remark("folds-turn", place, std::move(why)).hint(std::move(hint));
    }

    // What an element says of the angles of its folds. `edges`: it is written as these; `sides`: of so many
    // sides each, unless that is 0.
    void write_angles(const Attributes& own, const ElementMoves& moves, bool edges, std::size_t sides,
                      Place place) {
        std::optional<drawing::ShapeProblem> problem;
        const auto said = drawing::fold_angles(own, moves.lines(), {}, around_deg_, problem).deg;
        const xml::Attribute* given = own.find(drawing::kFoldAngle);
        if (!moves.has_angles() && !((edges || sides > 0) && given != nullptr)) return;
        if (problem) {
            tell_unsaid(place,
                        "the folds of this element have other angles now, and its data-fold-angle has one "
                        "for each line of one of the places at which it is drawn",
                        "draw it once, where it is");
            return;
        }
        const std::string text = sides > 0 ? *moves.angles_of_sides(said, sides) : moves.angles(said, edges);
        if (given != nullptr) {
            replace(*given, text);
        } else if (text != "auto") {
            const auto tag = trees_.back().root();
            const std::size_t behind_name = tag.start_tag().offset + 1 + tag.name().size();
            changes_.push_back(
                {behind_name, behind_name, fmt::format(" {}=\"{}\"", drawing::kFoldAngle, text)});
        }
    }

    bool rewrite(Offset element, const std::vector<Offset>& around, const ElementMoves& moves) {
        const Place place = nth(located_.elements, element).place;
        if (!moves.moved() && is_drawn_elsewhere(element, around)) {
            tell_unsaid(place,
                        "the folds of this element have other angles now, and it is drawn elsewhere "
                        "than it stands",
                        "draw it where it is, so that it can have a data-fold-angle of its own");
            return true;
        }
        trees_.clear();
        Attributes own({});
        const auto map = map_of(element, around, own);
        if (!map) return false;
        const auto back = inverse(*map);
        const std::string_view tag = local_name(located_.name(element));
        Path path;
        const bool unsound = drawing::make_shape(tag, own, view_, path).has_value();
        const Path in_mm = path.mapped(*map);
        const auto made = moved(in_mm, moves);
        const std::size_t sides = drawing::straight_sides(made.value_or(in_mm)).size();
        const bool by_sides = (moves.angles_differ() || moves.sides_bend()) && !moves.goes_apart() &&
                              moves.angles_of_sides({}, sides).has_value();
        const bool splits = moves.angles_differ() && !by_sides && tag == "path" && own.find("d") != nullptr;
        if (moves.angles_differ() && !by_sides && !splits) {
            tell_unsaid(place,
                        fmt::format("folds on one side of this <{}> have different angles now, and it has "
                                    "one data-fold-angle for each side",
                                    tag),
                        "draw it as a path: that can have one for each of its lines");
        }
        const bool edges = moves.goes_apart() || splits;
        write_angles(own, moves, edges, by_sides ? sides : 0, place);
        if (!moves.moved() && !edges) return true;
        if (unsound || !back) return refuse(place, "this element cannot be moved", "draw it as a path");
        if (moves.bends() && tag != "path" && tag != "polyline" && tag != "polygon" && tag != "rect")
            return refuse(place, fmt::format("this <{}> would have more corners than it can have", tag),
                          "draw it as a path");
        if (moves.goes_beyond(in_mm)) {
            return refuse(place,
                          "this element moves, and the first or last dash of its line is another element",
                          "draw the line as one element; in Illustrator, let dashes not be aligned to ends "
                          "and corners");
        }
        if (edges) return write_parted(tag, own, moves, *back, place);
        if (!made) {
            return refuse(
                place,
                "this element moves, and is drawn elsewhere than it stands, as by a use element or a style",
                "draw it where it is");
        }
        return write(element, own, path, made->mapped(*back), sides >= 3, place);
    }

    // A path in mm with its corners where they go; curves follow their ends.
    static std::optional<Path> moved(const Path& path, const ElementMoves& moves) {
        Path made;
        for (const Subpath& subpath : path.subpaths()) {
            const auto start = moves.find(subpath.start);
            if (!start) return std::nullopt;
            made.move(*start);
            Vec2 was = subpath.start;
            Vec2 is = *start;
            for (const PathStep& step : subpath.steps) {
                const auto to = moves.find(step.to);
                if (!to) return std::nullopt;
                if (step.curve) {
                    const Vec2 u = step.to - was;
                    const Vec2 v = *to - is;
                    const double size = dot(u, u);
                    const auto follow = [&](Vec2 p) {
                        if (size < 1e-12 || length(v - u) < 1e-12) return is + (p - was);
                        const double c = dot(u, v) / size;
                        const double s = cross(u, v) / size;
                        const Vec2 d = p - was;
                        return is + Vec2{c * d.x - s * d.y, s * d.x + c * d.y};
                    };
                    made.cubic(follow(step.control_1), follow(step.control_2), *to);
                } else {
                    for (const Vec2 at : moves.through(was, step.to)) made.line(at);
                    made.line(*to);
                }
                was = step.to;
                is = *to;
            }
            if (subpath.closed) {
                for (const Vec2 at : moves.through(was, subpath.start)) made.line(at);
                made.close();
            }
        }
        return made;
    }

    bool write_parted(std::string_view tag, const Attributes& own, const ElementMoves& moves,
                      const Affine& back, Place place) {
        const xml::Attribute* d = own.find("d");
        if (tag != "path" || d == nullptr) {
            return refuse(place, "what is cut by this element goes apart on its two sides",
                          "draw it as a path: that can have both sides");
        }
        std::string text;
        for (const Segment& one : moves.edges())
            text += fmt::format("{}M {} {}", text.empty() ? "" : " ", point(back(one.a)), point(back(one.b)));
        replace(*d, std::move(text));
        return true;
    }

    // `straight`: it has sides, and no curves.
    bool write(Offset element, const Attributes& own, const Path& was, const Path& is, bool straight,
               Place place) {
        const std::string_view tag = local_name(located_.name(element));
        const Subpath& shape = is.subpaths().front();
        if (tag == "path") {
            replace(*own.find("d"), path_text(is));
            return true;
        }
        if (tag == "polyline" || tag == "polygon") {
            std::string text = point(shape.start);
            for (const PathStep& step : shape.steps) text += " " + point(step.to);
            replace(*own.find("points"), std::move(text));
            return true;
        }
        if (tag == "line")
            return write_all(own,
                             {{"x1", shape.start.x},
                              {"y1", shape.start.y},
                              {"x2", shape.steps.front().to.x},
                              {"y2", shape.steps.front().to.y}},
                             place);
        const Box before = box_of(was);
        const Box after = box_of(is);
        const Vec2 by = after.min - before.min;
        const bool shifted = is_shifted(was, is, by);
        if (tag == "rect" &&
            (shifted || (own.find("rx") == nullptr && own.find("ry") == nullptr && is_square(is, after))))
            return write_all(own,
                             {{"x", after.min.x},
                              {"y", after.min.y},
                              {"width", after.max.x - after.min.x},
                              {"height", after.max.y - after.min.y}},
                             place);
        if ((tag == "circle" || tag == "ellipse") && shifted)
            return write_all(own, {{"cx", after.centre().x}, {"cy", after.centre().y}}, place);
        if (tag == "rect" && straight && !is_styled_by_name()) return write_as_polygon(element, is);
        return refuse(place, fmt::format("this <{}> would be none any more", tag), "draw it as a path");
    }

    // Whether a style sheet knows rectangles or polygons by their name.
    [[nodiscard]] bool is_styled_by_name() const {
        for (Offset i = 0; i < located_.elements.size(); ++i) {
            if (local_name(located_.name(i)) != "style") continue;
            const xml::LocatedElement& sheet = located_.elements[i];
            const std::string_view text =
                std::string_view(source_.text).substr(sheet.tag_end, sheet.end - sheet.tag_end);
            if (selects(text, "rect") || selects(text, "polygon")) return true;
        }
        return false;
    }

    // A rectangle that is none any more: the same element with another name, and corners.
    bool write_as_polygon(Offset element, const Path& is) {
        static constexpr std::string_view kRect = "rect";
        const xml::LocatedElement& at = nth(located_.elements, element);
        const auto rename = [&](std::size_t from) {
            const std::size_t name = source_.text.find(kRect, from);
            changes_.push_back({name, name + kRect.size(), "polygon"});
        };
        rename(at.begin);
        if (at.end > at.tag_end) rename(source_.text.rfind('<', at.end - 1));
        const Subpath& shape = is.subpaths().front();
        std::string points = point(shape.start);
        for (const PathStep& step : shape.steps) points += " " + point(step.to);
        bool written = false;
        for (const xml::LocatedAttribute& one : attributes_of(element)) {
            const std::string_view name = std::string_view(source_.text).substr(one.name, one.name_length);
            static constexpr std::array<std::string_view, 6> kOfRect{"x", "y", "width", "height", "rx", "ry"};
            if (std::find(kOfRect.begin(), kOfRect.end(), name) == kOfRect.end()) continue;
            const std::size_t end = one.value + one.value_length + 1;
            const std::size_t begin =
                written ? source_.text.find_last_not_of(" \t\r\n", one.name - 1) + 1 : one.name;
            changes_.push_back({begin, end, written ? "" : fmt::format("points=\"{}\"", points)});
            written = true;
        }
        return true;
    }
    [[nodiscard]] std::span<const xml::LocatedAttribute> attributes_of(Offset element) const {
        const std::span<const xml::LocatedAttribute> all(located_.attributes);
        const std::size_t first = nth(located_.elements, element).first_attribute;
        const std::size_t next = element + 1U;
        const std::size_t end =
            next < located_.elements.size() ? nth(located_.elements, next).first_attribute : all.size();
        return all.subspan(first, end - first);
    }

    bool write_all(const Attributes& own, const std::vector<std::pair<std::string_view, double>>& values,
                   Place place) {
        for (const auto& [name, value] : values) {
            const xml::Attribute* attribute = own.find(name);
            if (attribute == nullptr && std::abs(value) < 1e-6) continue;
            if (attribute == nullptr)
                return refuse(place, fmt::format("this element has no {} that could be changed", name),
                              "write all its coordinates");
            replace(*attribute, shown_number(value));
        }
        return true;
    }

    static Box box_of(const Path& path) {
        Box box;
        for (const Subpath& subpath : path.subpaths()) {
            box.extend(subpath.start);
            for (const PathStep& step : subpath.steps) box.extend(step.to);
        }
        return box;
    }
    static bool is_shifted(const Path& was, const Path& is, Vec2 by) {
        for (std::size_t i = 0; i < was.subpaths().size(); ++i) {
            const Subpath& one = was.subpaths()[i];
            const Subpath& other = is.subpaths()[i];
            if (distance(one.start + by, other.start) > kSameShapeMm ||
                one.steps.size() != other.steps.size())
                return false;
            for (std::size_t k = 0; k < one.steps.size(); ++k) {
                if (distance(one.steps[k].to + by, other.steps[k].to) > kSameShapeMm) return false;
            }
        }
        return true;
    }
    static bool is_square(const Path& is, const Box& box) {
        const auto on = [&](Vec2 p) {
            return std::min(std::abs(p.x - box.min.x), std::abs(p.x - box.max.x)) <= kSameShapeMm &&
                   std::min(std::abs(p.y - box.min.y), std::abs(p.y - box.max.y)) <= kSameShapeMm;
        };
        const Subpath& shape = is.subpaths().front();
        return on(shape.start) && std::all_of(shape.steps.begin(), shape.steps.end(),
                                              [&](const PathStep& step) { return on(step.to); });
    }

    const Source& source_;
    const xml::Located& located_;
    Diagnostics& diagnostics_;
    std::map<std::pair<int, int>, ElementMoves> moves_;  // by the place of an element
    Box before_, after_;                                 // of all lines
    std::optional<drawing::ViewBox> box_;
    Vec2 page_, view_;
    Affine to_mm_;
    std::optional<double> around_deg_;  // of the element at hand
    std::vector<xml::Tree> trees_;      // attributes live in them
    std::vector<xml::PatchEdit> changes_;
};

}  // namespace

std::optional<std::string> write_moved(const Source& source, const CreasePattern& pattern,
                                       const EditedSheet& edited, Diagnostics& diagnostics) {
    Diagnostics unheard;  // it has been read before
    const auto located = xml::locate(source.text, unheard, xml::Doctype::skip);
    if (!located) return std::nullopt;
    return Writer(source, *located, pattern, edited, diagnostics).run();
}

}  // namespace popup::edit
