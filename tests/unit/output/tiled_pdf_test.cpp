// Sheets on several pages, read back as pictures that another program makes of them.
#include "output/tiled_pdf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "output/pdf.h"
#include "support/run_program.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

constexpr double kDpi = 150.0;
constexpr double kPixelsPerMm = kDpi / 25.4;
constexpr TileOptions kA5{148.0, 210.0, 10.0};

// Two sheets of 500 × 400 mm: one with something nearly everywhere, one with two pieces far from each other.
Layout large_layout() {
    Layout layout = test::example_layout();
    for (LayoutSheet& sheet : layout.sheets) {
        sheet.width_mm = 500;
        sheet.height_mm = 400;
    }
    layout.placements = {
        {0, 0, 0, 0, {110, 90}, Angle::degrees(0)}, {0, 0, 1, 0, {380, 150}, Angle::degrees(33)},
        {0, 1, 0, 0, {70, 210}, Angle::degrees(0)}, {0, 1, 1, 0, {200, 300}, Angle::degrees(90)},
        {0, 1, 2, 1, {60, 20}, Angle::degrees(0)},  {0, 1, 3, 1, {440, 310}, Angle::degrees(0)}};
    return layout;
}

std::string document(const Layout& layout, const OutputOptions& options) {
    Diagnostics diagnostics;
    const auto files = write_pdf(layout, options, diagnostics);
    EXPECT_FALSE(diagnostics.has_findings());
    return files.value().at(0).bytes;
}

OutputOptions on(const TileOptions& paper) {
    OutputOptions options;
    options.tile = paper;
    return options;
}

std::vector<TiledSheet> sheets_of(const Layout& layout, const OutputOptions& options) {
    Diagnostics diagnostics;
    const auto views = views_of(layout, options, diagnostics);
    return tile_sheets(layout, options, views.value(), diagnostics).value();
}

struct Picture {
    int width = 0, height = 0;
    std::string grey;  // a byte a pixel
    [[nodiscard]] int at(int x, int y) const {
        if (x < 0 || y < 0 || x >= width || y >= height) return 255;
        return static_cast<unsigned char>(grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                               static_cast<std::size_t>(x)]);
    }
    // Of the pixels round it, how dark the darkest is, and how light the lightest.
    [[nodiscard]] std::pair<int, int> around(int x, int y) const {
        int least = 255;
        int most = 0;
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                least = std::min(least, at(x + dx, y + dy));
                most = std::max(most, at(x + dx, y + dy));
            }
        }
        return {least, most};
    }
};

// The pages as pdftoppm shows them.
std::vector<Picture> pages_of(const std::string& pdf) {
    const test::ScratchDirectory scratch;
    test::write_file(scratch / "a.pdf", pdf);
    EXPECT_EQ(test::run({"pdftoppm", "-r", "150", "-gray", scratch / "a.pdf", scratch / "page"}).exit, 0);
    std::vector<Picture> pages;
    for (const std::string& name : scratch.names()) {
        if (!name.ends_with(".pgm")) continue;
        std::istringstream file(test::read_file(scratch / name));
        std::string kind;
        int most = 0;
        Picture page;
        file >> kind >> page.width >> page.height >> most;
        EXPECT_EQ(kind + std::to_string(most), "P5255");
        file.get();
        page.grey.resize(static_cast<std::size_t>(page.width) * static_cast<std::size_t>(page.height));
        file.read(page.grey.data(), static_cast<std::streamsize>(page.grey.size()));
        EXPECT_TRUE(file.good());
        pages.push_back(std::move(page));
    }
    return pages;
}

// Page sizes in mm, as pdfinfo reads them.
std::vector<std::array<double, 2>> sizes_of(const std::string& pdf) {
    const test::ScratchDirectory scratch;
    test::write_file(scratch / "a.pdf", pdf);
    std::istringstream said(test::run({"pdfinfo", "-f", "1", "-l", "9999", scratch / "a.pdf"}).out);
    std::vector<std::array<double, 2>> sizes;
    for (std::string line; std::getline(said, line);) {
        if (!line.starts_with("Page ") || line.find(" size:") == std::string::npos) continue;
        std::istringstream words(line.substr(line.find(':') + 1));
        std::string times;
        std::array<double, 2> size{};
        words >> size[0] >> times >> size[1];
        for (double& one : size) one *= 25.4 / 72.0;
        sizes.push_back(size);
    }
    return sizes;
}

bool has_tools() {
    return test::run({"pdftoppm", "-v"}).exit != 127 && test::run({"pdfinfo", "-v"}).exit != 127;
}

// Pixels of the sheet, as it is seen when its pages are glued together, that the whole sheet has otherwise;
// with every page laid `wrong_mm` too far to the right. Counts the dark pixels of the sheet, too.
struct Difference {
    int pixels = 0;
    int dark = 0;
};
Difference difference(const TiledSheet& sheet, const Picture& whole, std::span<const Picture> pages,
                      double wrong_mm = 0.0) {
    const TileGrid& grid = sheet.grid;
    const double height = sheet.drawing.height_mm;
    Difference found;
    std::size_t next = 0;
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            const bool printed = sheet.printed(row, column);
            const Picture* page = printed ? &pages[next++] : nullptr;
            const Box tile = grid.tile(row, column);
            const Box seen = grid.seen(row, column);
            for (int y = static_cast<int>(std::ceil((height - seen.max.y) * kPixelsPerMm)) + 1;
                 y < (height - seen.min.y) * kPixelsPerMm - 2; ++y) {
                for (int x = static_cast<int>(std::ceil(seen.min.x * kPixelsPerMm)) + 1;
                     x < seen.max.x * kPixelsPerMm - 2; ++x) {
                    const int here = whole.at(x, y);
                    found.dark += here < 128 ? 1 : 0;
                    if (page == nullptr) {
                        found.pixels += here < 250 ? 1 : 0;
                        continue;
                    }
                    const double right = (x + 0.5) / kPixelsPerMm - tile.min.x + grid.left_mm() + wrong_mm;
                    const double down = (y + 0.5) / kPixelsPerMm - (height - tile.max.y) + grid.top_mm();
                    const int px = static_cast<int>(std::floor(right * kPixelsPerMm));
                    const int py = static_cast<int>(std::floor(down * kPixelsPerMm));
                    // Lines fall between pixels in different ways.
                    constexpr int kRoom = 100;
                    const auto [least, most] = page->around(px, py);
                    if (here < least - kRoom || here > most + kRoom) ++found.pixels;
                }
            }
        }
    }
    EXPECT_EQ(next, pages.size());
    return found;
}

TEST(TiledPdf, PagesGluedTogetherAreTheSheet) {
    if (!has_tools()) GTEST_SKIP() << "poppler-utils are not installed";
    const Layout layout = large_layout();
    const std::vector<Picture> whole = pages_of(document(layout, {}));
    ASSERT_EQ(whole.size(), 2U);
    for (const TileOptions& paper : {kA5, TileOptions{215.9, 279.4, 6.0}, TileOptions{300.0, 90.0, 12.5}}) {
        const OutputOptions options = on(paper);
        const std::vector<Picture> pages = pages_of(document(layout, options));
        const std::vector<TiledSheet> sheets = sheets_of(layout, options);
        std::size_t next = sheets.size();  // after a plan each
        for (std::size_t i = 0; i < sheets.size(); ++i) {
            ASSERT_LE(next + sheets[i].pages, pages.size());
            const auto own = std::span(pages).subspan(next, sheets[i].pages);
            const Difference same = difference(sheets[i], whole[i], own);
            EXPECT_EQ(same.pixels, 0);
            EXPECT_GT(same.dark, 1000);
            // So much would be seen of pages that lie wrong.
            EXPECT_GT(difference(sheets[i], whole[i], own, 0.6).pixels, 1000);
            next += sheets[i].pages;
        }
        EXPECT_EQ(next, pages.size());
    }
}

TEST(TiledPdf, PagesHaveTheSizeOfThePaperAndFewerOfThemChooseHowItLies) {
    if (!has_tools()) GTEST_SKIP() << "poppler-utils are not installed";
    const OutputOptions options = on(kA5);
    const std::vector<TiledSheet> sheets = sheets_of(large_layout(), options);
    const auto sizes = sizes_of(document(large_layout(), options));
    ASSERT_EQ(sizes.size(), 2 + sheets[0].pages + sheets[1].pages);
    // Plans lie as the sheets do.
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_NEAR(sizes[i][0], 210.0, 0.01);
        EXPECT_NEAR(sizes[i][1], 148.0, 0.01);
    }
    for (std::size_t i = 2; i < sizes.size(); ++i) {
        const TiledSheet& sheet = sheets[i < 2 + sheets[0].pages ? 0 : 1];
        EXPECT_NEAR(sizes[i][0], sheet.grid.page_width_mm, 0.01);
        EXPECT_NEAR(sizes[i][1], sheet.grid.page_height_mm, 0.01);
    }
    for (const TiledSheet& sheet : sheets) {
        for (const bool across : {false, true}) {
            const TileGrid grid = tile_grid(drawn_box(sheet.drawing), kA5, across);
            const auto parts = tile_parts(grid, sheet.drawing);
            const auto pages =
                std::count_if(parts.begin(), parts.end(), [](const SheetPart& p) { return !p.empty(); });
            EXPECT_LE(sheet.pages, static_cast<std::size_t>(pages));
            const bool is_across = sheet.grid.page_width_mm > sheet.grid.page_height_mm;
            if (is_across && !across) {
                EXPECT_LT(sheet.pages, static_cast<std::size_t>(pages));
            }
        }
    }
    // Between the two pieces of the second sheet pages are bare.
    EXPECT_LT(static_cast<double>(sheets[1].pages), sheets[1].grid.tiles());
}

// What pdftotext reads on each page, on one line.
std::vector<std::string> texts_of(const std::string& pdf) {
    const test::ScratchDirectory scratch;
    test::write_file(scratch / "a.pdf", pdf);
    std::istringstream said(test::run({"pdftotext", "-raw", scratch / "a.pdf", "-"}).out);
    std::vector<std::string> pages;
    for (std::string page; std::getline(said, page, '\f');) {
        // Words that are turned are lines of their own.
        std::replace(page.begin(), page.end(), '\n', ' ');
        pages.push_back(page);
    }
    return pages;
}

TEST(TiledPdf, PagesSayWhatTheyAreAndWhoTheirNeighboursAre) {
    if (test::run({"pdftotext", "-v"}).exit == 127) GTEST_SKIP() << "poppler-utils are not installed";
    const OutputOptions options = on(kA5);
    const std::vector<TiledSheet> sheets = sheets_of(large_layout(), options);
    const std::vector<std::string> pages = texts_of(document(large_layout(), options));
    ASSERT_EQ(pages.size(), 2 + sheets[0].pages + sheets[1].pages);
    const auto says = [&](std::size_t page, const std::string& what) {
        EXPECT_NE(pages.at(page).find(what), std::string::npos) << what << "\nin\n" << pages[page];
    };
    says(0, "castle, sheet 1 of 2: plan of the pages");
    says(0, "100 mm: measure this bar");
    says(0, "Print at 100 %");
    says(1, "castle, sheet 2 of 2: plan of the pages");
    says(1, "left out");
    std::size_t page = 2;
    for (std::size_t i = 0; i < 2; ++i) {
        const TiledSheet& sheet = sheets[i];
        for (int row = 0; row < sheet.grid.rows; ++row) {
            for (int column = 0; column < sheet.grid.columns; ++column) {
                if (!sheet.printed(row, column)) continue;
                says(page, "castle, sheet " + std::to_string(i + 1) + " of 2 · row " + row_name(row) +
                               " column " + std::to_string(column + 1) + " · page " +
                               std::to_string(page + 1) + " of " + std::to_string(pages.size()));
                if (sheet.printed(row + 1, column)) says(page, tile_name(row + 1, column) + " ↓");
                if (sheet.printed(row - 1, column)) says(page, tile_name(row - 1, column) + " ↑");
                // Turned, so that the arrow down points to the right.
                if (sheet.printed(row, column + 1)) says(page, tile_name(row, column + 1) + " ↓");
                if (sheet.printed(row, column - 1)) says(page, tile_name(row, column - 1) + " ↑");
                ++page;
            }
        }
    }
}

TEST(TiledPdf, ASheetThatFitsIsOnePageWithoutAPlan) {
    if (!has_tools()) GTEST_SKIP() << "poppler-utils are not installed";
    const Layout layout = test::example_layout();
    const OutputOptions options = on({297.0, 420.0, 10.0});
    const std::string pdf = document(layout, options);
    const auto sizes = sizes_of(pdf);
    ASSERT_EQ(sizes.size(), 2U);
    for (const auto& size : sizes) EXPECT_NEAR(size[0], 297.0, 0.01);
    EXPECT_EQ(pdf.find("plan of the pages"), std::string::npos);
    const std::vector<Picture> whole = pages_of(document(layout, {}));
    const std::vector<Picture> pages = pages_of(pdf);
    const std::vector<TiledSheet> sheets = sheets_of(layout, options);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_EQ(difference(sheets[i], whole[i], std::span(pages).subspan(i, 1)).pixels, 0);
}

TEST(TiledPdf, IsTheSameByteForByteAndBearsNoDate) {
    const std::string first = document(large_layout(), on(kA5));
    EXPECT_EQ(document(large_layout(), on(kA5)), first);
    EXPECT_EQ(first.find("/CreationDate"), std::string::npos);
}

TEST(TiledPdf, ALayoutWithNothingOnItIsOnePage) {
    Layout layout = large_layout();
    layout.sheets.resize(1);
    layout.placements.clear();
    const OutputOptions options = on(kA5);
    EXPECT_EQ(sheets_of(layout, options).at(0).pages, 1U);
    EXPECT_TRUE(document(layout, options).starts_with("%PDF"));
}

TEST(TiledPdf, TooManyTilesAreAnErrorWithTheirNumber) {
    Layout layout = large_layout();
    for (LayoutSheet& sheet : layout.sheets) sheet.width_mm = sheet.height_mm = 40000;
    layout.placements[1].offset = {39000, 39000};
    Diagnostics diagnostics;
    EXPECT_FALSE(write_pdf(layout, on(kA5), diagnostics).has_value());
    ASSERT_EQ(diagnostics.sorted().size(), 1U);
    const Diagnostic told = diagnostics.sorted().front();
    EXPECT_EQ(told.code, "too-many-tiles");
    EXPECT_NE(told.message.find("the sheet of 40000 × 40000 mm needs "), std::string::npos) << told.message;
    EXPECT_NE(told.message.find("pages of 148 × 210 mm; a document has at most 10000"), std::string::npos);
    EXPECT_FALSE(told.hints.empty());
    // A sheet may be larger than a PDF page can be, but paper may not.
    layout.placements[1].offset = {6000, 6000};
    Diagnostics good;
    EXPECT_TRUE(write_pdf(layout, on({1000.0, 1000.0, 10.0}), good).has_value());
    Diagnostics paper;
    EXPECT_FALSE(write_pdf(layout, on({5081.0, 1000.0, 10.0}), paper).has_value());
    EXPECT_EQ(paper.sorted().at(0).code, "pdf-page-size");
}

}  // namespace
}  // namespace popup
