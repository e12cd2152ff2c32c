// Pictures: read back with libpng and libjpeg; what their headers say, by readers of this test's own.
#include "output/raster.h"

#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>
#include <vector>
// Needs <cstdio> before it.
#include <jpeglib.h>

#include "support/sheet_example.h"

namespace popup {
namespace {

using test::rectangle;

struct Picture {
    int width = 0;
    int height = 0;
    std::vector<unsigned char> rgb;

    [[nodiscard]] std::array<int, 3> at(int x, int y) const {
        const std::size_t i = 3U * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                    static_cast<std::size_t>(x));
        return {rgb.at(i), rgb.at(i + 1), rgb.at(i + 2)};
    }
    // Of a place on a sheet of this height.
    [[nodiscard]] std::array<int, 3> at_mm(Vec2 p, double height_mm, double dpi) const {
        return at(static_cast<int>(p.x * dpi / 25.4), static_cast<int>((height_mm - p.y) * dpi / 25.4));
    }
};
using Rgb = std::array<int, 3>;
constexpr Rgb kWhite{255, 255, 255};

Picture read_png(const std::string& bytes) {
    Picture picture;
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
        ADD_FAILURE() << image.message;
        return picture;
    }
    EXPECT_EQ(image.format & PNG_FORMAT_FLAG_ALPHA, 0U);
    EXPECT_EQ(image.format & PNG_FORMAT_FLAG_COLOR, unsigned{PNG_FORMAT_FLAG_COLOR});
    image.format = PNG_FORMAT_RGB;
    picture.width = static_cast<int>(image.width);
    picture.height = static_cast<int>(image.height);
    picture.rgb.resize(PNG_IMAGE_SIZE(image));
    EXPECT_NE(png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr), 0) << image.message;
    EXPECT_EQ(image.warning_or_error, 0U) << image.message;
    return picture;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
        value = value << 8U | static_cast<unsigned char>(bytes.at(at + i));
    return value;
}

// The contents of all chunks, by their names.
std::map<std::string, std::string> png_chunks(const std::string& bytes) {
    std::map<std::string, std::string> chunks;
    EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
    for (std::size_t at = 8; at < bytes.size();) {
        const std::size_t length = big_endian(bytes, at, 4);
        chunks[bytes.substr(at + 4, 4)] += bytes.substr(at + 8, length);
        at += 12 + length;
    }
    return chunks;
}

// What jpeglib decodes; a failure of it is a failure of the test.
struct JpegErrors {
    jpeg_error_mgr manager;
    std::jmp_buf back;
};
[[noreturn]] void leave(j_common_ptr info) {
    std::longjmp(reinterpret_cast<JpegErrors*>(info->err)->back, 1);
}
bool decode(jpeg_decompress_struct& info, JpegErrors& errors, const std::string& bytes, Picture& picture) {
    if (setjmp(errors.back) != 0) return false;
    jpeg_create_decompress(&info);
    jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&info, TRUE);
    info.out_color_space = JCS_RGB;
    jpeg_start_decompress(&info);
    picture.width = static_cast<int>(info.output_width);
    picture.height = static_cast<int>(info.output_height);
    picture.rgb.resize(3U * info.output_width * info.output_height);
    while (info.output_scanline < info.output_height) {
        JSAMPROW row = picture.rgb.data() + 3U * info.output_width * info.output_scanline;
        jpeg_read_scanlines(&info, &row, 1);
    }
    jpeg_finish_decompress(&info);
    return true;
}
Picture read_jpeg(const std::string& bytes) {
    Picture picture;
    jpeg_decompress_struct info{};
    JpegErrors errors{};
    info.err = jpeg_std_error(&errors.manager);
    errors.manager.error_exit = leave;
    EXPECT_TRUE(decode(info, errors, bytes, picture));
    EXPECT_EQ(errors.manager.num_warnings, 0);
    jpeg_destroy_decompress(&info);
    return picture;
}

// What the markers before the picture say.
struct JpegHeader {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint32_t> sampling;  // of each component, 0x11: as it is
    std::uint32_t density_unit = 0;
    std::uint32_t density_x = 0;
    std::uint32_t density_y = 0;
    std::vector<std::uint32_t> steps;  // of the first table of quantization, as they stand
};
JpegHeader jpeg_header(const std::string& bytes) {
    JpegHeader header;
    EXPECT_EQ(big_endian(bytes, 0, 2), 0xffd8U);
    for (std::size_t at = 2; at + 4 < bytes.size();) {
        const std::uint32_t marker = big_endian(bytes, at, 2);
        if (marker == 0xffdaU) break;
        if (marker == 0xffe0U && bytes.substr(at + 4, 4) == "JFIF") {
            header.density_unit = big_endian(bytes, at + 11, 1);
            header.density_x = big_endian(bytes, at + 12, 2);
            header.density_y = big_endian(bytes, at + 14, 2);
        }
        if (marker == 0xffdbU && header.steps.empty()) {
            EXPECT_EQ(big_endian(bytes, at + 4, 1), 0U) << "table 0, a byte a step";
            for (std::size_t i = 0; i < 64; ++i) header.steps.push_back(big_endian(bytes, at + 5 + i, 1));
        }
        if (marker == 0xffc0U) {
            header.height = big_endian(bytes, at + 5, 2);
            header.width = big_endian(bytes, at + 7, 2);
            for (std::size_t i = 0; i < big_endian(bytes, at + 9, 1); ++i)
                header.sampling.push_back(big_endian(bytes, at + 11 + 3 * i, 1));
        }
        at += 2 + big_endian(bytes, at + 2, 2);
    }
    return header;
}

std::vector<SheetFile> png_files(const Layout& layout, const OutputOptions& options) {
    Diagnostics diagnostics;
    return write_png(layout, options, diagnostics).value();
}
std::vector<SheetFile> jpg_files(const Layout& layout, const OutputOptions& options = {}) {
    Diagnostics diagnostics;
    return write_jpg(layout, options, diagnostics).value();
}

// --- PNG

TEST(Png, IsAsLargeAsTheSheetAndSaysSo) {
    Layout layout = test::example_layout();
    layout.sheets[1].width_mm = 254.0;  // whole pixels: none is added
    layout.sheets[1].height_mm = 127.0;
    for (const double dpi : {30.0, 72.0, 100.0, 150.5}) {
        SCOPED_TRACE(dpi);
        OutputOptions options;
        options.dpi = dpi;
        const std::vector<SheetFile> files = png_files(layout, options);
        ASSERT_EQ(files.size(), 2U);
        EXPECT_EQ(files[0].suffix, "");
        EXPECT_EQ(files[1].suffix, "-2");
        const Picture first = read_png(files[0].bytes);
        EXPECT_EQ(first.width, static_cast<int>(297.0 / 25.4 * dpi) + 1);
        EXPECT_EQ(first.height, static_cast<int>(210.0 / 25.4 * dpi) + 1);
        const Picture second = read_png(files[1].bytes);
        EXPECT_EQ(second.width, static_cast<int>(std::ceil(10 * dpi)));
        EXPECT_EQ(second.height, static_cast<int>(std::ceil(5 * dpi)));
        const auto chunks = png_chunks(files[0].bytes);
        ASSERT_TRUE(chunks.contains("pHYs"));
        const std::string& size = chunks.at("pHYs");
        ASSERT_EQ(size.size(), 9U);
        // Pixels a metre, either way.
        EXPECT_EQ(big_endian(size, 0, 4), std::lround(dpi / 0.0254));
        EXPECT_EQ(big_endian(size, 4, 4), std::lround(dpi / 0.0254));
        EXPECT_EQ(size[8], 1);
        EXPECT_TRUE(chunks.contains("IEND"));
    }
}

TEST(Png, HasTheColoursOfTheSheetInTheirPlaces) {
    OutputOptions options;
    options.dpi = 100.0;
    const Layout layout = test::example_layout();
    const Picture picture = read_png(png_files(layout, options)[0].bytes);
    const auto at = [&](double x, double y) {
        // The page's origin lies in the middle of the sheet.
        return picture.at_mm({148.5 + x, 105.0 + y}, 210.0, 100.0);
    };
    for (const int x : {0, picture.width - 1}) {
        for (const int y : {0, picture.height - 1}) EXPECT_EQ(picture.at(x, y), kWhite);
    }
    EXPECT_EQ(at(-10, 5), (Rgb{0xff, 0xcc, 0x00}));
    EXPECT_EQ(at(20, 15), (Rgb{0xcc, 0x66, 0x00}));
    EXPECT_EQ(at(12.5, 2.5), kWhite) << "a hole in the fill";
    EXPECT_EQ(at(-10, -40), kWhite);
    EXPECT_EQ(at(-80, -50), (Rgb{0x00, 0x99, 0x33})) << "the middle of a stroke";
    // The outline is red, within the pixel or two that it is wide.
    const Rgb edge = at(30, -80);
    EXPECT_GT(edge[0], 200);
    EXPECT_LT(edge[1], 160);
    EXPECT_EQ(edge[1], edge[2]);
}

// 13 million pixels are painted in two bands, which meet in the middle of a yellow half of the page.
TEST(Png, PaintsLargeSheetsWithoutASeam) {
    OutputOptions options;
    options.dpi = 366.0;
    const Picture picture = read_png(png_files(test::example_layout(), options)[0].bytes);
    ASSERT_GT(static_cast<double>(picture.width) * picture.height, 12e6);
    const int first_band = 10'000'000 / picture.width;
    const double scale = options.dpi / 25.4;
    const auto column = [&](double x, int y) { return picture.at(static_cast<int>((148.5 + x) * scale), y); };
    for (int y = first_band - 40; y < first_band + 40; ++y) {
        ASSERT_EQ(column(-80, y), column(-80, first_band - 41)) << y;
        ASSERT_EQ(column(80, y), column(80, first_band - 41)) << y;
    }
    options.dpi = 100.0;
    const Picture whole = read_png(png_files(test::example_layout(), options)[0].bytes);
    for (const Vec2 p : {Vec2{-10, 5}, Vec2{20, 15}, Vec2{12.5, 2.5}, Vec2{-80, -50}}) {
        EXPECT_EQ(picture.at_mm({148.5 + p.x, 105.0 + p.y}, 210.0, 25.4 * scale),
                  whole.at_mm({148.5 + p.x, 105.0 + p.y}, 210.0, 100.0));
    }
}

TEST(Png, HasTheColoursOfATurnedPieceInTheirPlaces) {
    OutputOptions options;
    options.dpi = 100.0;
    const Picture picture = read_png(png_files(test::example_layout(), options)[1].bytes);
    const Rgb wall{0xd0, 0xe8, 0xff};
    EXPECT_EQ(picture.at_mm({60.25 - 10, 40.125 + 10}, 210.0, 100.0), wall);
    // By a quarter counter-clockwise: (-10, 10) lies at (-10, -10).
    EXPECT_EQ(picture.at_mm({200 - 10, 100 - 10}, 210.0, 100.0), wall);
    EXPECT_NE(picture.at_mm({200 - 10, 100 + 10}, 210.0, 100.0), wall);
}

TEST(Png, OfABackIsMirrored) {
    OutputOptions options;
    options.dpi = 50.0;
    options.backs = true;
    Layout layout = test::example_layout();
    layout.sheets = {{254, 203.2, 0.5, {}}};  // 500 × 400 pixels
    layout.placements.resize(1);
    const std::vector<SheetFile> files = png_files(layout, options);
    ASSERT_EQ(files.size(), 2U);
    EXPECT_EQ(files[1].suffix, "-back");
    const Picture front = read_png(files[0].bytes);
    const Picture back = read_png(files[1].bytes);
    const Vec2 yellow{148.5 - 15, 105 + 5};
    EXPECT_EQ(front.at_mm(yellow, 203.2, 50), (Rgb{0xff, 0xcc, 0x00}));
    EXPECT_EQ(back.at_mm({254 - yellow.x, yellow.y}, 203.2, 50), (Rgb{0xff, 0xcc, 0x00}));
    EXPECT_EQ(front.at_mm({254 - yellow.x, yellow.y}, 203.2, 50), kWhite);
}

TEST(Png, ThatWouldBeTooLargeIsAnError) {
    struct Row {
        double width, height, dpi;
        bool good;
    };
    for (const Row& row : {Row{25400, 25.4, 32.767, true},    // 32767 × 33
                           Row{25400, 25.4, 32.7675, false},  // 32768 × 33
                           Row{25.4, 25400, 32.768, false},   //
                           Row{508, 508, 900, false},         // 18000 × 18000 are 324 million
                           Row{2540, 2540, 1000, false}}) {
        SCOPED_TRACE(row.dpi);
        Layout layout;
        layout.sheets = {{20, 20, 0, {}}, {row.width, row.height, 0, {}}};
        OutputOptions options;
        options.dpi = row.dpi;
        Diagnostics diagnostics;
        const auto files = write_png(layout, options, diagnostics);
        EXPECT_EQ(files.has_value(), row.good);
        EXPECT_EQ(diagnostics.has_errors(), !row.good);
        if (row.good) {
            EXPECT_EQ(read_png(files->at(1).bytes).width, 32767);
        } else {
            ASSERT_EQ(diagnostics.sorted().size(), 1U);
            EXPECT_EQ(diagnostics.sorted()[0].code, "picture-too-large");
        }
    }
}

TEST(Png, IsTheSameTwice) {
    OutputOptions options;
    options.dpi = 72.0;
    EXPECT_EQ(test::bytes_of(png_files(test::example_layout(), options)),
              test::bytes_of(png_files(test::example_layout(), options)));
}

// --- JPEG

constexpr double kPixelMm = 25.4 / 72.0;

TEST(Jpg, IsAPictureOfAPageForEveryPiece) {
    Layout layout = test::example_layout();
    layout.designs.push_back(layout.designs[0]);
    layout.designs[1].stem = "castle~2";
    const std::vector<SheetFile> files = jpg_files(layout);
    // Two designs of two pieces, however many copies and sheets there are.
    ASSERT_EQ(files.size(), 4U);
    EXPECT_EQ(files[0].suffix, "");
    EXPECT_EQ(files[1].suffix, "-2");
    EXPECT_EQ(files[3].suffix, "-4");
    for (const SheetFile& file : files) {
        const JpegHeader header = jpeg_header(file.bytes);
        EXPECT_EQ(header.width, 800U);
        EXPECT_EQ(header.height, 650U);
        EXPECT_EQ(header.sampling, (std::vector<std::uint32_t>{0x11, 0x11, 0x11}));
        EXPECT_EQ(header.density_unit, 1U) << "dots an inch";
        EXPECT_EQ(header.density_x, 72U);
        EXPECT_EQ(header.density_y, 72U);
        // Quality 92: 16 % of the steps 16 and 99, with which the standard's example begins and ends.
        ASSERT_EQ(header.steps.size(), 64U);
        EXPECT_EQ(header.steps.front(), 3U);
        EXPECT_EQ(header.steps.back(), 16U);
    }
    EXPECT_EQ(files[0].bytes, files[2].bytes);
    EXPECT_NE(files[0].bytes, files[1].bytes);
}

// As near as a lossy picture is.
void expect_near(const Rgb& found, const Rgb& wanted) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found.at(i), wanted.at(i), 6);
}

TEST(Jpg, HasTheMiddleOfThePageInTheMiddle) {
    const std::vector<SheetFile> files = jpg_files(test::example_layout());
    const Picture page = read_jpeg(files[0].bytes);
    const auto at = [](const Picture& picture, double x, double y) {
        return picture.at(static_cast<int>(400 + x / kPixelMm), static_cast<int>(325 - y / kPixelMm));
    };
    ASSERT_EQ(page.width, 800);
    expect_near(page.at(2, 2), kWhite);
    expect_near(page.at(797, 647), kWhite);
    expect_near(at(page, -10, 5), {0xff, 0xcc, 0x00});
    expect_near(at(page, 20, 15), {0xcc, 0x66, 0x00});
    expect_near(at(page, 12.5, 2.5), kWhite);
    // Its lower edge, 80 mm below the middle, is red.
    EXPECT_LT(at(page, 30, -80)[1], 200);
    const Picture house = read_jpeg(files[1].bytes);
    expect_near(at(house, -20, 20), {0xd0, 0xe8, 0xff});
    expect_near(at(house, 20, -7), {0xa0, 0xc8, 0xf0});
    expect_near(at(house, 20, 20), kWhite);
}

// A piece larger than the page: so many fewer pixels an inch that all of it is there.
TEST(Jpg, HasAllOfAPieceThatReachesFurther) {
    for (const Vec2 reach : {Vec2{700, 20}, Vec2{20, 700}, Vec2{-500, 100}}) {
        Layout layout;
        layout.sheets = {{2000, 2000, 0, {}}};
        layout.designs = {{"large.svg", "large", {}}};
        PatternPiece& piece = layout.designs[0].pattern.pieces.emplace_back();
        const Ring outline = rectangle(std::min(reach.x, 0.0), 0, std::max(reach.x, 0.0), reach.y);
        piece.name = "large";
        piece.cuts = {{outline, true}};
        piece.prints = {{Area{{outline, {}}, {0x00, 0x00, 0xff}}}};
        piece.silhouette = {{outline, {}}};
        piece.bounds = bounds(outline);
        layout.placements = {{}};
        const Picture picture = read_jpeg(jpg_files(layout).at(0).bytes);
        ASSERT_EQ(picture.width, 800);
        ASSERT_EQ(picture.height, 650);
        // Where there is blue: from the middle on, to near an edge but not up to it.
        int left = 800;
        int right = 0;
        int top = 650;
        int bottom = 0;
        for (int y = 0; y < 650; ++y) {
            for (int x = 0; x < 800; ++x) {
                const Rgb color = picture.at(x, y);
                if (color[2] < 200 || color[0] > 60 || color[1] > 60) continue;
                left = std::min(left, x);
                right = std::max(right, x);
                top = std::min(top, y);
                bottom = std::max(bottom, y);
            }
        }
        ASSERT_LE(left, right);
        EXPECT_GT(left, 0);
        EXPECT_LT(right, 799);
        EXPECT_GT(top, 0);
        EXPECT_LT(bottom, 649);
        EXPECT_NEAR(reach.x > 0 ? left : right, 400, 2);
        EXPECT_NEAR(bottom, 325, 2);
        // In proportion, and no smaller than it must be.
        const double scale = static_cast<double>(right - left + 1) / std::abs(reach.x);
        EXPECT_NEAR((bottom - top + 1) / reach.y, scale, 0.25);
        EXPECT_TRUE(std::abs(reach.x) * scale > 380 || reach.y * scale > 300);
    }
}

TEST(Jpg, DoesNotDependOnMachineOrMarks) {
    OutputOptions options;
    options.profile = *find_profile("k40");
    options.backs = true;
    options.reference_mm = 100.0;
    options.print_and_cut = true;
    EXPECT_EQ(test::bytes_of(jpg_files(test::example_layout(), options)),
              test::bytes_of(jpg_files(test::example_layout())));
}

}  // namespace
}  // namespace popup
