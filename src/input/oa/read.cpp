#include "input/oa/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "assembly/settle.h"
#include "base/geometry/tolerances.h"
#include "input/oa/card.h"
#include "input/oa/sheet.h"
#include "input/origamic/folds.h"
#include "input/origamic/make_assembly.h"

namespace popup::oa {
namespace {

constexpr double kOpensDeg = 90.0;
// Paper that falls out and is smaller is dust.
constexpr double kDustMm2 = 0.5;

std::size_t at(int number) { return static_cast<std::size_t>(number); }

// What runs back is named after the face that carries it: the one it has the longest fold with.
std::vector<int> carriers(const std::vector<Region>& regions, const std::vector<origamic::Fold>& folds) {
    std::vector<std::map<int, double>> lengths(regions.size());
    for (const origamic::Fold& fold : folds) {
        if (fold.valley) continue;
        const int face = regions[at(fold.below)].face;
        if (face >= 0) lengths[at(fold.above)][face] += fold.y1 - fold.y0;
    }
    std::vector<int> result(regions.size(), -1);
    for (std::size_t i = 0; i < regions.size(); ++i) {
        double most = 0.0;
        for (const auto& [face, length] : lengths[i]) {
            if (length > most + kTouchMm) {
                most = length;
                result[i] = face;
            }
        }
    }
    return result;
}

std::vector<origamic::Named> names_of(const Card& card, const std::vector<Region>& regions,
                                      const std::vector<origamic::Fold>& folds,
                                      const origamic::Holding& held) {
    const std::vector<int> carrier = carriers(regions, folds);
    std::vector<origamic::Named> names(regions.size());
    std::map<std::string, int> count;
    for (const origamic::Holding::Step& step : held.order) {
        const Region& region = regions[at(step.region)];
        const int face = region.top ? carrier[at(step.region)] : region.face;
        std::string name = region.upright ? "back" : "floor";
        if (region.top) {
            name = face >= 0 ? fmt::format("face-{}/top", face) : fmt::format("shelf-{}", step.region);
        } else if (face >= 0) {
            name = fmt::format("face-{}", face);
        }
        const int number = ++count[name];
        origamic::Named& named = names[at(step.region)];
        named.plate = number == 1 ? name : fmt::format("{}/{}", name, number);
        if (face >= 0) named.joint = fmt::format("face-{}", face);
        named.place = card.place_of(face);
    }
    return names;
}

// What no fold leads to.
void tell_loose(const Card& card, const Sheet& sheet, const origamic::Holding& held,
                Diagnostics& diagnostics) {
    for (std::size_t i = 0; i < sheet.regions.size(); ++i) {
        const Region& region = sheet.regions[i];
        const double size = area(region.area);
        if (held.held[i] || size - region.cut_mm2 < kDustMm2) continue;
        const Vec2 inside = inner_point(region.area, 0.1).at;
        const std::string where =
            fmt::format("{:.1f} mm² at X {:.1f}, Y {:.1f}", size, inside.y + 0.5 * card.width, inside.x);
        if (region.face < 0 && !region.top) {
            diagnostics
                .warning("oa-loose", {},
                         fmt::format("paper of the {} falls out: no fold holds {}",
                                     region.upright ? "back" : "floor", where))
                .hint("a hole there says that it is meant; else leave a way to the rest of it");
        } else if (region.top) {
            diagnostics
                .warning(
                    "oa-loose", {},
                    fmt::format("a horizontal plate, {:.2f} mm above the floor, falls out: no fold holds "
                                "{}",
                                region.offset, where))
                .hint("what carries it must reach the floor or another plate");
        } else {
            diagnostics
                .warning("oa-loose", card.place_of(region.face),
                         fmt::format("a part of faces[{}] falls out: no fold holds {}", region.face, where))
                .hint(
                    fmt::format("let it reach the floor (Y {:g}) or a horizontal plate, or give it an upper "
                                "edge along the gutter",
                                region.offset));
        }
    }
}

}  // namespace

std::optional<Assembly> read(const Source& source, const ReadOptions& options, Diagnostics& diagnostics) {
    const std::optional<Card> card = read_card(source, options, diagnostics);
    if (!card) return std::nullopt;
    const std::optional<Sheet> sheet = lay_out_sheet(*card, diagnostics);
    if (!sheet) return std::nullopt;
    std::vector<origamic::Region> regions;
    regions.reserve(sheet->regions.size());
    for (const Region& one : sheet->regions)
        regions.push_back({one.upright, one.offset, one.area, one.face < 0 && !one.top});
    const std::vector<origamic::Fold> folds = origamic::folds_between(regions);
    const origamic::Holding held = origamic::holding(regions, folds);
    if (held.back < 0 || held.floor < 0) {
        diagnostics
            .error("oa-no-card", {},
                   fmt::format("nothing is left of the {}: the plates take all its paper",
                               held.back < 0 ? "back" : "floor"))
            .hint("make the card higher than what stands on it");
        return std::nullopt;
    }
    tell_loose(*card, *sheet, held, diagnostics);
    Assembly assembly = origamic::make_assembly({card->width, card->height, kOpensDeg}, regions, folds, held,
                                                names_of(*card, sheet->regions, folds, held));
    settle_numbers(assembly);
    return assembly;
}

bool recognises(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n";
    const auto skip = [&] { text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size())); };
    skip();
    if (!text.starts_with('{')) return false;
    text.remove_prefix(1);
    skip();
    return text.starts_with("\"settings\"") || text.starts_with("\"faces\"");
}

}  // namespace popup::oa
