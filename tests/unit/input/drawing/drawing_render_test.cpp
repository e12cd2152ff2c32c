// What is read of drawings, held against the picture that another program makes of them.
#include <cairo.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/drawings.h"
#include "support/run_program.h"

namespace popup {
namespace {

using test::area;
using test::read_drawing;

// Painted with one colour, another program's picture says where there is paper: for each column and row of
// pixels as much as in the parts.
TEST(Drawing, IsWhereAnotherRendererPaintsIt) {
    if (!test::have_program("rsvg-convert")) GTEST_SKIP() << "rsvg-convert (librsvg2-bin) is not installed";
    const std::string open =
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' ";
    const std::vector<std::string> pictures{
        open +
            "width='80mm' height='60mm' viewBox='0 0 80 60'>"
            "<path d='M5 5h20v10a8 4 30 1 1-9 9l-11-3z'/><g transform='translate(40 5) rotate(25) "
            "skewX(-20)'>"
            "<rect width='20' height='12' rx='3' ry='5'/></g><ellipse cx='60' cy='45' rx='15' ry='6' "
            "transform='rotate(-40 60 45)'/><path d='M5 40C0 55 25 60 20 45S35 35 30 50t-8 5z' "
            "fill-rule='evenodd'/>"
            "</svg>",
        open +
            "width='90mm' height='40mm' viewBox='-10 5 60 70' preserveAspectRatio='xMaxYMid slice'>"
            "<defs><symbol id='s' viewBox='0 0 4 2' preserveAspectRatio='xMinYMax'><polygon points='0,0 4,0 "
            "3,2 1,2'/>"
            "</symbol></defs><use href='#s' x='0' y='30' width='15' height='15'/>"
            "<use xlink:href='#s' width='10' height='5' transform='translate(20 50) scale(1.5 -1)'/>"
            "<svg x='25' y='30' width='20' height='12' viewBox='0 0 5 5' preserveAspectRatio='none'>"
            "<circle cx='2.5' cy='2.5' r='2'/></svg></svg>",
        open +
            "width='2in' height='5cm'><style>.a{display:none}#b{visibility:hidden}</style>"
            "<rect class='a' width='1in' height='1in'/><rect id='b' width='1in' height='1in'/>"
            "<path d='M1 1m19 9a10 10 0 0120 0 10 10 0 01-20 0' transform='matrix(1.5 .5 -.4 2 10 10)'/>"
            "<polyline points='100,100 180,110 150,170 120,120'/><circle cx='80%' cy='20%' r='10%'/></svg>",
    };
    constexpr double kPerMm = 20.0;
    const test::ScratchDirectory scratch;
    for (const std::string& picture : pictures) {
        const auto reading = read_drawing(picture);
        ASSERT_TRUE(reading.list) << reading.codes();
        test::write_file(scratch / "a.svg", picture);
        const std::string zoom = std::to_string(kPerMm * 25.4 / 96.0);
        ASSERT_EQ(
            test::run({"rsvg-convert", "--zoom", zoom, scratch / "a.svg", "-o", scratch / "a.png"}).exit, 0);
        cairo_surface_t* image = cairo_image_surface_create_from_png((scratch / "a.png").c_str());
        ASSERT_EQ(cairo_surface_status(image), CAIRO_STATUS_SUCCESS);
        ASSERT_EQ(cairo_image_surface_get_format(image), CAIRO_FORMAT_ARGB32);
        const int width = cairo_image_surface_get_width(image);
        const int height = cairo_image_surface_get_height(image);
        const auto wide = static_cast<std::size_t>(width);
        std::vector<double> alpha(wide * static_cast<std::size_t>(height));
        for (std::size_t i = 0; i < alpha.size(); ++i) {
            const unsigned char* row =
                cairo_image_surface_get_data(image) +
                (i / wide) * static_cast<std::size_t>(cairo_image_surface_get_stride(image));
            alpha[i] = row[4 * (i % wide) + 3] / 255.0;
        }
        cairo_surface_destroy(image);
        // The middle of every painted pixel lies in paper, and that of every bare one does not, but at edges.
        double painted = 0.0;
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < alpha.size(); ++i) {
            painted += alpha[i] / (kPerMm * kPerMm);
            if (alpha[i] > 0.0 && alpha[i] < 1.0) continue;
            const Vec2 middle{
                (static_cast<double>(i % wide) + 0.5) / kPerMm,
                static_cast<double>(height) / kPerMm - (static_cast<double>(i / wide) + 0.5) / kPerMm};
            if (i % 7 != 0) continue;  // enough of them
            bool inside = false;
            for (const FlatPart& part : reading.parts()) {
                for (const Polygon& paper : part.paper) inside = inside || contains(paper, middle);
            }
            wrong += inside != (alpha[i] == 1.0) ? 1U : 0U;
        }
        double paper = 0.0;
        for (const FlatPart& part : reading.parts()) paper += area(part);
        EXPECT_NEAR(paper, painted, 0.002 * painted) << picture;
        EXPECT_LE(wrong, alpha.size() / 7 / 500) << picture;
        EXPECT_GT(painted, 100.0);
    }
}

}  // namespace
}  // namespace popup
