// Still pictures: what a ray from the eye meets first is what is there; the same bytes; names of files.
#include <gif_lib.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "output/png.h"
#include "output/still/model.h"
#include "output/still/render.h"
#include "popup/compile.h"
#include "popup/image.h"
#include "popup/output.h"
#include "support/designs.h"
#include "support/random.h"
#include "support/sanitized.h"

namespace popup {
namespace {

Compilation compiled(const std::string& sample) {
    Diagnostics diagnostics("samples");
    std::optional<Source> source =
        read_source(std::string(POPUP_SOURCE_DIR) + "/samples/" + sample, diagnostics);
    POPUP_INVARIANT(source.has_value());
    CompileOptions options;
    options.until = Stage::motion;
    options.motion.examine = false;
    return compile({std::move(*source)}, options, {});
}

SceneCard card_of(const Compilation& run) {
    const CompiledDesign& one = run.designs.front();
    return {&*one.assembly, one.motion ? &*one.motion : nullptr, "", nullptr};
}

std::vector<SheetFile> pictures(const SceneCard& card, const StillOptions& still) {
    OutputOptions options;
    options.still = still;
    Diagnostics diagnostics("still");
    const auto write = std::get<StillWriter>(find_format("a.view.png")->write);
    auto files = write({&card, 1}, options, diagnostics);
    EXPECT_TRUE(files.has_value()) << test::findings(diagnostics);
    return files ? std::move(*files) : std::vector<SheetFile>{};
}

double linear(unsigned char byte) {
    const double c = byte / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// The nearest triangle on a ray, by solving for it.
int nearest(const still::Model& model, Vec3 eye, Vec3 way) {
    int hit = -1;
    double least = HUGE_VAL;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const still::Face& face = model.faces[f];
        if (!face.paper && dot(face.frame.normal(), way) >= 0.0) continue;
        for (std::size_t i = 0; i + 2 < face.indices.size(); i += 3) {
            const Vec3 a = face.points[face.indices[i]];
            const Vec3 u = face.points[face.indices[i + 1]] - a;
            const Vec3 v = face.points[face.indices[i + 2]] - a;
            const Vec3 n = cross(u, v);
            const double down = dot(n, way);
            if (std::abs(down) < 1e-12) continue;
            const double t = dot(n, a - eye) / down;
            const Vec3 d = eye + t * way - a;
            const double s1 = dot(cross(d, v), n) / dot(n, n);
            const double s2 = dot(cross(u, d), n) / dot(n, n);
            if (s1 < 0.0 || s2 < 0.0 || s1 + s2 > 1.0 || t <= 0.0 || t >= least) continue;
            hit = static_cast<int>(f);
            least = t;
        }
    }
    return hit;
}

// Pixels within two of an edge, hidden or not.
std::vector<char> near_edges(const still::Model& model, const still::Camera& camera, int width, int height) {
    std::vector<char> near(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    for (const still::Edge& edge : model.edges) {
        const still::Seen a = camera.see(edge.a);
        const still::Seen b = camera.see(edge.b);
        const int steps = 1 + static_cast<int>(std::max(std::abs(b.x - a.x), std::abs(b.y - a.y)));
        for (int i = 0; i <= steps; ++i) {
            const double t = static_cast<double>(i) / steps;
            const int x = static_cast<int>(std::floor(a.x + t * (b.x - a.x)));
            const int y = static_cast<int>(std::floor(a.y + t * (b.y - a.y)));
            for (int dy = -2; dy <= 2; ++dy) {
                for (int dx = -2; dx <= 2; ++dx) {
                    if (x + dx < 0 || y + dy < 0 || x + dx >= width || y + dy >= height) continue;
                    near[static_cast<std::size_t>(y + dy) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(x + dx)] = 1;
                }
            }
        }
    }
    return near;
}

struct Shown {
    const char* sample;
    double paper_mm;
};
class StillRays : public testing::TestWithParam<Shown> {};

// Where the pixels around one see the same face, the picture has its colour there, lit by some light; where
// rays meet nothing, it has the background, which is no darker than its shadow.
TEST_P(StillRays, MeetWhatThePictureShows) {
    const Compilation run = compiled(GetParam().sample);
    ASSERT_TRUE(run.designs.front().assembly.has_value()) << test::findings(run.designs.front().diagnostics);
    const SceneCard card = card_of(run);
    still::Modeller modeller({&card, 1}, false, GetParam().paper_mm);
    constexpr int kWide = 400;
    constexpr int kHigh = 300;
    test::Random random(7);
    for (const View view : {View::iso, View::front, View::top, View::left, View::right, View::back}) {
        Diagnostics diagnostics("still");
        const auto model = modeller.at(view == View::top ? 140.0 : 80.0, diagnostics);
        ASSERT_TRUE(model) << test::findings(diagnostics);
        const still::Framing framing = still::framing_of(*model, view, kWide, kHigh);
        const still::Camera& camera = framing.camera;
        const Pixels pixels = still::render(*model, framing, kWide, kHigh);
        const std::vector<char> edges = near_edges(*model, camera, kWide, kHigh);
        int looked_at = 0;
        for (int round = 0; round < test::sanitized_count(400); ++round) {
            const int x = 2 + static_cast<int>(random.below(kWide - 4));
            const int y = 2 + static_cast<int>(random.below(kHigh - 4));
            const std::size_t pixel = static_cast<std::size_t>(y) * kWide + static_cast<std::size_t>(x);
            if (edges[pixel] != 0) continue;
            const auto face_at = [&](double px, double py) {
                return nearest(*model, camera.eye(),
                               camera.point(px, py, 1.0 / camera.eye_mm) - camera.eye());
            };
            // Nine samples a pixel.
            const int face = face_at(x + 0.5, y + 0.5);
            bool alike = true;
            for (int k = 0; k < 9 && alike; ++k)
                alike = face_at(x + (k % 3 + 0.5) / 3.0, y + (k / 3 + 0.5) / 3.0) == face;
            if (!alike) continue;
            const unsigned char* rgb = pixels.rgb.data() + 3 * pixel;
            if (face < 0) {
                EXPECT_GE(linear(rgb[1]), 0.7 * 0.7) << x << ", " << y;
                continue;
            }
            const still::Face& shown = model->faces[static_cast<std::size_t>(face)];
            if (shown.texture != nullptr) continue;
            const bool from_front = dot(shown.frame.normal(), camera.eye() - shown.frame.origin) > 0.0;
            const still::Light paint = from_front ? shown.color : shown.back.value_or(shown.color);
            ++looked_at;
            // One light for all three channels, between the ambient's least and the sun's most.
            double least = HUGE_VAL;
            double most = 0.0;
            for (std::size_t c = 0; c < 3; ++c) {
                if (paint.at(c) < 0.05F) continue;
                const auto light = [&](int byte) {
                    return linear(static_cast<unsigned char>(std::clamp(byte, 0, 255))) / paint.at(c);
                };
                least = std::min(least, rgb[c] == 255 ? HUGE_VAL : light(rgb[c] + 1));
                most = std::max(most, light(rgb[c] - 1));
            }
            EXPECT_LE(most, least) << "view " << static_cast<int>(view) << " at " << x << ", " << y
                                   << ": another colour than that of face " << face;
            EXPECT_GE(least, 0.3);
            EXPECT_LE(most, 1.2);
        }
        if (view == View::iso || view == View::top) {
            EXPECT_GT(looked_at, test::sanitized_count(60, 20)) << static_cast<int>(view);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Samples, StillRays,
                         testing::Values(Shown{"castle.xml", 0.0}, Shown{"swallow.xml", 0.0},
                                         Shown{"seasons.xml", 0.0}, Shown{"dragon.xml", 0.0},
                                         Shown{"villa.oa", 0.0}, Shown{"swallow.xml", 1.5}));

// Front, back and sides of each plate close a solid, whose volume is the area times the thickness: by
// Gauss's theorem, from the triangles alone. Solids of hinged plates cross there; each is looked at by
// itself.
TEST(Still, ThickPlatesAreSolids) {
    const Compilation run = compiled("castle.xml");
    const SceneCard card = card_of(run);
    constexpr double kPaperMm = 0.8;
    still::Modeller modeller({&card, 1}, false, kPaperMm);
    Diagnostics diagnostics("still");
    const auto model = modeller.at(70.0, diagnostics);
    ASSERT_TRUE(model) << test::findings(diagnostics);
    ASSERT_EQ(static_cast<std::size_t>(model->plates), 3 * card.assembly->plates.size());
    std::vector<double> volumes(card.assembly->plates.size(), 0.0);
    for (const still::Face& face : model->faces) {
        if (!face.paper) continue;
        for (std::size_t i = 0; i + 2 < face.indices.size(); i += 3) {
            const double six = dot(face.points[face.indices[i]],
                                   cross(face.points[face.indices[i + 1]], face.points[face.indices[i + 2]]));
            // Triangles of the back turn as those of the front do.
            volumes.at(static_cast<std::size_t>(face.plate / 3)) += (face.plate % 3 == 1 ? -six : six) / 6.0;
        }
    }
    for (std::size_t i = 0; i < volumes.size(); ++i) {
        const Plate& plate = card.assembly->plates[i];
        EXPECT_NEAR(volumes[i], kPaperMm * area(plate.outline), 1e-6 * area(plate.outline) + 1e-3)
            << plate.name;
    }
}

TEST(Still, IsTheSameEachTimeAndNamesItsFiles) {
    const Compilation run = compiled("harbour.xml");
    const SceneCard card = card_of(run);
    StillOptions still;
    still.size = PictureSize{120, 90};
    ASSERT_EQ(pictures(card, still).size(), 1U);
    EXPECT_EQ(pictures(card, still).front().suffix, "");
    still.views = {View::iso, View::front};
    const auto two = pictures(card, still);
    ASSERT_EQ(two.size(), 2U);
    EXPECT_EQ(two[0].suffix, "-iso");
    EXPECT_EQ(two[1].suffix, "-front");
    still.openings_deg = {22.5, 150.0};
    const auto four = pictures(card, still);
    ASSERT_EQ(four.size(), 4U);
    EXPECT_EQ(four[0].suffix, "-iso-22.5");
    EXPECT_EQ(four[3].suffix, "-front-150");
    std::set<std::string> different;
    const auto again = pictures(card, still);
    for (std::size_t i = 0; i < four.size(); ++i) {
        EXPECT_EQ(four[i].bytes, again[i].bytes);
        different.insert(four[i].bytes);
        const auto opened = open_image(four[i].bytes);
        ASSERT_TRUE(std::holds_alternative<Image>(opened));
        EXPECT_EQ(std::get<Image>(opened).width, 120);
        EXPECT_EQ(std::get<Image>(opened).height, 90);
    }
    EXPECT_EQ(different.size(), 4U);
}

// Bands that pictures are drawn in do not show: one of many bands has the pixels of one that has a few.
TEST(Still, LooksTheSameInBandsOfAnyHeight) {
    const Compilation run = compiled("birthday.xml");
    const SceneCard card = card_of(run);
    still::Modeller modeller({&card, 1}, false);
    Diagnostics diagnostics("still");
    const auto model = modeller.at(90.0, diagnostics);
    ASSERT_TRUE(model);
    // Twice as wide, the same height: the model is as large, in the middle, in bands of half the rows.
    const still::Framing a = still::framing_of(*model, View::iso, 400, 300);
    const still::Framing b = still::framing_of(*model, View::iso, 1600, 300);
    ASSERT_EQ(a.camera.scale, b.camera.scale) << "the model is wider than high here";
    const Pixels narrow = still::render(*model, a, 400, 300);
    const Pixels wide = still::render(*model, b, 1600, 300);
    const auto at = [](const Pixels& pixels, int x, int y) {
        const auto* p =
            pixels.rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(pixels.width) +
                                     static_cast<std::size_t>(x));
        return std::array<int, 3>{p[0], p[1], p[2]};
    };
    int other = 0;
    for (int y = 0; y < 300; ++y) {
        for (int x = 20; x < 380; ++x) other += at(narrow, x, y) == at(wide, x + 600, y) ? 0 : 1;
    }
    EXPECT_LT(other, 300 * 360 / 100);  // rounding of places, at edges
}

// A tilted square of 100 mm, cut into so many squares a side of two triangles each, whose inner corners lie
// anywhere near their places.
still::Model cut_square(int count) {
    test::Random random(7);
    still::Model model;
    still::Face& face = model.faces.emplace_back();
    face.frame.axes = {Vec3{1, 0, 0}, Vec3{0, 0.8, 0.6}, Vec3{0, -0.6, 0.8}};
    face.color = {0.5F, 0.2F, 0.1F};
    for (int y = 0; y <= count; ++y) {
        for (int x = 0; x <= count; ++x) {
            const auto off = [&](int at) { return at % count == 0 ? 0.0 : 0.6 * random.unit() - 0.3; };
            face.points.push_back(
                face.frame.point({100.0 * (x + off(x)) / count, 100.0 * (y + off(y)) / count}));
        }
    }
    const auto number = [count](int x, int y) { return static_cast<std::uint32_t>(y * (count + 1) + x); };
    for (int y = 0; y < count; ++y) {
        for (int x = 0; x < count; ++x) {
            const std::array<std::uint32_t, 4> at{number(x, y), number(x + 1, y), number(x + 1, y + 1),
                                                  number(x, y + 1)};
            for (const std::size_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) face.indices.push_back(at.at(corner));
        }
    }
    model.plates = 1;
    return model;
}

TEST(Still, HasNoGapsBetweenTrianglesHoweverSmallTheyAre) {
    const still::Model whole = cut_square(1);
    const still::Framing framing = still::framing_of(whole, View::iso, 200, 150);
    const Pixels wanted = still::render(whole, framing, 200, 150);
    for (const int count : {7, 40, 90}) {
        const Pixels cut = still::render(cut_square(count), framing, 200, 150);
        int most = 0;
        for (std::size_t i = 0; i < wanted.rgb.size(); ++i)
            most = std::max(most, std::abs(int{wanted.rgb[i]} - int{cut.rgb[i]}));
        EXPECT_LE(most, 3) << count;
    }
}

TEST(Still, RefusesWhatIsTooLarge) {
    const Compilation run = compiled("castle.xml");
    const SceneCard card = card_of(run);
    OutputOptions options;
    options.still.size = PictureSize{20000, 20000};
    Diagnostics diagnostics("still");
    EXPECT_FALSE(std::get<StillWriter>(find_format(".view.png")->write)({&card, 1}, options, diagnostics));
    EXPECT_NE(test::findings(diagnostics).find("picture-too-large"), std::string::npos);
}

// ---- Moving pictures ----

std::string film(const SceneCard& card, std::string_view format, const OutputOptions& options) {
    Diagnostics diagnostics("film");
    const auto files = std::get<StillWriter>(find_format(format)->write)({&card, 1}, options, diagnostics);
    EXPECT_TRUE(files.has_value()) << test::findings(diagnostics);
    return files ? files->front().bytes : std::string();
}

OutputOptions short_film() {
    OutputOptions options;
    options.still.size = PictureSize{96, 72};
    options.fps = 9.0;  // while it moves, which takes 1.1 s
    options.duration_s = 2.0;
    return options;
}

// There in five steps, from the closed card to the open one, and back; the pictures are those of stills.
TEST(Film, GoesThereAndBackInAGif) {
    const Compilation run = compiled("castle.xml");
    const SceneCard card = card_of(run);
    const OutputOptions options = short_film();
    const std::string bytes = film(card, "gif", options);
    EXPECT_EQ(bytes, film(card, "gif", options));
    struct Reading {
        const std::string* bytes;
        std::size_t at = 0;
    } reading{&bytes};
    int error = 0;
    GifFileType* gif = DGifOpen(
        &reading,
        [](GifFileType* file, GifByteType* to, int length) {
            auto* const from = static_cast<Reading*>(file->UserData);
            const std::size_t count =
                std::min(static_cast<std::size_t>(length), from->bytes->size() - from->at);
            std::copy_n(from->bytes->data() + from->at, count, reinterpret_cast<char*>(to));
            from->at += count;
            return static_cast<int>(count);
        },
        &error);
    ASSERT_NE(gif, nullptr);
    ASSERT_EQ(DGifSlurp(gif), GIF_OK);
    EXPECT_EQ(gif->SWidth, 96);
    EXPECT_EQ(gif->SHeight, 72);
    ASSERT_EQ(gif->ImageCount, 10);
    // The pictures as a viewer puts them together.
    std::vector<std::vector<unsigned char>> pictures;
    std::vector<unsigned char> screen(3 * 96 * 72);
    int hundredths = 0;
    for (int i = 0; i < gif->ImageCount; ++i) {
        GraphicsControlBlock control{};
        ASSERT_EQ(DGifSavedExtensionToGCB(gif, i, &control), GIF_OK);
        hundredths += control.DelayTime;
        const SavedImage& image = gif->SavedImages[i];
        for (int y = 0; y < image.ImageDesc.Height; ++y) {
            for (int x = 0; x < image.ImageDesc.Width; ++x) {
                const GifColorType& color =
                    image.ImageDesc.ColorMap->Colors[image.RasterBits[y * image.ImageDesc.Width + x]];
                unsigned char* to =
                    screen.data() + 3 * ((y + image.ImageDesc.Top) * 96 + x + image.ImageDesc.Left);
                to[0] = color.Red;
                to[1] = color.Green;
                to[2] = color.Blue;
            }
        }
        pictures.push_back(screen);
    }
    DGifCloseFile(gif, &error);
    EXPECT_EQ(hundredths, 200);
    // The sixth is the open card, and what comes after it is what came before.
    const auto apart = [&](std::size_t a, std::size_t b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < screen.size(); ++i) sum += std::abs(pictures[a][i] - pictures[b][i]);
        return sum / static_cast<double>(screen.size());
    };
    for (std::size_t i = 1; i < 5; ++i) EXPECT_LT(apart(5 - i, 5 + i), 3.0) << i;
    for (std::size_t i = 0; i < 5; ++i) EXPECT_GT(apart(i, 5), 5.0) << i;
}

TEST(Film, IsAWebPOfAsManyFramesAndMilliseconds) {
    const Compilation run = compiled("harbour.xml");
    const SceneCard card = card_of(run);
    OutputOptions options = short_film();
    const std::string bytes = film(card, "webp", options);
    EXPECT_EQ(bytes, film(card, "webp", options));
    // RIFF: chunks of a name, a length and an even number of bytes.
    const auto number = [&](std::size_t at, int length) {
        unsigned value = 0;
        for (int i = length; i-- > 0;)
            value = value << 8U | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(i)));
        return value;
    };
    ASSERT_EQ(bytes.substr(0, 4) + bytes.substr(8, 4), "RIFFWEBP");
    ASSERT_EQ(number(4, 4) + 8U, bytes.size());
    unsigned frames = 0;
    unsigned ms = 0;
    for (std::size_t at = 12; at + 8 <= bytes.size(); at += 8 + number(at + 4, 4) + number(at + 4, 4) % 2) {
        const std::string name = bytes.substr(at, 4);
        if (name == "VP8X") {
            EXPECT_EQ(number(at + 12, 3) + 1, 96U);
            EXPECT_EQ(number(at + 15, 3) + 1, 72U);
        }
        if (name == "ANIM") {
            EXPECT_EQ(number(at + 12, 2), 0U);  // for ever
        }
        if (name != "ANMF") continue;
        ++frames;
        ms += number(at + 20, 3);
    }
    EXPECT_EQ(frames, 10U);
    EXPECT_NEAR(ms, 2000.0, 10.0);
    // One of each view.
    options.still.views = {View::iso, View::top};
    Diagnostics diagnostics("film");
    const auto files = std::get<StillWriter>(find_format("webp")->write)({&card, 1}, options, diagnostics);
    ASSERT_TRUE(files && files->size() == 2);
    EXPECT_EQ(files->back().suffix, "-top");
    EXPECT_EQ(files->front().bytes, bytes);
}

TEST(Film, TakesItsTimeHoweverManyPicturesItHas) {
    const Compilation run = compiled("castle.xml");
    const SceneCard card = card_of(run);
    OutputOptions options = short_film();
    options.fps = 70.0;  // 14.3 ms each, and GIF has at most 50
    options.duration_s = 1.0;
    const auto number = [](const std::string& bytes, std::size_t at) {
        return static_cast<unsigned char>(bytes.at(at)) + 256 * static_cast<unsigned char>(bytes.at(at + 1));
    };
    const std::string webp = film(card, "webp", options);
    int ms = 0;
    for (std::size_t at = webp.find("ANMF"); at != std::string::npos; at = webp.find("ANMF", at + 4))
        ms += number(webp, at + 20);
    EXPECT_EQ(ms, 1000);
    const std::string gif = film(card, "gif", options);
    int hundredths = 0;
    const std::string control{'\x21', '\xf9', '\x04'};
    for (std::size_t at = gif.find(control); at != std::string::npos; at = gif.find(control, at + 3)) {
        if (gif.at(at + 7) != 0 || gif.at(at + 8) != 0x2c) continue;  // chance, within a picture
        EXPECT_GE(number(gif, at + 4), 2);
        hundredths += number(gif, at + 4);
    }
    EXPECT_EQ(hundredths, 100);
    options.still.size = PictureSize{20000, 16};
    Diagnostics diagnostics("film");
    EXPECT_FALSE(std::get<StillWriter>(find_format("webp")->write)({&card, 1}, options, diagnostics));
    EXPECT_NE(test::findings(diagnostics).find("a WebP has at most 16383 a side"), std::string::npos);
}

TEST(Film, RefusesWhatIsTooLong) {
    const Compilation run = compiled("castle.xml");
    const SceneCard card = card_of(run);
    OutputOptions options;
    options.fps = 1000.0;
    options.duration_s = 1000.0;
    Diagnostics diagnostics("film");
    EXPECT_FALSE(std::get<StillWriter>(find_format("gif")->write)({&card, 1}, options, diagnostics));
    EXPECT_NE(test::findings(diagnostics).find("picture-too-large"), std::string::npos);
}

}  // namespace
}  // namespace popup
