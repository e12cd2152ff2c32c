#include "popup/layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>
#include <tuple>

#include "base/geometry/regions.h"
#include "layout/turns.h"
#include "support/sanitized.h"

namespace popup {
namespace {

double number(std::mt19937& random, double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967295.0);
}

PatternPiece piece_of(const std::string& name, const Ring& outline) {
    PatternPiece piece;
    piece.name = name;
    piece.silhouette = {{outline, {}}};
    for (const Vec2 p : outline) piece.bounds.extend(p);
    piece.cuts = {{outline, true}};
    return piece;
}

Ring rectangle(double width, double height, Vec2 at = {}) {
    return {at, at + Vec2{width, 0}, at + Vec2{width, height}, at + Vec2{0, height}};
}

DesignPattern design_of(const std::string& stem, std::vector<PatternPiece> pieces) {
    DesignPattern design;
    design.file = stem + ".xml";
    design.stem = stem;
    design.pattern.pieces = std::move(pieces);
    return design;
}

// A convex polygon about a random place far from the origin.
Ring random_polygon(std::mt19937& random, double low, double high) {
    const int corners = 3 + static_cast<int>(random() % 6);
    const Vec2 centre{number(random, -500, 500), number(random, -500, 500)};
    const Vec2 radius{number(random, low, high), number(random, low, high)};
    Ring ring;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * 3.14159265358979 * (i + number(random, 0.0, 0.7)) / corners;
        ring.push_back(centre + Vec2{radius.x * std::cos(angle), radius.y * std::sin(angle)});
    }
    return ring;
}

Box placed_box(const Layout& layout, const Placement& placement) {
    Box box;
    const auto& piece = layout.designs[static_cast<std::size_t>(placement.design)]
                            .pattern.pieces[static_cast<std::size_t>(placement.piece)];
    for (const Polygon& part : piece.silhouette) {
        for (const Vec2 p : part.outer) box.extend(placement.apply(p));
    }
    return box;
}

Ring outline_of(const Layout& layout, const Placement& placement) {
    Ring ring;
    for (const Vec2 p : layout.designs[static_cast<std::size_t>(placement.design)]
                            .pattern.pieces[static_cast<std::size_t>(placement.piece)]
                            .silhouette[0]
                            .outer) {
        ring.push_back(placement.apply(p));
    }
    return ring;
}

// The distance of two outlines, edge by edge; negative when a corner of one lies deeper than rounding in the
// other.
double gap(const Ring& a, const Ring& b) {
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < b.size(); ++j) {
            least = std::min(
                least, distance(Segment{a[i], a[(i + 1) % a.size()]}, Segment{b[j], b[(j + 1) % b.size()]}));
        }
    }
    for (const auto& [ring, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
        for (const Vec2 p : *ring) {
            if (!contains({*other, {}}, p)) continue;
            double depth = HUGE_VAL;
            for (std::size_t j = 0; j < other->size(); ++j)
                depth = std::min(depth, distance(p, Segment{(*other)[j], (*other)[(j + 1) % other->size()]}));
            least = std::min(least, -depth);
        }
    }
    return least;
}

// Everything lay_out() promises, looked at two by two.
void expect_sound(const Layout& layout, const LayoutOptions& options) {
    std::size_t pieces = 0;
    for (const DesignPattern& design : layout.designs) pieces += design.pattern.pieces.size();
    EXPECT_EQ(layout.placements.size(), pieces * static_cast<std::size_t>(options.copies));
    constexpr double kRounding = 3e-6;
    std::vector<Box> boxes;
    std::set<std::tuple<int, int, int>> seen;
    for (const Placement& p : layout.placements) {
        EXPECT_TRUE(seen.insert({p.design, p.piece, p.copy}).second);
        boxes.push_back(placed_box(layout, p));
        const Box& box = boxes.back();
        ASSERT_LT(static_cast<std::size_t>(p.sheet), layout.sheets.size());
        const LayoutSheet& sheet = layout.sheets[static_cast<std::size_t>(p.sheet)];
        EXPECT_GE(box.min.x, options.margin.mm - kRounding);
        EXPECT_GE(box.min.y, options.margin.mm - kRounding);
        EXPECT_LE(box.max.x, sheet.width_mm - options.margin.mm + kRounding);
        EXPECT_LE(box.max.y, sheet.height_mm - options.margin.mm + kRounding);
        if (options.rotation.count > 0) {
            const double steps = p.angle.deg * options.rotation.count / 360.0;
            EXPECT_NEAR(steps, std::round(steps), 1e-6);
        }
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (std::size_t j = i + 1; j < boxes.size(); ++j) {
            if (layout.placements[i].sheet != layout.placements[j].sheet) break;  // they are sorted by sheet
            const double dx = std::max(boxes[i].min.x - boxes[j].max.x, boxes[j].min.x - boxes[i].max.x);
            const double dy = std::max(boxes[i].min.y - boxes[j].max.y, boxes[j].min.y - boxes[i].max.y);
            if (std::max(dx, dy) >= options.spacing.mm) continue;
            EXPECT_GE(gap(outline_of(layout, layout.placements[i]), outline_of(layout, layout.placements[j])),
                      options.spacing.mm - kRounding);
        }
    }
    for (const LayoutSheet& sheet : layout.sheets) {
        EXPECT_GT(sheet.utilisation, 0.0);
        EXPECT_LE(sheet.utilisation, 1.0 + 1e-9);
    }
    EXPECT_TRUE(std::is_sorted(layout.placements.begin(), layout.placements.end(),
                               [](const Placement& a, const Placement& b) {
                                   return std::tuple(a.sheet, a.design, a.copy, a.piece) <
                                          std::tuple(b.sheet, b.design, b.copy, b.piece);
                               }));
}

TEST(Layout, RandomPiecesStayApartAndInsideTheMargin) {
    std::mt19937 random(1);
    for (int round = 0; round < test::sanitized_count(60); ++round) {
        std::vector<DesignPattern> designs;
        for (int d = 0; d < 1 + round % 3; ++d) {
            std::vector<PatternPiece> pieces;
            const int count = 1 + static_cast<int>(random() % 12);
            for (int i = 0; i < count; ++i) {
                pieces.push_back(piece_of("p" + std::to_string(i), random_polygon(random, 3, 90)));
            }
            designs.push_back(design_of("d" + std::to_string(d), std::move(pieces)));
        }
        LayoutOptions options;
        options.sheet = parse_sheet(round % 2 == 0 ? "a4" : "300x200").value();
        options.margin = Length::millimetres(number(random, 0, 6));
        options.spacing = Length::millimetres(round % 5 == 0 ? 0.0 : number(random, 0, 4));
        options.rotation = Rotation{std::array{1, 2, 4, 0, 7, 12}[static_cast<std::size_t>(round % 6)]};
        options.copies = 1 + round % 4;
        options.nesting.work = 3e3;
        Diagnostics diagnostics;
        const auto layout = lay_out(designs, options, diagnostics);
        ASSERT_TRUE(layout.has_value()) << round;
        expect_sound(*layout, options);
    }
}

TEST(Layout, ManyPiecesAreSoundToo) {
    std::mt19937 random(8);
    std::vector<PatternPiece> pieces;
    for (int i = 0; i < 400; ++i) pieces.push_back(piece_of("p", random_polygon(random, 3, 40)));
    LayoutOptions options;
    options.sheet = parse_sheet("a3").value();
    options.nesting.work = 1e3;
    for (const int copies : {1, 3}) {
        options.copies = copies;
        Diagnostics diagnostics;
        const auto layout = lay_out({design_of("d", pieces)}, options, diagnostics);
        ASSERT_TRUE(layout.has_value());
        expect_sound(*layout, options);
        double used = 0.0;
        for (const PatternPiece& piece : layout->designs[0].pattern.pieces)
            used += copies * area(offset(piece.silhouette, 1.0, Corners::sharp)[0]);
        const double whole = used / ((layout->sheets[0].width_mm - 8) * (layout->sheets[0].height_mm - 8));
        EXPECT_LE(static_cast<double>(layout->sheets.size()), std::ceil(whole / 0.75)) << copies;
    }
}

TEST(Layout, TheSameJobGivesTheSamePlaces) {
    std::mt19937 random(4);
    std::vector<PatternPiece> pieces;
    for (int i = 0; i < 40; ++i) pieces.push_back(piece_of("p", random_polygon(random, 3, 60)));
    Diagnostics diagnostics;
    const auto a = lay_out({design_of("d", pieces)}, {}, diagnostics);
    const auto b = lay_out({design_of("d", pieces)}, {}, diagnostics);
    ASSERT_TRUE(a && b);
    for (std::size_t i = 0; i < a->placements.size(); ++i) {
        EXPECT_EQ(a->placements[i].offset, b->placements[i].offset);
        EXPECT_EQ(a->placements[i].angle, b->placements[i].angle);
    }
}

TEST(Layout, PiecesThatTileASheetAreFoundToFillIt) {
    // 12 pieces of 50 × 100 fill 300 × 200 when nothing is lost; so do four of 150 × 100.
    for (const auto& [w, h, count] : {std::tuple{50.0, 100.0, 12}, std::tuple{150.0, 100.0, 4}}) {
        std::vector<PatternPiece> pieces;
        for (int i = 0; i < count; ++i) pieces.push_back(piece_of("p", rectangle(w, h, {i * 7.3, 1.0 / 3})));
        LayoutOptions options;
        options.sheet = {"", 300.0, 200.0};
        options.margin = options.spacing = Length::millimetres(0);
        Diagnostics diagnostics;
        const auto layout = lay_out({design_of("d", pieces)}, options, diagnostics);
        ASSERT_TRUE(layout.has_value());
        EXPECT_EQ(layout->sheets.size(), 1U);
        EXPECT_NEAR(layout->sheets[0].utilisation, 1.0, 1e-6);
        expect_sound(*layout, options);
    }
}

TEST(Layout, TheLastSheetIsUsedOverAShortLength) {
    std::vector<PatternPiece> pieces;
    for (int i = 0; i < 8; ++i) pieces.push_back(piece_of("p", rectangle(50, 98)));
    LayoutOptions options;
    options.sheet = {"", 1000.0, 200.0};
    options.margin = Length::millimetres(0);
    Diagnostics diagnostics;
    const auto layout = lay_out({design_of("d", pieces)}, options, diagnostics);
    ASSERT_TRUE(layout.has_value());
    EXPECT_NEAR(layout->sheets[0].used_mm.x, 4 * 50 + 3 * 2, 1e-6);
    EXPECT_NEAR(layout->sheets[0].used_mm.y, 2 * 98 + 2, 1e-6);
}

TEST(Layout, AutoTakesTheFirstPaperThatTakesTheLargestPiece) {
    const auto sheet_for = [](double w, double h) {
        Diagnostics diagnostics;
        const auto layout = lay_out({design_of("d", {piece_of("page", rectangle(w, h))})}, {}, diagnostics);
        return layout ? std::pair{layout->sheets[0].width_mm, layout->sheets[0].height_mm}
                      : std::pair{0.0, 0.0};
    };
    EXPECT_EQ(sheet_for(100, 100), (std::pair{279.4, 215.9}));      // letter, landscape if either way serves
    EXPECT_EQ(sheet_for(269.4, 205.9), (std::pair{279.4, 215.9}));  // exactly the usable part
    EXPECT_EQ(sheet_for(269.5, 205.9), (std::pair{431.8, 279.4}));  // a hair more than that
    EXPECT_EQ(sheet_for(280, 195), (std::pair{297.0, 210.0}));      // too long for letter, fits a4
    EXPECT_EQ(sheet_for(279.4, 215.9), (std::pair{431.8, 279.4}));  // a letter page needs tabloid
    EXPECT_EQ(sheet_for(1170, 800), (std::pair{1189.0, 841.0}));
    EXPECT_EQ(sheet_for(1190, 10), (std::pair{0.0, 0.0}));
}

TEST(Layout, SmallAndUnusualPapersAreTakenWhereTheyAreNamed) {
    const auto size_on = [](std::string_view paper, double width, double height) {
        LayoutOptions options;
        options.sheet = parse_sheet(paper).value();
        Diagnostics diagnostics;
        const auto layout =
            lay_out({design_of("d", {piece_of("p", rectangle(width, height))})}, options, diagnostics);
        if (!layout) return std::pair{0.0, 0.0};
        return std::pair{layout->sheets[0].width_mm, layout->sheets[0].height_mm};
    };
    EXPECT_EQ(size_on("a5", 60, 100), (std::pair{210.0, 148.0}));
    EXPECT_EQ(size_on("A6", 60, 100), (std::pair{148.0, 105.0}));
    EXPECT_EQ(size_on("legal", 340, 200), (std::pair{355.6, 215.9}));
    EXPECT_EQ(size_on("auto", 60, 100), (std::pair{279.4, 215.9})) << "who names nothing has usual paper";
    EXPECT_EQ(size_on("auto", 340, 200), (std::pair{431.8, 279.4}));
}

TEST(Layout, ANamedPaperStandsUprightWhenThePieceNeedsIt) {
    LayoutOptions options;
    options.sheet = parse_sheet("a4").value();
    options.rotation = {1};
    Diagnostics diagnostics;
    const auto layout = lay_out({design_of("d", {piece_of("p", rectangle(190, 250))})}, options, diagnostics);
    ASSERT_TRUE(layout.has_value());
    EXPECT_EQ(layout->sheets[0].width_mm, 210.0);
    EXPECT_EQ(layout->sheets[0].height_mm, 297.0);
}

TEST(Layout, APieceThatDoesNotFitIsNamedWithItsSizeAndTheSheets) {
    LayoutOptions options;
    options.sheet = parse_sheet("a4").value();
    Diagnostics diagnostics;
    EXPECT_FALSE(
        lay_out({design_of("card", {piece_of("page", rectangle(300, 200)), piece_of("ok", rectangle(9, 9))}),
                 design_of("other", {piece_of("page", rectangle(20, 20))})},
                options, diagnostics)
            .has_value());
    const auto found = diagnostics.sorted();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, "piece-too-large");
    EXPECT_EQ(found[0].file, "card.xml");
    EXPECT_EQ(found[0].message,
              "piece \"card:page\" of 300.00 × 200.00 mm does not fit on the sheet, of which 287.00 × 200.00 "
              "mm are "
              "usable");
    EXPECT_EQ(found[0].hints,
              (std::vector<std::string>{"--sheet tabloid would take it", "--scale 0.95 would make it fit"}));
}

TEST(Layout, MarginsThatLeaveNothingAreAnError) {
    LayoutOptions options;
    options.sheet = {"", 20.0, 100.0};
    options.margin = Length::millimetres(10);
    Diagnostics diagnostics;
    EXPECT_FALSE(
        lay_out({design_of("d", {piece_of("p", rectangle(1, 1))})}, options, diagnostics).has_value());
    ASSERT_EQ(diagnostics.sorted().size(), 1U);
    EXPECT_EQ(diagnostics.sorted()[0].code, "sheet-too-small");
}

TEST(Layout, OfNoPiecesThereAreNoSheets) {
    for (const std::vector<DesignPattern>& designs :
         {std::vector<DesignPattern>{}, std::vector<DesignPattern>{design_of("d", {})}}) {
        Diagnostics diagnostics;
        const auto layout = lay_out(designs, {}, diagnostics);
        ASSERT_TRUE(layout.has_value());
        EXPECT_TRUE(layout->sheets.empty());
        EXPECT_FALSE(diagnostics.has_findings());
    }
}

TEST(Layout, MoreSpacingThanAnySheetHasRoomForPartsAll) {
    const PatternPiece piece = piece_of("p", rectangle(1, 1));
    for (const double mm : {1e6, 3e9, 1e300}) {
        LayoutOptions options;
        options.spacing = Length::millimetres(mm);
        Diagnostics diagnostics;
        const auto layout = lay_out({design_of("d", {piece, piece})}, options, diagnostics);
        ASSERT_TRUE(layout.has_value()) << mm;
        EXPECT_EQ(layout->sheets.size(), 2U) << mm;
    }
}

TEST(Layout, CopiesThatThereAreNotCannotBeLocked) {
    for (const int copy : {-1, 1, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}) {
        LayoutOptions options;
        options.rules = {{"p", copy, {}, PieceLock{0, {20, 20}, {}}}};
        Diagnostics diagnostics;
        EXPECT_FALSE(lay_out({design_of("d", {piece_of("p", rectangle(1, 1))})}, options, diagnostics));
        EXPECT_EQ(diagnostics.sorted().at(0).code, "unknown-piece") << copy;
    }
}

TEST(Layout, TooManyCopiesAndBoundlessScalesAreErrors) {
    LayoutOptions options;
    options.copies = 1'000'001;
    Diagnostics many;
    EXPECT_FALSE(lay_out({design_of("d", {piece_of("p", rectangle(1, 1))})}, options, many).has_value());
    EXPECT_EQ(many.sorted().at(0).code, "too-many-pieces");
    options.copies = 1;
    for (const double scale : {1e9, 1e300, 1e307}) {
        options.scale = scale;
        Diagnostics huge;
        EXPECT_FALSE(
            lay_out({design_of("d", {piece_of("p", rectangle(100, 100))})}, options, huge).has_value());
        EXPECT_EQ(huge.sorted().at(0).code, "piece-too-large");
    }
}

TEST(Layout, TheOnlyPieceHasNoNameOnIt) {
    PatternPiece piece = piece_of("p", rectangle(10, 20));
    piece.labels.push_back({LabelKind::tab, "1L", {5, 5}, 4.0, 0.1});
    piece.labels.push_back({LabelKind::piece, "p", {5, 5}, 4.0, 0.1});
    const auto names = [](const std::vector<DesignPattern>& designs) {
        Diagnostics diagnostics;
        LayoutOptions options;
        options.copies = 2;
        const auto layout = lay_out(designs, options, diagnostics);
        std::ptrdiff_t found = 0;
        for (const DesignPattern& design : layout.value().designs) {
            for (const PatternPiece& one : design.pattern.pieces) {
                EXPECT_EQ(one.labels.front().text, "1L");
                found += std::count_if(one.labels.begin(), one.labels.end(),
                                       [](const Label& label) { return label.kind == LabelKind::piece; });
            }
        }
        return found;
    };
    EXPECT_EQ(names({design_of("d", {piece})}), 0);
    EXPECT_EQ(names({design_of("d", {piece, piece})}), 2);
    EXPECT_EQ(names({design_of("d", {piece}), design_of("e", {piece})}), 2);
}

TEST(Layout, ScaleAppliesToEverythingWithASize) {
    PatternPiece piece = piece_of("p", rectangle(10, 20));
    piece.prints.push_back({Stroke{{{1, 1}, {2, 2}}, 0.5, {}}, -1});
    piece.prints.push_back({Text{"t", {3, 4}, 2.0, 0.2}, -1});
    piece.prints.push_back(
        {Image{nullptr, ImageFormat::png, 8, 8, {{1, 0}, {0, -1}, {2, 3}}, {{rectangle(2, 2), {}}}}, 0});
    piece.labels.push_back({LabelKind::tab, "1L", {5, 5}, 4.0, 0.1});
    piece.targets.push_back({rectangle(2, 2), 0});
    piece.lines.push_back({LineKind::valley, {{0, 1}, {10, 1}}, 0});
    piece.prints.push_back({Area{{rectangle(3, 3), {rectangle(1, 1)}}, {}}, 0});
    LayoutOptions options;
    options.scale = 2.0;
    Diagnostics diagnostics;
    const auto layout = lay_out({design_of("d", {piece})}, options, diagnostics);
    ASSERT_TRUE(layout.has_value());
    const PatternPiece& scaled = layout->designs[0].pattern.pieces[0];
    EXPECT_EQ(scaled.cuts[0].points[2], (Vec2{20, 40}));
    const auto& stroke = std::get<Stroke>(scaled.prints.at(0).print);
    EXPECT_EQ(stroke.width_mm, 1.0);
    EXPECT_EQ(stroke.points[1], (Vec2{4, 4}));
    const auto& text = std::get<Text>(scaled.prints.at(1).print);
    EXPECT_EQ(text.at, (Vec2{6, 8}));
    EXPECT_EQ(text.height_mm, 4.0);
    EXPECT_EQ(text.angle, 0.2);
    const auto& image = std::get<Image>(scaled.prints.at(2).print);
    EXPECT_EQ(image.place, (Affine{{2, 0}, {0, -2}, {4, 6}}));
    EXPECT_EQ(image.clip.at(0).outer[2], (Vec2{4, 4}));
    EXPECT_EQ(scaled.labels[0].height_mm, 8.0);
    EXPECT_EQ(scaled.labels[0].at, (Vec2{10, 10}));
    EXPECT_EQ(scaled.labels[0].angle, 0.1);
    EXPECT_EQ(scaled.targets[0].outline[2], (Vec2{4, 4}));
    EXPECT_EQ(scaled.lines[0].at.b, (Vec2{20, 2}));
    EXPECT_EQ(std::get<Area>(scaled.prints.at(3).print).shape.holes[0][2], (Vec2{2, 2}));
    EXPECT_EQ(scaled.bounds.max, (Vec2{20, 40}));
    EXPECT_NEAR(layout->sheets[0].used_mm.x * layout->sheets[0].used_mm.y, 800.0, 1e-3);
}

TEST(Layout, AnyRotationLooksAtTheSmallestBox) {
    const Ring ring = rectangle(80, 20);
    const auto smallest = [](const Ring& hull, const std::vector<Angle>& turns) {
        double least = HUGE_VAL;
        for (const Angle turn : turns) {
            const GridBox box = turned_box(hull, turn);
            least = std::min(least, from_grid(box.width()) * from_grid(box.height()));
        }
        return least;
    };
    for (const double degrees : {0.0, 13.7, 45.0, 77.0, 90.0, 160.0}) {
        Ring tilted;
        for (const Vec2 p : ring) tilted.push_back(rotated(p, degrees * 3.14159265358979323846 / 180));
        const std::vector<Angle> any = turns_of(tilted, {0}, {{200, 200}});
        EXPECT_NEAR(smallest(tilted, any), 1600.0, 0.01) << degrees;
        EXPECT_EQ(any.front(), Angle{}) << "as drawn comes first";
        std::vector<Angle> all;
        for (int i = 0; i < 24; ++i) all.push_back(Angle::degrees(15.0 * i));
        EXPECT_NEAR(smallest(tilted, turns_of(tilted, {24}, {{200, 200}})), smallest(tilted, all), 1e-6)
            << degrees;
    }
}

TEST(Layout, TurnsAreThoseAllowedAndEachOnce) {
    std::mt19937 random(3);
    for (int round = 0; round < test::sanitized_count(50); ++round) {
        const Ring ring = random_polygon(random, 5, 50);
        for (const int count : {1, 2, 3, 4, 7, 12, 13, 24, 360, 1000, 0}) {
            const std::vector<Angle> turns = turns_of(ring, {count}, {{300, 300}});
            ASSERT_FALSE(turns.empty());
            EXPECT_LE(turns.size(), 17U);
            for (std::size_t i = 0; i < turns.size(); ++i) {
                EXPECT_TRUE(turns[i].deg >= 0.0 && turns[i].deg < 360.0);
                for (std::size_t j = 0; j < i; ++j) EXPECT_NE(turns[i], turns[j]);
                if (count == 0) continue;
                const double steps = turns[i].deg * count / 360.0;
                EXPECT_NEAR(steps, std::round(steps), 1e-6) << count;
            }
            if (count > 0 && count <= 12) {
                EXPECT_EQ(turns.size(), static_cast<std::size_t>(count));
            }
        }
    }
}

TEST(Layout, TheLeftoverIsFreeAndCannotGrow) {
    // An L of paper on a sheet: what is left is the larger of the two rectangles beside it.
    LayoutOptions options;
    options.sheet = {"", 200.0, 100.0};
    options.margin = Length::millimetres(0);
    options.spacing = Length::millimetres(3);
    options.rotation = {1};
    Diagnostics diagnostics;
    const auto layout = lay_out(
        {design_of("d", {piece_of("l", {{0, 0}, {200, 0}, {200, 20}, {50, 20}, {50, 100}, {0, 100}})})},
        options, diagnostics);
    ASSERT_TRUE(layout.has_value());
    EXPECT_NEAR(layout->leftover.min.x, 53.0, 1e-6);
    EXPECT_NEAR(layout->leftover.min.y, 23.0, 1e-6);
    EXPECT_NEAR(layout->leftover.max.x, 200.0, 1e-6);
    EXPECT_NEAR(layout->leftover.max.y, 100.0, 1e-6);
    EXPECT_NEAR(layout->sheets[0].used_mm.x, 200.0, 1e-6);
}

TEST(Layout, StocksAreUsedLargestFirstAndSmallerWhereTheyTakeAll) {
    LayoutOptions options;
    options.stock = parse_stock("210x210:1,110x110").value();
    options.margin = options.spacing = Length::millimetres(0);
    std::vector<PatternPiece> pieces;
    for (int i = 0; i < 5; ++i) pieces.push_back(piece_of("p" + std::to_string(i), rectangle(100, 100)));
    Diagnostics diagnostics;
    const auto layout = lay_out({design_of("d", pieces)}, options, diagnostics);
    ASSERT_TRUE(layout.has_value());
    ASSERT_EQ(layout->sheets.size(), 2U);
    EXPECT_EQ(layout->sheets[0].width_mm + layout->sheets[1].width_mm, 320.0);
    expect_sound(*layout, options);
    for (const char* text : {"", "a4:0", "auto", "a4:", "a4,,a3", "a4:2x", "12x:3"})
        EXPECT_FALSE(parse_stock(text).has_value()) << text;
}

TEST(Layout, LocksKeepTheirPlaceAndNamesAreChecked) {
    LayoutOptions options;
    options.sheet = {"", 200.0, 100.0};
    options.rules.push_back({"b", 0, {}, PieceLock{0, {120, 40}, Angle::degrees(90)}});
    const std::vector<DesignPattern> designs{
        design_of("d", {piece_of("a", rectangle(50, 20)), piece_of("b", rectangle(30, 10))})};
    Diagnostics diagnostics;
    const auto layout = lay_out(designs, options, diagnostics);
    ASSERT_TRUE(layout.has_value());
    EXPECT_EQ(layout->placements[1].offset, (Vec2{120, 40}));
    EXPECT_EQ(layout->placements[1].angle, Angle::degrees(90));
    expect_sound(*layout, options);
    const auto code_of = [&](const PieceRule& rule) {
        LayoutOptions more = options;
        more.rules.push_back(rule);
        Diagnostics found;
        EXPECT_FALSE(lay_out(designs, more, found).has_value());
        return found.sorted().empty() ? std::string() : found.sorted()[0].code;
    };
    EXPECT_EQ(code_of({"c", 0, {}, PieceLock{}}), "unknown-piece");
    EXPECT_EQ(code_of({"a", 1, {}, PieceLock{}}), "unknown-piece");
    EXPECT_EQ(code_of({"b", 0, {}, PieceLock{0, {20, 20}, {}}}), "lock-impossible");
    EXPECT_EQ(code_of({"a", 0, {}, PieceLock{0, {2, 20}, {}}}), "lock-impossible");
    EXPECT_EQ(code_of({"a", 0, {}, PieceLock{0, {100, 41}, {}}}), "lock-impossible");
}

TEST(Layout, GrainKeepsDirectionsAndGroupsKeepSheets) {
    std::mt19937 random(12);
    std::vector<PatternPiece> pieces;
    for (int i = 0; i < 5; ++i)
        pieces.push_back(piece_of("p" + std::to_string(i), random_polygon(random, 20, 60)));
    LayoutOptions options;
    options.sheet = parse_sheet("a3").value();
    options.copies = 5;
    options.nesting.work = 3e4;
    for (const Grain grain : {Grain::keep, Grain::either}) {
        options.grain = grain;
        options.group_designs = grain == Grain::keep;
        Diagnostics diagnostics;
        const auto layout = lay_out({design_of("d", pieces)}, options, diagnostics);
        ASSERT_TRUE(layout.has_value());
        std::vector<double> turn(5, -1.0);
        std::vector<int> sheet(5, -1);
        for (const Placement& p : layout->placements) {
            double& seen = turn[static_cast<std::size_t>(p.piece)];
            if (seen < 0.0) seen = p.angle.deg;
            EXPECT_EQ(p.angle.deg, seen) << "identical pieces are turned alike";
            EXPECT_TRUE(p.angle.deg == 0.0 || (grain == Grain::either && p.angle.deg == 180.0));
            int& lies = sheet[static_cast<std::size_t>(p.copy)];
            if (lies < 0) lies = p.sheet;
            if (options.group_designs) {
                EXPECT_EQ(p.sheet, lies) << "a copy of a design stays together";
            }
        }
    }
}

TEST(Layout, ALongPieceMayLieAcrossTheSheet) {
    LayoutOptions options;
    options.sheet = {"", 110.0, 110.0};
    options.rotation = {0};
    Diagnostics diagnostics;
    const auto layout = lay_out({design_of("d", {piece_of("p", rectangle(125, 2))})}, options, diagnostics);
    ASSERT_TRUE(layout.has_value());
    expect_sound(*layout, options);
}

TEST(Layout, QuarterTurnsAreExact) {
    const Placement placement{0, 0, 0, 0, {10, 20}, Angle::degrees(90)};
    EXPECT_EQ(placement.apply({3, 4}), (Vec2{6, 23}));
    EXPECT_EQ(turned({3, 4}, Angle::degrees(180)), (Vec2{-3, -4}));
    EXPECT_EQ(turned({3, 4}, Angle::degrees(270)), (Vec2{4, -3}));
}

TEST(Layout, NamesCarryTheStemWhenThereAreSeveralInputs) {
    Diagnostics diagnostics;
    const auto one = lay_out({design_of("a", {piece_of("page", rectangle(5, 5))})}, {}, diagnostics);
    EXPECT_EQ(one->piece_name(one->placements[0]), "page");
    const auto two = lay_out({design_of("a", {piece_of("page", rectangle(5, 5))}),
                              design_of("b", {piece_of("page", rectangle(5, 5))})},
                             {}, diagnostics);
    EXPECT_EQ(two->piece_name(two->placements[1]), "b:page");
}

}  // namespace
}  // namespace popup
