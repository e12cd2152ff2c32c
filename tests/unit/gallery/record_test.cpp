// The record of a gallery: rows that survive being written down, and files that are known as its own.
#include "gallery/record.h"

#include <gtest/gtest.h>

#include "support/run_program.h"

namespace popup::test {
namespace {

GalleryRow row_of(const std::string& label) {
    GalleryRow row;
    row.label = label;
    row.result.command = "c0";
    row.result.status = JobStatus::failed;
    row.result.inputs = {{label, 12, "aa"}, {"parts/\xff\n.fl", 0, ""}};
    row.result.outputs = {{"designs/x.html", 3, "bb"}};
    row.result.errors = 1;
    row.result.warnings = 1;
    GalleryTile& tile = row.tile.emplace();
    tile.title = "x";
    tile.file = label;
    tile.page = "designs/x.html";
    tile.elements = {{"beak", 1}, {"tent", 20}};
    tile.width_mm = 254.0;
    tile.height_mm = 203.2;
    tile.pieces = 3;
    tile.sheets = 2;
    Diagnostics told(label);
    told.error("piece-too-large", {}, "it does not fit").hint("take a larger sheet");
    told.warning("tent-too-narrow", {4, 5}, "\"tent\": <b>")
        .about("tent")
        .with({7, 1}, "fire")
        .changed("1", "2");
    row.findings = told.sorted();
    tell_findings(row.findings, tile);
    return row;
}

TEST(GalleryRecord, RowsComeBackAsTheyWere) {
    const GalleryRow row = row_of("a \xff\"\n/x.xml");
    const std::string line = to_line(row);
    EXPECT_EQ(line.find('\n'), line.size() - 1);
    const auto back = gallery_row_of(line);
    ASSERT_TRUE(back);
    EXPECT_EQ(to_line(*back), line);
    EXPECT_EQ(back->label, row.label);
    EXPECT_EQ(back->result.inputs, row.result.inputs);
    EXPECT_EQ(back->result.outputs, row.result.outputs);
    ASSERT_EQ(back->findings.size(), 2U);
    EXPECT_EQ(back->findings[0].hints, row.findings[0].hints);
    EXPECT_EQ(back->findings[1].place, (Place{4, 5}));
    EXPECT_EQ(back->findings[1].element, "tent");
    EXPECT_EQ(back->findings[1].related.at(0).text, "fire");
    EXPECT_EQ(back->findings[1].change->after, "2");
    ASSERT_TRUE(back->tile);
    EXPECT_EQ(back->tile->elements, row.tile->elements);
    EXPECT_EQ(back->tile->errors, std::vector<std::string>{"it does not fit"});
    EXPECT_EQ(back->tile->findings.size(), 2U);
    EXPECT_EQ(back->tile->title, "x");
}

TEST(GalleryRecord, WhatIsNoRowIsPassedOver) {
    const std::string line = to_line(row_of("x.xml"));
    for (const std::string& broken : {std::string(), std::string("{}"), line.substr(0, line.size() / 2),
                                      std::string("{\"key\":\"x\"}"), std::string("[1,2]")}) {
        EXPECT_FALSE(gallery_row_of(broken)) << broken;
    }
    // A diagnostic of another version.
    std::string other = line;
    other.replace(other.find("piece-too-large"), 15, "piece-too-green");
    EXPECT_FALSE(gallery_row_of(other));
}

TEST(GalleryRecord, TheLastLineCountsAndAllFilesAreKnown) {
    const ScratchDirectory scratch;
    GalleryRow first = row_of("x.xml");
    GalleryRow second = row_of("x.xml");
    second.result.outputs = {{"designs/x.html", 4, "cc"}, {"designs/x.jpg", 4, "dd"}};
    write_file(scratch / "record",
               to_line(first) + "torn{\n" + to_line(second) + to_line(second).substr(0, 40));
    GalleryRecord record;
    Diagnostics trouble;
    ASSERT_TRUE(record.read(scratch / "record", trouble));
    ASSERT_EQ(record.rows().size(), 1U);
    EXPECT_EQ(record.find("x.xml")->result.outputs, second.result.outputs);
    EXPECT_TRUE(record.has_written({"designs/x.html", 3, "bb"}));
    EXPECT_TRUE(record.has_written({"designs/x.html", 4, "cc"}));
    EXPECT_FALSE(record.has_written({"designs/x.jpg", 4, "cc"}));
    EXPECT_FALSE(record.has_written({"designs/y.jpg", 4, "dd"}));
    EXPECT_TRUE(record.read(scratch / "none", trouble));
    EXPECT_FALSE(record.read(scratch.path(), trouble));
    EXPECT_TRUE(trouble.has_errors());
}

}  // namespace
}  // namespace popup::test
