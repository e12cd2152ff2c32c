// Where pictures, texts and areas of a document come to lie, and what becomes of them when their page does
// not stay as it was.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "base/geometry/regions.h"
#include "input/xml/read.h"
#include "popup/check.h"
#include "popup/image.h"
#include "popup/pattern.h"
#include "support/designs.h"
#include "support/pictures.h"

namespace popup::test {
namespace {

// A v-fold on the gutter; with `way` -1 its piece is drawn from the back.
std::string v_fold(const std::string& id, double at, double way = 1.0) {
    std::string text = "<structure type='v-fold' id='" + id + "'><outerpoints>";
    const auto point = [&text](double x, double y) {
        text += "<point x='" + std::to_string(x) + "' y='" + std::to_string(y) + "'/>";
    };
    point(-24.2487, at + 14.0);
    point(0.0, at);
    point(24.2487, at + 14.0);
    point(-27.1684 * way, 6.7738);
    point(0.0, 0.0);
    point(27.1684 * way, 6.7738);
    point(27.0 * way, 40.0);
    point(-27.0 * way, 40.0);
    return text +
           "</outerpoints><parentfold><begin x='0' y='-60'/><end x='0' y='60'/></parentfold></structure>\n";
}

std::string document(const std::string& structures, const std::string& prints) {
    return "<popup version='3.0' units='mm'><mainpage width='160' height='120'/><structurelist>\n" +
           structures + "</structurelist><drawnlinelist>\n" + prints + "\n</drawnlinelist></popup>\n";
}

struct Made {
    std::optional<Assembly> assembly;
    std::string fixed, text;
};

Made make(const std::string& structures, const std::string& prints, const CheckOptions& options = {}) {
    Made made;
    Diagnostics diagnostics;
    ReadOptions reading;
    reading.program.read_file = [](const std::string& name) -> std::optional<Source> {
        return Source{name, png_of(40, 20)};
    };
    const Source source{"card.xml", document(structures, prints)};
    const auto design = xml::read(source, reading, diagnostics);
    const auto checked = design ? check(*design, options, diagnostics) : std::nullopt;
    if (checked) {
        made.assembly = assemble(*checked, {}, diagnostics);
        made.fixed = xml::patch(source, checked->design());
    }
    made.text = findings(diagnostics);
    return made;
}

const Plate& plate_of(const Assembly& assembly, std::string_view name) {
    const auto at = std::find_if(assembly.plates.begin(), assembly.plates.end(),
                                 [name](const Plate& plate) { return plate.name == name; });
    EXPECT_NE(at, assembly.plates.end()) << name;
    return *at;
}

template <typename Kind>
std::vector<Kind> on_plate(const Assembly& assembly, std::string_view name) {
    std::vector<Kind> found;
    for (const Print& print : plate_of(assembly, name).prints) {
        if (const auto* one = std::get_if<Kind>(&print)) found.push_back(*one);
    }
    return found;
}

TEST(SpreadPrints, APictureIsOnThePlatesThatItMeetsAndOnNoOthers) {
    // Over the gutter, but to the right of the v-fold's left half.
    const Made made = make(v_fold("v", -20.0),
                           "<image x='-10' y='-50' width='40' href='a.png'/>"
                           "<image page='1' x='5' y='10' width='10' height='10' href='a.png'/>");
    ASSERT_TRUE(made.assembly) << made.text;
    EXPECT_EQ(made.text, "");
    EXPECT_EQ(on_plate<Image>(*made.assembly, "page/left").size(), 1U);
    EXPECT_EQ(on_plate<Image>(*made.assembly, "page/right").size(), 1U);
    EXPECT_EQ(on_plate<Image>(*made.assembly, "v/left").size(), 0U);
    const std::vector<Image> right = on_plate<Image>(*made.assembly, "v/right");
    ASSERT_EQ(right.size(), 1U);
    // Pixels are 0.25 mm wide and 0.5 mm high; the upper left corner is 10 mm above the lower one.
    EXPECT_EQ(right[0].place.origin, (Vec2{5.0, 20.0}));
    EXPECT_EQ(right[0].place.x, (Vec2{0.25, 0.0}));
    EXPECT_EQ(right[0].place.y, (Vec2{0.0, -0.5}));
    // Each plate prints its own part: together they are the whole picture, and nothing is printed twice.
    Diagnostics diagnostics;
    const auto pattern = make_pattern(*made.assembly, {}, diagnostics);
    ASSERT_TRUE(pattern);
    double printed = 0.0;
    for (const PatternPrint& print : pattern->pieces.front().prints) {
        if (const auto* image = std::get_if<Image>(&print.print)) printed += area(image->clip);
    }
    EXPECT_NEAR(printed, 40.0 * 20.0, 1e-3);
}

TEST(SpreadPrints, TheThreeWaysToFitAPicture) {
    // 40 × 20 pixels in 20 × 20 mm, turned by a quarter: up the page is along the rows.
    const auto fitted = [](const std::string& fit) {
        const Made made = make(
            "", "<image x='30' y='-10' width='20' height='20' rotate='90' fit='" + fit + "' href='a.png'/>");
        EXPECT_TRUE(made.assembly) << made.text;
        return on_plate<Image>(*made.assembly, "page/right").at(0);
    };
    const Image stretched = fitted("stretch");
    EXPECT_EQ(stretched.place, (Affine{{0.0, 0.5}, {1.0, 0.0}, {10.0, -10.0}}));
    EXPECT_TRUE(stretched.clip.empty());
    const Image whole = fitted("contain");
    EXPECT_EQ(whole.place, (Affine{{0.0, 0.5}, {0.5, 0.0}, {15.0, -10.0}}));
    const Image covering = fitted("cover");
    EXPECT_EQ(covering.place, (Affine{{0.0, 1.0}, {1.0, 0.0}, {10.0, -20.0}}));
    ASSERT_EQ(covering.clip.size(), 1U);
    EXPECT_NEAR(area(covering.clip), 400.0, 1e-9);
    const Box box = bounds(covering.clip[0].outer);
    EXPECT_EQ(box.min, (Vec2{10.0, -10.0}));
    EXPECT_EQ(box.max, (Vec2{30.0, 10.0}));
}

TEST(SpreadPrints, AnAreaIsCutAtFoldsAndEdges) {
    const Made made =
        make("", "<area fill='#112233' d='M -100 0 H 20 V 10 H -100 Z M -90 2 H -10 V 8 H -90 Z'/>");
    ASSERT_TRUE(made.assembly) << made.text;
    double left = 0.0;
    for (const Area& one : on_plate<Area>(*made.assembly, "page/left")) {
        left += area(one.shape);
        EXPECT_EQ(one.color, (Color{0x11, 0x22, 0x33}));
    }
    EXPECT_NEAR(left, 80.0 * 10.0 - 70.0 * 6.0, 1e-3);  // even-odd: a frame
    double right = 0.0;
    for (const Area& one : on_plate<Area>(*made.assembly, "page/right")) right += area(one.shape);
    EXPECT_NEAR(right, 20.0 * 10.0, 1e-3);
}

TEST(SpreadPrints, ATextIsOnItsPieceOnceAndIsNoLabel) {
    const Made made = make(v_fold("v", -20.0),
                           "<text page='1' x='0' y='20' height='3' rotate='30' font='mono' "
                           "fill='#00ff00'>Ahoy</text>");
    ASSERT_TRUE(made.assembly) << made.text;
    ASSERT_EQ(made.assembly->pieces.size(), 2U);
    ASSERT_EQ(made.assembly->pieces[1].prints.size(), 1U);
    const auto& text = std::get<Text>(made.assembly->pieces[1].prints[0]);
    EXPECT_EQ(text.text, "Ahoy");
    EXPECT_EQ(text.at, (Vec2{0.0, 20.0}));
    EXPECT_EQ(text.height_mm, 3.0);
    EXPECT_NEAR(text.angle, 0.5235987755982988, 1e-12);
    EXPECT_EQ(text.color, (Color{0, 255, 0}));
    EXPECT_EQ(text.font, TextFont::mono);
    // The piece still has its name on it.
    Diagnostics diagnostics;
    const auto pattern = make_pattern(*made.assembly, {}, diagnostics);
    const auto& labels = pattern->pieces[1].labels;
    EXPECT_TRUE(
        std::any_of(labels.begin(), labels.end(), [](const Label& label) { return label.text == "1. v"; }));
}

// A piece that was drawn from its back is mended, and so is what is printed on it: it lies where the author
// had it, seen in a mirror, but pictures and letters are not turned over.
// --- letters that are not printed

TEST(SpreadPrints, TellOfLettersThatTheFontLacks) {
    const Made none = make("", "<text x='0' y='20' height='8'>中文 a 中</text>");
    EXPECT_NE(none.text.find("the font sans has no 中 文; they are printed as empty boxes"),
              std::string::npos)
        << none.text;
    EXPECT_NE(none.text.find("letters-missing"), std::string::npos);
    const Made other = make("", "<text x='0' y='20' height='8' font='mono-bold'>שלום</text>");
    EXPECT_NE(other.text.find("the font mono-bold has no ש ל ו ם"), std::string::npos) << other.text;
    for (const std::string text : {"Grüße, Ελλάδα, Москва", "שלום", "e&#x301;", "a&#x200b;b"}) {
        EXPECT_EQ(make("", "<text x='0' y='20' height='4'>" + text + "</text>").text, "") << text;
    }
}

TEST(SpreadPrints, TellHowMuchOfATextLiesBesideThePaper) {
    const std::string words = "This line is far too long for the card";
    const Made wide = make("", "<text x='0' y='0' height='20'>" + words + "</text>");
    EXPECT_NE(wide.text.find("321.9 mm of it lies beside the paper of page 0, which is 160.0 mm long there"),
              std::string::npos)
        << wide.text;
    EXPECT_NE(wide.text.find("text-cut"), std::string::npos);
    // Across the card it has 120 mm of paper.
    const Made up = make("", "<text x='0' y='0' height='20' rotate='90'>" + words + "</text>");
    EXPECT_NE(up.text.find("which is 120.0 mm long there"), std::string::npos) << up.text;
    // One that is in its place is not told of, though few letters could be as wide as its guess; nor is a
    // long one of narrow letters.
    EXPECT_EQ(make("", "<text x='0' y='0' height='3'>" + words + "</text>").text, "");
    EXPECT_EQ(make("", "<text x='0' y='0' height='5'>" + std::string(60, 'i') + "</text>").text, "");
}

TEST(SpreadPrints, FollowAPageThatIsMirroredForGood) {
    const std::string prints =
        "<image page='1' x='5' y='10' width='10' height='6' rotate='30' href='a.png'/>\n"
        "<text page='1' x='-8' y='20' rotate='10'>a</text>\n<area page='1' d='M 2 2 H 8 V 5 Z'/>";
    const Made made = make(v_fold("v", -20.0, -1.0), prints);
    ASSERT_TRUE(made.assembly) << made.text;
    // The corner that is the left one now: the right one's mirror image.
    const Vec2 corner{-5.0 - 10.0 * 0.8660254037844386, 10.0 + 10.0 * 0.5};
    const std::vector<Image> images = on_plate<Image>(*made.assembly, "v/left");
    ASSERT_EQ(images.size(), 1U) << made.text;
    const Image& image = images[0];
    EXPECT_LT(distance(image.place.point({0.0, 20.0}), corner), 1e-9);
    EXPECT_LT(distance(image.place.point({40.0, 20.0}), Vec2{-5.0, 10.0}), 1e-9);
    EXPECT_GT(cross(image.place.x, -image.place.y), 0.0) << "it is not turned over";
    const auto& text = std::get<Text>(made.assembly->pieces[1].prints.at(0));
    EXPECT_EQ(text.at, (Vec2{8.0, 20.0}));
    EXPECT_NEAR(text.angle, -0.17453292519943295, 1e-12);
    const std::vector<Area> areas = on_plate<Area>(*made.assembly, "v/left");
    ASSERT_EQ(areas.size(), 1U);
    EXPECT_EQ(bounds(areas[0].shape.outer).min, (Vec2{-8.0, 2.0}));
    // What is written over the document says the same, and needs no more repair.
    EXPECT_NE(made.fixed.find("rotate='-30'"), std::string::npos) << made.fixed;
    EXPECT_NE(made.fixed.find("x='8'"), std::string::npos) << made.fixed;
    EXPECT_NE(made.fixed.find("M -2 2"), std::string::npos) << made.fixed;
    const std::size_t from = made.fixed.find("<image");
    const Made again = make(v_fold("v", -20.0), made.fixed.substr(from, made.fixed.find("</drawnl") - from));
    ASSERT_TRUE(again.assembly) << again.text;
    EXPECT_LT(distance(on_plate<Image>(*again.assembly, "v/left").at(0).place.origin, image.place.origin),
              1e-5);
}

TEST(SpreadPrints, GoWithADroppedPageAndFollowOneThatMovesUp) {
    CheckOptions drop;
    drop.drop = true;
    // The first v-fold is degenerate: its V has no angle.
    std::string flat = v_fold("flat", 20.0);
    for (std::size_t at; (at = flat.find("24.2487")) != std::string::npos;) flat.replace(at, 7, "00.0001");
    const Made made = make(flat + v_fold("v", -20.0),
                           "<text page='1' x='0' y='5'>gone</text>\n<text page='2' x='0' y='5'>stays</text>\n"
                           "<image page='1' x='0' y='0' width='5' href='a.png'/>\n"
                           "<area page='2' d='M 2 2 H 8 V 5 Z'/>",
                           drop);
    ASSERT_TRUE(made.assembly) << made.text;
    EXPECT_EQ(made.fixed.find("gone"), std::string::npos) << made.fixed;
    EXPECT_EQ(made.fixed.find("<image"), std::string::npos) << made.fixed;
    EXPECT_NE(made.fixed.find("<text page='1' x='0' y='5'>stays"), std::string::npos) << made.fixed;
    EXPECT_NE(made.fixed.find("<area page='1'"), std::string::npos) << made.fixed;
    const auto part = [&made](std::string_view from, std::string_view to) {
        const std::size_t at = made.fixed.find(from) + from.size();
        return made.fixed.substr(at, made.fixed.find(to) - at);
    };
    const Made again =
        make(part("<structurelist>", "</structurelist>"), part("<drawnlinelist>", "</drawnlinelist>"));
    ASSERT_TRUE(again.assembly) << again.text << made.fixed;
    ASSERT_EQ(again.assembly->pieces.size(), 2U);
    EXPECT_EQ(std::get<Text>(again.assembly->pieces[1].prints.at(0)).text, "stays");
    EXPECT_EQ(on_plate<Area>(*again.assembly, "v/right").size(), 1U);
}

}  // namespace
}  // namespace popup::test
