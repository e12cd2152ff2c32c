#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <variant>

#include "base/geometry/edge_index.h"
#include "base/geometry/regions.h"
#include "base/text/numbers.h"
#include "pattern/chain.h"
#include "pattern/glue_overlaps.h"
#include "pattern/hidden_numbers.h"
#include "pattern/labels.h"
#include "pattern/silhouette.h"
#include "pattern/tab_places.h"
#include "pattern/tabs.h"
#include "popup/image.h"
#include "popup/pattern.h"

namespace popup {
namespace {

// Folds whose angles, in radians, are the same to so many decimals are one where they meet in line.
constexpr int kAngleDecimals = 6;

std::size_t at(int number) { return static_cast<std::size_t>(number); }

class Unfolder {
 public:
    Unfolder(const Assembly& assembly, const PatternOptions& options, Diagnostics& diagnostics)
        : in_(assembly),
          options_(options),
          diagnostics_(diagnostics),
          rules_(tab_rules(options)),
          pieces_(assembly.pieces.size()),
          hidden_numbers_(assembly),
          places_(assembly, rules_) {}

    Pattern run() {
        sort_lines();
        for (std::size_t i = 0; i < pieces_.size(); ++i) unfold_plates(i);
        report_glue_overlaps(in_, options_, diagnostics_);
        for (const Glue& glue : in_.glue) add_tab(glue);
        for (const GluedArea& area : in_.glued_areas) add_glued_area(area);
        for (std::size_t i = 0; i < pieces_.size(); ++i) finish(i);
        for (const Plate& plate : in_.plates) out_.plate_names.push_back(plate.name);
        for (Work& work : pieces_) out_.pieces.push_back(std::move(work.piece));
        out_.curves = in_.curves;
        return std::move(out_);
    }

 private:
    enum { kMountain, kValley, kSeam, kDrawnKinds };

    // Tags of lines are the plates they name (-1: none), those of folds by known angles numbers below.
    static constexpr int kFirstFolded = -2;
    struct FoldedTag {
        int plate = -1;
        double angle = 0.0;
    };

    // A piece in the making.
    struct Work {
        PatternPiece piece;
        std::string tab_label;  // of any of its tabs
        std::vector<TaggedSegment> cuts;
        std::array<std::vector<TaggedSegment>, kDrawnKinds> lines;
        std::vector<PatternLine> marks;
        std::vector<Segment> glued;            // what the assembly drew along these gives way to
        std::vector<TaggedSegment> tab_cuts;   // the tabs' free edges and the rests of their seams,
        std::vector<TaggedSegment> tab_seams;  // and the lines between piece and tab
        std::vector<Polygon> tabs;
    };

    void sort_lines() {
        for (std::size_t i = 0; i < in_.lines.size(); ++i) {
            const Line& line = in_.lines[i];
            Work& work = pieces_[at(line.piece)];
            switch (line.kind) {
                case LineKind::cut:
                    work.cuts.push_back({line.at, 0});
                    break;
                case LineKind::mountain:
                    add_line(line, kMountain);
                    break;
                case LineKind::valley:
                    add_line(line, kValley);
                    break;
                case LineKind::seam:
                    add_line(line, kSeam);
                    break;
                case LineKind::mark:
                    work.marks.push_back({line.kind, line.at, line.plate});
                    break;
            }
        }
    }

    // Folds of one plate, by one angle, may become one where they meet in line: they have one tag.
    void add_line(const Line& line, int kind) {
        int tag = line.plate;
        if (line.fold_angle) {
            const double angle = rounded(*line.fold_angle, kAngleDecimals);
            const auto [known, fresh] = folded_tags_.try_emplace({line.piece, kind, line.plate, angle},
                                                                 static_cast<int>(folded_.size()));
            if (fresh) folded_.push_back({line.plate, *line.fold_angle});
            tag = kFirstFolded - known->second;
        }
        pieces_[at(line.piece)].lines.at(static_cast<std::size_t>(kind)).push_back({line.at, tag});
    }

    [[nodiscard]] PatternLine line_of(LineKind kind, const TaggedSegment& segment) const {
        PatternLine line{kind, segment.at, segment.tag};
        if (segment.tag <= kFirstFolded) {
            const FoldedTag& folded = folded_[at(kFirstFolded - segment.tag)];
            line.plate = folded.plate;
            line.fold_angle = folded.angle;
        }
        return line;
    }

    // Pictures are cut to the paper they are printed on.
    static void add_print(const Print& print, const std::vector<Polygon>& paper, int plate,
                          PatternPiece& piece) {
        const Image* image = std::get_if<Image>(&print);
        if (image == nullptr) {
            piece.prints.push_back({print, plate});
            return;
        }
        Image cut = *image;
        cut.clip = intersect(shown_regions(*image), paper);
        if (!cut.clip.empty()) piece.prints.push_back({std::move(cut), plate});
    }

    void unfold_plates(std::size_t number) {
        PatternPiece& piece = pieces_[number].piece;
        const Piece& from = in_.pieces[number];
        piece.name = from.name;
        for (const int index : from.plates) {
            const Plate& plate = in_.plates[at(index)];
            if (plate.fill) piece.prints.push_back({Area{plate.outline, *plate.fill}, index});
            for (const Print& print : plate.prints) add_print(print, {plate.outline}, index, piece);
        }
        piece.silhouette = places_.paper(static_cast<int>(number));
        for (const Print& print : from.prints) add_print(print, piece.silhouette, -1, piece);
    }

    void add_tab(const Glue& glue) {
        const SeamFrame on_piece(glue.on_piece, true);
        const SeamFrame on_base(glue.on_base, glue.on_back);
        Work& work = pieces_[at(in_.plates[at(glue.piece_plate)].piece)];
        const std::vector<Ring> parts = places_.place(glue);
        judge_tab(in_, rules_, glue, parts, diagnostics_);

        work.tab_label = glue.label;
        work.glued.push_back(glue.on_piece);
        Work& under = pieces_[at(in_.plates[at(glue.base_plate)].piece)];
        for (const Ring& part : parts) {
            add_part(glue, on_piece, part, work);
            Ring target = on_base.to_page(part);
            // The base's front sees the tab from the other side.
            if (!glue.on_back) std::reverse(target.begin(), target.end());
            under.piece.targets.push_back({std::move(target), glue.base_plate, glue.label, glue.on_back});
        }
        add_rest_of_seam(on_piece, parts, work);
        if (const auto spot = place_in_tab(parts, glue.label)) {
            work.piece.labels.push_back({LabelKind::tab, glue.label, on_piece.to_page(spot->at), spot->height,
                                         on_piece.text_angle()});
            name_tab(on_piece, parts, work);
            under.piece.labels.push_back({LabelKind::target, glue.label, on_base.to_page(spot->at),
                                          spot->height, on_base.text_angle(), glue.on_back});
        }
    }

    // The roomiest of the piece's tabs that have room for its name after their number.
    static void name_tab(const SeamFrame& frame, const std::vector<Ring>& parts, Work& work) {
        const std::size_t number = work.piece.labels.size() - 1;
        const std::string text = fmt::format("{} {}", work.piece.labels[number].text, work.piece.name);
        const auto spot = place_if_it_fits(parts, text);
        std::optional<NamedTab>& best = work.piece.named_tab;
        if (!spot || (best && best->named.height_mm >= spot->height)) return;
        best = NamedTab{number,
                        {LabelKind::tab, text, frame.to_page(spot->at), spot->height, frame.text_angle()}};
    }

    // Its target is the area itself, with the piece's number where there is most room for it.
    void add_glued_area(const GluedArea& glued) {
        constexpr double kLeastText = 1.5;
        pieces_[at(in_.plates[at(glued.plate)].piece)].tab_label = glued.label;
        const Plate& base = in_.plates[at(glued.base_plate)];
        const bool back = in_.plates[at(glued.plate)].lying == Lying::on_back;
        Work& under = pieces_[at(base.piece)];
        const std::string number = upright_number(glued.label);
        const auto label = [&](const TextSpot& spot) {
            under.piece.labels.push_back({LabelKind::target, number, spot.at, spot.height, spot.angle, back});
        };
        std::optional<TextSpot> spot;
        for (const Polygon& part : glued.on_base) {
            under.piece.targets.push_back({part.outer, glued.base_plate, glued.label, back});
            places_.take(glued.base_plate, back, part.outer);
            if (spot) continue;
            spot = place_on_plate(EdgeIndex(edges_of(part), {}), Drawing{}, bounds(part.outer), number);
        }
        label(spot.value_or(TextSpot{inner_point(glued.on_base.front(), 0.1).at, kLeastText}));
        std::optional<Label>& hidden = pieces_[at(in_.plates[at(glued.plate)].piece)].piece.hidden_number;
        if (!hidden) hidden = hidden_numbers_.of(glued, spot);
    }

    void add_part(const Glue& glue, const SeamFrame& frame, const Ring& part, Work& work) {
        Ring ring;
        Ring joined;  // reaches a little into the piece, so that rounding leaves no gap between the two
        constexpr double kReach = 1e-3;
        for (std::size_t i = 0; i < part.size(); ++i) {
            const Vec2 before = part[i == 0 ? part.size() - 1 : i - 1];
            const Vec2 after = part[i + 1 == part.size() ? 0 : i + 1];
            const Segment edge{frame.to_page(part[i]), frame.to_page(after)};
            const bool to_seam = part[i].y == 0.0 && after.y == 0.0;
            const bool from_seam = part[i].y == 0.0 && before.y == 0.0;
            ring.push_back(edge.a);
            if (from_seam) joined.push_back(frame.to_page(part[i] - Vec2{2.0 * kReach, kReach}));
            joined.push_back(edge.a);
            if (to_seam) joined.push_back(frame.to_page(part[i] + Vec2{2.0 * kReach, -kReach}));
            if (to_seam) {
                work.tab_seams.push_back({edge, glue.piece_plate});
            } else {
                work.tab_cuts.push_back({edge, 0});
            }
        }
        work.tabs.push_back({std::move(joined), {}});
        if (glue.fill) work.piece.prints.push_back({Area{{std::move(ring), {}}, *glue.fill}, -1});
    }

    // Where no tab is left the seam is simply the piece's edge.
    static void add_rest_of_seam(const SeamFrame& frame, const std::vector<Ring>& parts, Work& work) {
        double reached = 0.0;
        for (const Stretch& stretch : seam_stretches(parts)) {
            if (stretch.from > reached) {
                work.tab_cuts.push_back(
                    {{frame.to_page({reached, 0.0}), frame.to_page({stretch.from, 0.0})}, 0});
            }
            reached = stretch.to;
        }
        if (reached < frame.length()) {
            work.tab_cuts.push_back(
                {{frame.to_page({reached, 0.0}), frame.to_page({frame.length(), 0.0})}, 0});
        }
    }

    void finish(std::size_t number) {
        Work& work = pieces_[number];
        PatternPiece& piece = work.piece;
        piece.number = glue_number(number);
        const bool has_paper = !in_.pieces[number].paper.empty();
        POPUP_INVARIANT(!has_paper || work.glued.empty());
        if (has_paper) {
            add_drawn_cuts(in_.pieces[number], piece);
        } else {
            work.cuts = without(std::move(work.cuts), work.glued);
            work.cuts.insert(work.cuts.end(), work.tab_cuts.begin(), work.tab_cuts.end());
            piece.cuts = cut_paths(work.cuts);
        }
        work.tab_seams = merged(std::move(work.tab_seams));
        std::vector<Segment> folded;
        for (const TaggedSegment& s : work.tab_seams) folded.push_back(s.at);
        work.lines[kSeam] = without(without(std::move(work.lines[kSeam]), work.glued), folded);
        constexpr std::array kKinds{LineKind::mountain, LineKind::valley, LineKind::seam};
        for (std::size_t k = 0; k < kDrawnKinds; ++k) {
            for (const TaggedSegment& s : merged(std::move(work.lines[k]))) {
                piece.lines.push_back(line_of(kKinds[k], s));
                // Where the source draws the tabs itself its seams are their folds.
                piece.lines.back().glued_on = kKinds[k] == LineKind::seam && !has_paper;
            }
        }
        for (const TaggedSegment& s : work.tab_seams) piece.lines.push_back({LineKind::seam, s.at, s.tag});
        piece.lines.insert(piece.lines.end(), work.marks.begin(), work.marks.end());
        if (!work.tabs.empty()) {
            work.tabs.insert(work.tabs.end(), piece.silhouette.begin(), piece.silhouette.end());
            piece.silhouette = silhouette_of(work.tabs);
        }
        for (const Polygon& part : piece.silhouette) {
            for (const Vec2 p : part.outer) piece.bounds.extend(p);
        }
        name_piece(number);
    }

    static void add_drawn_cuts(const Piece& from, PatternPiece& piece) {
        for (const Polygon& paper : from.paper) {
            piece.cuts.push_back({paper.outer, true});
            for (const Ring& hole : paper.holes) piece.cuts.push_back({hole, true});
        }
        for (Contour& slit : slits_once(from.slits)) piece.cuts.push_back(std::move(slit));
        put_in_order(piece.cuts);
    }

    // Slits as they are drawn; where some lie on one another, in paths that have every part of them once.
    static std::vector<Contour> slits_once(const std::vector<std::vector<Vec2>>& slits) {
        std::vector<Contour> drawn;
        std::vector<TaggedSegment> segments;
        for (const std::vector<Vec2>& slit : slits) {
            drawn.push_back({slit, false});
            for (std::size_t i = 0; i + 1 < slit.size(); ++i) segments.push_back({{slit[i], slit[i + 1]}, 0});
        }
        const auto length_of = [](const std::vector<TaggedSegment>& all) {
            double sum = 0.0;
            for (const TaggedSegment& one : all) sum += distance(one.at.a, one.at.b);
            return sum;
        };
        constexpr double kTwiceMm = 0.01;
        if (length_of(segments) - length_of(merged(segments)) < kTwiceMm) return drawn;
        return cut_paths(segments);
    }

    // Lines across a picture, so near each other that no label stands between two.
    static void hatch(const Image& image, std::vector<Segment>& lines) {
        constexpr double kApartMm = 2.0;
        constexpr double kMostLines = 100.0;
        const auto across = [&](Vec2 corner, Vec2 along, Vec2 up) {
            const double count = std::ceil(std::min(kMostLines, length(up) / kApartMm));
            for (int i = 0; i <= static_cast<int>(count); ++i) {
                const Vec2 from = corner + (i / std::max(1.0, count)) * up;
                lines.push_back({from, from + along});
            }
        };
        if (image.clip.empty())
            return across(image.place.origin, image.width * image.place.x, image.height * image.place.y);
        for (const Polygon& shown : image.clip) {
            const Box box = bounds(shown.outer);
            across(box.min, {box.width(), 0.0}, {0.0, box.height()});
        }
    }

    // What labels stay off: strokes, pictures, and texts that are drawn.
    // With the targets on the plate's back: on printed backs names stand there, too.
    static Drawing drawing_of(std::span<const Print> on_plate, std::span<const Print> on_piece,
                              std::span<const GlueTarget> targets, int plate) {
        std::vector<Segment> lines;
        std::vector<Segment> texts;
        double half_width = 0.0;
        double half_text = 0.0;
        const auto add = [&](const Print& print) {
            if (const Text* text = std::get_if<Text>(&print); text != nullptr && text->color) {
                const Vec2 along = rotated({0.5 * text_width(text->text, text->height_mm), 0.0}, text->angle);
                texts.push_back({text->at - along, text->at + along});
                half_text = std::max(half_text, text->height_mm);
            }
            if (const Image* image = std::get_if<Image>(&print)) hatch(*image, lines);
            const Stroke* stroke = std::get_if<Stroke>(&print);
            if (stroke == nullptr) return;
            for (std::size_t i = 0; i + 1 < stroke->points.size(); ++i) {
                lines.push_back({stroke->points[i], stroke->points[i + 1]});
            }
            half_width = std::max(half_width, 0.5 * stroke->width_mm);
        };
        std::for_each(on_plate.begin(), on_plate.end(), add);
        std::for_each(on_piece.begin(), on_piece.end(), add);
        for (const GlueTarget& target : targets) {
            if (!target.on_back || target.plate != plate) continue;
            // Across it as well, for its number stands in it.
            const std::size_t n = target.outline.size();
            for (std::size_t i = 0; i < n; ++i) {
                lines.push_back({target.outline[i], target.outline[(i + 1) % n]});
                lines.push_back({target.outline[i], target.outline[(i + n / 2) % n]});
            }
        }
        lines.insert(lines.end(), texts.begin(), texts.end());
        return {{EdgeIndex({}, lines), std::max(half_width, half_text)}, {EdgeIndex({}, texts), half_text}};
    }

    // The piece's name goes on one of its largest plates, after the number that its tabs have: in the order
    // of these numbers pieces are glued, for none stands on a later one. Where both are too long the name
    // alone; of a piece that has no tab with the number, that is glued flat, the number.
    void name_piece(std::size_t number) {
        const Piece& from = in_.pieces[number];
        // Its source names it.
        const auto is_note = [](const Print& print) {
            const Text* text = std::get_if<Text>(&print);
            return text != nullptr && !text->color;
        };
        if (std::any_of(from.prints.begin(), from.prints.end(), is_note)) return;
        const std::string& name = from.name;
        if (!from.paper.empty()) return write_on_paper(number, name);
        const std::string& order = pieces_[number].piece.number;
        if (!order.empty() && write_on_piece(number, fmt::format("{}. {}", order, name))) return;
        const std::vector<Label>& labels = pieces_[number].piece.labels;
        const bool has_tab = std::any_of(labels.begin(), labels.end(),
                                         [](const Label& one) { return one.kind == LabelKind::tab; });
        write_on_piece(number, order.empty() || has_tab ? name : upright_number(order));
    }

    // "3" of a piece with the tabs "3L" and "3R"; empty for one without tabs.
    [[nodiscard]] std::string glue_number(std::size_t piece) const {
        return pieces_[piece].tab_label.substr(0, pieces_[piece].tab_label.find_first_not_of("0123456789"));
    }

    void write(std::size_t number, const std::string& text, const TextSpot& spot) {
        pieces_[number].piece.labels.push_back(
            {LabelKind::piece, text, spot.at, spot.height, spot.angle, false, spot.room});
    }

    // On the largest of its paper's regions that has room for it.
    void write_on_paper(std::size_t number, const std::string& text) {
        constexpr std::size_t kTried = 3;
        const Piece& from = in_.pieces[number];
        std::vector<std::pair<double, std::size_t>> largest;
        for (std::size_t i = 0; i < from.paper.size(); ++i) {
            largest.emplace_back(-std::round(1e3 * area(from.paper[i])), i);
        }
        std::sort(largest.begin(), largest.end());
        std::vector<Segment> lines;
        for (const PatternLine& line : pieces_[number].piece.lines) lines.push_back(line.at);
        for (const std::vector<Vec2>& slit : from.slits) {
            for (std::size_t i = 0; i + 1 < slit.size(); ++i) lines.push_back({slit[i], slit[i + 1]});
        }
        const Drawing drawing = drawing_of({}, from.prints, {}, -1);
        for (std::size_t i = 0; i < std::min(kTried, largest.size()); ++i) {
            const Polygon& paper = from.paper[largest[i].second];
            const EdgeIndex edges(edges_of(paper), lines);
            if (const auto spot = place_on_plate(edges, drawing, bounds(paper.outer), text)) {
                return write(number, text, *spot);
            }
        }
    }

    bool write_on_piece(std::size_t number, const std::string& text) {
        constexpr std::size_t kTried = 3;
        std::vector<std::pair<double, int>> largest;
        for (const int plate : in_.pieces[number].plates) {
            largest.emplace_back(-std::round(1e3 * area(in_.plates[at(plate)].outline)), plate);
        }
        const std::size_t tried = std::min(kTried, largest.size());
        std::partial_sort(largest.begin(), largest.begin() + static_cast<std::ptrdiff_t>(tried),
                          largest.end());
        std::optional<TextSpot> best;
        for (std::size_t i = 0; i < tried; ++i) {
            const int plate = largest[i].second;
            const auto spot =
                place_on_plate(places_.on_plate(plate),
                               drawing_of(in_.plates[at(plate)].prints, in_.pieces[number].prints,
                                          pieces_[number].piece.targets, plate),
                               bounds(in_.plates[at(plate)].outline.outer), text);
            if (spot && (!best || spot->height > best->height)) best = spot;
        }
        if (!best) return false;
        write(number, text, *best);
        return true;
    }

    const Assembly& in_;
    const PatternOptions& options_;
    Diagnostics& diagnostics_;
    TabRules rules_;
    std::vector<Work> pieces_;
    HiddenNumbers hidden_numbers_;
    TabPlaces places_;
    std::vector<FoldedTag> folded_;
    std::map<std::tuple<int, int, int, double>, int> folded_tags_;  // by piece, kind, plate and rounded angle
    Pattern out_;
};

}  // namespace

std::optional<Pattern> make_pattern(const Assembly& assembly, const PatternOptions& options,
                                    Diagnostics& diagnostics) {
    return Unfolder(assembly, options, diagnostics).run();
}

}  // namespace popup
