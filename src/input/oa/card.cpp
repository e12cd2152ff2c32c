#include "input/oa/card.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "base/geometry/regions.h"
#include "base/text/json_tree.h"
#include "base/text/place_at.h"
#include "input/text.h"
#include "parts/work.h"

namespace popup::oa {
namespace {

// No sheet is larger, and no coordinate further out.
constexpr double kLargestMm = 10'000.0;
constexpr double kSheetReachMm = 1e6;
// A contour with less is a slip of the mouse.
constexpr double kLeastAreaMm2 = 0.01;
// So many findings have their place looked up; beyond that it is left out.
constexpr std::size_t kToldPlaces = 1000;

class Reader {
 public:
    Reader(std::string_view text, bool strict, Diagnostics& diagnostics)
        : text_(text), walk_(text), strict_(strict), diagnostics_(diagnostics) {}

    std::optional<Card> run(const JsonValue& root) {
        if (root.object() == nullptr) {
            wrong(root, "the file", "an object with \"settings\" and \"faces\"");
            return std::nullopt;
        }
        only(root, {"settings", "faces"});
        read_settings(root);
        if (const JsonValue* faces = needed(root, "faces", "the file")) {
            if (faces->list() == nullptr) {
                wrong(*faces, "faces", "a list");
            } else {
                for (std::size_t i = 0; i < faces->list()->size() && !given_up_; ++i)
                    read_face((*faces->list())[i], static_cast<int>(i));
            }
        }
        if (!sound_) return std::nullopt;
        return std::move(card_);
    }

 private:
    Place place(std::size_t at) { return ++told_ <= kToldPlaces ? place_at(text_, at) : Place{}; }

    // --- what is wrong with the text

    void wrong(const JsonValue& json, std::string_view path, std::string_view wanted) {
        sound_ = false;
        diagnostics_.error("oa-value", place(json.at), fmt::format("{} must be {}", path, wanted));
    }
    const JsonValue* needed(const JsonValue& object, std::string_view name, std::string_view path) {
        const JsonValue* found = object.member(name);
        if (found != nullptr) return found;
        sound_ = false;
        diagnostics_.error("oa-value", place(object.at), fmt::format("{} has no \"{}\"", path, name));
        return nullptr;
    }
    void only(const JsonValue& object, std::initializer_list<std::string_view> names) {
        for (const JsonMember& member : *object.object()) {
            if (std::find(names.begin(), names.end(), member.name) != names.end()) continue;
            if (strict_) sound_ = false;
            diagnostics_
                .add(strict_ ? Severity::error : Severity::warning, "unknown-member", place(member.value.at),
                     fmt::format("\"{}\" is no member of this, and is not read", shown(member.name)))
                .hint("take it out, or correct its name");
        }
    }
    std::optional<double> number(const JsonValue& object, std::string_view name, const std::string& path,
                                 double least, double most) {
        const JsonValue* json = needed(object, name, path);
        if (json == nullptr) return std::nullopt;
        const double* value = json->number();
        if (value != nullptr && *value >= least && *value <= most) return *value;
        wrong(*json, fmt::format("{}.{}", path, name),
              fmt::format("a number from {:g} to {:g}", least, most));
        return std::nullopt;
    }

    // --- part by part

    void read_settings(const JsonValue& root) {
        const JsonValue* settings = needed(root, "settings", "the file");
        if (settings == nullptr) return;
        if (settings->object() == nullptr) return wrong(*settings, "settings", "an object");
        only(*settings, {"cardW", "cardH"});
        card_.width = number(*settings, "cardW", "settings", 1.0, kLargestMm).value_or(0.0);
        card_.height = number(*settings, "cardH", "settings", 1.0, kLargestMm).value_or(0.0);
    }

    // Of a member that may be left out: a word, or none.
    std::string_view word(const JsonValue& object, std::string_view name, const std::string& path) {
        const JsonValue* json = object.member(name);
        if (json == nullptr || json->null()) return {};
        if (json->text() == nullptr) {
            wrong(*json, fmt::format("{}.{}", path, name), "a text");
            return {};
        }
        return *json->text();
    }

    void read_face(const JsonValue& json, int number_of_face) {
        const std::string path = fmt::format("faces[{}]", number_of_face);
        if (json.object() == nullptr) return wrong(json, path, "an object");
        only(json, {"contours", "contoursType", "type", "mode", "t", "timestamp"});
        Face face;
        face.number = number_of_face;
        face.place = walk_.to(json.at);
        face.text = word(json, "contoursType", path) == "expolygons";
        if (const std::string_view type = word(json, "type", path); !type.empty() && type != "VFACE") {
            wrong(*json.member("type"), path + ".type", "\"VFACE\": horizontal plates follow from these");
        }
        constexpr std::array kModes{Mode::face, Mode::hole, Mode::pull};
        if (const JsonValue* mode = json.member("mode"); mode != nullptr) {
            const double* value = mode->number();
            if (value == nullptr || !(*value == 0.0 || *value == 1.0 || *value == 2.0)) {
                wrong(*mode, path + ".mode", "0 (a face), 1 (a hole) or 2 (a pull)");
            } else {
                face.mode = kModes.at(static_cast<std::size_t>(*value));
            }
        }
        if (json.member("timestamp") != nullptr && !json.member("timestamp")->null())
            face.timestamp = number(json, "timestamp", path, 0.0, 1e300).value_or(0.0);
        const auto depth = number(json, "t", path, -kSheetReachMm, kSheetReachMm);
        read_contours(json, path, face);
        if (!depth || face.contours.empty()) return;
        face.depth = on_grid({*depth, 0.0}).x;
        if (face.mode != Mode::hole && !(face.depth > 0.0 && face.depth <= card_.height) && sound_) {
            diagnostics_
                .warning("oa-depth", place(json.member("t")->at),
                         fmt::format("{} stands {:g} mm from the back, and is left out: a plate can stand up "
                                     "to {:g} mm in front of it, above the floor",
                                     path, face.depth, card_.height))
                .hint(fmt::format("give it a t above 0, and up to {:g}", card_.height));
            return;
        }
        card_.faces.push_back(std::move(face));
    }

    void read_contours(const JsonValue& json, const std::string& path, Face& face) {
        const JsonValue* contours = needed(json, "contours", path);
        if (contours == nullptr) return;
        if (contours->list() == nullptr) return wrong(*contours, path + ".contours", "a list");
        if (contours->list()->empty()) {
            diagnostics_
                .warning("oa-contour-empty", place(contours->at),
                         fmt::format("{} has no contour, and is left out", path))
                .hint("take it out of the list of faces");
        }
        for (std::size_t i = 0; i < contours->list()->size() && !given_up_; ++i) {
            const JsonValue& one = (*contours->list())[i];
            const std::string own = fmt::format("{}.contours[{}]", path, i);
            if (one.object() == nullptr) {
                wrong(one, own, "an object with \"outer\" and \"holes\"");
                continue;
            }
            only(one, {"outer", "holes"});
            const JsonValue* outer = needed(one, "outer", own);
            if (outer == nullptr) continue;
            Contour contour;
            contour.area = enclosed(*outer, own + ".outer", true);
            const JsonValue* holes = one.member("holes");
            const bool has_area = !contour.area.empty();
            if (holes != nullptr && !holes->null()) cut_holes(*holes, own + ".holes", contour);
            if (has_area && contour.area.empty() && !given_up_) {
                diagnostics_
                    .warning("oa-contour-empty", place(holes->at),
                             fmt::format("{} is left out: its holes leave nothing of it", own))
                    .hint("make the holes smaller, or take it out");
            }
            if (!contour.area.empty()) face.contours.push_back(std::move(contour));
        }
    }

    void cut_holes(const JsonValue& holes, const std::string& path, Contour& contour) {
        if (holes.list() == nullptr) return wrong(holes, path, "a list of lists of points");
        std::vector<Polygon> cut;
        for (std::size_t i = 0; i < holes.list()->size() && !given_up_; ++i) {
            const JsonValue& one = (*holes.list())[i];
            // webOAcard writes [[]] where there is none.
            if (one.list() != nullptr && one.list()->empty()) continue;
            for (Polygon& area : enclosed(one, fmt::format("{}[{}]", path, i), false))
                cut.push_back(std::move(area));
        }
        if (cut.empty() || contour.area.empty()) return;
        std::vector<Polygon> both = contour.area;
        both.insert(both.end(), cut.begin(), cut.end());
        if (afford(both, holes.at)) contour.area = subtract(contour.area, cut);
    }

    bool afford(const std::vector<Polygon>& regions, std::size_t at) {
        if (given_up_) return false;
        if (work_.sweep(regions)) return true;
        given_up_ = true;
        sound_ = false;
        diagnostics_.error("document-too-large", place(at),
                           "too many edges of contours lie side by side to examine them");
        return false;
    }

    // What a list of points encloses, all that it goes round. Says what is wrong with it.
    std::vector<Polygon> enclosed(const JsonValue& json, const std::string& path, bool outer) {
        if (json.list() == nullptr) {
            wrong(json, path, "a list of points");
            return {};
        }
        Ring ring;
        for (const JsonValue& one : *json.list()) {
            const JsonValue* x = one.member("X");
            const JsonValue* y = one.member("Y");
            const auto near = [](const JsonValue* value) {
                return value != nullptr && value->number() != nullptr &&
                       std::abs(*value->number()) <= kSheetReachMm;
            };
            if (!near(x) || !near(y)) {
                wrong(one, fmt::format("{}[{}]", path, ring.size()),
                      "a point, {\"X\": mm, \"Y\": mm}, no further out than a kilometre");
                return {};
            }
            ring.push_back(on_grid({*y->number(), *x->number() - 0.5 * card_.width}));
        }
        if (!afford({Polygon{ring, {}}}, json.at)) return {};
        std::vector<Polygon> area = filled({ring}, FillRule::non_zero);
        if (popup::area(area) < kLeastAreaMm2) {
            // A hole without points is none.
            if (!outer && ring.size() < 3) return {};
            diagnostics_
                .warning("oa-contour-empty", place(json.at),
                         fmt::format("{} encloses no area, and is left out: it has {} point{}", path,
                                     ring.size(), ring.size() == 1 ? "" : "s"))
                .hint("take it out, or give it three corners that do not lie in line");
            return {};
        }
        tell_crossings(json, path, ring, area);
        return area;
    }

    // Where a ring crosses itself there are corners that it has not itself, or parts come apart.
    void tell_crossings(const JsonValue& json, const std::string& path, const Ring& ring,
                        const std::vector<Polygon>& area) {
        const double own = std::abs(signed_area(ring));
        const double taken = popup::area(area);
        double around = 0.0;
        for (std::size_t i = 0; i < ring.size(); ++i)
            around += distance(ring[i], ring[(i + 1) % ring.size()]);
        if (std::abs(own - taken) <= 1e-6 * taken + kOnGridLineMm * around) return;
        const std::set<std::pair<double, double>> corners = [&] {
            std::set<std::pair<double, double>> all;
            for (const Vec2 p : ring) all.emplace(p.x, p.y);
            return all;
        }();
        std::optional<Vec2> crossing;
        for (const Polygon& part : area) {
            for (const Vec2 p : part.outer) {
                if (!crossing && !corners.contains({p.x, p.y})) crossing = p;
            }
        }
        const std::string where =
            crossing ? fmt::format(" at X {:.2f}, Y {:.2f}", crossing->y + 0.5 * card_.width, crossing->x)
                     : std::string();
        diagnostics_
            .warning("contour-crosses-itself", place(json.at),
                     fmt::format("{} crosses itself{}: all {:.2f} mm² that it goes round were taken", path,
                                 where, taken))
            .hint("draw it without the crossing");
    }

    std::string_view text_;
    PlaceWalk walk_;  // to the faces, one after the other
    bool strict_;
    Diagnostics& diagnostics_;
    Work work_;
    Card card_;
    std::size_t told_ = 0;
    bool sound_ = true;
    bool given_up_ = false;
};

}  // namespace

Place Card::place_of(int face) const {
    const auto found = std::lower_bound(faces.begin(), faces.end(), face,
                                        [](const Face& one, int number) { return one.number < number; });
    return found == faces.end() || found->number != face ? Place{} : found->place;
}

std::optional<Card> read_card(const Source& source, const ReadOptions& options, Diagnostics& diagnostics) {
    const std::optional<JsonValue> root = read_json(source.text, "oa-syntax", diagnostics);
    if (!root) return std::nullopt;
    return Reader(source.text, options.strict, diagnostics).run(*root);
}

}  // namespace popup::oa
