// Pictures that are printed: from their files through the assembly to sheets and models.
#include "popup/image.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "base/text/base64.h"
#include "output/emit.h"
#include "popup/output.h"
#include "popup/pattern.h"
#include "support/designs.h"
#include "support/pictures.h"
#include "support/prints.h"
#include "support/random.h"
#include "support/run_program.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using test::jpeg_of;
using test::png_of;

Image opened(const std::string& file) {
    auto result = open_image(file);
    const auto* image = std::get_if<Image>(&result);
    EXPECT_NE(image, nullptr) << to_string(std::get<ImageFault>(result));
    return image != nullptr ? *image : Image{};
}

std::optional<ImageFault> fault_of(std::string file) {
    const auto result = open_image(std::move(file));
    const auto* fault = std::get_if<ImageFault>(&result);
    return fault != nullptr ? std::optional(*fault) : std::nullopt;
}

// --- files

TEST(Image, FilesAreOpenedAndTheirPixelsAreTheirs) {
    for (const bool clear : {false, true}) {
        const Image png = opened(png_of(40, 20, clear));
        EXPECT_EQ(png.format, ImageFormat::png);
        EXPECT_EQ(png.width, 40);
        EXPECT_EQ(png.height, 20);
        EXPECT_TRUE(may_be_transparent(png));
        const auto pixels = pixels_of(png);
        ASSERT_TRUE(pixels);
        EXPECT_EQ(pixels->opaque, !clear);
        EXPECT_EQ(pixels->rgba, test::quarters(40, 20, clear));
    }
    const Image jpeg = opened(jpeg_of(48, 32));
    EXPECT_EQ(jpeg.format, ImageFormat::jpeg);
    EXPECT_FALSE(may_be_transparent(jpeg));
    const auto pixels = pixels_of(jpeg);
    ASSERT_TRUE(pixels);
    EXPECT_TRUE(pixels->opaque);
    const std::vector<unsigned char> wanted = test::quarters(48, 32);
    ASSERT_EQ(pixels->rgba.size(), wanted.size());
    // In the middle of the quarters, where compression smears nothing.
    for (const std::size_t at : {8 * 48 + 12, 8 * 48 + 36, 24 * 48 + 12, 24 * 48 + 36}) {
        for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(pixels->rgba[4 * at + k], wanted[4 * at + k], 6);
    }
}

// A PNG of two colours, the second clear.
std::string palette_png() {
    const std::array<unsigned char, 8> colors{200, 10, 20, 255, 0, 0, 0, 0};
    const std::array<unsigned char, 4> pixels{0, 1, 1, 0};
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = 2;
    image.height = 2;
    image.format = PNG_FORMAT_RGBA_COLORMAP;
    image.colormap_entries = 2;
    png_alloc_size_t size = 0;
    png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0, colors.data());
    std::string bytes(size, '\0');
    png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, colors.data());
    bytes.resize(size);
    return bytes;
}

TEST(Image, OfAPaletteWithAClearColourIsNotOpaque) {
    const auto pixels = pixels_of(opened(palette_png()));
    ASSERT_TRUE(pixels.has_value());
    EXPECT_FALSE(pixels->opaque);
    EXPECT_EQ(pixels->rgba,
              (std::vector<std::uint8_t>{200, 10, 20, 255, 0, 0, 0, 0, 0, 0, 0, 0, 200, 10, 20, 255}));
}

// Pixels are kept from when the file was opened, as long as there are few of them.
TEST(Image, HasTheSamePixelsKeptAndDecodedAnew) {
    std::vector<Image> held;
    for (const std::string& file : {png_of(37, 20), png_of(37, 20, true), jpeg_of(64, 48), palette_png()})
        held.push_back(opened(file));
    // 20 of a million pixels are more than are kept.
    for (int i = 0; i < 20; ++i) held.push_back(opened(png_of(1000, 1000)));
    for (const Image& image : held) {
        Image bare = image;
        bare.pixels = nullptr;
        const auto kept = pixels_of(image);
        const auto anew = pixels_of(bare);
        ASSERT_TRUE(kept && anew);
        EXPECT_EQ(kept->opaque, anew->opaque);
        EXPECT_TRUE(kept->rgba == anew->rgba);
        bare.width += 1;
        EXPECT_FALSE(pixels_of(bare).has_value());
    }
    EXPECT_NE(held.front().pixels, nullptr);
    EXPECT_EQ(held.back().pixels, nullptr);
}

// --- pictures of cameras that were held otherwise

// What Exif says of a camera, with its numbers little or big end first.
std::string exif_of(int orientation, bool big_end) {
    const char value = static_cast<char>(orientation);
    const std::string little{'I', 'I', '*', 0, 8, 0,     0, 0, 1, 0, 0x12, 1, 3,
                             0,   1,   0,   0, 0, value, 0, 0, 0, 0, 0,    0, 0};
    const std::string big{'M', 'M', 0, '*', 0, 0, 0,     8, 0, 1, 1, 0x12, 0,
                          3,   0,   0, 0,   1, 0, value, 0, 0, 0, 0, 0,    0};
    return big_end ? big : little;
}

std::string jpeg_held(int width, int height, int orientation, bool big_end = false) {
    const std::string held = std::string("Exif\0\0", 6) + exif_of(orientation, big_end);
    const auto size = static_cast<char>(held.size() + 2);
    return jpeg_of(width, height).insert(2, std::string{'\xff', '\xe1', 0, size} + held);
}

std::string png_held(int width, int height, int orientation) {
    const std::string held = "eXIf" + exif_of(orientation, true);
    const auto crc = static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const unsigned char*>(held.data()), static_cast<unsigned>(held.size())));
    std::string chunk{0, 0, 0, static_cast<char>(held.size() - 4)};
    chunk += held;
    for (const unsigned shift : {24U, 16U, 8U, 0U}) chunk += static_cast<char>(crc >> shift & 0xFFU);
    return png_of(width, height).insert(33, chunk);
}

// Exif says on which side of what was seen the first row and the first column of the file lie: red is where
// both are, green where the first row meets the last column, and blue where the first column meets the last.
struct Seen {
    bool turned;  // the first row is a column
    bool row_last, column_last;
};
constexpr std::array<Seen, 9> kSeen{{{},
                                     {false, false, false},
                                     {false, false, true},
                                     {false, true, true},
                                     {false, true, false},
                                     {true, false, false},
                                     {true, true, false},
                                     {true, true, true},
                                     {true, false, true}}};

std::array<int, 3> color_at(const ImagePixels& pixels, bool right, bool below) {
    const int x = pixels.width * (right ? 3 : 1) / 4;
    const int y = pixels.height * (below ? 3 : 1) / 4;
    const auto at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(pixels.width) +
                         static_cast<std::size_t>(x));
    return {pixels.rgba[at], pixels.rgba[at + 1], pixels.rgba[at + 2]};
}

void expect_upright(const Image& image, int width, int height, int orientation) {
    const Seen& seen = kSeen.at(static_cast<std::size_t>(orientation));
    EXPECT_EQ(image.width, seen.turned ? height : width) << orientation;
    EXPECT_EQ(image.height, seen.turned ? width : height) << orientation;
    const auto pixels = pixels_of(image);
    ASSERT_TRUE(pixels);
    EXPECT_EQ(pixels->width, image.width);
    // Where the corner of the first or last row and the first or last column is seen.
    const auto corner = [&](bool last_row, bool last_column) {
        const bool row_side = last_row != seen.row_last;
        const bool column_side = last_column != seen.column_last;
        return seen.turned ? color_at(*pixels, row_side, column_side)
                           : color_at(*pixels, column_side, row_side);
    };
    const auto expect = [&](const std::array<int, 3>& color, const std::array<int, 3>& wanted) {
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(color.at(k), wanted.at(k), 6) << orientation;
    };
    expect(corner(false, false), {255, 0, 0});
    expect(corner(false, true), {0, 255, 0});
    expect(corner(true, false), {0, 0, 255});
    expect(corner(true, true), {255, 255, 255});
}

TEST(Image, IsUprightHoweverTheCameraWasHeld) {
    for (int orientation = 1; orientation <= 8; ++orientation) {
        // Whole blocks, no whole blocks, and pixels.
        expect_upright(opened(jpeg_held(48, 32, orientation)), 48, 32, orientation);
        expect_upright(opened(jpeg_held(48, 32, orientation, true)), 48, 32, orientation);
        expect_upright(opened(jpeg_held(50, 37, orientation)), 50, 37, orientation);
        expect_upright(opened(png_held(50, 37, orientation)), 50, 37, orientation);
    }
}

// Outputs that have the file itself show what those show that have its pixels.
TEST(Image, HasTheFileOfTheUprightPictureWithoutAWordOfTheCamera) {
    for (const std::string& file : {jpeg_held(48, 32, 6), jpeg_held(50, 37, 6), png_held(50, 37, 6)}) {
        const Image image = opened(file);
        EXPECT_EQ(image.bytes->find("Exif"), std::string::npos);
        EXPECT_EQ(image.bytes->find("eXIf"), std::string::npos);
        const Image again = opened(*image.bytes);
        EXPECT_EQ(*again.bytes, *image.bytes);
        EXPECT_EQ(pixels_of(again)->rgba, pixels_of(image)->rgba);
    }
}

TEST(Image, StaysByteForByteWhereTheCameraWasHeldUpright) {
    for (const int orientation : {0, 1, 9}) {
        for (const std::string& file : {jpeg_held(48, 32, orientation), png_held(50, 37, orientation)})
            EXPECT_EQ(*opened(file).bytes, file) << orientation;
    }
}

// A quarter turn of whole blocks loses nothing: four of them give the picture of the beginning.
TEST(Image, OfWholeBlocksIsTurnedWithoutLoss) {
    const std::string first = jpeg_of(48, 32);
    std::string file = first;
    for (int turn = 0; turn < 4; ++turn) {
        const std::string held = jpeg_held(48, 32, 6);
        file = *opened(file.insert(2, held.substr(2, held.size() - first.size()))).bytes;
    }
    EXPECT_EQ(pixels_of(opened(file))->rgba, pixels_of(opened(first))->rgba);
}

TEST(Image, BrokenFilesAreFaults) {
    EXPECT_EQ(fault_of(""), ImageFault::not_an_image);
    EXPECT_EQ(fault_of("GIF89a"), ImageFault::not_an_image);
    EXPECT_EQ(fault_of(std::string(kMostImageBytes + 1, '\xff')), ImageFault::too_many_bytes);
    EXPECT_EQ(fault_of(jpeg_of(16, 16, 4)), ImageFault::unsupported);
    for (const std::string& whole : {png_of(24, 16), jpeg_of(24, 16)}) {
        for (std::size_t size = 0; size + 2 < whole.size(); ++size) {
            EXPECT_TRUE(fault_of(whole.substr(0, size))) << size << " of " << whole.size() << " bytes";
        }
    }
}

TEST(Image, FilesWithBytesChangedAreFaultsOrPictures) {
    test::Random random(7);
    std::size_t broken = 0;
    for (const std::string& whole : {png_of(24, 16), jpeg_of(24, 16)}) {
        for (int round = 0; round < 400; ++round) {
            std::string bytes = whole;
            for (int n = 0; n < 3; ++n)
                bytes[random.below(bytes.size())] = static_cast<char>(random.below(256));
            const auto result = open_image(bytes);
            if (const auto* image = std::get_if<Image>(&result)) {
                EXPECT_TRUE(pixels_of(*image));
            } else {
                ++broken;
            }
        }
    }
    EXPECT_GT(broken, 400U);
}

// The header alone says how large it is; nothing is decoded for it.
TEST(Image, MoreThan64MillionPixelsAreTooMany) {
    std::string large = jpeg_of(16, 16);
    const std::size_t frame = large.find("\xff\xc0");
    ASSERT_NE(frame, std::string::npos);
    large.replace(frame + 5, 4, "\x20\x01\x20\x00", 4);  // 8193 × 8192
    EXPECT_EQ(fault_of(large), ImageFault::too_many_pixels);
}

// --- on paper

// A page of two plates, 60 × 40 mm each, joined at x = 0, with a picture of 60 × 30 mm across the fold. The
// plates stand at a right angle.
struct Page {
    Assembly assembly;

    explicit Page(const std::string& file) {
        assembly.stem = "page";
        Piece piece;
        piece.name = "page";
        piece.plates = {0, 1};
        piece.paper = {{test::rectangle(-60, -20, 60, 20), {}}};
        assembly.pieces = {piece};
        Image image = opened(file);
        image.place = {{60.0 / image.width, 0}, {0, -30.0 / image.height}, {-30, 15}};
        for (const bool right : {false, true}) {
            Plate plate;
            plate.name = right ? "page/right" : "page/left";
            plate.outline.outer = right ? test::rectangle(0, -20, 60, 20) : test::rectangle(-60, -20, 0, 20);
            plate.prints = {image};
            plate.stands = Frame{};
            if (right) plate.stands->axes = {Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{-1, 0, 0}};
            assembly.plates.push_back(plate);
        }
        assembly.lines = {{LineKind::valley, {{0, -20}, {0, 20}}, 0, 0, 1}};
    }

    [[nodiscard]] Pattern pattern() const {
        Diagnostics diagnostics;
        auto made = make_pattern(assembly, {}, diagnostics);
        EXPECT_TRUE(made);
        return made.value_or(Pattern{});
    }

    [[nodiscard]] Layout layout(int copies = 1) const {
        LayoutOptions options;
        options.sheet = {"", 140, 60};
        options.rotation = {1};
        options.copies = copies;
        Diagnostics diagnostics;
        auto laid = lay_out({{"page", "page", pattern()}}, options, diagnostics);
        EXPECT_TRUE(laid) << test::findings(diagnostics);
        return laid.value_or(Layout{});
    }
};

std::vector<SheetFile> sheets(const Layout& layout, const char* suffix, const OutputOptions& options = {}) {
    Diagnostics diagnostics;
    const auto write = std::get<SheetWriter>(find_format(suffix)->write);
    auto files = write(layout, options, diagnostics);
    EXPECT_TRUE(files) << test::findings(diagnostics);
    return files.value_or(std::vector<SheetFile>{});
}

std::size_t count_of(const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
    return count;
}

TEST(Image, IsCutToThePlatesOfItsPiece) {
    const Page page(png_of(40, 20));
    const Pattern pattern = page.pattern();
    const auto images = test::prints_of<Image>(pattern.pieces.at(0).prints);
    ASSERT_EQ(images.size(), 2U);
    for (const auto& one : images) {
        EXPECT_NEAR(area(one.print.clip), 30.0 * 30.0, 1e-6);
        EXPECT_EQ(one.print.bytes, images[0].print.bytes);  // shared, not copied
    }
    EXPECT_EQ(images[0].plate, 0);
    EXPECT_EQ(images[1].plate, 1);
    const auto json = nlohmann::json::parse(emit_pattern(pattern));
    EXPECT_EQ(json.at("pieces").at(0).at("images").size(), 2U);
    EXPECT_EQ(json.at("pieces").at(0).at("images").at(1).at("plate"), "page/right");
}

// What is beside its plates is not printed, and a picture wholly beside them is no print of the pattern.
TEST(Image, BesideThePaperIsNotThere) {
    Page page(png_of(8, 8));
    for (Plate& plate : page.assembly.plates) std::get<Image>(plate.prints[0]).place.origin = {100, 100};
    EXPECT_TRUE(page.pattern().pieces.at(0).prints.empty());
}

// The colours of the four quarters, where they lie on the sheet: of files of either kind, read back from the
// picture of the sheet.
TEST(Image, IsWhereItsMapPutsIt) {
    for (const std::string& file : {png_of(40, 20), jpeg_of(400, 200)}) {
        const Layout layout = Page(file).layout();
        const Vec2 middle = layout.placements.at(0).offset;
        OutputOptions options;
        options.dpi = 254;  // ten pixels a millimetre
        const auto png = sheets(layout, ".png", options);
        const auto picture = pixels_of(opened(png.at(0).bytes));
        ASSERT_TRUE(picture);
        const auto at = [&](double x, double y) {
            const auto column = static_cast<std::size_t>(10.0 * (middle.x + x));
            const auto row = static_cast<std::size_t>(10.0 * (layout.sheets[0].height_mm - middle.y - y));
            const std::uint8_t* p =
                &picture->rgba[4 * (row * static_cast<std::size_t>(picture->width) + column)];
            return Vec3{std::round(p[0] / 64.0), std::round(p[1] / 64.0), std::round(p[2] / 64.0)};
        };
        EXPECT_EQ(at(-15, 8), (Vec3{4, 0, 0}));
        EXPECT_EQ(at(15, 8), (Vec3{0, 4, 0}));
        EXPECT_EQ(at(-15, -8), (Vec3{0, 0, 4}));
        EXPECT_EQ(at(15, -8), (Vec3{4, 4, 4}));
        EXPECT_EQ(at(-29, 14), (Vec3{4, 0, 0}));
        EXPECT_EQ(at(-31, 14), (Vec3{4, 4, 4}));  // bare paper beside it
        EXPECT_EQ(at(-29, 16), (Vec3{4, 4, 4}));
    }
}

TEST(Image, StandsInAnSvgAsItsFileAndOnce) {
    const std::string file = jpeg_of(64, 32);
    const std::string svg = sheets(Page(file).layout(), ".svg").at(0).bytes;
    EXPECT_EQ(count_of(svg, base64(file)), 1U);
    EXPECT_EQ(count_of(svg, "<use "), 2U);
    EXPECT_EQ(count_of(svg, "<clipPath "), 2U);
    EXPECT_EQ(count_of(svg, "data:image/jpeg;base64,"), 1U);
}

TEST(Image, OfCamerasStandsInAPdfAsItsFileAndOnce) {
    const std::string file = jpeg_of(64, 32);
    const Layout layout = Page(file).layout(3);
    ASSERT_EQ(layout.sheets.size(), 3U);
    const std::string pdf = sheets(layout, ".pdf").at(0).bytes;
    EXPECT_EQ(count_of(pdf, file), 1U);
    EXPECT_EQ(sheets(layout, ".pdf").at(0).bytes, pdf);
}

// Where nothing is printed there are no pictures, and what is cut is what would be cut without them.
TEST(Image, IsLeftOutWhereNothingIsPrinted) {
    const Page with(png_of(8, 8));
    Page without(png_of(8, 8));
    for (Plate& plate : without.assembly.plates) plate.prints.clear();
    for (const char* suffix : {".dxf", ".plt", ".lbrn2"}) {
        EXPECT_EQ(sheets(with.layout(), suffix).at(0).bytes, sheets(without.layout(), suffix).at(0).bytes)
            << suffix;
    }
    OutputOptions apart;
    apart.print_and_cut = true;
    for (const SheetFile& one : sheets(with.layout(), ".svg", apart)) {
        EXPECT_EQ(one.bytes.find("<image") != std::string::npos, one.suffix == "-print") << one.suffix;
    }
}

TEST(Image, IsArtOfProductionPdfs) {
    OutputOptions options;
    options.profile = *find_profile("print-and-cut");
    for (const bool clear : {false, true}) {
        const Layout layout = Page(png_of(8, 8, clear)).layout(2);
        const std::string pdf = sheets(layout, ".pdf", options).at(0).bytes;
        EXPECT_EQ(count_of(pdf, "/Subtype /Image"), clear ? 2U : 1U);
        EXPECT_EQ(count_of(pdf, "/ColorSpace /DeviceCMYK"), 1U);
        EXPECT_EQ(count_of(pdf, "/SMask"), clear ? 1U : 0U);
    }
}

// --- on models

struct Glb {
    nlohmann::json json;
    std::string numbers;
};

Glb parts_of(const std::string& bytes) {
    const auto length = [&bytes](std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, 4);
        return static_cast<std::size_t>(value);
    };
    const std::size_t json = length(12);
    return {nlohmann::json::parse(bytes.substr(20, json)), bytes.substr(28 + json, length(20 + json))};
}

std::string glb_of(const Assembly& assembly, const Motion* motion = nullptr) {
    const SceneCard card{&assembly, motion, {}};
    Diagnostics diagnostics;
    const auto write = std::get<SceneWriter>(find_format(".glb")->write);
    const auto bytes = write({&card, 1}, {}, diagnostics);
    EXPECT_TRUE(bytes) << test::findings(diagnostics);
    return bytes.value_or("");
}

// Every corner of a mesh with a texture shows the place of the picture that lies there on the paper.
void expect_textured(const Glb& glb, const std::string& file, std::size_t meshes) {
    ASSERT_EQ(glb.json.at("images").size(), 1U);
    EXPECT_EQ(glb.json.at("textures").size(), 1U);
    const auto& view =
        glb.json.at("bufferViews").at(glb.json["images"][0].at("bufferView").get<std::size_t>());
    EXPECT_EQ(glb.numbers.substr(view.at("byteOffset").get<std::size_t>(),
                                 view.at("byteLength").get<std::size_t>()),
              file);
    const auto numbers = [&glb](const nlohmann::json& accessor, std::size_t width) {
        const auto& own = glb.json["accessors"].at(accessor.get<std::size_t>());
        const auto& from = glb.json["bufferViews"].at(own.at("bufferView").get<std::size_t>());
        const std::size_t offset =
            from.value("byteOffset", std::size_t{0}) + own.value("byteOffset", std::size_t{0});
        std::vector<float> values(width * own.at("count").get<std::size_t>());
        std::memcpy(values.data(), glb.numbers.data() + offset, values.size() * sizeof(float));
        return values;
    };
    std::size_t seen = 0;
    for (const auto& mesh : glb.json.at("meshes")) {
        for (const auto& primitive : mesh.at("primitives")) {
            if (!primitive.at("attributes").contains("TEXCOORD_0")) continue;
            ++seen;
            const auto places = numbers(primitive["attributes"]["TEXCOORD_0"], 2);
            const auto points = numbers(primitive["attributes"]["POSITION"], 3);
            ASSERT_EQ(points.size() / 3, places.size() / 2);
            for (std::size_t i = 0; i < places.size() / 2; ++i) {
                EXPECT_NEAR(places[2 * i + 1], (15.0 - 1000.0 * points[3 * i + 1]) / 30.0, 1e-5);
                EXPECT_GE(places[2 * i], -1e-6F);
                EXPECT_LE(places[2 * i], 1.0F + 1e-6F);
            }
        }
    }
    EXPECT_EQ(seen, meshes);
}

TEST(Image, IsATextureOfWhatStandsStill) {
    const std::string file = png_of(40, 20);
    const Page page(file);
    const Glb glb = parts_of(glb_of(page.assembly));
    expect_textured(glb, file, 2);  // a place in it for either plate
}

TEST(Image, IsATextureOfPlatesThatMove) {
    test::Built built = test::build(test::card(120, 40));
    ASSERT_TRUE(built.assembly);
    const std::string file = jpeg_of(40, 20);
    for (std::size_t i = 0; i < 2; ++i)
        built.assembly->plates.at(i).prints = Page(file).assembly.plates[i].prints;
    MotionOptions options;
    options.examine = false;
    const auto motion = simulate(*built.assembly, options, built.diagnostics);
    ASSERT_TRUE(motion);
    const Glb glb = parts_of(glb_of(*built.assembly, &*motion));
    ASSERT_EQ(glb.json.at("images").size(), 1U);
    EXPECT_EQ(glb.json["materials"].size(), 4U);  // paper, picture, edges and folds
}

// An opaque picture hides the area under it, so that nothing flickers; a later area hides the picture.
TEST(Image, AndAreasOfAModelDoNotOverlap) {
    Page page(jpeg_of(40, 20));
    std::vector<Print>& prints = page.assembly.plates[0].prints;
    prints.insert(prints.begin(), Area{{test::rectangle(-50, -18, -10, 18), {}}, Color{255, 255, 0}});
    prints.push_back(Area{{test::rectangle(-20, -5, -5, 5), {}}, Color{0, 0, 0}});
    const Glb glb = parts_of(glb_of(page.assembly));
    EXPECT_EQ(glb.json["materials"].size(), 6U);  // paper, yellow, picture, black, edges and folds
}

TEST(Image, KhronosValidatorFindsNothing) {
    if (std::getenv("POPUP_GLTF_VALIDATOR") == nullptr || !test::have_program("node")) {
        GTEST_SKIP() << "POPUP_GLTF_VALIDATOR does not say where gltf-validator is, or there is no node";
    }
    const test::ScratchDirectory scratch;
    std::vector<std::string> command{"node",
                                     std::string(POPUP_SOURCE_DIR) + "/tests/tools/validate_gltf.mjs"};
    for (const std::string& file : {png_of(40, 20), png_of(16, 16, true), jpeg_of(64, 32)}) {
        const auto path = scratch / ("model" + std::to_string(command.size()) + ".glb");
        test::write_file(path, glb_of(Page(file).assembly));
        command.push_back(path.string());
    }
    const auto result = test::run(command);
    EXPECT_EQ(result.exit, 0) << result.out << result.err;
}

}  // namespace
}  // namespace popup
