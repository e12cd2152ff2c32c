// Pictures of PDFs, held against what libpng and another program see.
#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include "output/png_rows.h"
#include "popup/image.h"
#include "popup/output.h"
#include "support/designs.h"
#include "support/pictures.h"
#include "support/random.h"
#include "support/run_program.h"

namespace popup {
namespace {

struct Kind {
    const char* name;
    int colors;
    int bits;
    bool interlaced = false;
    bool one_clear = false;  // a colour of the palette
    bool as_rows = true;     // stands in a PDF as it stands in its file
    int entries = 0;         // of a palette; 0: as many as there can be
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

constexpr std::array kKinds{
    Kind{.name = "rgb", .colors = PNG_COLOR_TYPE_RGB, .bits = 8},
    Kind{.name = "grey", .colors = PNG_COLOR_TYPE_GRAY, .bits = 8},
    Kind{.name = "grey_of_four_bits", .colors = PNG_COLOR_TYPE_GRAY, .bits = 4},
    Kind{.name = "grey_of_two_bits", .colors = PNG_COLOR_TYPE_GRAY, .bits = 2},
    Kind{.name = "black_and_white", .colors = PNG_COLOR_TYPE_GRAY, .bits = 1},
    Kind{.name = "palette", .colors = PNG_COLOR_TYPE_PALETTE, .bits = 8},
    Kind{.name = "palette_of_four_bits", .colors = PNG_COLOR_TYPE_PALETTE, .bits = 4},
    Kind{.name = "palette_of_two_bits", .colors = PNG_COLOR_TYPE_PALETTE, .bits = 2},
    Kind{.name = "two_colours", .colors = PNG_COLOR_TYPE_PALETTE, .bits = 1},
    Kind{.name = "short_palette", .colors = PNG_COLOR_TYPE_PALETTE, .bits = 4, .entries = 5},
    Kind{.name = "rgb_of_16_bits", .colors = PNG_COLOR_TYPE_RGB, .bits = 16, .as_rows = false},
    Kind{.name = "interlaced", .colors = PNG_COLOR_TYPE_RGB, .bits = 8, .interlaced = true, .as_rows = false},
    Kind{.name = "rgba", .colors = PNG_COLOR_TYPE_RGB_ALPHA, .bits = 8, .as_rows = false},
    Kind{.name = "grey_and_alpha", .colors = PNG_COLOR_TYPE_GRAY_ALPHA, .bits = 8, .as_rows = false},
    Kind{.name = "palette_with_a_clear_colour",
         .colors = PNG_COLOR_TYPE_PALETTE,
         .bits = 2,
         .one_clear = true,
         .as_rows = false},
};

// No whole number of bytes a row where a pixel has fewer bits; and so many that libpng puts the rows of most
// kinds into several chunks.
constexpr std::size_t kWidth = 101;
constexpr std::size_t kHeight = 90;

// Random pixels as the kind has them.
std::string png_of(const Kind& kind, std::uint64_t seed) {
    test::Random random(seed);
    std::string bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    const auto append = [](png_structp to, png_bytep data, png_size_t length) {
        static_cast<std::string*>(png_get_io_ptr(to))->append(reinterpret_cast<const char*>(data), length);
    };
    png_set_write_fn(png, &bytes, append, nullptr);
    png_set_IHDR(png, info, kWidth, kHeight, kind.bits, kind.colors,
                 kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    const auto any = [&random](int below) {
        return static_cast<png_byte>(random.below(static_cast<std::size_t>(below)));
    };
    const int entries = kind.entries > 0 ? kind.entries : 1 << kind.bits;
    if (kind.colors == PNG_COLOR_TYPE_PALETTE) {
        std::vector<png_color> palette(static_cast<std::size_t>(entries));
        for (png_color& color : palette) color = {any(256), any(256), any(256)};
        png_set_PLTE(png, info, palette.data(), entries);
        const png_byte clear = 0;
        if (kind.one_clear) png_set_tRNS(png, info, &clear, 1, nullptr);
    }
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_ALL_FILTERS);
    png_write_info(png, info);
    std::vector<std::vector<png_byte>> rows(kHeight, std::vector<png_byte>(png_get_rowbytes(png, info)));
    std::vector<png_bytep> lines;
    for (std::vector<png_byte>& row : rows) {
        for (png_byte& byte : row) {
            if (kind.entries == 0)
                byte = any(256);
            else
                byte = static_cast<png_byte>(any(entries) << 4 | any(entries));
        }
        lines.push_back(row.data());
    }
    png_write_image(png, lines.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

// The same pixels in a file that has alpha, in use or not.
std::string with_alpha(const ImagePixels& pixels) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(pixels.width);
    image.height = static_cast<png_uint_32>(pixels.height);
    image.format = PNG_FORMAT_RGBA;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string bytes(size, '\0');
    EXPECT_NE(png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.rgba.data(), 0, nullptr), 0);
    bytes.resize(size);
    return bytes;
}

Image opened(const std::string& file) {
    auto result = open_image(file);
    EXPECT_TRUE(std::holds_alternative<Image>(result));
    return std::get<Image>(result);
}

// A sheet that the picture covers, a pixel a millimetre.
Layout layout_of(const Image& picture, int copies = 1) {
    Piece piece;
    piece.name = "page";
    piece.plates = {0};
    const double x = 0.5 * kWidth;
    const double y = 0.5 * kHeight;
    piece.paper = {{test::rectangle(-x, -y, x, y), {}}};
    Assembly assembly;
    assembly.stem = "page";
    assembly.pieces = {piece};
    Plate plate;
    plate.name = "page";
    plate.outline.outer = piece.paper.front().outer;
    Image image = picture;
    image.place.origin = {-x, y};
    plate.prints = {image};
    plate.stands = Frame{};
    assembly.plates = {plate};
    Diagnostics diagnostics;
    auto pattern = make_pattern(assembly, {}, diagnostics);
    EXPECT_TRUE(pattern) << test::findings(diagnostics);
    LayoutOptions options;
    options.sheet = {"", kWidth + 20.0, kHeight + 20.0};
    options.rotation = {1};
    options.copies = copies;
    auto layout = lay_out({{"page", "page", *pattern}}, options, diagnostics);
    EXPECT_TRUE(layout) << test::findings(diagnostics);
    return *layout;
}

std::string pdf_of(const Layout& layout, const OutputOptions& options = {}) {
    Diagnostics diagnostics;
    const auto files = std::get<SheetWriter>(find_format(".pdf")->write)(layout, options, diagnostics);
    EXPECT_TRUE(files) << test::findings(diagnostics);
    return files->at(0).bytes;
}

std::size_t count_of(const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
    return count;
}

// The data of all chunks of one kind, one behind the other; `count`: how many there are.
std::string chunks_of(const std::string& file, const std::string& kind, int& count) {
    std::string data;
    count = 0;
    for (std::size_t at = 8; at + 12 <= file.size();) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) length = length * 256 + static_cast<unsigned char>(file[at + i]);
        if (file.compare(at + 4, 4, kind) == 0) {
            data += file.substr(at + 8, length);
            ++count;
        }
        at += 12 + length;
    }
    return data;
}

class PdfPicture : public testing::TestWithParam<Kind> {};

// What another program takes out of the document is what libpng reads, pixel by pixel; where a picture is
// clear it may have any colour.
TEST_P(PdfPicture, IsInItPixelByPixel) {
    if (!test::have_program("pdfimages")) GTEST_SKIP() << "no pdfimages (Debian package poppler-utils)";
    if (GetParam().colors == PNG_COLOR_TYPE_PALETTE && GetParam().bits == 1)
        GTEST_SKIP() << "pdfimages takes one bit a pixel for black and white; IsShownWhereCairoShowsIt holds";
    const Image picture = opened(png_of(GetParam(), 1));
    const test::ScratchDirectory scratch;
    test::write_file(scratch / "a.pdf", pdf_of(layout_of(picture)));
    ASSERT_EQ(test::run({"pdfimages", "-png", scratch / "a.pdf", scratch / "a"}).exit, 0);
    const auto found = pixels_of(opened(test::read_file(scratch / "a-000.png")));
    const auto wanted = pixels_of(picture);
    ASSERT_TRUE(found && wanted);
    ASSERT_EQ(found->width, wanted->width);
    ASSERT_EQ(found->height, wanted->height);
    std::size_t different = 0;
    for (std::size_t i = 0; i < wanted->rgba.size(); ++i) {
        const std::uint8_t alpha = wanted->rgba[i | 3U];
        // Multiplied by alpha, and divided again, a channel has lost some of its digits.
        const int lost = alpha == 255 ? 0 : 1 + 255 / (alpha + 1);
        if (i % 4 != 3 && std::abs(found->rgba[i] - wanted->rgba[i]) > lost) ++different;
    }
    EXPECT_EQ(different, 0U);
}

// The same place, the same size and the same way up as a picture that Cairo puts there.
TEST_P(PdfPicture, IsShownWhereCairoShowsIt) {
    if (!test::have_program("pdftoppm")) GTEST_SKIP() << "no pdftoppm (Debian package poppler-utils)";
    const Image picture = opened(png_of(GetParam(), 6));
    const test::ScratchDirectory scratch;
    std::array<std::string, 2> shown;
    for (const bool by_cairo : {false, true}) {
        const Image one = by_cairo ? opened(with_alpha(*pixels_of(picture))) : picture;
        test::write_file(scratch / "a.pdf", pdf_of(layout_of(one)));
        ASSERT_EQ(test::run({"pdftoppm", "-r", "200", scratch / "a.pdf", scratch / "a"}).exit, 0);
        shown.at(by_cairo ? 1 : 0) = test::read_file(scratch / "a-1.ppm");
    }
    EXPECT_GT(shown[0].size(), 10000U);
    EXPECT_EQ(shown[0], shown[1]);
}

// Such a picture is neither unpacked nor packed anew, and several sheets have it in common.
TEST_P(PdfPicture, StandsInItAsInItsFileWhereItCan) {
    const std::string file = png_of(GetParam(), 2);
    int chunks = 0;
    const std::string rows = chunks_of(file, "IDAT", chunks);
    EXPECT_GT(chunks, GetParam().colors == PNG_COLOR_TYPE_RGB ? 1 : 0);
    const Layout layout = layout_of(opened(file), 3);
    ASSERT_EQ(layout.sheets.size(), 3U);
    const std::string pdf = pdf_of(layout);
    EXPECT_EQ(count_of(pdf, rows), GetParam().as_rows ? 1U : 0U);
    const bool clear = (GetParam().colors & PNG_COLOR_MASK_ALPHA) != 0 || GetParam().one_clear;
    EXPECT_EQ(count_of(pdf, "/Subtype /Image"), clear ? 2U : 1U);
    EXPECT_EQ(pdf_of(layout), pdf);
    EXPECT_EQ(png_rows(opened(file)).has_value(), GetParam().as_rows);
}

INSTANTIATE_TEST_SUITE_P(Kinds, PdfPicture, testing::ValuesIn(kKinds),
                         [](const auto& info) { return std::string(info.param.name); });

// The plan of a sheet on several pages shows it small, and its pages in parts: one picture for all.
TEST(PdfPictures, OfTilesStandInItOnce) {
    const std::string file = png_of(kKinds[0], 3);
    OutputOptions options;
    options.tile = TileOptions{.width_mm = 55.0, .height_mm = 50.0};
    const std::string pdf = pdf_of(layout_of(opened(file)), options);
    EXPECT_GT(count_of(pdf, "/Type /Page\n") + count_of(pdf, "/Type /Page "), 2U);
    EXPECT_EQ(count_of(pdf, "/Subtype /Image"), 1U);
}

// A picture that has the size of a stand-in is none.
TEST(PdfPictures, OfSixteenPixelsAreThemselves) {
    for (const std::string& small : {test::jpeg_of(16, 1), test::png_of(16, 1)}) {
        Layout layout = layout_of(opened(png_of(kKinds[0], 4)), 2);
        const Layout second = layout_of(opened(small));
        layout.designs.push_back(second.designs.at(0));
        layout.placements.at(1).design = 1;
        const std::string pdf = pdf_of(layout);
        EXPECT_EQ(count_of(pdf, "/Subtype /Image"), 2U);
        EXPECT_EQ(count_of(pdf, "/Width 16"), 1U);
    }
}

// Two pictures side by side in one document are not taken for one another.
TEST(PdfPictures, EachTakesItsOwnPlace) {
    const std::string one = png_of(kKinds[0], 4);
    const std::string other = png_of(kKinds[5], 5);
    Layout layout = layout_of(opened(one), 2);
    const Layout second = layout_of(opened(other));
    layout.designs.push_back(second.designs.at(0));
    layout.placements.at(1).design = 1;
    const std::string pdf = pdf_of(layout);
    EXPECT_EQ(count_of(pdf, "/Subtype /Image"), 2U);
    EXPECT_EQ(count_of(pdf, "/Indexed"), 1U);
}

}  // namespace
}  // namespace popup
