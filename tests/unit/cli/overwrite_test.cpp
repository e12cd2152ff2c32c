// Nothing that a run reads is written over by it, whatever option names it and by whatever path.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "support/run_program.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = POPUP_SOURCE_DIR;

// A directory that has one of everything that popupc reads, and other names of these.
class Overwriting : public testing::Test {
 protected:
    Overwriting() {
        const std::string card = read_file(kSource / "samples/bird.xml");
        fs::create_directories(scratch / "lib/more");
        write_file(scratch / "card.xml", card);
        write_file(scratch / "lib/one.xml", card);
        write_file(scratch / "lib/more/two.xml", card);
        write_file(scratch / "lib/.popupcignore", "old-*\n");
        write_file(scratch / "popupc.toml", "[build]\ntab-depth = \"9mm\"\n");
        write_file(scratch / "other.toml", "tab-depth = \"9mm\"\n");
        write_file(scratch / "words", "--tab-depth 9mm\n");
        write_file(scratch / "words-2.svg", "--copies 2 --sheet letter\n");
        write_file(scratch / "shape.fl", "load(\"loaded.fl\")\nsquare(20)\n");
        write_file(scratch / "loaded.fl", "define square(a) repeat (4) forward(a) left(90) done done\n");
        fs::copy_file(kSource / "samples/card-cutter.toml", scratch / "cutter.toml");
        write_file(scratch / "edits.txt", "move e1 --along 1\n");
        write_file(scratch / "shape.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>\n");
        fs::copy_file(kSource / "samples/pictures/sea.png", scratch / "sea.png");
        write_file(
            scratch / "pictured.xml",
            "<popup version=\"3.0\" units=\"mm\"><mainpage width=\"200\" height=\"140\"/><drawnlinelist>"
            "<image page=\"0\" x=\"10\" y=\"10\" width=\"20\" height=\"20\" href=\"sea.png\"/>"
            "</drawnlinelist></popup>\n");
        fs::create_symlink("card.xml", scratch / "link.svg");
        fs::create_hard_link(scratch / "lib/one.xml", scratch / "twin.txt");
        options.directory = scratch.path();
        options.environment["POPUPC_NO_CONFIG"] = "";
        const RunResult made =
            popupc({"check", "card.xml", "--baseline", "base.json", "--write-baseline"}, options);
        EXPECT_EQ(made.exit, 0) << made.err;
        write_file(scratch / "jobs.jsonl", R"({"input": "card.xml", "output": "a.svg"})"
                                           "\n"
                                           R"({"input": "lib/one.xml", "output": "twin.svg"})"
                                           "\n");
        fs::create_hard_link(scratch / "card.xml", scratch / "twin.svg");
    }
    // All files, by their names.
    [[nodiscard]] std::map<std::string, std::string> disk() const {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::recursive_directory_iterator(scratch.path())) {
            if (entry.is_regular_file())
                all[fs::relative(entry.path(), scratch.path())] = read_file(entry.path());
        }
        return all;
    }
    ScratchDirectory scratch;
    RunOptions options;
};

struct Refused {
    std::string command, said;
};

TEST_F(Overwriting, IsRefusedBeforeAnythingIsWritten) {
    const auto before = disk();
    for (const auto& [command, said] : std::vector<Refused>{
             {"fix --in-place card.xml --diagnostics card.xml",
              "--diagnostics would overwrite card.xml, an input"},
             {"fix --in-place card.xml --diagnostics ./lib/../card.xml", "the same file as card.xml"},
             {"fix --diff card.xml --diagnostics link.svg",
              "--diagnostics would overwrite link.svg, an input"},
             {"fix card.xml -o out.xml --diagnostics card.xml", "--diagnostics would overwrite card.xml"},
             {"fix card.xml -o card.xml", "-o would overwrite card.xml, an input"},
             {"fix card.xml -o popupc.toml", "-o would overwrite popupc.toml"},
             {"fix --in-place lib --diagnostics lib/one.xml", "would overwrite lib/one.xml, an input"},
             {"fix --in-place lib --diagnostics twin.txt", "the same file as lib/one.xml"},
             {"check card.xml --diagnostics card.xml", "--diagnostics would overwrite card.xml, an input"},
             {"check lib --diagnostics lib/more/two.xml", "would overwrite lib/more/two.xml, an input"},
             {"check lib --diagnostics lib/.popupcignore", "lib/.popupcignore, which says what"},
             {"check lib --diagnostics lib/more/.popupcignore", "which popupc would read in later runs"},
             {"check lib --diagnostics lib/popupc.toml", "which popupc would read in later runs"},
             {"check lib --diagnostics popupc.toml", "popupc.toml, which options are read from"},
             {"check lib --config other.toml --diagnostics other.toml", "other.toml, which options"},
             {"check @words card.xml --diagnostics words", "words, which options are read from"},
             {"check card.xml --baseline base.json --diagnostics base.json", "base.json is named twice"},
             {"check card.xml --baseline twin.svg --write-baseline",
              "--write-baseline would overwrite twin.svg"},
             {"check card.xml --baseline popupc.toml --write-baseline", "would overwrite popupc.toml"},
             {"check lib --statistics --diagnostics lib/one.xml", "lib/one.xml, an input"},
             {"check shape.fl --print shape.fl", "--print would overwrite shape.fl, an input"},
             {"check shape.fl --print loaded.fl", "loaded.fl is read by an input of this run"},
             {"build card.xml -o a.svg --diagnostics card.xml", "card.xml"},
             {"build card.xml -o a.svg --diagnostics popupc.toml",
              "popupc.toml, which options are read from"},
             {"build card.xml -o a.svg --config other.toml --diagnostics other.toml",
              "other.toml, which options"},
             {"build card.xml -o a.svg --profile cutter.toml --diagnostics cutter.toml",
              "cutter.toml, the profile"},
             {"build card.xml -o a.svg --profile cutter.toml -MD -MF cutter.toml",
              "the dependency file would overwrite cutter.toml, the profile"},
             {"build card.xml -o a.svg -MD -MF words @words", "the dependency file would overwrite words"},
             {"build card.xml -o link.svg", "link.svg is an input"},
             {"build card.xml @words-2.svg -o words-2.svg", "-o would overwrite words-2.svg"},
             {"build card.xml @words-2.svg -o words.svg", "a further sheet would overwrite words-2.svg"},
             {"build shape.fl -o a.svg --print loaded.fl", "loaded.fl is read by an input of this run"},
             {"fix card.xml -o card.xml", "--in-place writes it over its input"},
             {"fmt card.xml -o card.xml", "--in-place writes it over its input"},
             {"edit card.xml size e1 10 10 -o card.xml", "--in-place writes it over its input"},
             {"edit card.xml -f edits.txt -o edits.txt", "-o would overwrite edits.txt, which edits"},
             {"edit card.xml -f edits.txt -o a.xml --diagnostics edits.txt", "would overwrite edits.txt"},
             {"edit card.xml outline e1 --from shape.svg -o shape.svg", "-o would overwrite shape.svg"},
             {"edit card.xml outline e1 --from=shape.svg -o shape.svg", "-o would overwrite shape.svg"},
             {"edit card.xml outline e1 --from shape.svg -o a.xml --diagnostics shape.svg",
              "--diagnostics would overwrite shape.svg, a drawing"},
             {"edit pictured.xml add tent -o sea.png", "sea.png is a .png file"},
             {"fmt card.xml -o card.xml", "-o would overwrite card.xml, an input"},
             {"fmt card.xml -o popupc.toml", "-o would overwrite popupc.toml"},
             {"fmt pictured.xml -o sea.png", "sea.png is a .png file"},
             {"fmt pictured.xml -o a.xml --diagnostics sea.png", "sea.png is read by an input"},
             {"show pictured.xml --diagnostics sea.png", "sea.png is read by an input of this run"},
             {"fix pictured.xml -o a.xml --diagnostics sea.png", "sea.png is read by an input"},
             {"batch jobs.jsonl --results card.xml", "--results would overwrite"},
             {"batch jobs.jsonl -j1 -n --results jobs.jsonl", "jobs.jsonl, the manifest"},
             {"merge-reports jobs.jsonl -o twin.svg", "twin.svg"}}) {
        SCOPED_TRACE(command);
        std::vector<std::string> words;
        std::istringstream stream(command);
        for (std::string word; stream >> word;) words.push_back(word);
        const RunResult result = popupc(words, options);
        EXPECT_EQ(result.exit, 2) << result.err;
        EXPECT_NE(result.err.find(said), std::string::npos) << result.err;
        EXPECT_EQ(disk(), before);
    }
}

// The job that would write over the input of another fails; the other is done.
TEST_F(Overwriting, IsRefusedToAJobToo) {
    const std::string card = read_file(scratch / "card.xml");
    const RunResult result = popupc({"batch", "jobs.jsonl", "-j1"}, options);
    EXPECT_EQ(result.exit, 2);
    EXPECT_NE(result.err.find("would overwrite twin.svg, an input of the batch"), std::string::npos)
        << result.err;
    EXPECT_EQ(read_file(scratch / "card.xml"), card);
    EXPECT_TRUE(fs::exists(scratch / "a.svg"));
}

// What is not there cannot be lost, and a terminal may be both.
TEST_F(Overwriting, IsNoneOfDevicesAndNewFiles) {
    EXPECT_EQ(popupc({"check", "lib", "--diagnostics", "lib/new.txt"}, options).exit, 0);
    EXPECT_EQ(popupc({"fix", "card.xml", "-o", "fixed.xml", "--diagnostics", "/dev/null"}, options).exit, 0);
    EXPECT_EQ(popupc({"check", "card.xml", "--baseline", "base.json", "--write-baseline"}, options).exit, 0);
}

}  // namespace
}  // namespace popup::test
