// Settings that are not on the command line: popupc.toml, the environment, and which counts more.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kCard = R"(<popup version="2.0" units="mm">
  <mainpage width="200" height="150"/>
  <structurelist>
    <structure type="step" id="box">
      <outerpoints>
        <point x="-30" y="20"/> <point x="-30" y="-20"/> <point x="30" y="20"/> <point x="30" y="-20"/>
      </outerpoints>
      <parentfold> <begin x="0" y="-75"/> <end x="0" y="75"/> </parentfold>
    </structure>
  </structurelist>
</popup>
)";

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

class Config : public testing::Test {
 protected:
    void SetUp() override {
        fs::create_directories(scratch / "designs/sub");
        fs::create_directories(scratch / "other");
        for (const char* name : {"designs/card.xml", "designs/sub/card.xml", "other/card.xml"})
            write_file(scratch / name, kCard);
        options.directory = scratch.path();
        options.environment["POPUPC_NO_CONFIG"] = "";
    }
    void config(std::string_view text, const std::string& name = "designs/popupc.toml") {
        write_file(scratch / name, text);
    }
    RunResult popupc(std::vector<std::string> arguments) {
        return test::popupc(std::move(arguments), options);
    }
    // The settings that are made, a line each with the blanks in a row as one.
    std::vector<std::string> settings(std::vector<std::string> arguments) {
        arguments.emplace_back("--print-config");
        const RunResult result = popupc(arguments);
        EXPECT_EQ(result.exit, 0) << result.err;
        EXPECT_EQ(result.err, "");
        std::vector<std::string> lines;
        std::istringstream text(result.out);
        for (std::string line; std::getline(text, line) && line != "# Not set:";) {
            if (line.starts_with('#') || line.empty()) continue;
            line.erase(
                std::unique(line.begin(), line.end(), [](char a, char b) { return a == ' ' && b == ' '; }),
                line.end());
            lines.push_back(line);
        }
        return lines;
    }
    // The whole of standard error of a run that must be wrong usage and leave nothing.
    std::string refused(const std::vector<std::string>& arguments) {
        const RunResult result = popupc(arguments);
        EXPECT_EQ(result.exit, 2) << result.err;
        EXPECT_EQ(result.out, "");
        return result.err;
    }
    using Lines = std::vector<std::string>;

    ScratchDirectory scratch;
    RunOptions options;
};

TEST_F(Config, IsFoundUpwardFromTheFirstInput) {
    config("sheet = 'a3'\n");
    EXPECT_EQ(settings({"build", "designs/card.xml"}), Lines{"sheet = \"a3\" # designs/popupc.toml:1"});
    EXPECT_EQ(settings({"build", "designs/sub/card.xml"}), Lines{"sheet = \"a3\" # designs/popupc.toml:1"});
    EXPECT_EQ(settings({"build", "designs/sub/../card.xml"}),
              Lines{"sheet = \"a3\" # designs/popupc.toml:1"});
    EXPECT_EQ(settings({"check", "designs/"}), Lines{"sheet = \"a3\" # designs/popupc.toml:1"});
    EXPECT_EQ(settings({"build", "other/card.xml"}), Lines{});
    config("sheet = 'a2'\n", "popupc.toml");
    EXPECT_EQ(settings({"build", "other/card.xml"}), Lines{"sheet = \"a2\" # popupc.toml:1"});
    EXPECT_EQ(settings({"build", "-"}), Lines{"sheet = \"a2\" # popupc.toml:1"});
    EXPECT_EQ(settings({"build"}), Lines{"sheet = \"a2\" # popupc.toml:1"});
    options.directory = scratch / "designs/sub";
    EXPECT_EQ(settings({"build", "card.xml"}), Lines{"sheet = \"a3\" # ../popupc.toml:1"});
    const std::string whole = (scratch / "other/card.xml").string();
    EXPECT_EQ(settings({"build", whole}),
              Lines{fmt::format("sheet = \"a2\" # {}:1", (scratch / "popupc.toml").string())});
}

TEST_F(Config, OfADirectoryWithThatNameIsNone) {
    fs::create_directories(scratch / "designs/popupc.toml");
    EXPECT_EQ(settings({"build", "designs/card.xml"}), Lines{});
}

// It was meant to be read: to go on without it would build what nobody asked for.
TEST_F(Config, ALinkToNothingIsTold) {
    fs::create_symlink("../shared/popupc.toml", scratch / "designs/popupc.toml");
    EXPECT_TRUE(has(refused({"check", "designs/card.xml"}), "popupc.toml"));
}

TEST_F(Config, ChangesWhatARunDoes) {
    config("sheet = '300x210'\nmargin = 4\n[build]\nverbose = true\n");
    const RunResult built = popupc({"build", "designs/card.xml", "-o", "card.svg"});
    EXPECT_EQ(built.exit, 0);
    EXPECT_TRUE(has(built.err, "1 sheet of 300.0 x 210.0 mm")) << built.err;
    // A check lays sheets out when it is asked to itself, not for what holds for builds.
    config("sheet = '30x20'\n");
    EXPECT_EQ(popupc({"check", "designs/card.xml"}).exit, 0);
    config("[check]\nsheet = '30x20'\n");
    EXPECT_TRUE(has(popupc({"check", "designs/card.xml"}).err, "[piece-too-large]"));
    EXPECT_EQ(popupc({"check", "--no-config", "designs/card.xml"}).exit, 0);
    // A variable may have the value: it is the table that asks for sheets.
    options.environment["POPUPC_SHEET"] = "30x20";
    EXPECT_TRUE(has(popupc({"check", "designs/card.xml"}).err, "[piece-too-large]"));
    EXPECT_FALSE(has(popupc({"check", "--no-config", "designs/card.xml"}).err, "[piece-too-large]"));
}

TEST_F(Config, FlagsStandAboveTheEnvironmentAndThatAboveTheFile) {
    config("sheet = 'a3'\nmargin = '4mm'\nwerror = true\nspacing = 1\n");
    options.environment["POPUPC_MARGIN"] = "6mm";
    options.environment["POPUPC_SHEET"] = "a2";
    options.environment["POPUPC_WERROR"] = "0";
    EXPECT_EQ(settings({"check", "designs/card.xml", "--sheet", "a4"}),
              (Lines{"sheet = \"a4\" # --sheet", "margin = \"6mm\" # POPUPC_MARGIN",
                     "spacing = \"1\" # designs/popupc.toml:4", "werror = false # POPUPC_WERROR"}));
    options.environment.erase("POPUPC_WERROR");
    EXPECT_EQ(settings({"check", "designs/card.xml", "--werror=false"}).back(), "werror = false # --werror");
    // Empty is not set.
    options.environment["POPUPC_MARGIN"] = "";
    EXPECT_TRUE(has(settings({"check", "designs/card.xml"})[1], "margin = \"4mm\" # designs/popupc.toml:2"));
}

TEST_F(Config, AVerbsTableStandsAboveTheTop) {
    config("deny = ['collision']\n[check]\nwerror = false\nrepair = 'never'\n[build]\nwerror = true\n");
    EXPECT_EQ(
        settings({"check", "designs/card.xml"}),
        (Lines{"repair = \"never\" # designs/popupc.toml:4", "deny = [\"collision\"] # designs/popupc.toml:1",
               "werror = false # designs/popupc.toml:3"}));
    EXPECT_EQ(
        settings({"build", "designs/card.xml"}),
        (Lines{"deny = [\"collision\"] # designs/popupc.toml:1", "werror = true # designs/popupc.toml:6"}));
    // Also where they exclude each other, or one stands instead of the other.
    config("stock = 'a3'\nquiet = true\n[build]\nsheet = 'letter'\nverbose = true\n");
    EXPECT_EQ(settings({"build", "designs/card.xml"}), (Lines{"sheet = \"letter\" # designs/popupc.toml:4",
                                                              "verbose = true # designs/popupc.toml:5"}));
    config("margin = 1\n[build]\nmargin = 2\n");
    EXPECT_EQ(settings({"build", "designs/card.xml"}), Lines{"margin = \"2\" # designs/popupc.toml:3"});
}

TEST_F(Config, ListsOfAHigherLevelReplaceThoseOfALower) {
    config("deny = ['collision', 'protrusion']\nallow = 'undecided'\n");
    options.environment["POPUPC_ALLOW"] = "tab-too-small,clearance-low";
    EXPECT_EQ(settings({"check", "designs/card.xml"}),
              (Lines{"deny = [\"collision\", \"protrusion\"] # designs/popupc.toml:1",
                     "allow = [\"tab-too-small\", \"clearance-low\"] # POPUPC_ALLOW"}));
    EXPECT_EQ(
        settings({"check", "designs/card.xml", "--deny", "layer-order", "--deny", "clearance-low"}).front(),
        "deny = [\"layer-order\", \"clearance-low\"] # --deny");
}

TEST_F(Config, OptionsThatExcludeEachOtherDoNotMeetAcrossLevels) {
    config("quiet = true\nsheet = 'a3'\nnest-time = 3\n");
    EXPECT_EQ(settings({"build", "designs/card.xml", "-v", "--stock", "a4:2", "--nest-effort", "normal"}),
              (Lines{"stock = \"a4:2\" # --stock", "nest-effort = \"normal\" # --nest-effort",
                     "verbose = true # --verbose"}));
    config("quiet = true\nverbose = true\n");
    EXPECT_TRUE(
        has(refused({"build", "designs/card.xml", "-o", "x.svg"}), "designs/popupc.toml:2:11: error: "));
    config("quiet = false\nverbose = true\n");
    EXPECT_EQ(settings({"build", "designs/card.xml"}).size(), 2U);
}

TEST_F(Config, WhatIsPrintedIsAConfigurationAgain) {
    config(
        "sheet = 'a3'\nwerror = true\n[build]\nkerf = 0.2\nrotate = ['none', 'page=180']\nprofile = "
        "'cut.toml'\n"
        "speed = [\"cut=20\"]\n");
    const RunResult first = popupc({"build", "designs/card.xml", "--print-config", "--margin", "3mm"});
    write_file(scratch / "popupc.toml", first.out);
    const RunResult second = popupc({"build", "--config", "popupc.toml", "--print-config"});
    const auto without_comments = [](const std::string& text) {
        std::string rest;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            line = line.substr(0, line.find("  #"));
            if (!line.starts_with('#')) rest += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
        }
        return rest;
    };
    EXPECT_EQ(without_comments(first.out), without_comments(second.out));
    EXPECT_TRUE(has(first.out, "profile = \"designs/cut.toml\"")) << first.out;
    EXPECT_TRUE(has(first.out, "# popupc build: settings with designs/popupc.toml\n")) << first.out;
    EXPECT_FALSE(fs::exists(scratch / "x.svg"));
}

// Every key that is offered as not set is taken, by the file and by the environment.
TEST_F(Config, EveryOptionThatIsOfferedCanBeSet) {
    std::size_t seen = 0;
    for (const std::string verb : {"build", "check", "fix"}) {
        std::istringstream offered(popupc({verb, "--no-config", "--print-config"}).out);
        for (std::string line; std::getline(offered, line);) {
            const std::size_t equals = line.find(" = ");
            if (!line.starts_with("# ") || equals == std::string::npos) continue;
            if (seen++ % (test::kSanitized ? 10 : 1) != 0) continue;
            const std::string key = line.substr(2, equals - 2);
            const bool flag = line.substr(equals + 3).starts_with("true");
            // A value that no option takes must be refused by the option itself, where it stands.
            config(fmt::format("[{}]\n{} = {}\n", verb, key, flag ? "true" : "\"\\u0001\""), "popupc.toml");
            const RunResult result = popupc({verb, "--print-config"});
            std::string variable = "POPUPC_";
            for (const char c : key) variable += c == '-' ? '_' : static_cast<char>(std::toupper(c));
            RunOptions other = options;
            other.environment["POPUPC_NO_CONFIG"] = "1";
            other.environment[variable] = flag ? "1" : "\x01";
            const RunResult environment = test::popupc({verb, "--print-config"}, other);
            if (flag) {
                EXPECT_TRUE(has(result.out, key + " = true  ")) << result.out;
                EXPECT_TRUE(has(environment.out, "# " + variable + "\n")) << environment.out;
            } else if (result.exit == 0) {
                // Options that take any text: names of files.
                EXPECT_TRUE(has(result.out, key + " = ")) << key << result.out;
            } else {
                EXPECT_TRUE(has(result.err, fmt::format("popupc.toml:2:{}: error: ", key.size() + 4)))
                    << result.err;
                EXPECT_TRUE(has(environment.err, variable + ": ")) << environment.err;
            }
        }
    }
    EXPECT_GT(seen, 50U);
}

// For editors: made from what the program says can be set.
TEST_F(Config, IsWhatTheSchemaSays) {
    using Json = nlohmann::ordered_json;
    Json top = Json::object();
    Json tables = Json::object();
    std::istringstream help(popupc({"--help"}).out);
    for (std::string line; std::getline(help, line);) {
        std::istringstream words(line);
        std::string verb;
        words >> verb;
        if (!line.starts_with("  ") || !has(popupc({verb, "--help"}).out, "--print-config")) continue;
        Json& table = tables[verb] = {
            {"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
        RunOptions bare = options;
        bare.environment["POPUPC_NO_CONFIG"] = "1";
        std::istringstream offered(test::popupc({verb, "--print-config"}, bare).out);
        for (std::string one; std::getline(offered, one);) {
            const std::size_t equals = one.find(" = ");
            const std::size_t about = one.find("  # ");
            if (!one.starts_with("# ") || equals == std::string::npos || about == std::string::npos) continue;
            const std::string value = one.substr(equals + 3);
            Json kind;
            if (value.starts_with("true")) {
                kind = {{"type", "boolean"}};
            } else if (value.starts_with('[')) {
                kind = {{"type", {"array", "string", "number"}}, {"items", {{"type", {"string", "number"}}}}};
            } else {
                kind = {{"type", {"string", "number"}}};
            }
            kind["description"] = one.substr(about + 4);
            const std::string key = one.substr(2, equals - 2);
            table["properties"][key] = kind;
            if (!top.contains(key)) top[key] = kind;
        }
    }
    EXPECT_GE(tables.size(), 3U);
    for (const char* verb : {"build", "batch", "merge-reports"})
        EXPECT_TRUE(tables.contains(verb) && tables[verb]["properties"].contains("quiet")) << verb;
    for (const auto& [verb, table] : tables.items()) top[verb] = table;
    const Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                      {"title", "Settings of popupc, as a popupc.toml"},
                      {"type", "object"},
                      {"additionalProperties", false},
                      {"properties", top}};
    const fs::path file = fs::path(POPUP_SOURCE_DIR) / "schemas/popupc.schema.json";
    const char* update = std::getenv("POPUP_UPDATE");
    if (update != nullptr && std::string(update) == "1") write_file(file, schema.dump(2) + "\n");
    EXPECT_EQ(read_file(file), schema.dump(2) + "\n") << "out of date: POPUP_UPDATE=1 writes it anew";
}

TEST_F(Config, MistakesAreToldWithTheirPlaces) {
    const auto expect = [&](std::string_view text, const std::vector<std::string>& parts) {
        config(text);
        const std::string told = refused({"check", "designs/card.xml"});
        for (const std::string& part : parts) EXPECT_TRUE(has(told, part)) << part << "\n" << told;
    };
    expect("shet = 'a4'\n", {"designs/popupc.toml:1:1: error: there is no option \"shet\" [bad-config]\n"
                             "    1 | shet = 'a4'\n      | ^\n  hint: did you mean \"sheet\"?\n"});
    expect("\n[chek]\nwerror = true\n", {"designs/popupc.toml:2:", "\"chek\"", "did you mean \"check\"?"});
    expect("[check]\nkerf = 0.1\n",
           {":2:1: error: there is no option \"kerf\" of check", "hint: it is an option of build"});
    expect("[batch]\nkerv = 1\n",
           {":2:1: error: there is no option \"kerv\" of batch", "see \"popupc batch --help\""});
    expect("[fix]\ndeny = 'collision'\n", {":2:1:", "of fix", "hint: it is an option of build, check"});
    expect("output = 'x.svg'\n", {":1:1: error: \"output\" belongs to one run and cannot be configured",
                                  "hint: give --output on the command line"});
    expect("[fix]\nin-place = true\n", {":2:1: error: \"in-place\" belongs to one run"});
    expect("INPUT = 'x'\n", {":1:1: error: there is no option \"INPUT\""});
    expect("help = true\n", {"\"help\" belongs to one run"});
    expect("werror = 'yes'\n", {":1:10: error: \"werror\" takes true or false, not a string"});
    expect("margin = true\n", {":1:10: error: \"margin\" takes a string or a number, not true or false"});
    expect("margin = ['4mm']\n", {":1:10: error: \"margin\" takes a string or a number, not a list"});
    expect("deny = ['collision', true]\n",
           {":1:22: error: \"deny\" takes a list of strings, not true or false"});
    expect("deny = 1979-05-27\n", {":1:8: error: \"deny\" takes a list of strings, not a date or time"});
    expect("check = 3\n", {":1:9: error: \"check\" is a verb: its options stand in a table [check]"});
    expect("view = 3\n",
           {":1:8: error: \"view\" is a verb: its options stand in a table [view], and the option "
            "--view of build in [build]"});
    expect("sheet.x = 3\n", {"\"sheet\" takes a string or a number, not a table"});
    expect("margin = -3\nsheet = 'a9'\n",
           {":1:10: error: --margin takes a length", ":2:9: error: --sheet takes auto"});
    expect("deny = ['colision']\n",
           {":1:8: error: --deny: there is no diagnostic \"colision\"", "did you mean collision?"});
    expect("spacing = inf\n", {":1:11: error: --spacing takes"});
    expect("a = \n", {":1:", "error: this is not TOML: "});
    expect("sheet = a3\n", {":1:", "texts stand in quotes: sheet = \"a3\""});
    expect("margin = 1\nmargin = 2\n", {"designs/popupc.toml:2:", "error: this is not TOML: "});
    expect(std::string(70000, '#'), {"designs/popupc.toml: error: a configuration has at most 65536 bytes"});
    expect(std::string("a\0b", 3), {"designs/popupc.toml:1:"});
    expect("\xff = 1\n", {"designs/popupc.toml:1:", "this is not TOML"});
    expect("margin = " + std::string(60000, '['), {"designs/popupc.toml:1:", "this is not TOML"});
    // What is meant for other verbs is looked at, too.
    expect("[build]\nkerv = 1\n",
           {":2:1: error: there is no option \"kerv\" of build", "did you mean \"kerf\"?"});
    // But a verb that has nothing to configure does not ask.
    EXPECT_EQ(popupc({"explain", "collision"}).exit, 0);
    config("x = 1\n", "popupc.toml");
    EXPECT_EQ(popupc({"list", "codes"}).exit, 0);
}

TEST_F(Config, MistakesInTheEnvironmentNameTheVariable) {
    options.environment["POPUPC_SHEET"] = "a9";
    EXPECT_TRUE(
        has(refused({"check", "designs/card.xml"}), "popupc: error: POPUPC_SHEET: --sheet takes auto"));
    options.environment = {{"POPUPC_WERROR", "yes"}};
    EXPECT_EQ(refused({"check", "designs/card.xml"}),
              "popupc: error: POPUPC_WERROR takes 1, 0, true or false, not \"yes\"\n");
    options.environment = {{"POPUPC_QUIET", "1"}, {"POPUPC_VERBOSE", "1"}};
    EXPECT_TRUE(has(refused({"check", "designs/card.xml"}), "popupc: error: POPUPC_VERBOSE: "));
    // One that is no option's is not silent where settings are looked at.
    options.environment = {{"POPUPC_SHET", "a4"}};
    EXPECT_TRUE(has(popupc({"check", "--print-config"}).out,
                    "\n# POPUPC_SHET sets no option; did you mean POPUPC_SHEET?\n"));
    options.environment = {{"POPUPC_OUTPUT", "x.svg"}};
    EXPECT_TRUE(has(refused({"build", "designs/card.xml"}), "nothing to build"));
}

TEST_F(Config, AFileCanBeNamedOrSwitchedOff) {
    config("sheet = 'a3'\n");
    config("sheet = 'a2'\n", "other/mine.toml");
    const Lines mine{"sheet = \"a2\" # other/mine.toml:1"};
    EXPECT_EQ(settings({"build", "designs/card.xml", "--config", "other/mine.toml"}), mine);
    EXPECT_EQ(settings({"build", "designs/card.xml", "--no-config"}), Lines{});
    options.environment["POPUPC_CONFIG"] = "other/mine.toml";
    EXPECT_EQ(settings({"build", "designs/card.xml"}), mine);
    EXPECT_EQ(settings({"build", "designs/card.xml", "--no-config"}), Lines{});
    options.environment = {{"POPUPC_NO_CONFIG", "1"}};
    EXPECT_EQ(settings({"build", "designs/card.xml"}), Lines{});
    EXPECT_EQ(settings({"build", "designs/card.xml", "--config", "other/mine.toml"}), mine);
    EXPECT_TRUE(has(refused({"check", "designs/card.xml", "--config", "none.toml"}),
                    "none.toml: error: cannot be read: no such file or directory"));
    EXPECT_TRUE(
        has(refused({"check", "designs/card.xml", "--config", "designs"}), "designs: error: cannot be read"));
    EXPECT_TRUE(
        has(refused({"check", "designs/card.xml", "--config", ""}), "--config takes the name of a file"));
    EXPECT_TRUE(has(refused({"check", "designs/card.xml", "--config", "x", "--no-config"}), "excludes"));
}

TEST_F(Config, OneRunHasOneConfiguration) {
    config("sheet = 'a3'\n");
    const std::string told = refused({"check", "designs/card.xml", "other/card.xml"});
    EXPECT_TRUE(has(told, "designs/card.xml has designs/popupc.toml, and other/card.xml has no popupc.toml"))
        << told;
    EXPECT_TRUE(has(told, "--config FILE")) << told;
    config("sheet = 'a2'\n", "other/popupc.toml");
    EXPECT_TRUE(
        has(refused({"build", "designs/sub/card.xml", "other/card.xml", "-o", "x.svg"}),
            "designs/sub/card.xml has designs/popupc.toml, and other/card.xml has other/popupc.toml"));
    EXPECT_EQ(settings({"check", "--no-config", "designs", "card.xml"}).size(), 0U);
    EXPECT_TRUE(has(refused({"check", "designs", "card.xml"}), "card.xml has no popupc.toml"));
    EXPECT_TRUE(has(refused({"check", "designs", "other"}), "other has other/popupc.toml"));
    // The same file by another name is the same.
    EXPECT_EQ(settings({"check", "designs/card.xml", (scratch / "designs/sub/card.xml").string()}).size(),
              1U);
    EXPECT_EQ(settings({"check", "--no-config", "designs/card.xml", "other/card.xml"}).size(), 0U);
}

TEST_F(Config, OneBelowADirectoryThatIsWalkedIsNamed) {
    config("sheet = 'a2'\n", "designs/sub/popupc.toml");
    write_file(scratch / "designs/sub/card.xml", read_file(scratch / "designs/card.xml"));
    const RunResult result = popupc({"check", "designs"});
    EXPECT_TRUE(has(result.err, "designs/sub/popupc.toml: remark: this is not looked at")) << result.err;
    EXPECT_FALSE(has(popupc({"check", "designs", "--no-config"}).err, "config-ignored"));
    EXPECT_FALSE(has(popupc({"check", "designs/sub"}).err, "config-ignored"));
    options.directory = scratch / "designs";
    EXPECT_TRUE(has(popupc({"check", "."}).err, "sub/popupc.toml: remark: this is not looked at"));
    options.environment["POPUPC_CONFIG"] = "sub/popupc.toml";
    EXPECT_FALSE(has(popupc({"check", "."}).err, "config-ignored")) << "that was chosen";
}

TEST_F(Config, FilesInItCountFromItsDirectory) {
    write_file(scratch / "designs/mine.toml", "base = 'k40'\n");
    config("[build]\nprofile = 'mine.toml'\n");
    EXPECT_EQ(popupc({"build", "designs/sub/card.xml", "-o", "card.svg"}).exit, 0);
    options.directory = scratch / "designs/sub";
    EXPECT_EQ(popupc({"build", "card.xml", "-o", "card.svg"}).exit, 0);
    config("[build]\nprofile = 'k40'\n");
    EXPECT_EQ(settings({"build", "card.xml"}), Lines{"profile = \"k40\" # ../popupc.toml:2"});
    // A variable is read as the command line is: from where the program runs.
    options.environment["POPUPC_PROFILE"] = "mine.toml";
    EXPECT_TRUE(has(refused({"build", "card.xml", "-o", "card.svg"}), "mine.toml: error: cannot be read"));
}

}  // namespace
}  // namespace popup::test
