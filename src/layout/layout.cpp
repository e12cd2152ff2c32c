#include "popup/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "base/geometry/hull.h"
#include "base/nth.h"
#include "layout/leftover.h"
#include "layout/scale.h"
#include "layout/turns.h"
#include "nest/shapes.h"

namespace popup {

Vec2 Placement::apply(Vec2 p) const { return turned(p, angle) + offset; }

std::string Layout::piece_name(const Placement& placement) const {
    const DesignPattern& design = nth(designs, placement.design);
    const std::string& name = nth(design.pattern.pieces, placement.piece).name;
    return prefix_names ? design.stem + ":" + name : name;
}

namespace {

constexpr std::size_t kMostPieces = 1'000'000;
constexpr double kMostMm = 1e5;

// A piece of a design, before it is copied.
struct PieceSource {
    int design = 0;
    int piece = 0;
    Ring hull;
    std::vector<Angle> turns;
    int kind = -1;
};

// Sheets of one size, margins included.
struct SheetRow {
    double width = 0.0;
    double height = 0.0;
    int count = -1;
    [[nodiscard]] SheetArea usable(double margin) const {
        return {width - 2.0 * margin, height - 2.0 * margin};
    }
};

class Layouter {
 public:
    Layouter(std::vector<DesignPattern> designs, const LayoutOptions& options, Diagnostics& diagnostics)
        : options_(options),
          diagnostics_(diagnostics),
          spacing_mm_(std::fmin(std::fmax(options.spacing.mm, 0.0), kMostMm)) {
        layout_.designs = std::move(designs);
        layout_.margin_mm = options.margin.mm;
        layout_.prefix_names = layout_.designs.size() > 1;
        spare_only_name();
    }

    std::optional<Layout> run() {
        if (!gather()) return std::nullopt;
        if (sources_.empty()) return std::move(layout_);
        if (!choose_sheets() || !make_job()) return std::nullopt;
        const NestResult result = nest(job_, options_.nesting);
        if (options_.nesting.stop != nullptr && options_.nesting.stop->load()) {
            diagnostics_.remark("nest-stopped", {},
                                result.plan
                                    ? "the search was stopped; the best layout that it had found is taken"
                                    : "the search was stopped before it had found a layout");
        }
        if (result.refusal) {
            complain(*result.refusal);
            return std::nullopt;
        }
        take(*result.plan);
        return std::move(layout_);
    }

 private:
    [[nodiscard]] const PatternPiece& piece_of(const PieceSource& source) const {
        return nth(nth(layout_.designs, source.design).pattern.pieces, source.piece);
    }
    [[nodiscard]] std::string name_of(const PieceSource& source) const {
        return layout_.piece_name({source.design, source.piece, 0, 0, {}, {}});
    }
    [[nodiscard]] const PieceSource& source_of(int item) const {
        return sources_[static_cast<std::size_t>(item) % sources_.size()];
    }
    [[nodiscard]] bool is_meant(const PieceRule& rule, const PieceSource& source) const {
        return rule.piece == name_of(source) || rule.piece == piece_of(source).name;
    }

    // Names tell pieces apart: the only one would have it on its face for nothing.
    void spare_only_name() {
        if (layout_.designs.size() != 1 || layout_.designs.front().pattern.pieces.size() != 1) return;
        std::erase_if(layout_.designs.front().pattern.pieces.front().labels,
                      [](const Label& label) { return label.kind == LabelKind::piece; });
    }

    bool gather() {
        bool in_range = true;
        for (std::size_t d = 0; d < layout_.designs.size(); ++d) {
            Pattern& pattern = layout_.designs[d].pattern;
            if (options_.scale != 1.0) scale_pattern(pattern, options_.scale);
            for (std::size_t p = 0; p < pattern.pieces.size(); ++p) {
                const PatternPiece& piece = pattern.pieces[p];
                POPUP_INVARIANT(!piece.silhouette.empty());
                PieceSource source{static_cast<int>(d), static_cast<int>(p), {}, {}, -1};
                const Box& b = piece.bounds;
                const double reach =
                    std::max({std::abs(b.min.x), std::abs(b.min.y), std::abs(b.max.x), std::abs(b.max.y)});
                if (reach <= kMostMm) {
                    std::vector<Vec2> points;
                    for (const Polygon& part : piece.silhouette)
                        points.insert(points.end(), part.outer.begin(), part.outer.end());
                    source.hull = convex_hull(std::move(points));
                    sources_.push_back(std::move(source));
                    continue;
                }
                in_range = false;
                diagnostics_
                    .error("piece-too-large", {},
                           fmt::format(
                               "piece \"{}\" reaches {:.3g} mm from the middle of its page, which is further "
                               "than {:.0f} m",
                               name_of(source), reach, kMostMm / 1e3))
                    .hint("choose a smaller --scale")
                    .about(piece.name);
            }
        }
        if (!in_range) return false;
        if (sources_.size() * static_cast<std::size_t>(options_.copies) > kMostPieces) {
            diagnostics_
                .error("too-many-pieces", {},
                       fmt::format("{} copies of {} pieces are more than {} pieces", options_.copies,
                                   sources_.size(), kMostPieces))
                .hint("ask for fewer --copies, or split the run");
            return false;
        }
        return true;
    }

    // The turns a piece may be given on sheets of these areas.
    [[nodiscard]] std::vector<Angle> turns_on(const PieceSource& source,
                                              const std::vector<SheetArea>& areas) const {
        if (options_.grain == Grain::keep) return {Angle{}};
        if (options_.grain == Grain::either) return {Angle{}, Angle::degrees(180.0)};
        Rotation rotation = options_.rotation;
        for (const PieceRule& rule : options_.rules) {
            if (rule.rotation && is_meant(rule, source)) rotation = *rule.rotation;
        }
        return turns_of(source.hull, rotation, areas);
    }

    [[nodiscard]] bool takes(const SheetRow& sheet, const PieceSource& source) const {
        const SheetArea area = sheet.usable(options_.margin.mm);
        if (area.width <= 0.0 || area.height <= 0.0) return false;
        const std::vector<Angle> turns = turns_on(source, {area});
        return std::any_of(turns.begin(), turns.end(),
                           [&](Angle turn) { return fits(source.hull, turn, area); });
    }

    [[nodiscard]] std::size_t taken_by(const SheetRow& sheet) const {
        return static_cast<std::size_t>(
            std::count_if(sources_.begin(), sources_.end(),
                          [&](const PieceSource& source) { return takes(sheet, source); }));
    }

    [[nodiscard]] bool in_bed(const SheetRow& sheet) const {
        constexpr double kHair = 1e-6;
        const Vec2 bed = options_.bed + Vec2{kHair, kHair};
        return options_.bed == Vec2{} || (sheet.width <= bed.x && sheet.height <= bed.y) ||
               (sheet.width <= bed.y && sheet.height <= bed.x);
    }

    // A paper as takes most of the pieces; landscape if either way serves.
    [[nodiscard]] SheetRow oriented(const Paper& paper) const {
        const SheetRow lying{paper.height_mm, paper.width_mm, -1};
        const SheetRow standing{paper.width_mm, paper.height_mm, -1};
        return taken_by(standing) > taken_by(lying) ? standing : lying;
    }

    [[nodiscard]] SheetRow row_of(const SheetChoice& choice) const {
        if (choice.name.empty()) return {choice.width_mm, choice.height_mm, -1};
        SheetRow row{options_.bed.x, options_.bed.y, -1};
        if (choice.name != "auto") {
            for (const Paper& paper : paper_table()) {
                if (choice.name == paper.name) return oriented(paper);
            }
            return row;
        }
        for (const Paper& paper : papers_of(options_.papers)) {
            const SheetRow next = oriented(paper);
            if (!in_bed(next)) continue;
            row = next;
            // Of no paper that takes all the largest remains, to say on it what does not fit.
            if (taken_by(row) == sources_.size()) return row;
        }
        // Where no paper that goes into the machine takes all, its whole bed is the sheet.
        return options_.bed == Vec2{} ? row : SheetRow{options_.bed.x, options_.bed.y, -1};
    }

    bool choose_sheets() {
        if (options_.stock.empty()) {
            rows_.push_back(row_of(options_.sheet));
        } else {
            for (const StockRow& row : options_.stock) {
                rows_.push_back(row_of(row.size));
                rows_.back().count = row.count;
            }
        }
        bool all = true;
        for (const SheetRow& row : rows_) {
            if (!in_bed(row)) {
                all = false;
                diagnostics_
                    .error("sheet-too-large", {},
                           fmt::format(
                               "a sheet of {:.1f} × {:.1f} mm does not go into the machine, whose bed is "
                               "{:.1f} × {:.1f} mm",
                               row.width, row.height, options_.bed.x, options_.bed.y))
                    .hint("choose a smaller --sheet, or --sheet auto");
                continue;
            }
            const SheetArea area = row.usable(options_.margin.mm);
            if (to_grid(area.width) > 0 && to_grid(area.height) > 0) {
                areas_.push_back(area);
                continue;
            }
            all = false;
            diagnostics_
                .error("sheet-too-small", {},
                       fmt::format("margins of {:.2f} mm leave nothing of a sheet of {:.2f} × {:.2f} mm",
                                   options_.margin.mm, row.width, row.height))
                .hint("choose a larger --sheet or a smaller --margin");
        }
        return all;
    }

    bool make_job() {
        // Pieces of one outline and the same turns are of one kind, whatever design they come from.
        std::map<std::vector<double>, int> known;
        std::vector<const PieceSource*> too_large;
        const double smallest = smallest_outline();
        for (std::size_t i = 0; i < sources_.size(); ++i) {
            PieceSource& source = sources_[i];
            source.turns = turns_on(source, areas_);
            const std::vector<Polygon> outline = with_useful_holes(piece_of(source).silhouette, smallest);
            std::vector<double> key;
            for (const Angle turn : source.turns) key.push_back(turn.deg);
            for (const Polygon& polygon : outline) {
                add_ring(key, polygon.outer);
                for (const Ring& hole : polygon.holes) add_ring(key, hole);
                key.push_back(HUGE_VAL);
            }
            const auto [row, is_new] = known.emplace(std::move(key), static_cast<int>(job_.kinds.size()));
            source.kind = row->second;
            if (is_new) job_.kinds.push_back({outline, source.turns, options_.grain == Grain::either});
            const bool fits_one = std::any_of(areas_.begin(), areas_.end(), [&](const SheetArea& area) {
                return std::any_of(source.turns.begin(), source.turns.end(),
                                   [&](Angle turn) { return fits(source.hull, turn, area); });
            });
            if (fits_one || all_locked(source)) continue;
            too_large.push_back(&source);
        }
        complain_of_size(too_large);
        const int designs = static_cast<int>(layout_.designs.size());
        for (int copy = 0; copy < options_.copies; ++copy) {
            for (const PieceSource& source : sources_) {
                job_.items.push_back(
                    {source.kind, options_.group_designs ? copy * designs + source.design : -1, {}});
            }
        }
        for (std::size_t r = 0; r < rows_.size(); ++r)
            job_.stock.push_back({areas_[r].width, areas_[r].height, rows_[r].count});
        job_.spacing = spacing_mm_;
        job_.use_holes = options_.part_in_hole;
        return apply_rules() && too_large.empty();
    }

    // The area of the smallest part of any piece, its holes counted in.
    [[nodiscard]] double smallest_outline() const {
        double least = HUGE_VAL;
        for (const PieceSource& source : sources_) {
            for (const Polygon& part : piece_of(source).silhouette)
                least = std::min(least, std::abs(signed_area(part.outer)));
        }
        return least;
    }

    // Without the holes that no part of any piece goes into: grilles have thousands.
    static std::vector<Polygon> with_useful_holes(std::vector<Polygon> outline, double smallest) {
        for (Polygon& part : outline) {
            std::erase_if(part.holes,
                          [smallest](const Ring& hole) { return std::abs(signed_area(hole)) < smallest; });
        }
        return outline;
    }

    [[nodiscard]] bool all_locked(const PieceSource& source) const {
        const auto locks =
            std::count_if(options_.rules.begin(), options_.rules.end(),
                          [&](const PieceRule& rule) { return rule.lock && is_meant(rule, source); });
        return locks >= options_.copies;
    }

    static void add_ring(std::vector<double>& key, const Ring& ring) {
        key.push_back(static_cast<double>(ring.size()));
        for (const Vec2 p : ring) {
            key.push_back(p.x);
            key.push_back(p.y);
        }
    }

    // Names that mean no piece are errors, and so are two locks of one piece.
    bool apply_rules() {
        bool good = true;
        for (const PieceRule& rule : options_.rules) {
            bool found = false;
            for (std::size_t i = 0; i < sources_.size(); ++i) {
                if (!is_meant(rule, sources_[i])) continue;
                found = true;
                if (rule.lock && rule.copy >= 0 && rule.copy < options_.copies)
                    good =
                        lock(static_cast<std::size_t>(rule.copy) * sources_.size() + i, *rule.lock) && good;
            }
            if (!found) {
                std::string known;
                for (std::size_t i = 0; i < std::min<std::size_t>(sources_.size(), 8); ++i)
                    known += (i == 0 ? "" : ", ") + name_of(sources_[i]);
                if (sources_.size() > 8) known += fmt::format(" and {} more", sources_.size() - 8);
                diagnostics_.error("unknown-piece", {}, fmt::format("there is no piece \"{}\"", rule.piece))
                    .hint("the pieces are " + known);
                good = false;
            } else if (rule.lock && (rule.copy < 0 || rule.copy >= options_.copies)) {
                diagnostics_
                    .error("unknown-piece", {},
                           fmt::format("there is no copy {} of piece \"{}\": {} {} made",
                                       std::int64_t{rule.copy} + 1, rule.piece, options_.copies,
                                       options_.copies == 1 ? "is" : "are"))
                    .hint("ask for more --copies, or lock another");
                good = false;
            }
        }
        return good;
    }

    bool lock(std::size_t item, const PieceLock& lock) {
        if (job_.items[item].locked) {
            diagnostics_.error("lock-impossible", {},
                               fmt::format("{} is locked twice", item_name(static_cast<int>(item))));
            return false;
        }
        job_.items[item].locked =
            NestSpot{lock.sheet, lock.offset - Vec2{options_.margin.mm, options_.margin.mm}, lock.angle};
        // A lock may ask for a turn that the search would not choose: then the piece is of a kind of its own.
        const NestKind& kind = nth(job_.kinds, job_.items[item].kind);
        if (std::find(kind.turns.begin(), kind.turns.end(), lock.angle) != kind.turns.end()) return true;
        job_.kinds.push_back({kind.outline, {lock.angle}, false});
        job_.items[item].kind = static_cast<int>(job_.kinds.size()) - 1;
        return true;
    }

    [[nodiscard]] std::string item_name(int item) const {
        const auto copy = static_cast<std::size_t>(item) / sources_.size();
        const std::string name = name_of(source_of(item));
        return options_.copies == 1 ? fmt::format("\"{}\"", name)
                                    : fmt::format("\"{}\" (copy {})", name, copy + 1);
    }

    void complain_of_size(const PieceSource& source, const std::vector<std::string>& hints) {
        const PatternPiece& piece = piece_of(source);
        std::string sheets;
        for (std::size_t i = 0; i < areas_.size(); ++i) {
            sheets +=
                fmt::format("{}{:.2f} × {:.2f} mm", i == 0 ? "" : " or ", areas_[i].width, areas_[i].height);
        }
        Diagnostic& finding = diagnostics_.error(
            "piece-too-large", {},
            fmt::format(
                "piece \"{}\" of {:.2f} × {:.2f} mm does not fit on the sheet, of which {} are usable",
                name_of(source), piece.bounds.width(), piece.bounds.height(), sheets));
        finding.about(piece.name);
        finding.file = nth(layout_.designs, source.design).file;
        for (const std::string& hint : hints) finding.hint(hint);
    }

    // What would make all of them fit: one paper and one scale, because a run has one.
    [[nodiscard]] std::vector<std::string> hints_of_size(const std::vector<const PieceSource*>& large) const {
        std::vector<std::string> hints;
        const std::string_view them = large.size() == 1 ? "it" : "all of them";
        for (const Paper& paper : papers_of(options_.papers)) {
            if (!in_bed({paper.width_mm, paper.height_mm, -1})) continue;
            const bool takes_all = std::all_of(large.begin(), large.end(), [&](const PieceSource* source) {
                return takes({paper.height_mm, paper.width_mm, -1}, *source) ||
                       takes({paper.width_mm, paper.height_mm, -1}, *source);
            });
            if (!takes_all) continue;
            hints.push_back(fmt::format("--sheet {} would take {}", paper.name, them));
            break;
        }
        double least = HUGE_VAL;
        for (const PieceSource* source : large) {
            double scale = 0.0;
            for (const SheetArea& area : areas_) {
                for (const Angle turn : source->turns) {
                    const GridBox box = turned_box(source->hull, turn);
                    scale = std::max(scale, options_.scale * std::min(area.width / from_grid(box.width()),
                                                                      area.height / from_grid(box.height())));
                }
            }
            least = std::min(least, scale);
        }
        const double rounded = std::floor(100.0 * least + 1e-6) / 100.0;
        if (rounded > 0.0) hints.push_back(fmt::format("--scale {:.2f} would make {} fit", rounded, them));
        return hints;
    }

    void complain_of_size(const std::vector<const PieceSource*>& large) {
        if (large.empty()) return;
        const std::vector<std::string> hints = hints_of_size(large);
        for (const PieceSource* source : large) complain_of_size(*source, hints);
    }

    void complain(const NestRefusal& refusal) {
        std::string names;
        constexpr std::size_t kNamed = 5;
        for (std::size_t i = 0; i < std::min(refusal.items.size(), kNamed); ++i)
            names += (i == 0 ? "" : ", ") + item_name(refusal.items[i]);
        if (refusal.items.size() > kNamed)
            names += fmt::format(" and {} more", refusal.items.size() - kNamed);
        const bool one = refusal.items.size() == 1;
        switch (refusal.reason) {
            case NestRefusal::Reason::too_large: {
                std::vector<const PieceSource*> large;
                for (const int item : refusal.items) large.push_back(&source_of(item));
                return complain_of_size(large);
            }
            case NestRefusal::Reason::lock_outside:
                diagnostics_
                    .error(
                        "lock-impossible", {},
                        fmt::format("locked where they are, {} would not lie inside the margins of a sheet",
                                    names))
                    .hint(
                        "the numbers of a lock are those of a placement in a report: where the origin of the "
                        "piece's page goes");
                return;
            case NestRefusal::Reason::lock_overlap:
                diagnostics_
                    .error(
                        "lock-impossible", {},
                        fmt::format("locked where they are, {} would be closer than {:.2f} mm to each other",
                                    names, spacing_mm_))
                    .hint("lock one of them elsewhere, or leave it free");
                return;
            case NestRefusal::Reason::lock_apart:
                diagnostics_
                    .error("lock-impossible", {},
                           fmt::format("{} are locked on two sheets or in two turns, and have to share one",
                                       names))
                    .hint(
                        "--group keeps the pieces of a design on one sheet, --grain either turns identical "
                        "pieces alike; lock them so, or leave one of them free");
                return;
            case NestRefusal::Reason::stock_used_up:
                diagnostics_
                    .error("stock-used-up", {},
                           fmt::format("the stock of sheets has no place for {} piece{}: {}",
                                       refusal.items.size(), one ? "" : "s", names))
                    .hint("more sheets in --stock would take them; so may a higher --nest-effort");
                return;
            case NestRefusal::Reason::group_too_large:
                diagnostics_
                    .error(
                        "group-too-large", {},
                        fmt::format("no sheet has place for all pieces of {} together", design_name(refusal)))
                    .hint("a larger sheet, a smaller --scale, or no --group would help");
                return;
        }
    }

    [[nodiscard]] std::string design_name(const NestRefusal& refusal) const {
        const PieceSource& source = source_of(refusal.items.front());
        return fmt::format("\"{}\"", nth(layout_.designs, source.design).stem);
    }

    void take(const NestPlan& plan) {
        const double margin = from_grid(to_grid(options_.margin.mm));
        std::vector<double> areas;
        for (const PieceSource& source : sources_) areas.push_back(area(piece_of(source).silhouette));
        for (std::size_t s = 0; s < plan.sheets.size(); ++s) {
            const SheetRow& row = nth(rows_, plan.sheets[s]);
            layout_.sheets.push_back({row.width, row.height, 0.0, plan.used[s]});
        }
        std::vector<std::vector<GridRegion>> last;
        for (std::size_t i = 0; i < plan.spots.size(); ++i) {
            const NestSpot& spot = plan.spots[i];
            const std::size_t number = i % sources_.size();
            const PieceSource& source = sources_[number];
            LayoutSheet& sheet = nth(layout_.sheets, spot.sheet);
            const SheetArea& usable = nth(areas_, nth(plan.sheets, spot.sheet));
            sheet.utilisation += areas[number] / (usable.width * usable.height);
            layout_.placements.push_back({source.design, source.piece, static_cast<int>(i / sources_.size()),
                                          spot.sheet, spot.offset + Vec2{margin, margin}, spot.angle});
            if (static_cast<std::size_t>(spot.sheet) + 1 == plan.sheets.size())
                last.push_back(placed(turned_outline(piece_of(source).silhouette, spot.angle), spot.offset));
        }
        const SheetArea& usable = nth(areas_, plan.sheets.back());
        const Box free = largest_free(last, usable, spacing_mm_);
        layout_.leftover = free;
        if (!free.empty()) {
            layout_.leftover.min = free.min + Vec2{margin, margin};
            layout_.leftover.max = free.max + Vec2{margin, margin};
        }
        std::sort(layout_.placements.begin(), layout_.placements.end(),
                  [](const Placement& a, const Placement& b) {
                      return std::tuple(a.sheet, a.design, a.copy, a.piece) <
                             std::tuple(b.sheet, b.design, b.copy, b.piece);
                  });
    }

    static std::vector<GridRegion> placed(std::vector<GridRegion> outline, Vec2 offset) {
        const GridPoint by{to_grid(offset.x), to_grid(offset.y)};
        for (GridRegion& region : outline) {
            for (GridPoint& p : region.outer) p = p + by;
            for (GridRing& hole : region.holes) {
                for (GridPoint& p : hole) p = p + by;
            }
        }
        return outline;
    }

    const LayoutOptions& options_;
    Diagnostics& diagnostics_;
    const double spacing_mm_;  // that of the options, within its range
    Layout layout_;
    std::vector<PieceSource> sources_;
    std::vector<SheetRow> rows_;
    std::vector<SheetArea> areas_;  // of each row
    NestJob job_;
};

}  // namespace

std::optional<Layout> lay_out(std::vector<DesignPattern> designs, const LayoutOptions& options,
                              Diagnostics& diagnostics) {
    return Layouter(std::move(designs), options, diagnostics).run();
}

}  // namespace popup
