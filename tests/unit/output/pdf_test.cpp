#include "output/pdf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/run_program.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using test::example_layout;

constexpr double kPoint = 25.4 / 72.0;  // mm

std::string written(const Layout& layout) {
    Diagnostics diagnostics;
    const auto documents = write_pdf(layout, OutputOptions{}, diagnostics);
    EXPECT_FALSE(diagnostics.has_findings());
    EXPECT_TRUE(documents.has_value());
    EXPECT_EQ(documents->size(), 1U);
    return documents->front().bytes;
}

std::vector<std::array<double, 4>> media_boxes(const std::string& pdf) {
    std::vector<std::array<double, 4>> boxes;
    const std::string key = "/MediaBox [";
    for (std::size_t at = 0; (at = pdf.find(key, at)) != std::string::npos;) {
        at += key.size();
        std::istringstream numbers(pdf.substr(at, 100));
        std::array<double, 4> box{};
        for (double& one : box) numbers >> one;
        boxes.push_back(box);
    }
    return boxes;
}

TEST(Pdf, HasAPageASheetInItsTrueSize) {
    Layout layout = example_layout();
    for (LayoutSheet& sheet : layout.sheets) {
        sheet.width_mm = 210;
        sheet.height_mm = 297;
    }
    const auto boxes = media_boxes(written(layout));
    ASSERT_EQ(boxes.size(), 2U);
    for (const auto& box : boxes) {
        EXPECT_EQ(box[0], 0.0);
        EXPECT_EQ(box[1], 0.0);
        EXPECT_NEAR(box[2], 595.2756, 1e-4);
        EXPECT_NEAR(box[3], 841.8898, 1e-4);
    }
}

TEST(Pdf, EmbedsTheFontOfItsLabels) {
    const std::string pdf = written(example_layout());
    EXPECT_NE(pdf.find("+DejaVuSans"), std::string::npos);
    EXPECT_NE(pdf.find("/FontFile2"), std::string::npos);
}

TEST(Pdf, SaysWhoMadeItAndBearsNoDate) {
    const std::string pdf = written(example_layout());
    EXPECT_NE(pdf.find("/Creator (popupc 0"), std::string::npos);
    EXPECT_NE(pdf.find("/Title (castle)"), std::string::npos);
    EXPECT_EQ(pdf.find("/CreationDate"), std::string::npos);
    EXPECT_EQ(pdf.find("/ModDate"), std::string::npos);
}

TEST(Pdf, BearsTheDateOfSourceDateEpochWhereThatIsSet) {
    ASSERT_EQ(setenv("SOURCE_DATE_EPOCH", "951827696", 1), 0);
    const std::string dated = written(example_layout());
    ASSERT_EQ(setenv("SOURCE_DATE_EPOCH", "yesterday", 1), 0);
    const std::string undated = written(example_layout());
    ASSERT_EQ(unsetenv("SOURCE_DATE_EPOCH"), 0);
    EXPECT_NE(dated.find("/CreationDate (20000229123456Z"), std::string::npos)
        << dated.substr(dated.find("/Creat"), 80);
    EXPECT_EQ(undated.find("/CreationDate"), std::string::npos);
}

TEST(Pdf, IsTheSameByteForByteWhateverWasWrittenBefore) {
    const std::string first = written(example_layout());
    Layout other = example_layout("bird");
    for (Label& label : other.designs[0].pattern.pieces[1].labels) {
        label.text = "Zyx";
        label.height_mm = 7.0;
    }
    EXPECT_NE(written(other), first);
    EXPECT_EQ(written(example_layout()), first);
}

TEST(Pdf, AMissingFontIsAnErrorThatNamesTheFile) {
    for (const std::string file : {"/nowhere/font.ttf", "/dev/null"}) {
        Diagnostics diagnostics;
        EXPECT_FALSE(write_pdf_with_font(example_layout(), {}, file, diagnostics).has_value());
        const auto all = diagnostics.sorted();
        ASSERT_EQ(all.size(), 1U);
        EXPECT_EQ(all[0].code, "font-missing");
        EXPECT_EQ(all[0].severity, Severity::error);
        EXPECT_NE(all[0].message.find(file), std::string::npos);
        EXPECT_FALSE(all[0].hints.empty());
    }
}

TEST(Pdf, ASheetLargerThanAPageCanBeIsAnError) {
    Layout layout = example_layout();
    layout.sheets[1].height_mm = 5081;
    Diagnostics diagnostics;
    EXPECT_FALSE(write_pdf(layout, OutputOptions{}, diagnostics).has_value());
    ASSERT_EQ(diagnostics.sorted().size(), 1U);
    EXPECT_EQ(diagnostics.sorted()[0].code, "pdf-page-size");
    layout.sheets[1].height_mm = 5080;
    Diagnostics good;
    EXPECT_TRUE(write_pdf(layout, OutputOptions{}, good).has_value());
}

TEST(Pdf, ALabelThatIsNoTextIsWrittenAllTheSame) {
    Layout layout = example_layout("\xff\x01<");
    layout.designs[0].pattern.pieces[0].labels[0].text = "\xff\x01\xc3";
    layout.designs[0].pattern.pieces[0].labels[1].text = "";
    EXPECT_EQ(media_boxes(written(layout)).size(), 2U);
}

// --- what is drawn, read back with qpdf

// Strokes of all pages by colour, and the number of fills by even-odd.
struct Drawn {
    struct Lines {
        std::size_t strokes = 0;
        std::size_t dashed = 0;
        double mm = 0.0;
    };
    std::map<std::string, Lines> lines;  // by "r g b"
    std::size_t fills = 0;
    std::set<std::string> texts;
    Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};  // of strokes, mm
};

// Follows the few operators that Cairo writes for lines and areas.
class ContentReader {
 public:
    Drawn read(const std::string& qdf) {
        std::istringstream words(qdf);
        std::string word;
        while (words >> word) {
            if (word.starts_with("(") && word.ends_with(")Tj")) {
                drawn_.texts.insert(word.substr(1, word.size() - 4));
            } else if (is_number(word)) {
                operands_.push_back(std::stod(word));
            } else if (word == "[" || word == "[]") {
                operands_.clear();
            } else {
                // "4.3]": the last length of a dash pattern.
                if (word.ends_with("]") && is_number(word.substr(0, word.size() - 1))) {
                    operands_.push_back(0.0);
                    continue;
                }
                step(word);
                operands_.clear();
            }
        }
        return drawn_;
    }

 private:
    static bool is_number(const std::string& word) {
        return !word.empty() && word.find_first_not_of("-.0123456789") == std::string::npos;
    }
    [[nodiscard]] Vec2 point(std::size_t i) const {
        return {operands_.at(i) * kPoint, operands_.at(i + 1) * kPoint};
    }
    void to(Vec2 p) {
        mm_ += distance(at_, p);
        at_ = p;
        extend(p);
    }
    void extend(Vec2 p) {
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
        high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
    }
    void done() {
        mm_ = 0.0;
        low_ = {HUGE_VAL, HUGE_VAL};
        high_ = {-HUGE_VAL, -HUGE_VAL};
    }
    void step(const std::string& op) {
        if (op == "RG") {
            std::ostringstream name;
            name << operands_.at(0) << " " << operands_.at(1) << " " << operands_.at(2);
            color_ = name.str();
        } else if (op == "d") {
            dashed_ = operands_.size() > 1;
        } else if (op == "m") {
            at_ = start_ = point(0);
            extend(at_);
        } else if (op == "l") {
            to(point(0));
        } else if (op == "h") {
            to(start_);
        } else if (op == "re") {
            mm_ += 2 * (std::abs(operands_.at(2)) + std::abs(operands_.at(3))) * kPoint;
            extend(point(0));
            extend(point(0) + point(2));
        } else if (op == "f*") {
            ++drawn_.fills;
            done();
        } else if (op == "S") {
            Drawn::Lines& lines = drawn_.lines[color_];
            ++lines.strokes;
            lines.dashed += dashed_ ? 1 : 0;
            lines.mm += mm_;
            drawn_.low = {std::min(drawn_.low.x, low_.x), std::min(drawn_.low.y, low_.y)};
            drawn_.high = {std::max(drawn_.high.x, high_.x), std::max(drawn_.high.y, high_.y)};
            done();
        }
    }

    Drawn drawn_;
    std::vector<double> operands_;
    std::string color_;
    bool dashed_ = false;
    double mm_ = 0.0;
    Vec2 at_, start_;
    Vec2 low_{HUGE_VAL, HUGE_VAL}, high_{-HUGE_VAL, -HUGE_VAL};
};

// The content streams of all pages, as qpdf marks them.
std::string contents(const std::string& qdf) {
    std::string all;
    for (std::size_t at = 0; (at = qdf.find("%% Contents for page", at)) != std::string::npos;) {
        const std::size_t begin = qdf.find("stream\n", at) + 7;
        at = qdf.find("endstream", begin);
        all += qdf.substr(begin, at - begin);
    }
    return all;
}

TEST(Pdf, DrawsEveryLineInItsLengthColourAndPlace) {
    if (!test::have_program("qpdf")) GTEST_SKIP() << "qpdf is not installed (Debian package qpdf)";
    Layout layout = example_layout();
    const test::ScratchDirectory scratch;
    test::write_file(scratch / "a.pdf", written(layout));
    const auto checked = test::run({"qpdf", "--check", (scratch / "a.pdf").string()});
    EXPECT_EQ(checked.exit, 0) << checked.out << checked.err;
    const auto unpacked = test::run({"qpdf", "--qdf", "--object-streams=disable",
                                     (scratch / "a.pdf").string(), (scratch / "b.pdf").string()});
    ASSERT_EQ(unpacked.exit, 0) << unpacked.err;
    const Drawn drawn = ContentReader().read(contents(test::read_file(scratch / "b.pdf")));

    const auto expect = [&drawn](const std::string& color, std::size_t strokes, double mm, bool dashed) {
        ASSERT_TRUE(drawn.lines.contains(color)) << color;
        EXPECT_EQ(drawn.lines.at(color).strokes, strokes) << color;
        EXPECT_EQ(drawn.lines.at(color).dashed, dashed ? strokes : 0) << color;
        EXPECT_NEAR(drawn.lines.at(color).mm, mm, 0.02) << color;
    };
    const double house = 2 * std::hypot(5, 10) + 30 + 2 * 60 + 2 * std::hypot(40, 15) + 40;
    expect("1 0 0", 5, 45 + 45 + 2 * (200 + 160) + 2 * house, false);
    expect("1 0 1", 3, 70 + 60 + std::hypot(1, 0.5), true);
    expect("0 0 1", 3, 30 + 2 * 75, true);
    expect("0 0 0", 2, 2 * 40, true);
    expect("0 0.6 0.2", 1, std::hypot(20, 20) + std::hypot(20, 25), false);
    EXPECT_EQ(drawn.fills, 2U + 2 * 2 + 1);  // and white under a fold on brown
    EXPECT_EQ(drawn.texts, (std::set<std::string>{"page", "1R", "house"}));
    // The extreme lines are the page's edges and the foot of the first house.
    EXPECT_NEAR(drawn.low.x, 20.25, 0.002);
    EXPECT_NEAR(drawn.low.y, 25, 0.002);
    EXPECT_NEAR(drawn.high.x, 248.5, 0.002);
    EXPECT_NEAR(drawn.high.y, 185, 0.002);
}

}  // namespace
}  // namespace popup
