// The house's floor plan, enforced: data flows one way, so a room includes only rooms that come before it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/run_program.h"

namespace popup {
namespace {

namespace fs = std::filesystem;

// What each room, or file beside the rooms, may include from src/. Element rows stand above check(), which
// walks the build order and lowers each element before the next; motion and pattern are neighbours that do
// not know each other.
const std::map<std::string, std::set<std::string>>& allowed_rooms() {
    static const std::map<std::string, std::set<std::string>> table{
        {"base", {}},
        {"parts", {"base"}},
        {"input", {"base", "parts"}},
        {"mechanism", {"base"}},
        {"check", {"base", "mechanism"}},
        {"motion", {"base"}},
        {"pattern", {"base"}},
        {"nest", {"base"}},
        {"layout", {"base", "nest"}},
        {"fabrication", {"base"}},
        {"output", {"base", "fabrication"}},
        {"findings", {"base"}},
        {"compile.cpp", {"base", "fabrication"}},
        {"batch", {"base"}},
        {"cli", {"base", "findings", "output", "batch"}},
        {"main.cpp", {"cli"}},
    };
    return table;
}

// The public headers in the order of the stages: a header, and a room that makes a stage, may include those
// up to it.
const std::vector<std::string>& stages() {
    static const std::vector<std::string> order{
        "units",  "diagnostics", "geometry",  "path",     "curves",    "nest",   "files",
        "design", "lines",       "part_list", "language", "mechanism", "check",  "assembly",
        "motion", "pattern",     "layout",    "profile",  "output",    "compile"};
    return order;
}

std::size_t stage_of(const std::string& header) {
    const auto at = std::find(stages().begin(), stages().end(), header);
    EXPECT_NE(at, stages().end()) << "popup/" << header << ".h has no place in the order of stages";
    return static_cast<std::size_t>(at - stages().begin());
}

// The last stage that a room may know of. The report writer alone sees the whole compilation.
std::string last_stage(const std::string& room, const std::string& file) {
    if (room == "base") return "files";
    if (room == "parts") return "part_list";
    if (room == "input") return "mechanism";
    if (room == "mechanism") return "assembly";
    if (room == "check") return "check";
    if (room == "fabrication") return "profile";
    if (room == "output" && file != "report.cpp" && file != "report.h") return "output";
    if (room == "motion" || room == "nest" || room == "pattern" || room == "layout") return room;
    return "compile";
}

struct Include {
    std::string what;
    bool quoted = false;
};

std::vector<Include> includes_of(const fs::path& path) {
    std::vector<Include> found;
    std::istringstream lines(test::read_file(path));
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("#include")) continue;
        const std::size_t open = line.find_first_of("<\"");
        if (open == std::string::npos) continue;
        const bool quoted = line[open] == '"';
        const std::size_t close = line.find(quoted ? '"' : '>', open + 1);
        found.push_back({line.substr(open + 1, close - open - 1), quoted});
    }
    return found;
}

std::vector<fs::path> sources(const fs::path& root) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        const std::string extension = entry.path().extension();
        if (extension == ".cpp" || extension == ".h") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

TEST(IncludeOrder, ARoomIncludesOnlyRoomsBeforeIt) {
    const fs::path root = fs::path(POPUP_SOURCE_DIR) / "src";
    std::size_t seen = 0;
    for (const fs::path& path : sources(root)) {
        const std::string file = fs::relative(path, root);
        const std::string room = file.substr(0, file.find('/'));
        ASSERT_TRUE(allowed_rooms().contains(room)) << file << " stands in a room the plan does not know";
        for (const Include& include : includes_of(path)) {
            if (!include.quoted) continue;
            ++seen;
            const std::string from = include.what.substr(0, include.what.find('/'));
            if (from == "popup") {
                const std::string header = fs::path(include.what).stem();
                const std::string last = last_stage(room, path.filename());
                EXPECT_LE(stage_of(header), stage_of(last)) << file << " includes " << include.what;
                if (room == "pattern") {
                    EXPECT_NE(header, "motion") << file;
                }
                if (room != "check" && room != "mechanism" && room != "output" && room != "compile.cpp" &&
                    room != "cli") {
                    EXPECT_NE(header, "check") << file << " can see the checked design";
                }
            } else if (file == "output/xml.cpp" && from == "input") {
                // The document writer spells numbers as the reader's patch does.
            } else if (from != room) {
                EXPECT_TRUE(allowed_rooms().at(room).contains(from)) << file << " includes " << include.what;
            }
        }
    }
    EXPECT_GT(seen, 100U);
}

TEST(IncludeOrder, PublicHeadersFollowTheStages) {
    for (const fs::path& path : sources(fs::path(POPUP_SOURCE_DIR) / "include/popup")) {
        for (const Include& include : includes_of(path)) {
            if (!include.quoted) {
                EXPECT_EQ(include.what.find('/'), std::string::npos)
                    << path << ": a public header must need nothing but the standard library";
                continue;
            }
            ASSERT_TRUE(include.what.starts_with("popup/")) << path << " includes " << include.what;
            EXPECT_LT(stage_of(fs::path(include.what).stem()), stage_of(path.stem())) << path;
        }
    }
}

TEST(IncludeOrder, LibrariesStayInTheirRooms) {
    // XML is read in one room; a writer lends its printer.
    const std::multimap<std::string, std::string> home{{"tinyxml2.h", "input/xml/"},
                                                       {"tinyxml2.h", "output/lightburn.cpp"},
                                                       {"tinyxml2.h", "findings/junit.cpp"},
                                                       {"CLI/", "cli/"},
                                                       {"cairo", "output/"},
                                                       {"toml++/", "base/toml_text.h"},
                                                       {"qpdf/", "output/production_pdf.cpp"},
                                                       {"png.h", "output/raster.cpp"},
                                                       {"csv.h", "batch/manifest.cpp"},
                                                       {"nettle/", "base/digest.cpp"},
                                                       {"jpeglib.h", "output/raster.cpp"},
                                                       {"tiny_gltf.h", "output/"}};
    const fs::path root = fs::path(POPUP_SOURCE_DIR) / "src";
    for (const fs::path& path : sources(root)) {
        const std::string file = fs::relative(path, root);
        for (const Include& include : includes_of(path)) {
            for (const auto& [library, first_room] : home) {
                if (include.quoted || !include.what.starts_with(library) || file == "main.cpp") continue;
                const auto [begin, end] = home.equal_range(library);
                EXPECT_TRUE(std::any_of(begin, end,
                                        [&file](const auto& row) { return file.starts_with(row.second); }))
                    << file << " includes " << include.what;
            }
        }
    }
}

// ARCHITECTURE: the stages in order on one page.
TEST(IncludeOrder, TheCompilerFitsOnOnePage) {
    const std::string text = test::read_file(fs::path(POPUP_SOURCE_DIR) / "src/compile.cpp");
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 150);
}

// Two types of one name in one namespace are one type to the linker, which then takes either's functions for
// both.
TEST(Headers, NoTwoDefineATypeOfTheSameName) {
    std::map<std::string, std::string> seen;  // namespace and name: the header
    const fs::path source = POPUP_SOURCE_DIR;
    for (const fs::path& root : {source / "include", source / "src"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root)) {
            if (entry.path().extension() != ".h") continue;
            std::istringstream text(test::read_file(entry.path()));
            std::string space;
            for (std::string line; std::getline(text, line);) {
                std::istringstream words(line);
                std::string kind;
                std::string name;
                words >> kind >> name;
                if (kind == "namespace") space = name;
                if (kind == "enum" && name == "class") words >> name;
                // Only what begins a line is at the top; "struct Name;" declares and defines nothing.
                const bool defines =
                    line.find(';') == std::string::npos || line.find('{') != std::string::npos;
                if (!(line.rfind("struct ", 0) == 0 || line.rfind("class ", 0) == 0 ||
                      line.rfind("enum ", 0) == 0) ||
                    !defines) {
                    continue;
                }
                const auto [at, fresh] = seen.try_emplace(space + "::" + name, entry.path());
                EXPECT_TRUE(fresh) << space << "::" << name << " is defined in " << at->second << " and "
                                   << entry.path();
            }
        }
    }
    EXPECT_GT(seen.size(), 100u);
}

}  // namespace
}  // namespace popup
