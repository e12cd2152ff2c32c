// Crease patterns that nobody would draw. Seeded, so that a failure comes again.
//
// Whatever the bytes, reading and folding end, crash nothing, and say what is wrong where it stands; and
// whatever is folded holds what assemblies promise: no loop that is said to close is open at any opening
// looked at.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "input/assembly/guarantees.h"
#include "popup/language.h"
#include "popup/motion.h"
#include "popup/pattern.h"
#include "support/mutate_json.h"
#include "support/random.h"
#include "support/sanitized.h"

namespace popup {
namespace {

using test::Random;
using test::sanitized_count;

// A Miura corner with its four panels; a box of slits on a fold; a card with a window and a fold that
// dangles.
const std::vector<std::string>& seeds() {
    static const std::vector<std::string> texts{
        R"({"file_spec": 1.2, "vertices_coords": [[0,0],[20,0],[40,0],[5,20],[25,20],[45,20],[0,40],[20,40],[40,40]],
"edges_vertices": [[0,1],[1,2],[2,5],[5,8],[8,7],[7,6],[6,3],[3,0],[1,4],[4,7],[3,4],[4,5]],
"edges_assignment": ["B","B","B","B","B","B","B","B","V","V","M","V"],
"edges_foldAngle": [0,0,0,0,0,0,0,0,180,180,-180,180], "frame_unit": "mm"})",
        R"({"vertices_coords": [[0,0],[100,0],[100,160],[0,160],[0,80],[30,80],[70,80],[100,80],[30,60],[70,60],
[30,100],[70,100]], "edges_vertices": [[0,1],[1,7],[7,2],[2,3],[3,4],[4,0],[4,5],[6,7],[5,6],[8,9],[10,11],
[8,5],[5,10],[9,6],[6,11]],
"edges_assignment": ["B","B","B","B","B","B","V","V","M","V","V","C","C","C","C"]})",
        R"({"frame_classes": ["foldedForm"], "vertices_coords": [[0,0,0],[1,0,0],[0,1,1]], "file_frames": [
{"frame_classes": ["creasePattern"], "vertices_coords": [[0,0],[1,0],[1,1],[0,1],[0.5,0],[0.5,1],[0.2,0.5]],
"edges_vertices": [[0,4],[4,1],[1,2],[2,5],[5,3],[3,0],[4,5],[6,4]], "faces_vertices": [[0,4,5,3],[4,1,2,5]],
"edges_assignment": ["B","B","B","B","B","B","U","F"]},
{"frame_parent": 1, "frame_inherit": true, "edges_foldAngles": [0,0,0,0,0,0,90,null]}]})"};
    return texts;
}

void expect_sound(const std::string& text) {
    Diagnostics diagnostics("sheet.fold");
    const Source source{"sheet.fold", text};
    const Reading reading = read_source_text(source, {}, diagnostics);
    const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
    for (const Diagnostic& one : diagnostics.sorted()) {
        EXPECT_GE(one.place.line, 0);
        EXPECT_LE(one.place.line, lines);
    }
    if (!reading.creases) {
        EXPECT_TRUE(diagnostics.has_errors()) << text;
        return;
    }
    const auto assembly = fold_sheet(*reading.creases, {}, diagnostics);
    if (!assembly) {
        EXPECT_TRUE(diagnostics.has_errors()) << text;
        return;
    }
    for (const AssemblyFault& fault : faults_of(*assembly)) ADD_FAILURE() << fault.what << "\n" << text;
    std::vector<Frame> frames(assembly->plates.size());
    for (const double share : {0.0, 0.1, 0.37, 0.81, 1.0}) {
        const double deg =
            assembly->sweep.from_deg + share * (assembly->sweep.to_deg - assembly->sweep.from_deg);
        ASSERT_TRUE(place(*assembly, Angle::degrees(deg), frames)) << text;
        EXPECT_LT(closure_error(*assembly, frames), 1e-6) << text << " at " << deg;
    }
    EXPECT_TRUE(make_pattern(*assembly, {}, diagnostics)) << text;
}

TEST(FoldFuzz, SeedsAreSound) {
    for (const std::string& text : seeds()) expect_sound(text);
}

TEST(FoldFuzz, DamagedBytes) {
    Random random(11);
    for (int i = 0; i < sanitized_count(1500); ++i)
        expect_sound(test::mutated_bytes(seeds()[random.below(seeds().size())], random));
}

TEST(FoldFuzz, DamagedValues) {
    Random random(12);
    for (int i = 0; i < sanitized_count(1500); ++i)
        expect_sound(test::mutated_values(seeds()[random.below(seeds().size())], random));
}

// Corners anywhere near a grid, and edges of all kinds between them.
TEST(FoldFuzz, RandomPatterns) {
    Random random(13);
    for (int i = 0; i < sanitized_count(300); ++i) {
        test::Json file;
        const std::size_t corners = 4 + random.below(12);
        for (std::size_t k = 0; k < corners; ++k)
            file["vertices_coords"].push_back(
                {static_cast<double>(random.below(5)) + (random.below(3) == 0 ? 0.01 * random.unit() : 0.0),
                 static_cast<double>(random.below(5))});
        const std::size_t edges = 4 + random.below(24);
        for (std::size_t k = 0; k < edges; ++k) {
            file["edges_vertices"].push_back({random.below(corners), random.below(corners)});
            file["edges_assignment"].push_back(std::string(1, "BBCMVMVUF"[random.below(9)]));
        }
        expect_sound(file.dump());
    }
}

}  // namespace
}  // namespace popup
