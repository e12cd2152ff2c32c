// The house's floor plan, enforced: data flows one way, so a room includes only rooms that come before it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "popup/diagnostics.h"
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
        {"assembly", {"base"}},
        {"pictures", {"base"}},
        {"trace", {"base"}},
        {"parts", {"base"}},
        {"input", {"base", "assembly", "parts"}},
        {"folded", {"base", "assembly"}},
        {"mechanism", {"base", "assembly"}},
        {"check", {"base", "mechanism"}},
        {"motion", {"base", "assembly"}},
        {"gluing", {"base", "assembly"}},
        {"pattern", {"base"}},
        {"nest", {"base"}},
        {"layout", {"base", "nest"}},
        {"fabrication", {"base"}},
        {"output", {"base", "assembly", "gluing", "fabrication", "run"}},
        {"edit", {"base", "input", "mechanism", "output"}},
        {"run", {"base"}},
        {"findings", {"base"}},
        {"codes.cpp",
         {"base", "trace", "input", "folded", "mechanism", "check", "motion", "parts", "pattern", "layout",
          "fabrication", "output", "run", "findings", "repair", "batch", "cli", "edit"}},
        {"compile.cpp", {"base", "folded", "run"}},
        {"lay_out_run.cpp", {"base", "fabrication"}},
        {"repair", {"base", "mechanism", "output"}},
        {"lsp", {"base", "input", "mechanism", "repair"}},
        {"write.cpp", {"base", "run"}},
        {"batch", {"base"}},
        {"gallery", {"base", "output", "batch"}},
        {"live", {"base"}},
        {"cli", {"base", "findings", "output", "batch", "gallery", "live", "repair", "lsp"}},
        {"main.cpp", {"cli", "findings", "batch"}},
    };
    return table;
}

// The public headers in the order of the stages: a header, and a room that makes a stage, may include those
// up to it.
const std::vector<std::string>& stages() {
    static const std::vector<std::string> order{
        "units",      "diagnostics", "geometry",     "path",      "curves",   "nest",        "print",
        "image",      "trace",       "files",        "lines",     "joints",   "assembly",    "crease_pattern",
        "refinement", "sheet_edit",  "flat_folding", "design",    "language", "mechanism",   "check",
        "motion",     "gluing",      "pattern",      "made_size", "tabs",     "layout",      "profile",
        "output",     "compile",     "find",         "write",     "edit",     "edit_drawing"};
    return order;
}

std::size_t stage_of(const std::string& header) {
    const auto at = std::find(stages().begin(), stages().end(), header);
    EXPECT_NE(at, stages().end()) << "popup/" << header << ".h has no place in the order of stages";
    return static_cast<std::size_t>(at - stages().begin());
}

// The last stage that a room may know of. The report writer alone sees the whole compilation.
std::string last_stage(const std::string& room, const std::string& file) {
    if (room == "base" || room == "run" || room == "live") return "files";
    if (room == "pictures") return "image";
    if (room == "trace") return "trace";
    if (room == "parts" || room == "assembly") return "assembly";
    if (room == "folded") return "flat_folding";
    if (room == "input") return "mechanism";
    if (room == "mechanism" || room == "check") return "check";
    if (room == "fabrication") return "profile";
    if (room == "output" && file != "report.cpp" && file != "report.h") return "output";
    if (room == "cli" || room == "edit" || room == "lsp") return "edit_drawing";
    if (room == "motion" || room == "gluing" || room == "nest" || room == "layout") return room;
    if (room == "pattern") return "tabs";
    return "write";
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
                    room != "write.cpp" && room != "cli" && room != "edit") {
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

// Every header that a file sees, through whatever others, as it is included: "base/text/utf8.h",
// "popup/units.h".
std::set<std::string> headers_seen_by(const fs::path& path) {
    const fs::path source = POPUP_SOURCE_DIR;
    std::set<std::string> seen;
    std::vector<fs::path> waiting{path};
    while (!waiting.empty()) {
        const std::vector<Include> found = includes_of(waiting.back());
        waiting.pop_back();
        for (const Include& include : found) {
            if (!include.quoted || !seen.insert(include.what).second) continue;
            waiting.push_back(source / (include.what.starts_with("popup/") ? "include" : "src") /
                              include.what);
            EXPECT_TRUE(fs::exists(waiting.back())) << path << " sees " << include.what;
        }
    }
    return seen;
}

// What a room may not include it does not see through others' headers either, but for the stages that rooms
// it may include know of: check() sees assemblies, for elements are lowered to them.
TEST(IncludeOrder, ARoomSeesNoOtherRoomThroughHeaders) {
    const fs::path root = fs::path(POPUP_SOURCE_DIR) / "src";
    for (const fs::path& path : sources(root)) {
        const std::string file = fs::relative(path, root);
        const std::string room = file.substr(0, file.find('/'));
        std::size_t last = stage_of(last_stage(room, path.filename()));
        for (const std::string& other : allowed_rooms().at(room)) {
            last = std::max(last, stage_of(last_stage(other, {})));
        }
        for (const std::string& header : headers_seen_by(path)) {
            const std::string from = header.substr(0, header.find('/'));
            if (from == "popup") {
                EXPECT_LE(stage_of(fs::path(header).stem()), last) << file << " sees " << header;
            } else if (from != room && (file != "output/xml.cpp" || from != "input")) {
                EXPECT_TRUE(allowed_rooms().at(room).contains(from)) << file << " sees " << header;
            }
        }
    }
}

// The narrow waist: what comes after the assembly does not know of elements, nor of how a design was written.
// But the document's writer writes a design, --emit prints one, and the report tells of the whole
// compilation.
TEST(IncludeOrder, NothingBehindTheWaistSeesTheDesign) {
    const std::set<std::string> behind{"parts", "motion", "gluing",      "pattern",
                                       "nest",  "layout", "fabrication", "output"};
    const std::set<std::string> before{"popup/design.h", "popup/check.h", "popup/mechanism.h",
                                       "popup/language.h", "popup/compile.h"};
    const std::set<std::string> of_designs{"output/xml", "output/emit_design", "output/report"};
    const fs::path root = fs::path(POPUP_SOURCE_DIR) / "src";
    std::size_t seen = 0;
    for (const fs::path& path : sources(root)) {
        const fs::path file = fs::relative(path, root);
        if (!behind.contains(*file.begin()) || of_designs.contains(fs::path(file).replace_extension()))
            continue;
        ++seen;
        for (const std::string& header : headers_seen_by(path)) {
            EXPECT_FALSE(before.contains(header)) << file << " sees " << header;
        }
    }
    EXPECT_GT(seen, 50U);
}

// base/ holds what several have a use for: each of its headers is included from a room, and from another
// room, a file beside the rooms, or another file of base/. What has one user only stands with that user. Each
// room has rows of codes for the one table, base/ as well.
TEST(IncludeOrder, WhatIsInBaseHasSeveralUsers) {
    const fs::path root = fs::path(POPUP_SOURCE_DIR) / "src";
    std::map<std::string, std::set<std::string>> users;  // header: rooms, or files of base/
    for (const fs::path& path : sources(root)) {
        const std::string file = fs::relative(path, root);
        const std::string room = file.substr(0, file.find('/'));
        for (const Include& include : includes_of(path)) {
            const bool own = fs::path(file).stem() == fs::path(include.what).stem() && room == "base";
            if (include.what.starts_with("base/") && !own)
                users[include.what].insert(room == "base" ? file : room);
        }
    }
    std::size_t headers = 0;
    for (const fs::path& path : sources(root / "base")) {
        const std::string header = fs::relative(path, root);
        if (path.extension() != ".h" || header == "base/diagnostics/codes.h") continue;
        ++headers;
        const std::set<std::string>& of_this = users[header];
        EXPECT_GE(of_this.size(), 2U) << header << " has one user or none";
        EXPECT_TRUE(std::any_of(of_this.begin(), of_this.end(),
                                [](const std::string& user) { return user.find('/') == std::string::npos; }))
            << header << " is included by base/ alone";
    }
    EXPECT_GT(headers, 10U);
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
                                                       {"toml++/", "base/text/toml_text.h"},
                                                       {"qpdf/", "output/qpdf.h"},
                                                       {"gif_lib.h", "output/still/gif.cpp"},
                                                       {"webp/", "output/still/webp.cpp"},
                                                       {"zlib.h", "output/viewer/deflate.cpp"},
                                                       {"png.h", "output/png.cpp"},
                                                       {"png.h", "pictures/decode_png.cpp"},
                                                       {"jpeglib.h", "pictures/decode_jpeg.cpp"},
                                                       {"png.h", "pictures/upright.cpp"},
                                                       {"turbojpeg.h", "pictures/upright.cpp"},
                                                       {"libexif/", "pictures/upright.cpp"},
                                                       {"fribidi.h", "base/text/visual_order.cpp"},
                                                       {"csv.h", "batch/manifest.cpp"},
                                                       {"boost/asio", "live/server.cpp"},
                                                       {"boost/beast", "live/server.cpp"},
                                                       {"potracelib.h", "trace/curves.cpp"},
                                                       {"nettle/", "base/system/digest.cpp"},
                                                       {"nettle/", "base/text/base64.cpp"},
                                                       {"jpeglib.h", "output/jpeg.cpp"},
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

// Who changes a stage finds what it says beside it: a room has the rows of the codes that it gives, and no
// others.
TEST(Codes, StandInARoomThatGivesThem) {
    const fs::path root = fs::path(POPUP_SOURCE_DIR) / "src";
    std::map<std::string, std::string> texts;  // of every other file, by its name below src/
    std::vector<fs::path> tables;
    for (const fs::path& path : sources(root)) {
        if (path.filename() == "codes.cpp" && path.parent_path() != root) {
            tables.push_back(path);
        } else {
            texts[fs::relative(path, root)] = test::read_file(path);
        }
    }
    std::size_t rows = 0;
    for (const fs::path& table : tables) {
        const std::string folder = fs::relative(table.parent_path(), root).string() + "/";
        const std::string text = test::read_file(table);
        for (const CodeInfo& row : code_table()) {
            const std::string quoted = '"' + std::string(row.code) + '"';
            if (text.find('{' + quoted + ',') == std::string::npos) continue;
            ++rows;
            // Files are read and written by base/system, whose codes stand with the findings.
            const std::string room = folder == "base/diagnostics/" ? "base/" : folder;
            EXPECT_TRUE(std::any_of(texts.begin(), texts.end(),
                                    [&](const auto& file) {
                                        return file.first.starts_with(room) &&
                                               file.second.find(quoted) != std::string::npos;
                                    }))
                << row.code << " has its row in " << folder << ", where nothing gives it";
        }
    }
    EXPECT_EQ(rows, code_table().size());
}

// Who reads that points are as near as kSameMm must not have to ask whose. Names in common are best defined
// once, in base/geometry/tolerances.h.
TEST(Constants, ALengthOfOneNameHasOneValue) {
    std::map<std::string, std::pair<std::string, fs::path>> seen;  // name: its value as written, and where
    for (const char* folder : {"include", "src"}) {
        for (const fs::path& path : sources(fs::path(POPUP_SOURCE_DIR) / folder)) {
            std::istringstream lines(test::read_file(path));
            for (std::string line; std::getline(lines, line);) {
                const std::size_t begin = line.find("constexpr double k");
                const std::size_t equals = line.find(" = ");
                const std::size_t end = line.find(';');
                if (begin == std::string::npos || equals == std::string::npos || end == std::string::npos)
                    continue;
                const std::size_t name_at = line.find('k', begin + 16);
                const std::string name = line.substr(name_at, equals - name_at);
                if (!name.ends_with("Mm")) continue;
                const std::string value = line.substr(equals + 3, end - equals - 3);
                const auto [at, fresh] = seen.try_emplace(name, value, path);
                EXPECT_EQ(value, at->second.first) << name << " in " << path << " and " << at->second.second;
            }
        }
    }
    EXPECT_GT(seen.size(), 30U);
}

// ARCHITECTURE: the stages in order on one page.
TEST(IncludeOrder, TheCompilerFitsOnOnePage) {
    const std::string text = test::read_file(fs::path(POPUP_SOURCE_DIR) / "src/compile.cpp");
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 150);
}

// What is longer than this has a part that could stand for itself.
TEST(IncludeOrder, FilesAreShortEnoughToBeRead) {
    for (const char* folder : {"include", "src"}) {
        for (const fs::path& path : sources(fs::path(POPUP_SOURCE_DIR) / folder)) {
            const std::string text = test::read_file(path);
            EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 600) << path;
        }
    }
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
                if (name.empty() || std::isalpha(static_cast<unsigned char>(name[0])) == 0) continue;
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

// The words in backquotes of a line, in their order.
std::vector<std::string> quoted_words(const std::string& line) {
    std::vector<std::string> words;
    for (std::size_t at = line.find('`'); at != std::string::npos; at = line.find('`', at + 1)) {
        const std::size_t end = std::min(line.find('`', at + 1), line.size());
        words.push_back(line.substr(at + 1, end - at - 1));
        at = end;
    }
    return words;
}

// docs/architecture.md has the plan as tables, for people.
TEST(IncludeOrder, TheMapHasThePlan) {
    std::istringstream lines(test::read_file(fs::path(POPUP_SOURCE_DIR) / "docs/architecture.md"));
    std::map<std::string, std::set<std::string>> rooms;
    std::vector<std::string> headers;
    bool in_rooms = false;
    bool in_headers = false;
    for (std::string line; std::getline(lines, line);) {
        if (line == "| room | what it is for | may include |") in_rooms = true;
        if (line == "<!-- headers -->") in_headers = true;
        if (line.empty()) in_rooms = false;
        if (line.empty() && !headers.empty()) in_headers = false;
        if (in_rooms && line.starts_with("| `")) {
            const std::string name = quoted_words(line).front();
            const std::vector<std::string> others =
                quoted_words(line.substr(line.rfind('|', line.size() - 2)));
            rooms[name] = {others.begin(), others.end()};
        } else if (in_headers && line.starts_with('`')) {
            const std::vector<std::string> words = quoted_words(line);
            headers.insert(headers.end(), words.begin(), words.end());
        }
    }
    EXPECT_EQ(rooms, allowed_rooms());
    EXPECT_EQ(headers, stages());
}

}  // namespace
}  // namespace popup
