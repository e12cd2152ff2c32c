#include "output/svg.h"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/text/numbers.h"
#include "output/sheet_drawing.h"
#include "support/prints.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using test::example_layout;
using Element = tinyxml2::XMLElement;

const std::vector<std::string> kLayerNames{"fill",   "draw",     "glue", "label",
                                           "valley", "mountain", "seam", "cut"};

// --- an SVG reader of the test's own

struct Path {
    std::vector<std::vector<Vec2>> runs;
    std::vector<bool> closed;

    [[nodiscard]] double length() const {
        double sum = 0.0;
        for (std::size_t r = 0; r < runs.size(); ++r) {
            const auto& run = runs[r];
            for (std::size_t i = 1; i < run.size(); ++i) {
                sum += std::hypot(run[i].x - run[i - 1].x, run[i].y - run[i - 1].y);
            }
            if (closed[r]) {
                sum += std::hypot(run.front().x - run.back().x, run.front().y - run.back().y);
            }
        }
        return sum;
    }
};

// Only "Mx,y", "Lx,y" and "Z": anything else fails the test.
Path parse_path(const std::string& d) {
    Path path;
    const char* at = d.c_str();
    while (*at != '\0') {
        const char command = *at++;
        if (command == 'Z' && !path.runs.empty()) {
            path.closed.back() = true;
            continue;
        }
        char* end = nullptr;
        const double x = std::strtod(at, &end);
        const bool comma = end != at && *end == ',';
        at = end + (comma ? 1 : 0);
        const double y = std::strtod(at, &end);
        if ((command != 'M' && command != 'L') || !comma || end == at ||
            (command == 'L' && path.runs.empty())) {
            ADD_FAILURE() << "no path of the kind that is promised: " << d;
            return path;
        }
        at = end;
        if (command == 'M') {
            path.runs.emplace_back();
            path.closed.push_back(false);
        }
        path.runs.back().push_back({x, y});
    }
    return path;
}

// Whether each number of the text has four decimals at most, no superfluous zeros, no exponent, and is not
// -0.
bool numbers_are_short(const std::string& text) {
    std::size_t at = 0;
    while ((at = text.find_first_of("-0123456789", at)) != std::string::npos) {
        const std::size_t end = std::min(text.find_first_not_of("-.0123456789", at), text.size());
        const std::string number = text.substr(at, end - at);
        const std::size_t point = number.find('.');
        if (number == "-0" || (end < text.size() && text[end] == 'e')) return false;
        if (point != std::string::npos && (number.size() - point > 5 || number.back() == '0')) return false;
        at = end;
    }
    return true;
}

std::string attribute(const Element& element, const char* name) {
    const char* value = element.Attribute(name);
    return value == nullptr ? "" : value;
}

std::vector<const Element*> children(const Element& parent, const char* name = nullptr) {
    std::vector<const Element*> all;
    for (const Element* e = parent.FirstChildElement(name); e != nullptr; e = e->NextSiblingElement(name)) {
        all.push_back(e);
    }
    return all;
}

struct Svg {
    tinyxml2::XMLDocument document;
    const Element* root = nullptr;
    const Element* sheet = nullptr;
    std::map<std::string, const Element*> layers;

    explicit Svg(const std::string& text) {
        EXPECT_EQ(document.Parse(text.c_str(), text.size()), tinyxml2::XML_SUCCESS) << text;
        root = document.RootElement();
        sheet = root->FirstChildElement("g");
        for (const Element* layer : children(*sheet)) {
            layers[attribute(*layer, "inkscape:label")] = layer;
        }
    }
    // Paths of a layer, pieces one after the other.
    [[nodiscard]] std::vector<const Element*> paths(const std::string& layer) const {
        std::vector<const Element*> all;
        for (const Element* piece : children(*layers.at(layer))) {
            for (const Element* path : children(*piece, "path")) all.push_back(path);
        }
        return all;
    }
    [[nodiscard]] std::vector<const Element*> texts() const {
        std::vector<const Element*> all;
        for (const Element* piece : children(*layers.at("label"))) {
            for (const Element* text : children(*piece, "text")) all.push_back(text);
        }
        return all;
    }
    [[nodiscard]] double length(const std::string& layer) const {
        double sum = 0.0;
        for (const Element* path : paths(layer)) sum += parse_path(attribute(*path, "d")).length();
        return sum;
    }
};

std::vector<std::string> written(const Layout& layout) {
    Diagnostics diagnostics;
    const auto sheets = write_svg(layout, OutputOptions{}, diagnostics);
    EXPECT_TRUE(sheets.has_value());
    EXPECT_FALSE(diagnostics.has_findings());
    return test::bytes_of(sheets);
}

double ring_length(const Ring& ring, bool closed = true) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) sum += distance(ring[i], ring[i + 1]);
    return closed ? sum + distance(ring.back(), ring.front()) : sum;
}

// --- the whole document

TEST(Svg, HasTheSizeOfTheSheetInMillimetresAndOneUserUnitIsOne) {
    const auto sheets = written(example_layout());
    ASSERT_EQ(sheets.size(), 2U);
    for (const std::string& text : sheets) {
        const Svg svg(text);
        EXPECT_STREQ(svg.root->Name(), "svg");
        EXPECT_EQ(attribute(*svg.root, "width"), "297mm");
        EXPECT_EQ(attribute(*svg.root, "height"), "210mm");
        EXPECT_EQ(attribute(*svg.root, "viewBox"), "0 0 297 210");
        EXPECT_EQ(attribute(*svg.sheet, "class"), "sheet");
    }
}

TEST(Svg, HoldsAllLayersInDrawingOrderEvenEmptyOnes) {
    for (const std::string& text : written(example_layout())) {
        const Svg svg(text);
        std::vector<std::string> labels;
        for (const Element* layer : children(*svg.sheet)) {
            EXPECT_EQ(attribute(*layer, "inkscape:groupmode"), "layer");
            EXPECT_EQ(attribute(*layer, "id"), attribute(*layer, "inkscape:label"));
            labels.push_back(attribute(*layer, "inkscape:label"));
        }
        EXPECT_EQ(labels, kLayerNames);
    }
}

TEST(Svg, ShowsEveryLineOfTheLayoutOnceAndInItsLength) {
    const Layout layout = example_layout();
    const auto sheets = written(layout);
    for (int sheet = 0; sheet < static_cast<int>(layout.sheets.size()); ++sheet) {
        const Svg svg(sheets[static_cast<std::size_t>(sheet)]);
        std::map<std::string, double> length;
        std::map<std::string, std::size_t> count;
        std::size_t texts = 0;
        for (const Placement& placement : layout.placements) {
            if (placement.sheet != sheet) continue;
            const PatternPiece& piece =
                layout.designs[0].pattern.pieces[static_cast<std::size_t>(placement.piece)];
            const auto add = [&](const std::string& layer, double mm) {
                length[layer] += mm;
                ++count[layer];
            };
            for (const Contour& cut : piece.cuts) add("cut", ring_length(cut.points, cut.closed));
            for (const PatternLine& line : piece.lines) {
                const std::string layer =
                    line.kind == LineKind::mark ? "draw" : std::string(to_string(line.kind));
                add(layer, distance(line.at.a, line.at.b));
            }
            for (const auto& one : test::prints_of<Stroke>(piece.prints)) {
                add("draw", ring_length(one.print.points, false));
            }
            for (const GlueTarget& target : piece.targets) add("glue", ring_length(target.outline));
            for (const auto& fill : test::prints_of<Area>(piece.prints)) {
                double around = ring_length(fill.print.shape.outer);
                for (const Ring& hole : fill.print.shape.holes) around += ring_length(hole);
                add("fill", around);
            }
            texts += piece.labels.size();
        }
        for (const std::string& layer : kLayerNames) {
            if (layer == "label") continue;
            EXPECT_EQ(svg.paths(layer).size(), count[layer]) << layer;
            EXPECT_NEAR(svg.length(layer), length[layer], 0.01) << layer;
        }
        EXPECT_EQ(svg.texts().size(), texts);
    }
}

TEST(Svg, PutsPiecesWhereTheLayoutHasThemWithYDown) {
    const Svg svg(written(example_layout())[1]);
    const auto cuts = svg.paths("cut");
    ASSERT_EQ(cuts.size(), 2U);
    const Path first = parse_path(attribute(*cuts[0], "d"));
    EXPECT_EQ(first.runs[0][0], (Vec2{60.25, 169.875}));
    EXPECT_EQ(first.runs[0][3], (Vec2{100.25, 169.875}));
    EXPECT_EQ(first.runs[0][5], (Vec2{60.25, 94.875}));
    // The second is turned by 90° counter-clockwise: (x, y) comes to (200 - y, 100 + x), seen from below.
    const Path second = parse_path(attribute(*cuts[1], "d"));
    EXPECT_EQ(second.runs[0][0], (Vec2{200, 110}));
    EXPECT_EQ(second.runs[0][3], (Vec2{200, 70}));
    EXPECT_EQ(second.runs[0][5], (Vec2{125, 110}));
    EXPECT_TRUE(first.closed[0]);
}

TEST(Svg, TransformsNothingButText) {
    for (const std::string& text : written(example_layout())) {
        const Svg svg(text);
        std::vector<const Element*> open{svg.root};
        while (!open.empty()) {
            const Element* element = open.back();
            open.pop_back();
            if (std::string(element->Name()) != "text") {
                EXPECT_EQ(element->Attribute("transform"), nullptr) << element->Name();
            }
            for (const Element* child : children(*element)) open.push_back(child);
        }
    }
}

TEST(SvgTest, NumbersAreToldApart) {
    EXPECT_TRUE(numbers_are_short("M1,2.5L-3.1234,0.05Z"));
    for (const char* bad : {"M1.50,2", "M-0,1", "M1.12345,2", "M1e-9,2"}) {
        EXPECT_FALSE(numbers_are_short(bad)) << bad;
    }
}

TEST(Svg, WritesFourDecimalsAtMostAndNoMinusZero) {
    Layout layout = example_layout();
    layout.placements[1].offset = {60 + 1.0 / 3.0, 40 + 1e-9};
    layout.placements[2].angle = Angle::degrees(33.3);
    for (const std::string& text : written(layout)) {
        const Svg svg(text);
        for (const std::string& layer : kLayerNames) {
            for (const Element* path : svg.paths(layer)) {
                EXPECT_TRUE(numbers_are_short(attribute(*path, "d"))) << attribute(*path, "d");
            }
        }
    }
}

TEST(Svg, DrawsInTheWorkshopNotation) {
    const Svg svg(written(example_layout())[0]);
    const auto stroke = [&svg](const std::string& layer) {
        return attribute(*svg.layers.at(layer), "stroke");
    };
    EXPECT_EQ(stroke("cut"), "#ff0000");
    EXPECT_EQ(stroke("valley"), "#ff00ff");
    EXPECT_EQ(stroke("mountain"), "#0000ff");
    EXPECT_EQ(stroke("seam"), "#000000");
    for (const std::string layer : {"valley", "mountain", "seam", "cut", "glue"}) {
        EXPECT_EQ(attribute(*svg.layers.at(layer), "fill"), "none") << layer;
    }
    for (const Element* cut : svg.paths("cut")) EXPECT_EQ(cut->Attribute("stroke-dasharray"), nullptr);
}

TEST(Svg, AFoldIsOneWholeLineThatBeginsAndEndsWithADash) {
    for (const std::string& text : written(example_layout())) {
        const Svg svg(text);
        for (const std::string layer : {"valley", "mountain", "seam"}) {
            for (const Element* fold : svg.paths(layer)) {
                const Path path = parse_path(attribute(*fold, "d"));
                ASSERT_EQ(path.runs.size(), 1U);
                EXPECT_EQ(path.runs[0].size(), 2U);
                std::istringstream dashes(attribute(*fold, "stroke-dasharray"));
                std::vector<double> mm;
                for (double one = 0; dashes >> one;) mm.push_back(one);
                ASSERT_GE(mm.size(), 2U) << layer;
                ASSERT_EQ(mm.size() % 2, 0U);
                // Walk along the dashes: the end of the line must be the end of a first dash.
                double at = 0.0;
                std::size_t steps = 0;
                const double length = path.length();
                while (at < length - 0.1 * mm[0]) at += mm[steps++ % mm.size()];
                EXPECT_EQ(steps % mm.size(), 1U) << layer;
                EXPECT_GT(steps, mm.size());  // a gap at least
                EXPECT_NEAR(at, length, 0.001 * static_cast<double>(steps)) << layer;
            }
        }
    }
}

TEST(Svg, CutsKeepTheOrderOfThePattern) {
    const Svg svg(written(example_layout())[0]);
    const auto cuts = svg.paths("cut");
    ASSERT_EQ(cuts.size(), 3U);
    EXPECT_FALSE(parse_path(attribute(*cuts[0], "d")).closed[0]);
    EXPECT_FALSE(parse_path(attribute(*cuts[1], "d")).closed[0]);
    EXPECT_TRUE(parse_path(attribute(*cuts[2], "d")).closed[0]);
}

TEST(Svg, NamesPiecesDesignsPlatesAndCopies) {
    Layout layout = example_layout();
    const auto check = [](const Layout& of, const std::string& prefix) {
        const Svg svg(written(of)[1]);
        const auto pieces = children(*svg.layers.at("mountain"));
        ASSERT_EQ(pieces.size(), 2U);
        for (const Element* piece : pieces) {
            EXPECT_EQ(attribute(*piece, "data-piece"), prefix + "house");
            EXPECT_EQ(attribute(*piece, "data-design"), "castle");
            EXPECT_EQ(attribute(*piece->FirstChildElement("path"), "data-plate"), prefix + "house/left");
        }
        EXPECT_EQ(pieces[0]->Attribute("data-copy"), nullptr);
        EXPECT_EQ(attribute(*pieces[1], "data-copy"), "2");
        // A tab's fill belongs to no plate.
        EXPECT_EQ(svg.paths("fill")[1]->Attribute("data-plate"), nullptr);
    };
    check(layout, "");
    layout.prefix_names = true;
    check(layout, "castle:");
}

TEST(Svg, StaysWellFormedWhateverTheNames) {
    const std::string hostile = "<a b=\"'&]]>\x01\x1b\xff\xef\xbf\xbf\n\xe2\x80\xae\xc3\xa9";
    Layout layout = example_layout(hostile);
    layout.prefix_names = true;
    layout.designs[0].pattern.pieces[1].name += hostile;
    layout.designs[0].pattern.pieces[1].labels[0].text = hostile;
    for (const std::string& text : written(layout)) {
        const Svg svg(text);
        EXPECT_EQ(text.find("\xff"), std::string::npos);
        EXPECT_EQ(text.find("\xef\xbf\xbf"), std::string::npos);
        for (const char c : text) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20);
        for (const Element* piece : children(*svg.layers.at("cut"))) {
            EXPECT_TRUE(attribute(*piece, "data-design").starts_with("<a b=\"'&]]>"));
            EXPECT_TRUE(attribute(*piece, "data-design").ends_with("\xc3\xa9"));
        }
    }
}

TEST(Svg, TextIsCentredUprightAndAsHighAsItsCapitals) {
    const Svg first(written(example_layout())[0]);
    const auto on_page = first.texts();
    ASSERT_EQ(on_page.size(), 2U);
    EXPECT_EQ(attribute(*first.layers.at("label"), "text-anchor"), "middle");
    EXPECT_EQ(attribute(*first.layers.at("label"), "font-family"), "DejaVu Sans");
    EXPECT_STREQ(on_page[0]->GetText(), "page");
    EXPECT_NEAR(on_page[0]->DoubleAttribute("x"), 68.5, 1e-9);
    EXPECT_NEAR(on_page[0]->DoubleAttribute("y"), 210 - 175 + 2.0, 1e-9);
    // DejaVu Sans has capitals of 1493 of its 2048 units.
    EXPECT_NEAR(on_page[0]->DoubleAttribute("font-size") * 1493 / 2048, 4.0, 1e-3);
    // Written downwards in the pattern, it is turned over so as to be read from the right.
    EXPECT_EQ(attribute(*on_page[1], "transform"), "rotate(-90 193.5 145)");

    const Svg second(written(example_layout())[1]);
    const auto on_houses = second.texts();
    ASSERT_EQ(on_houses.size(), 4U);
    EXPECT_EQ(on_houses[0]->Attribute("transform"), nullptr);
    EXPECT_EQ(attribute(*on_houses[2], "transform"), "rotate(-90 170 130)");
}

TEST(Svg, IsTheSameEveryTime) { EXPECT_EQ(written(example_layout()), written(example_layout())); }

TEST(Svg, ALayoutOfManyPiecesIsWrittenOnceEach) {
    Layout layout = example_layout();
    layout.placements.clear();
    layout.sheets.resize(3, layout.sheets.front());
    for (int i = 0; i < 300; ++i) {
        layout.placements.push_back({0, 1, i, i / 100, {1.0 * i, 0}, Angle::degrees(0)});
    }
    const auto sheets = written(layout);
    ASSERT_EQ(sheets.size(), 3U);
    for (const std::string& text : sheets) EXPECT_EQ(Svg(text).paths("cut").size(), 100U);
}

// --- numbers

TEST(Numbers, AreShortAndRoundedAndNeverMinusZero) {
    EXPECT_EQ(number_text(0.0, 4), "0");
    EXPECT_EQ(number_text(-0.0, 4), "0");
    EXPECT_EQ(number_text(-0.00004, 4), "0");
    EXPECT_EQ(number_text(-0.00006, 4), "-0.0001");
    EXPECT_EQ(number_text(1.0, 4), "1");
    EXPECT_EQ(number_text(-1.5, 4), "-1.5");
    EXPECT_EQ(number_text(0.05, 4), "0.05");
    EXPECT_EQ(number_text(12.34567, 4), "12.3457");
    EXPECT_EQ(number_text(9.99996, 4), "10");
    EXPECT_EQ(number_text(100, 0), "100");
    EXPECT_EQ(number_text(2.5, 0), "3");
    EXPECT_EQ(number_text(1e-9, 9), "0.000000001");
    EXPECT_EQ(number_text(1e12, 4), "1000000000000");
    EXPECT_EQ(number_text(-12345678901.25, 4), "-12345678901.25");
    EXPECT_EQ(number_text(1e300, 4).find_first_not_of("0123456789"), std::string::npos);
}

TEST(Numbers, ReadBackAreWithinHalfAStep) {
    double value = 1e-5;
    for (int i = 0; i < 2000; ++i) {
        value = -value * 1.0173;
        const std::string text = number_text(value, 4);
        EXPECT_NEAR(std::strtod(text.c_str(), nullptr), value, 0.5e-4 + 1e-12 * std::abs(value)) << text;
        EXPECT_EQ(text.find_first_not_of("-.0123456789"), std::string::npos) << text;
    }
}

TEST(Numbers, ForJsonAreRoundedToo) {
    EXPECT_EQ(rounded(1.23456789, 6), 1.234568);
    EXPECT_FALSE(std::signbit(rounded(-1e-12, 6)));
    EXPECT_TRUE(std::isnan(rounded(std::numeric_limits<double>::quiet_NaN(), 6)));
}

TEST(NumbersDeathTest, ADrawingWithoutAPlaceIsABrokenInvariant) {
    EXPECT_DEATH(number_text(std::numeric_limits<double>::quiet_NaN(), 4), "isfinite");
}

}  // namespace
}  // namespace popup
