#include "mechanism/spread_prints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/geometry/edge_index.h"
#include "base/geometry/near_boxes.h"
#include "base/geometry/regions.h"
#include "base/text/letters.h"
#include "base/text/utf8.h"
#include "popup/image.h"
#include "popup/path.h"
#include "popup/units.h"

namespace popup {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

// The direction at an angle in degrees. Quarter turns are exact.
Vec2 direction_at(double degrees) {
    const double quarters = degrees / 90.0;
    if (quarters == std::round(quarters)) {
        switch (static_cast<int>(std::fmod(quarters, 4.0) + 4.0) % 4) {
            case 0:
                return {1.0, 0.0};
            case 1:
                return {0.0, 1.0};
            case 2:
                return {-1.0, 0.0};
            default:
                return {0.0, -1.0};
        }
    }
    return rotated({1.0, 0.0}, radians(degrees));
}

// The rectangle of a picture, and the picture in it.
Image placed(const DrawnPrint& print, const DrawnImage& drawn) {
    const Vec2 right = direction_at(print.rotate_deg);
    const Vec2 up = left_of(right);
    const double width = drawn.width_mm;
    const double height = drawn.height_mm;
    const double across = drawn.picture.width;
    const double down = drawn.picture.height;
    // mm a pixel.
    Vec2 scale{width / across, height / down};
    if (drawn.fit == PictureFit::contain) scale.x = scale.y = std::min(scale.x, scale.y);
    if (drawn.fit == PictureFit::cover) scale.x = scale.y = std::max(scale.x, scale.y);
    const Vec2 left_over{0.5 * (width - scale.x * across), 0.5 * (height - scale.y * down)};
    Image image = drawn.picture;
    image.place.x = scale.x * right;
    image.place.y = -scale.y * up;
    image.place.origin = print.at.at + left_over.x * right + (height - left_over.y) * up;
    if (drawn.fit == PictureFit::cover) {
        const Vec2 at = print.at.at;
        image.clip = {
            Polygon{{at, at + width * right, at + width * right + height * up, at + height * up}, {}}};
    }
    return image;
}

// Each page's plates, found by where their paper is.
class Pages {
 public:
    Pages(const Skeleton& skeleton, const Assembly& assembly)
        : mirrored_(skeleton.page_mirrored),
          boxes_(mirrored_.size()),
          plates_(mirrored_.size()),
          reach_(mirrored_.size()) {
        for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
            const Box box = bounds(assembly.plates[i].outline.outer);
            const auto page = static_cast<std::size_t>(skeleton.plate_page[i]);
            boxes_[page].insert({box.min, box.max}, false);
            reach_[page].extend(box.min);
            reach_[page].extend(box.max);
            plates_[page].push_back(i);
        }
    }
    [[nodiscard]] bool mirrored(int page) const { return mirrored_[static_cast<std::size_t>(page)]; }
    [[nodiscard]] const std::vector<std::size_t>& plates(int page) const {
        return plates_[static_cast<std::size_t>(page)];
    }
    // A box round the page's paper, as its author sees the page.
    [[nodiscard]] Box reach(int page) const {
        Box box = reach_[static_cast<std::size_t>(page)];
        if (mirrored(page)) box = {{-box.max.x, box.min.y}, {-box.min.x, box.max.y}};
        return box;
    }
    // The plates of the page whose paper may reach into the box, in their order.
    [[nodiscard]] const std::vector<std::size_t>& near(int number, const Box& box) {
        const auto page = static_cast<std::size_t>(number);
        boxes_[page].query(box, found_);
        near_.clear();
        for (const int one : found_) near_.push_back(plates_[page][static_cast<std::size_t>(one)]);
        return near_;
    }

 private:
    const std::vector<bool>& mirrored_;
    std::vector<EdgeIndex> boxes_;
    std::vector<std::vector<std::size_t>> plates_;
    std::vector<Box> reach_;
    std::vector<int> found_;
    std::vector<std::size_t> near_;
};

// Numbers as the document has them.
std::string written(double mm, const Unit& unit) {
    return fmt::format("{}", std::round(mm / unit.mm * 1e4) / 1e4 + 0.0);
}

struct Teller {
    const Design& design;
    const Pages& pages;
    Diagnostics& diagnostics;

    void off_page(std::string_view what, int page, const Box& drawn, Place place) const {
        if (drawn.width() <= 0.0 && drawn.height() <= 0.0) {
            diagnostics.warning(
                "drawn-off-page", place,
                fmt::format("the {} has no length: it begins and ends at ({}, {}); nothing of it is printed",
                            what, written(drawn.min.x, design.unit), written(drawn.min.y, design.unit)));
            return;
        }
        const Box reach = pages.reach(page);
        const auto span = [&](double from, double to) {
            return fmt::format("{} to {}", written(from, design.unit), written(to, design.unit));
        };
        const bool beside = !touch(drawn, reach);
        diagnostics.warning(
            "drawn-off-page", place,
            fmt::format("the {} lies at x {}, y {}, wholly {} page {}, {}; nothing of it is printed", what,
                        span(drawn.min.x, drawn.max.x), span(drawn.min.y, drawn.max.y),
                        beside ? "beside the paper of" : "off the paper of", page,
                        beside ? fmt::format("which reaches from x {}, y {}", span(reach.min.x, reach.max.x),
                                             span(reach.min.y, reach.max.y))
                               : "where paper has been cut away or never was"));
    }
};

// Each page's lines go to the plates whose paper they cross; a plate's lines are clipped together.
void spread_lines(const Design& design, Pages& pages, Assembly& assembly, const Teller& tell) {
    std::vector<std::vector<std::vector<Vec2>>> paths(assembly.plates.size());
    std::vector<std::vector<const DrawnLine*>> sources(assembly.plates.size());
    for (const DrawnLine& line : design.lines) {
        if (line.dropped) continue;
        std::vector<Vec2> path;
        Box box;
        for (const DesignPoint& point : line.points) {
            path.push_back(pages.mirrored(line.page) ? Vec2{-point.at.x, point.at.y} : point.at);
            box.extend(path.back());
        }
        for (const std::size_t plate : pages.near(line.page, box)) {
            paths[plate].push_back(path);
            sources[plate].push_back(&line);
        }
    }
    std::set<const DrawnLine*> shown;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        if (paths[i].empty()) continue;
        auto parts = clip_lines(paths[i], assembly.plates[i].outline);
        for (std::size_t k = 0; k < parts.size(); ++k) {
            const double width = Length::points(sources[i][k]->thickness_pt).mm;
            if (!parts[k].empty()) shown.insert(sources[i][k]);
            for (auto& part : parts[k]) {
                assembly.plates[i].prints.emplace_back(Stroke{std::move(part), width, sources[i][k]->color});
            }
        }
    }
    for (const DrawnLine& line : design.lines) {
        if (line.dropped || shown.contains(&line)) continue;
        Box box;
        for (const DesignPoint& point : line.points) box.extend(point.at);
        tell.off_page("drawn line", line.page, box, line.place);
    }
}

// Whether any of it lies on paper.
bool spread_area(const DrawnArea& drawn, int page, Pages& pages, Assembly& assembly) {
    bool shown = false;
    for (const Polygon& area : drawn.shape.inside.areas) {
        for (const std::size_t number : pages.near(page, bounds(area.outer))) {
            Plate& plate = assembly.plates[number];
            for (Polygon& part : intersect({area}, {plate.outline})) {
                plate.prints.emplace_back(Area{std::move(part), drawn.fill});
                shown = true;
            }
        }
    }
    return shown;
}

Box box_of(const DrawnArea& drawn) {
    Box box;
    for (const Polygon& area : drawn.shape.inside.areas) {
        for (const Vec2 p : area.outer) box.extend(p);
    }
    return box;
}

// Pictures with a horizon go to all plates of their page, until that becomes too much to hold.
struct Horizons {
    std::size_t copies = 1'000'000;  // that there may still be
    int next = 0;
};

// Whether any of it lies on paper.
bool spread_image(const DrawnPrint& print, const DrawnImage& drawn, const AssembleOptions& options,
                  Horizons& horizons, Pages& pages, Assembly& assembly) {
    Image image = placed(print, drawn);
    if (drawn.horizon || options.horizon_mm) {
        image.horizon = Horizon{drawn.horizon, drawn.horizon_mm ? drawn.horizon_mm : options.horizon_mm,
                                horizons.next++, print.place};
        const std::vector<std::size_t>& all = pages.plates(print.page);
        if (all.size() <= horizons.copies) {
            horizons.copies -= all.size();
            for (const std::size_t plate : all) assembly.plates[plate].prints.emplace_back(image);
            return true;
        }
    }
    bool any = false;
    const std::vector<Polygon> shown = shown_regions(image);
    for (const std::size_t number : pages.near(print.page, bounds(shown.front().outer))) {
        Plate& plate = assembly.plates[number];
        if (intersect(shown, {plate.outline}).empty()) continue;
        plate.prints.emplace_back(image);
        any = true;
    }
    return any;
}

Box box_of(const DrawnPrint& print, const DrawnImage& drawn) {
    Box box;
    for (const Polygon& part : shown_regions(placed(print, drawn))) {
        for (const Vec2 p : part.outer) box.extend(p);
    }
    return box;
}

// Round its letters, each as wide as `each` times the height of capitals.
Box box_of(const DrawnPrint& print, const DrawnText& drawn, double each) {
    std::size_t letters = 0;
    for (std::string_view rest = drawn.text; !rest.empty(); ++letters)
        rest.remove_prefix(first_character(rest).bytes);
    const Vec2 along =
        (0.5 * each * drawn.height_mm * static_cast<double>(letters)) * direction_at(print.rotate_deg);
    const Vec2 up = (0.5 * drawn.height_mm) * left_of(direction_at(print.rotate_deg));
    Box box;
    for (const Vec2 end : {along, -1.0 * along}) {
        box.extend(print.at.at + end + up);
        box.extend(print.at.at + end - up);
    }
    return box;
}

// Letters of most words are narrower, and hardly any are wider.
constexpr double kUsualLetter = 0.8;
constexpr double kWidestLetter = 1.5;

// How much of the line from the middle of a text to both its ends lies in the box, and how long the paper is
// along it.
struct SeenLine {
    double seen_mm = 0.0;
    double paper_mm = 0.0;
};
SeenLine seen_line(Vec2 middle, Vec2 along, double length_mm, const Box& box) {
    double from = -1e9;
    double to = 1e9;
    const auto bound = [&](double at, double way, double least, double most) {
        if (std::abs(way) < 1e-9) return;
        const double one = (least - at) / way;
        const double two = (most - at) / way;
        from = std::max(from, std::min(one, two));
        to = std::min(to, std::max(one, two));
    };
    bound(middle.x, along.x, box.min.x, box.max.x);
    bound(middle.y, along.y, box.min.y, box.max.y);
    const double seen = std::min(to, 0.5 * length_mm) - std::max(from, -0.5 * length_mm);
    return {std::max(seen, 0.0), std::max(to - from, 0.0)};
}

std::string listed(const std::vector<std::string>& characters) {
    constexpr std::size_t kMost = 10;
    std::string list;
    for (std::size_t i = 0; i < std::min(characters.size(), kMost); ++i)
        list += (i == 0 ? "" : " ") + characters[i];
    return characters.size() > kMost ? fmt::format("{} and {} more", list, characters.size() - kMost) : list;
}

void tell_missing(const DrawnPrint& print, const DrawnText& drawn, const Letters& letters,
                  const Teller& tell) {
    if (letters.missing.empty()) return;
    std::string fonts;
    for (std::size_t i = 0; i < kTextFontNames.size(); ++i) {
        const auto other = measure_letters(drawn.text, drawn.height_mm, static_cast<TextFont>(i));
        if (other && other->missing.empty())
            fonts += (fonts.empty() ? "" : ", ") + std::string(kTextFontNames.at(i));
    }
    tell.diagnostics
        .warning("letters-missing", print.place,
                 fmt::format("the font {} has no {}; {} printed as {}", to_string(drawn.font),
                             listed(letters.missing), letters.missing.size() == 1 ? "it is" : "they are",
                             letters.missing.size() == 1 ? "an empty box" : "empty boxes"))
        .hint(fonts.empty() ? "no font of texts has all of it: print it as a picture, or draw it as an area"
                            : fmt::format("these fonts have all of it: {}", fonts));
}

// Of a text whose ends may lie beside the paper: where they do is known when its letters are measured.
void tell_ends(const DrawnPrint& print, const Letters& letters, const Pages& pages, const Teller& tell) {
    constexpr double kSeenMm = 0.1;
    const SeenLine line =
        seen_line(print.at.at, direction_at(print.rotate_deg), letters.length_mm, pages.reach(print.page));
    const double lost = letters.length_mm - line.seen_mm;
    if (lost < kSeenMm || line.seen_mm <= 0.0) return;
    const auto mm = [](double length) { return fmt::format("{:.1f} mm", length); };
    tell.diagnostics
        .remark("text-cut", print.place,
                fmt::format("the text is {} long, and {} of it lies beside the paper of page {}, which is {} "
                            "long there",
                            mm(letters.length_mm), mm(lost), print.page, mm(line.paper_mm)))
        .hint("make it lower, move it, or part it into lines");
}

// Only what is beside the page for certain is told of as such. Fonts are opened only where a text may lack
// letters or reach beyond the paper.
void tell_text(const DrawnPrint& print, const DrawnText& drawn, const Pages& pages, const Teller& tell) {
    const Box box = box_of(print, drawn, kWidestLetter);
    const Box reach = pages.reach(print.page);
    if (touch(box, reach)) {
        const bool inside = box.min.x >= reach.min.x && box.max.x <= reach.max.x &&
                            box.min.y >= reach.min.y && box.max.y <= reach.max.y;
        if (inside && is_plain(drawn.text)) return;
        const auto letters = measure_letters(drawn.text, drawn.height_mm, drawn.font);
        if (!letters) return;
        tell_missing(print, drawn, *letters, tell);
        tell_ends(print, *letters, pages, tell);
        return;
    }
    tell.off_page("text", print.page, box_of(print, drawn, kUsualLetter), print.place);
}

void spread_text(const DrawnPrint& print, const DrawnText& drawn, Pages& pages, Assembly& assembly) {
    const std::vector<std::size_t>& plates = pages.plates(print.page);
    if (plates.empty()) return;
    const int piece = assembly.plates[plates.front()].piece;
    assembly.pieces[static_cast<std::size_t>(piece)].prints.emplace_back(
        Text{drawn.text, print.at.at, drawn.height_mm, radians(print.rotate_deg), drawn.fill, drawn.font});
}

}  // namespace

void mirror(DrawnPrint& print) {
    if (auto* area = std::get_if<DrawnArea>(&print.what)) {
        area->shape.path = area->shape.path.mapped([](Vec2 p) { return Vec2{-p.x, p.y}; });
        area->shape.moved = true;
        static_cast<void>(enclose(area->shape.path, area->shape.inside));  // as many points as before
        return;
    }
    print.at.at.x = -print.at.at.x;
    print.at.changed = true;
    if (print.rotate_deg != 0.0) print.rotate_deg = -print.rotate_deg;
    // The corner that was the right one is the left one now.
    if (const auto* image = std::get_if<DrawnImage>(&print.what))
        print.at.at = print.at.at - image->width_mm * direction_at(print.rotate_deg);
}

void spread_prints(const Skeleton& skeleton, const Design& design, const AssembleOptions& options,
                   Assembly& assembly, Diagnostics& diagnostics) {
    if (design.lines.empty() && design.prints.empty()) return;
    Pages pages(skeleton, assembly);
    const Teller tell{design, pages, diagnostics};
    Horizons horizons;
    for (const DrawnPrint& drawn : design.prints) {
        if (drawn.dropped) continue;
        DrawnPrint print = drawn;
        if (pages.mirrored(print.page)) mirror(print);
        if (const auto* area = std::get_if<DrawnArea>(&print.what)) {
            if (spread_area(*area, print.page, pages, assembly)) continue;
            tell.off_page("area", print.page, box_of(std::get<DrawnArea>(drawn.what)), print.place);
        } else if (const auto* image = std::get_if<DrawnImage>(&print.what)) {
            if (spread_image(print, *image, options, horizons, pages, assembly)) continue;
            tell.off_page("picture", print.page, box_of(drawn, std::get<DrawnImage>(drawn.what)),
                          print.place);
        } else {
            spread_text(print, std::get<DrawnText>(print.what), pages, assembly);
            tell_text(drawn, std::get<DrawnText>(drawn.what), pages, tell);
        }
    }
    spread_lines(design, pages, assembly, tell);
}

}  // namespace popup
