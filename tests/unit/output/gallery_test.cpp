// The page of a gallery: what stands in it, and that nothing in it is more than text.
#include "output/gallery/gallery.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/system/digest.h"
#include "base/text/base64.h"
#include "support/viewer_page.h"

namespace popup {
namespace {

using test::between;

GalleryTile tile(const std::string& title) {
    GalleryTile one;
    one.title = title;
    one.file = "spring/" + title + ".xml";
    one.page = "designs/x.html";
    one.picture = "designs/x.jpg";
    one.elements = {{"beak", 1}, {"v-fold", 3}};
    one.width_mm = 254.04;
    one.height_mm = 203.2;
    one.pieces = 4;
    one.sheets = 1;
    return one;
}

std::string tile_of(const std::string& page) {
    return between(page, "<ul id=\"tiles\" role=\"list\">\n", "</ul>");
}

TEST(GalleryPage, SaysWhatATileHas) {
    GalleryTile one = tile("castle");
    Diagnostics told("castle.xml");
    told.warning("collision", {}, "two plates cross");
    told.warning("collision", {}, "two others cross");
    told.warning("protrusion", {}, "a plate sticks out");
    told.remark("undecided", {}, "who knows");
    tell_findings(told.sorted(), one);
    EXPECT_EQ(
        tile_of(write_gallery("Cards", std::vector{one})),
        "<li data-elements=\"beak v-fold\" data-codes=\"collision protrusion undecided\" "
        "data-worst=\"warning\" "
        "data-side=\"254\" data-pieces=\"4\"><img src=\"designs/x.jpg\" alt=\"\" width=\"480\" "
        "height=\"360\" "
        "loading=\"lazy\" decoding=\"async\"><h2><a href=\"designs/x.html\">castle</a></h2><p class=\"file\">"
        "spring/castle.xml</p><p class=\"elements\">beak, 3\u00a0×\u00a0v-fold</p><p class=\"facts\">"
        "254\u00a0×\u00a0203.2\u00a0mm, 4\u00a0pieces, 1\u00a0sheet</p><p class=\"findings\">3 "
        "warnings</p></li>\n");
}

TEST(GalleryPage, ErrorsStandInPlaceOfThePicture) {
    GalleryTile one;
    one.title = "bad";
    one.file = "bad.xml";
    one.page = "designs/bad.html";
    Diagnostics told("bad.xml");
    for (int i = 0; i < 5; ++i)
        told.error("missing-value", {i + 1, 1}, "no. " + std::to_string(i) + std::string(200, 'x'));
    tell_findings(told.sorted(), one);
    ASSERT_EQ(one.errors.size(), kTileErrors);
    const std::string html = tile_of(write_gallery("Cards", std::vector{one}));
    EXPECT_EQ(html.find("<img"), std::string::npos);
    EXPECT_NE(html.find("<div class=\"told\"><p>no. 0" + std::string(155, 'x') + " …</p>"), std::string::npos)
        << html;
    EXPECT_NE(html.find("<p>and 2 more</p></div>"), std::string::npos);
    EXPECT_NE(html.find("data-worst=\"error\""), std::string::npos);
    EXPECT_NE(html.find("<p class=\"findings\">5 errors</p>"), std::string::npos);
}

TEST(GalleryPage, NoTextIsMarkup) {
    GalleryTile one = tile("</ul><script>alert('{{script}}')</script>");
    one.file = "\"><img src=x onerror=alert(1)>\xff\n.xml";
    one.errors = {"<b>"};
    const std::string page = write_gallery("<i>&{{tiles}}", std::vector{one});
    EXPECT_NE(page.find("<h1>&lt;i&gt;&amp;{{tiles}}</h1>"), std::string::npos);
    EXPECT_NE(page.find("&lt;/ul&gt;&lt;script&gt;alert("), std::string::npos);
    EXPECT_NE(page.find("&quot;&gt;&lt;img src=x onerror=alert(1)&gt;\\xff .xml"), std::string::npos);
    EXPECT_EQ(page.find("<img src=x"), std::string::npos);
    EXPECT_EQ(page.find('\xff'), std::string::npos);
}

TEST(GalleryPage, ThePolicyLetsInWhatStandsThere) {
    const std::string page = write_gallery("Cards", {});
    const std::string script = between(page, "<script>", "</script>");
    const std::string style = between(page, "<style>", "</style>");
    EXPECT_EQ(between(page, "Content-Security-Policy\" content=\"", "\""),
              "default-src 'none'; script-src 'sha256-" + base64(sha256_bytes(script)) +
                  "'; style-src 'sha256-" + base64(sha256_bytes(style)) +
                  "'; img-src 'self' file: data:; base-uri 'none'; form-action 'none'");
    EXPECT_EQ(page.find("http"), page.find("http-equiv"));
    EXPECT_EQ(page.find("http", page.find("http-equiv") + 1), std::string::npos);
}

TEST(GalleryPage, ChoicesAreWhatDesignsHave) {
    GalleryTile other = tile("b");
    other.elements = {{"tent", 2}};
    const std::string page = write_gallery("Cards", std::vector{tile("a"), other});
    EXPECT_EQ(between(page, "<select id=\"element\">", "</select>"),
              "<option value=\"\">any</option><option value=\"beak\">beak (1)</option>"
              "<option value=\"tent\">tent (1)</option><option value=\"v-fold\">v-fold (1)</option>");
    EXPECT_NE(page.find("<p id=\"summary\">2 designs</p>"), std::string::npos);
}

TEST(GalleryPage, AThousandTilesAreLessThanAMegabyte) {
    std::vector<GalleryTile> tiles;
    for (int i = 0; i < 1000; ++i)
        tiles.push_back(tile("a design with a name of some length " + std::to_string(i)));
    const std::string page = write_gallery("Cards", tiles);
    EXPECT_LT(page.size(), 1'000'000U);
    EXPECT_EQ(page, write_gallery("Cards", tiles));
}

}  // namespace
}  // namespace popup
