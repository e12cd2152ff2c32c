// The command line, run as users run it: exit codes, who gets standard output, and what is left on the disk.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "popup/diagnostics.h"
#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

// A card with one step; nothing about it is doubtful.
constexpr std::string_view kCard = R"(<?xml version="1.0" encoding="UTF-8"?>
<popup version="2.0" units="mm">
  <mainpage width="200" height="150"/>
  <structurelist>
    <structure type="step" id="box">
      <outerpoints>
        <point x="-30" y="20"/>
        <point x="-30" y="-20"/>
        <point x="30" y="20"/>
        <point x="30" y="-20"/>
      </outerpoints>
      <parentfold page="0">
        <begin x="0" y="-75"/>
        <end x="0" y="75"/>
      </parentfold>
    </structure>
  </structurelist>
</popup>
)";

std::string with(std::string text, std::string_view what, std::string_view replacement) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos);
    return text.replace(at, what.size(), replacement);
}

// One side of the step is not parallel to the fold: a repair.
std::string crooked() { return with(std::string(kCard), "x=\"30\" y=\"20\"", "x=\"34\" y=\"20\""); }

// A wing that folds down onto a mouth and through it; nothing needs a repair.
constexpr std::string_view kCrossing = R"(<popup version="2.0" units="mm">
  <mainpage width="280" height="220"/>
  <structurelist>
    <structure type="v-fold" id="wing">
      <outerpoints>
        <point x="-60" y="20"/>         <point x="0" y="-20"/> <point x="60" y="20"/>
        <point x="-65.355" y="30.475"/> <point x="0" y="0"/>   <point x="65.355" y="30.475"/>
        <point x="62" y="80"/>          <point x="-62" y="80"/>
      </outerpoints>
      <parentfold> <begin x="0" y="-100"/> <end x="0" y="100"/> </parentfold>
    </structure>
    <structure type="beak" id="mouth">
      <outerpoints>
        <point x="0" y="-30"/> <point x="-30" y="-60"/> <point x="30" y="-60"/>
      </outerpoints>
      <parentfold> <begin x="0" y="-100"/> <end x="0" y="100"/> </parentfold>
    </structure>
  </structurelist>
</popup>
)";

class Cli : public testing::Test {
 protected:
    void SetUp() override {
        options.directory = scratch.path();
        write_file(scratch / "card.xml", kCard);
    }
    RunResult popupc(std::vector<std::string> arguments) {
        return test::popupc(std::move(arguments), options);
    }
    // Wrong usage: 2, a word on standard error that holds `part`, nothing on standard output, nothing new on
    // the disk.
    void expect_usage_error(const std::vector<std::string>& arguments, const std::string& part) {
        const auto before = scratch.names();
        const RunResult result = popupc(arguments);
        std::string line = "popupc";
        for (const std::string& word : arguments) line += " " + word;
        EXPECT_EQ(result.exit, 2) << line;
        EXPECT_EQ(result.out, "") << line;
        EXPECT_NE(result.err.find(part), std::string::npos) << line << "\n" << result.err;
        EXPECT_EQ(scratch.names(), before) << line;
    }
    ScratchDirectory scratch;
    RunOptions options;
};

TEST_F(Cli, ACleanCardBuildsInSilence) {
    const RunResult result = popupc({"build", "card.xml", "-o", "card.svg", "-o", "card.pdf", "-o",
                                     "card.glb", "-o", "card.gltf", "-o", "again.xml", "-o", "card.json"});
    EXPECT_EQ(result.exit, 0) << result.err;
    EXPECT_EQ(result.out + result.err, "");
    EXPECT_EQ(scratch.names(), (std::vector<std::string>{"again.xml", "card.glb", "card.gltf", "card.json",
                                                         "card.pdf", "card.svg", "card.xml"}));
    for (const std::string& name : scratch.names()) EXPECT_GT(read_file(scratch / name).size(), 100U) << name;
    EXPECT_EQ(popupc({"check", "card.xml"}).exit, 0);
    EXPECT_EQ(popupc({"fix", "--diff", "card.xml"}).exit, 0);
}

TEST_F(Cli, HelpAndVersionGoToStandardOutput) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                      {"--version"},
                                                      {"build", "--help"},
                                                      {"check", "-h"},
                                                      {"fix", "--help"},
                                                      {"explain", "--help"},
                                                      {"list", "--help"}}) {
        const RunResult result = popupc(arguments);
        EXPECT_EQ(result.exit, 0) << arguments.front();
        EXPECT_NE(result.out, "");
        EXPECT_EQ(result.err, "");
        std::size_t width = 0;
        for (std::size_t begin = 0; begin < result.out.size();) {
            const std::size_t end = std::min(result.out.find('\n', begin), result.out.size());
            width = std::max(width, end - begin);
            begin = end + 1;
        }
        EXPECT_LE(width, 100U) << arguments.front();
    }
}

TEST_F(Cli, WrongUsageIsTwoAndSaysWhatIsRight) {
    expect_usage_error(
        {}, "verbs: build check view fix edit show new fmt batch merge-reports gallery trace suggest lsp");
    expect_usage_error({"biuld", "card.xml"}, "did you mean build?");
    expect_usage_error({"build", "card.xml", "--shet", "a4", "-o", "x.pdf"}, "did you mean --sheet?");
    expect_usage_error({"build"}, "INPUT is missing: build needs documents");
    expect_usage_error({"merge-reports", "-o", "-"},
                       "MANIFEST is missing: merge-reports needs the batch's manifest");
    expect_usage_error({"merge-reports", "a.jsonl", "-o", "-", "--missing", "-"},
                       "standard output has two users: the report and the rows of what is missing");
    expect_usage_error({"build", "card.xml"}, "-o");
    expect_usage_error({"build", "card.xml", "-o"}, "--output");
    expect_usage_error({"build", "card.xml", "-o", "x.doc"}, ".svg");
    expect_usage_error({"build", "card.xml", "-o", "-"}, "--to");
    expect_usage_error({"build", "card.xml", "-o", "x.pdf", "--to", "svg"}, "--to");
    expect_usage_error({"build", "card.xml", "-o", "-", "--to", "doc"}, ".svg");
    expect_usage_error({"build", "card.xml", "-o", "x.pdf", "-o", "./x.pdf"}, "same output");
    expect_usage_error({"build", "card.xml", "-o", "card.xml"}, "is an input");
    expect_usage_error({"build", "card.xml", "card.xml", "-o", "both.xml"}, "one document");
    expect_usage_error({"build", "card.xml", "-o", "-", "--to", "svg", "--emit", "design"},
                       "more than one user");
    expect_usage_error({"build", "card.xml", "-o", "-", "--to", "svg", "--message-format", "json"},
                       "more than one user");
    expect_usage_error({"build", "card.xml", "-o", "x.pdf", "--diagnostics", "x.pdf"}, "twice");
    expect_usage_error({"build", "-", "-", "-o", "x.pdf"}, "only once");
    expect_usage_error({"build", "card.xml", "-o", "x.pdf", "--kerf", "slit=0.1"}, "--kerf takes WIDTH");
    expect_usage_error({"build", "card.xml", "-o", "x.pdf", "--profile", "k41"}, "workshop");
    expect_usage_error({"build", "card.xml", "-o", "x.pdf", "--emit", "plates"}, "assembly");
    expect_usage_error({"check", "card.xml", "--message-format", "sariff"}, "did you mean sarif");
    expect_usage_error({"check", "card.xml", "--deny", "no-such-code"}, "popupc list codes");
    expect_usage_error({"check", "card.xml", "--quiet", "--verbose"}, "--quiet");
    expect_usage_error({"check", "card.xml", "--solver", "iterative", "--clearance", "1"}, "closed form");
    expect_usage_error(
        {"build", "card.xml", "--paper-thickness", "1", "--solver", "iterative", "-o", "x.pdf"},
        "closed form");
    expect_usage_error({"fix", "card.xml", "card.xml"}, "--in-place");
    expect_usage_error({"fix", "--diff", "--in-place", "card.xml"}, "--diff");
    expect_usage_error({"fix", "card.xml", "-o", "x.pdf"}, "document");
    expect_usage_error({"explain", "unreadble-input"}, "did you mean unreadable-input?");
    expect_usage_error({"list", "papers"}, "sheets");
}

TEST_F(Cli, ValuesOutOfRangeAreTwo) {
    for (const auto& [option, values] : std::vector<std::pair<std::string, std::vector<std::string>>>{
             {"--angles",
              {"", "x", "0:180", "0:180:0", "180:0:5", "0:181:5", "-1", "nan", "0x10", "0:180:1e-9", "1,,2"}},
             {"--margin", {"", "-1", "x", "5km", "nan", "inf", "1e999"}},
             {"--spacing", {"-1", "1 2"}},
             {"--tab-depth", {"0", "-5"}},
             {"--clearance", {"", "0", "-1", "x", "5km", "nan", "inf"}},
             {"--paper-thickness", {"", "0", "-0.1", "thin"}},
             {"--copies", {"0", "1.5", "-1", "1e9", ""}},
             {"--scale", {"0", "-1", "nan"}},
             {"--sheet", {"", "a99", "0x5", "10x", "10x-5", "1e400x5", "10x10furlongs"}},
             {"--rotate", {"", "sideways", "-90", "0"}},
             {"--solver", {"magic"}},
             {"--repair", {"maybe"}},
             {"--color", {"red"}},
             {"-j", {"0", "x", "1.5", "99999"}},
             {"--fps", {"0", "-1", "x"}},
             {"--fold-dialect", {"", "Strict", "simulator,strict"}},
             {"--duration", {"0", "inf"}}}) {
        for (const std::string& value : values) {
            expect_usage_error(
                {"build", "card.xml", "-o", "x.pdf", option + (option == "-j" ? "" : "=") + value}, "");
        }
    }
}

TEST_F(Cli, UnreadableInputIsTwoAndTheOthersAreStillLookedAt) {
    write_file(scratch / "bad.xml", "<popup>");
    const RunResult result =
        popupc({"build", "missing.xml", "bad.xml", ".", "card.xml", "-o", "x.pdf", "--from", "xml"});
    EXPECT_EQ(result.exit, 2);
    const std::size_t missing = result.err.find("missing.xml: error: ");
    const std::size_t bad = result.err.find("bad.xml:");
    const std::size_t directory = result.err.find("\n.: error: ");
    ASSERT_NE(directory, std::string::npos) << result.err;
    EXPECT_LT(missing, bad);
    EXPECT_LT(bad, directory);
    EXPECT_EQ(scratch.names(), (std::vector<std::string>{"bad.xml", "card.xml"}));
}

TEST_F(Cli, AFailedRunLeavesEveryOldOutputAlone) {
    write_file(scratch / "bad.xml", "<popup>");
    write_file(scratch / "old.svg", "old");
    EXPECT_EQ(popupc({"build", "bad.xml", "-o", "old.svg", "-o", "new.pdf"}).exit, 1);
    EXPECT_EQ(popupc({"build", "card.xml", "bad.xml", "-o", "old.svg", "-o", "new.pdf"}).exit, 1);
    EXPECT_EQ(popupc({"build", "card.xml", "-o", "old.svg", "-o", "nowhere/new.pdf"}).exit, 2);
    EXPECT_EQ(popupc({"build", "card.xml", "-o", "old.svg", "--sheet", "50x50"}).exit, 1);
    EXPECT_EQ(read_file(scratch / "old.svg"), "old");
    EXPECT_EQ(scratch.names(), (std::vector<std::string>{"bad.xml", "card.xml", "old.svg"}));
}

TEST_F(Cli, StandardInputAndOutput) {
    options.input = kCard;
    const RunResult piped = popupc({"build", "-", "-o", "-", "--to", "svg"});
    EXPECT_EQ(piped.exit, 0) << piped.err;
    EXPECT_EQ(popupc({"build", "card.xml", "-o", "card.svg"}).exit, 0);
    EXPECT_NE(piped.out.find("<svg"), std::string::npos);
    options.input = "<popup>";
    const RunResult bad = popupc({"check", "-"});
    EXPECT_EQ(bad.exit, 1);
    EXPECT_EQ(bad.err.find("<stdin>:"), 0U) << bad.err;
}

TEST_F(Cli, EverySheetIsAFile) {
    const RunResult one = popupc(
        {"build", "card.xml", "--copies", "3", "--sheet", "220x170", "-o", "run.svg", "-o", "run.pdf"});
    EXPECT_EQ(one.exit, 0) << one.err;
    EXPECT_EQ(scratch.names(),
              (std::vector<std::string>{"card.xml", "run-2.svg", "run-3.svg", "run.pdf", "run.svg"}));
    expect_usage_error({"build", "card.xml", "--copies", "2", "--sheet", "220x170", "-o", "-", "--to", "svg"},
                       "parts make 2");
    expect_usage_error(
        {"build", "card.xml", "--copies", "2", "--sheet", "220x170", "-o", "x.svg", "-o", "x-2.svg"},
        "two outputs of this run would have this name");
}

TEST_F(Cli, CheckTellsAndWritesNothing) {
    write_file(scratch / "crooked.xml", crooked());
    const RunResult found = popupc({"check", "crooked.xml"});
    EXPECT_EQ(found.exit, 1);
    EXPECT_EQ(found.out, "");
    EXPECT_NE(found.err.find(": warning: "), std::string::npos) << found.err;
    EXPECT_NE(popupc({"check", "crooked.xml", "--repair", "never"}).err.find(": error: "), std::string::npos);
    EXPECT_EQ(popupc({"check", "card.xml", "--sheet", "50x50"}).exit, 1);
    EXPECT_EQ(scratch.names(), (std::vector<std::string>{"card.xml", "crooked.xml"}));
}

TEST_F(Cli, ACollisionIsAWarningThatShowsBothElements) {
    write_file(scratch / "crossing.xml", kCrossing);
    const RunResult found = popupc({"check", "crossing.xml"});
    EXPECT_EQ(found.exit, 1);
    EXPECT_EQ(found.err.find("crossing.xml:12:5: warning: "), 0U) << found.err;
    EXPECT_NE(
        found.err.find(" [collision]\n   12 |     <structure type=\"beak\" id=\"mouth\">\n      |     ^\n"
                       "  with: crossing.xml:4:5: \"wing\"\n"
                       "    4 |     <structure type=\"v-fold\" id=\"wing\">\n      |     ^\n  hint: "),
        std::string::npos)
        << found.err;
    const RunResult allowed = popupc({"check", "crossing.xml", "--allow", "collision"});
    EXPECT_EQ(allowed.exit, 0) << allowed.err;
    EXPECT_EQ(popupc({"build", "crossing.xml", "-o", "x.glb", "--deny", "collision"}).exit, 1);
    EXPECT_FALSE(std::filesystem::exists(scratch / "x.glb"));
    // Allowed or not, the report and the model have it.
    const RunResult built =
        popupc({"build", "crossing.xml", "--allow", "collision", "-o", "x.json", "-o", "x.gltf"});
    EXPECT_EQ(built.exit, 0) << built.err;
    const auto motion = nlohmann::json::parse(read_file(scratch / "x.json"))["inputs"][0]["motion"];
    ASSERT_EQ(motion["collisions"].size(), 2U);
    EXPECT_EQ(motion["collisions"][0]["plates"], nlohmann::json({"wing/left", "mouth/left"}));
    const auto first =
        std::find(motion["angles"].begin(), motion["angles"].end(), motion["collisions"][0]["to_deg"]);
    EXPECT_NE(first, motion["angles"].end());
    EXPECT_NE(read_file(scratch / "x.gltf").find("\"name\": \"collision\""), std::string::npos);
}

TEST_F(Cli, ClearanceAndThicknessAreLookedAtWhenAskedFor) {
    const std::string boat = std::string(POPUP_SOURCE_DIR) + "/samples/boat.xml";
    const auto motion = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"build", boat, "-q", "-o", "x.json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(popupc(arguments).exit, 0);
        return nlohmann::json::parse(read_file(scratch / "x.json"))["inputs"][0]["motion"];
    };
    const auto plain = motion({});
    EXPECT_TRUE(plain["clearance"].is_null());
    EXPECT_TRUE(plain["closed_thickness_mm"].is_null());
    EXPECT_EQ(motion({"--clearance", "0.001mm"})["clearance"], nlohmann::json::array());
    const auto asked = motion({"--clearance", "0.2cm", "--paper-thickness", "0.5"});
    ASSERT_FALSE(asked["clearance"].empty());
    EXPECT_LT(asked["clearance"][0]["least_mm"].get<double>(), 2.0);
    EXPECT_EQ(asked["closed_thickness_mm"].get<double>(), 0.5 * asked["max_layers"].get<int>());

    EXPECT_EQ(popupc({"check", boat}).exit, 0);
    const RunResult near = popupc({"check", boat, "--clearance", "2"});
    EXPECT_EQ(near.exit, 1);
    EXPECT_NE(near.err.find("[clearance-low]"), std::string::npos) << near.err;
    const RunResult thick = popupc({"check", boat, "--paper-thickness", "0.5", "-v"});
    EXPECT_EQ(thick.exit, 0);
    EXPECT_EQ(
        thick.err,
        fmt::format("popupc: {}: closed, up to {} plates lie on one another, covers included, {:.2f} mm\n",
                    boat, asked["max_layers"].get<int>(), asked["closed_thickness_mm"].get<double>()));
}

TEST_F(Cli, WarningsFailABuildOnlyUnderWerrorOrDeny) {
    write_file(scratch / "crooked.xml", crooked());
    const RunResult json = popupc({"build", "crooked.xml", "-o", "x.svg", "--message-format", "json"});
    EXPECT_EQ(json.exit, 0);
    EXPECT_EQ(json.err, "");
    const std::string code = nlohmann::json::parse(json.out.substr(0, json.out.find('\n')))["code"];
    std::filesystem::remove(scratch / "x.svg");
    EXPECT_EQ(popupc({"build", "crooked.xml", "-o", "x.svg", "--werror"}).exit, 1);
    EXPECT_EQ(popupc({"build", "crooked.xml", "-o", "x.svg", "--deny", code}).exit, 1);
    EXPECT_FALSE(std::filesystem::exists(scratch / "x.svg"));
    const RunResult allowed = popupc({"build", "crooked.xml", "-o", "x.svg", "--allow", code, "--werror"});
    EXPECT_EQ(allowed.exit, 0);
    EXPECT_EQ(allowed.err, "");
    EXPECT_EQ(popupc({"check", "crooked.xml", "--allow", code}).exit, 0);
}

TEST_F(Cli, DiagnosticsGoWhereTheUserWantsThem) {
    write_file(scratch / "bad.xml", "<popup>");
    const RunResult json = popupc({"check", "bad.xml", "--message-format", "json"});
    EXPECT_EQ(json.err, "");
    EXPECT_EQ(nlohmann::json::parse(json.out)["severity"], "error");
    const RunResult filed =
        popupc({"check", "bad.xml", "--message-format", "json", "--diagnostics", "d.jsonl"});
    EXPECT_EQ(filed.out + filed.err, "");
    EXPECT_EQ(read_file(scratch / "d.jsonl"), json.out);
    const RunResult brief = popupc({"check", "bad.xml", "--message-format", "short"});
    EXPECT_EQ(std::count(brief.err.begin(), brief.err.end(), '\n'), 1);
    EXPECT_EQ(popupc({"check", "bad.xml", "--diagnostics", "nowhere/d.txt"}).exit, 2);
    EXPECT_NE(popupc({"check", "bad.xml", "--color", "always"}).err.find("\x1b[1;31m"), std::string::npos);
    EXPECT_EQ(popupc({"check", "bad.xml"}).err.find('\x1b'), std::string::npos);
}

TEST_F(Cli, ASummaryClosesSeveralFiles) {
    write_file(scratch / "bad.xml", "<popup>");
    const RunResult result = popupc({"check", "bad.xml", "card.xml"});
    const std::size_t summary = result.err.find("popupc: 2 designs in ");
    ASSERT_NE(summary, std::string::npos) << result.err;
    EXPECT_TRUE(result.err.ends_with(" s: 1 error (1 xml-syntax)\n")) << result.err;
    EXPECT_EQ(popupc({"check", "bad.xml", "card.xml", "-q"}).err.find("designs"), std::string::npos);
    EXPECT_EQ(popupc({"check", "bad.xml"}).err.find("designs"), std::string::npos);
}

TEST_F(Cli, EmitPrintsEachStageAsJson) {
    for (const std::string stage : {"design", "assembly", "motion", "pattern", "layout"}) {
        const RunResult one = popupc({"build", "card.xml", "--emit", stage});
        EXPECT_EQ(one.exit, 0) << one.err;
        EXPECT_TRUE(nlohmann::json::parse(one.out).is_object()) << stage;
        const RunResult two = popupc({"build", "card.xml", "card.xml", "--emit", stage, "-q"});
        const auto json = nlohmann::json::parse(two.out);
        if (stage != "layout") {
            EXPECT_EQ(json.size(), 2U) << stage;
        }
    }
}

TEST_F(Cli, EqualStemsAreToldApart) {
    std::filesystem::create_directory(scratch / "other");
    write_file(scratch / "other/card.xml", kCard);
    write_file(scratch / "card~2.xml", kCard);
    const RunResult result =
        popupc({"build", "card.xml", "other/card.xml", "card~2.xml", "--emit", "design", "-q"});
    std::set<std::string> stems;
    for (const auto& design : nlohmann::json::parse(result.out))
        stems.insert(design["stem"].get<std::string>());
    EXPECT_EQ(stems, (std::set<std::string>{"card", "card~2", "card~3"}));
}

TEST_F(Cli, FixMendsOnceAndKeepsEverythingElse) {
    const std::string original = with(crooked(), "<mainpage", "<!-- by  hand -->\n\t<mainpage");
    write_file(scratch / "crooked.xml", original);
    const RunResult shown = popupc({"fix", "crooked.xml"});
    EXPECT_EQ(shown.exit, 0) << shown.err;
    EXPECT_NE(shown.out, original);
    EXPECT_NE(shown.out.find("<!-- by  hand -->\n\t<mainpage"), std::string::npos);
    EXPECT_EQ(read_file(scratch / "crooked.xml"), original);

    const RunResult diff = popupc({"fix", "--diff", "crooked.xml"});
    EXPECT_EQ(diff.exit, 1);
    EXPECT_EQ(diff.out.find("--- crooked.xml\n+++ crooked.xml\n@@ "), 0U);
    EXPECT_EQ(read_file(scratch / "crooked.xml"), original);

    EXPECT_EQ(popupc({"fix", "crooked.xml", "-o", "fixed.xml"}).exit, 0);
    EXPECT_EQ(popupc({"fix", "--in-place", "crooked.xml", "card.xml"}).exit, 0);
    EXPECT_EQ(read_file(scratch / "crooked.xml"), shown.out);
    EXPECT_EQ(read_file(scratch / "fixed.xml"), shown.out);
    EXPECT_EQ(read_file(scratch / "card.xml"), kCard);

    const RunResult again = popupc({"fix", "--diff", "crooked.xml"});
    EXPECT_EQ(again.exit, 0);
    EXPECT_EQ(again.out + again.err, "");
    EXPECT_EQ(popupc({"check", "crooked.xml"}).exit, 0);
}

TEST_F(Cli, FixWritesNothingWhenSomethingCannotBeMended) {
    write_file(scratch / "crooked.xml", crooked());
    write_file(scratch / "bad.xml", with(std::string(kCard), "page=\"0\"", "page=\"7\""));
    EXPECT_EQ(popupc({"fix", "--in-place", "crooked.xml", "bad.xml"}).exit, 1);
    EXPECT_EQ(read_file(scratch / "crooked.xml"), crooked());
    const RunResult shown = popupc({"fix", "bad.xml"});
    EXPECT_EQ(shown.exit, 1);
    EXPECT_EQ(shown.out, "");
}

TEST_F(Cli, IfChangedLeavesIdenticalFilesAlone) {
    EXPECT_EQ(popupc({"build", "card.xml", "-o", "x.svg"}).exit, 0);
    const auto past = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
    std::filesystem::last_write_time(scratch / "x.svg", past);
    EXPECT_EQ(popupc({"build", "card.xml", "-o", "x.svg", "--if-changed"}).exit, 0);
    EXPECT_EQ(std::filesystem::last_write_time(scratch / "x.svg"), past);
    EXPECT_EQ(popupc({"build", "card.xml", "-o", "x.svg"}).exit, 0);
    EXPECT_NE(std::filesystem::last_write_time(scratch / "x.svg"), past);
}

TEST_F(Cli, ExplainKnowsEveryCode) {
    const auto& all = code_table();
    for (std::size_t i = 0; i < all.size(); i += test::kSanitized ? 10 : 1) {
        const CodeInfo& row = all[i];
        const RunResult result = popupc({"explain", std::string(row.code)});
        EXPECT_EQ(result.exit, 0) << row.code;
        EXPECT_EQ(
            result.out.find(std::string(row.code) + " (" + std::string(to_string(row.severity)) + "): "), 0U);
    }
}

TEST_F(Cli, ListsAreTablesAndJson) {
    for (const std::string what : {"formats", "languages", "elements", "profiles", "sheets", "codes"}) {
        const RunResult text = popupc({"list", what});
        const RunResult json = popupc({"list", what, "--json"});
        EXPECT_EQ(text.exit + json.exit, 0);
        const auto rows = nlohmann::json::parse(json.out);
        EXPECT_EQ(rows.size(), static_cast<std::size_t>(std::count(text.out.begin(), text.out.end(), '\n')))
            << what;
        EXPECT_GT(rows.size(), 0U) << what;
    }
}

TEST_F(Cli, AReaderThatGoesAwayIsTwoAndQuiet) {
    const RunResult result =
        run({"bash", "-c",
             std::string("\"$0\" build card.xml --emit motion --angles 0:180:0.1 | head -c 10 >/dev/null; "
                         "echo ${PIPESTATUS[0]}"),
             kPopupc},
            options);
    EXPECT_EQ(result.out, "2\n");
    EXPECT_EQ(result.err, "");
}

TEST_F(Cli, AClosedStandardOutputIsTwoAndHurtsNoFile) {
    const RunResult result =
        run({"bash", "-c", "\"$0\" build card.xml -o x.svg --emit design >&-; echo $?", kPopupc}, options);
    EXPECT_EQ(result.out, "2\n");
    EXPECT_EQ(scratch.names(), std::vector<std::string>{"card.xml"});
}

TEST_F(Cli, SameBytesWhateverTheThreadsTheDirectoryAndTheLocale) {
    const std::vector<std::string> files{"card.xml", "card.xml", "card.xml"};
    const auto build = [&](std::vector<std::string> more, const std::string& out) {
        std::vector<std::string> arguments{"build", "card.xml", "card.xml", "card.xml", "-q"};
        for (const std::string suffix : {"svg", "pdf", "glb", "json"}) {
            arguments.insert(arguments.end(), {"-o", out + "/run." + suffix});
        }
        arguments.insert(arguments.end(), more.begin(), more.end());
        std::filesystem::create_directory(scratch / out);
        EXPECT_EQ(popupc(arguments).exit, 0);
    };
    build({"-j1"}, "one");
    build({"-j8"}, "eight");
    options.environment = {
        {"LC_ALL", "de_DE.UTF-8"}, {"LANG", "de_DE.UTF-8"}, {"TZ", "Asia/Tokyo"}, {"HOME", "/nonexistent"}};
    build({}, "german");
    for (const std::string suffix : {"svg", "pdf", "glb", "json"}) {
        const std::string first = read_file(scratch / ("one/run." + suffix));
        EXPECT_FALSE(first.empty());
        EXPECT_EQ(first, read_file(scratch / ("eight/run." + suffix))) << suffix;
        EXPECT_EQ(first, read_file(scratch / ("german/run." + suffix))) << suffix;
    }
}

}  // namespace
}  // namespace popup::test
