// "@FILE" on the command line: which words a file makes, and what is said of one that makes none.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/run_program.h"

namespace popup::test {
namespace {

using Words = std::vector<std::string>;

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

class ResponseFiles : public testing::Test {
 protected:
    void SetUp() override { options.directory = scratch.path(); }
    // The words that the program makes of these arguments: it is told to check what is not there, and names
    // each.
    Words expanded(const Words& arguments) {
        Words all{"check", "--message-format", "json", "--no-config", "--"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        Words words;
        std::istringstream lines(popupc(all, options).out);
        for (std::string line; std::getline(lines, line);) {
            const auto file = nlohmann::json::parse(line)["file"];
            words.push_back(file.is_null() ? "" : file.get<std::string>());
        }
        return words;
    }
    Words words(std::string_view text) {
        write_file(scratch / "args", text);
        return expanded({"@args"});
    }
    std::string refused(std::string_view text) {
        write_file(scratch / "args", text);
        const RunResult result = popupc({"check", "@args"}, options);
        EXPECT_EQ(result.exit, 2);
        EXPECT_EQ(result.out, "");
        return result.err;
    }

    ScratchDirectory scratch;
    RunOptions options;
};

TEST_F(ResponseFiles, AreReadAsGccReadsThem) {
    EXPECT_EQ(words(""), Words{});
    EXPECT_EQ(words(" \n\t\r\n"), Words{});
    EXPECT_EQ(words("a b\nc\t d\r\n"), (Words{"a", "b", "c", "d"}));
    EXPECT_EQ(words("'a b' \"c 'd'\" e'f g'h"), (Words{"a b", "c 'd'", "ef gh"}));
    EXPECT_EQ(words(R"(a\ b "c\"d" 'e\'f' \\ \"g)"), (Words{"a b", "c\"d", "e'f", "\\", "\"g"}));
    for (const std::string_view empty : {"'' a", "a \"\""})
        EXPECT_NE(refused(empty).find("an input has an empty name"), std::string::npos) << empty;
    EXPECT_EQ(words("'a\nb'"), Words{"a\nb"});
    EXPECT_EQ(words("\xEF\xBB\xBF"
                    "a b"),
              (Words{"a", "b"}));
    EXPECT_EQ(words("# $x *"), (Words{"#", "$x", "*"}));
    EXPECT_EQ(words("-o 'größe 1.svg'"), (Words{"-o", "größe 1.svg"}));
}

TEST_F(ResponseFiles, StandAnywhereAndInEachOther) {
    write_file(scratch / "inner", "--sheet a4\n");
    write_file(scratch / "outer", "check @inner '@inner' \\@x");
    EXPECT_EQ(expanded({"a", "@outer", "./@b", "c@d", "@inner"}),
              (Words{"a", "check", "--sheet", "a4", "@inner", "@x", "./@b", "c@d", "--sheet", "a4"}));
}

TEST_F(ResponseFiles, GiveTheProgramItsArguments) {
    write_file(scratch / "args", "collision\n");
    EXPECT_EQ(popupc({"explain", "@args"}, options).out, popupc({"explain", "collision"}).out);
    write_file(scratch / "args", "list formats --json");
    EXPECT_EQ(popupc({"@args"}, options).out, popupc({"list", "formats", "--json"}).out);
}

TEST_F(ResponseFiles, WrongOptionsAreToldWithTheirPlaces) {
    EXPECT_TRUE(has(refused("card.xml\n  --shet a4\n"),
                    "args:2:3: error: there is no option --shet [bad-response-file]\n"
                    "    2 |   --shet a4\n      |   ^\n  hint: did you mean --sheet?\n"));
    for (const std::string wrong : {" --sheet=a9", " --sheet a4 --sheet\n a9"}) {
        const std::string place = wrong.ends_with("\n a9") ? "args:3:2: " : "args:2:2: ";
        EXPECT_TRUE(has(refused("card.xml\n" + wrong), place + "error: --sheet takes auto, ")) << wrong;
    }
    EXPECT_TRUE(has(refused("card.xml\n  --sheet"), "args:2:3: error: --sheet: 1 required SIZE missing"));
    // In a file that a file names.
    write_file(scratch / "inner", "\n\n --deny nosuch --allow '' ");
    EXPECT_TRUE(has(refused("card.xml @inner"), "inner:3:9: error: --deny: there is no "));
    write_file(scratch / "args", "fix card.xml --diff\n--in-place");
    EXPECT_TRUE(has(popupc({"@args"}, options).err, "args:2:1: error: --diff excludes --in-place"));
    write_file(scratch / "args", "build card.xml -MD\n -MF");
    EXPECT_TRUE(has(popupc({"@args"}, options).err, "args:2:2: error: -MF takes the name of a file"));
    write_file(scratch / "args", "\nchekc card.xml");
    EXPECT_TRUE(has(popupc({"@args"}, options).err, "args:2:1: error: there is no verb \"chekc\""));
    // What is wrong on the command line is told as ever.
    write_file(scratch / "args", "card.xml --sheet a4");
    EXPECT_TRUE(popupc({"check", "@args", "--shet"}, options).err.starts_with("popupc: error: there is"));
    EXPECT_TRUE(
        popupc({"check", "@args", "--sheet", "a9"}, options).err.starts_with("popupc: error: --sheet"));
}

TEST_F(ResponseFiles, MistakesAreToldWithTheirPlaces) {
    EXPECT_TRUE(
        has(refused("x\n 'ab c\n"), "args:2:2: error: this quote is not closed [bad-response-file]\n"));
    EXPECT_TRUE(has(refused("größe \\"), "args:1:7: error: nothing follows this backslash"));
    EXPECT_TRUE(has(refused(std::string_view("a\0b", 3)), "args:1:2: error: this is a NUL byte"));
    const std::string missing = refused("a @nope b");
    EXPECT_TRUE(has(missing, "args:1:3: error: the response file nope cannot be read: no such file"))
        << missing;
    EXPECT_TRUE(has(missing, "hint: an argument that begins with @ itself is written ./@nope")) << missing;
    EXPECT_TRUE(has(popupc({"check", "@nope"}, options).err,
                    "popupc: error: the response file nope cannot be read: no such file"));
    EXPECT_TRUE(has(popupc({"check", "@"}, options).err, "@ names no response file"));
    EXPECT_TRUE(has(popupc({"check", "@-"}, options).err, "not read from standard input"));
    EXPECT_EQ(popupc({"check", "@."}, options).exit, 2);
}

TEST_F(ResponseFiles, ThatNameThemselvesOrGoTooDeepAreRefused) {
    EXPECT_TRUE(has(refused("@args"), "args:1:1: error: the response file args names itself"));
    write_file(scratch / "b", "@args");
    EXPECT_TRUE(has(refused("@b"), "b:1:1: error: the response file args names itself")) << refused("@b");
    for (int i = 0; i < 20; ++i) write_file(scratch / std::to_string(i), "@" + std::to_string(i + 1));
    EXPECT_TRUE(has(refused("@0"), "more than 16 response files are in each other")) << refused("@0");
    std::string many;
    for (int i = 0; i < 600000; ++i) many += "x ";
    write_file(scratch / "many", many);
    EXPECT_TRUE(has(refused("@many @many"), "more than 1000000 arguments"));
}

}  // namespace
}  // namespace popup::test
