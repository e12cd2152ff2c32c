// Completions are asked for as users get them: by the shells themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "popup/diagnostics.h"
#include "popup/layout.h"
#include "popup/output.h"
#include "popup/profile.h"
#include "support/run_program.h"

namespace popup::test {
namespace {

using Words = std::set<std::string>;

// A directory with inputs and other files, and one shell's script.
class Completions : public testing::TestWithParam<std::string> {
 protected:
    void SetUp() override {
        if (!have_program(GetParam())) GTEST_SKIP() << GetParam() << " is not installed";
        std::filesystem::create_directories(scratch / "work/sub dir");
        for (const char* name : {"my card.xml", "parts.svg", "note.txt", "cutter.toml"})
            write_file(scratch / "work" / name, "");
        const RunResult script = popupc({"completions", GetParam()});
        ASSERT_EQ(script.exit, 0) << script.err;
        write_file(scratch / (GetParam() == "zsh" ? "_popupc" : "script"), script.out);
        options.directory = scratch / "work";
        options.environment["HOME"] = scratch.path();
        options.environment["LC_ALL"] = "C.UTF-8";
    }

    // What the shell offers when the last of the words is being written.
    Words offered(const std::vector<std::string>& words) {
        const RunResult result = GetParam() == "bash"  ? bash(words)
                                 : GetParam() == "zsh" ? zsh(words)
                                                       : fish(words);
        EXPECT_EQ(result.exit, 0) << result.err;
        EXPECT_EQ(result.err, "");
        Words all;
        std::istringstream lines(result.out);
        for (std::string line; std::getline(lines, line);) {
            line = line.substr(0, line.find('\t'));
            line.erase(std::remove(line.begin(), line.end(), '\\'), line.end());
            if (line.ends_with('/')) line.pop_back();
            if (!line.empty()) all.insert(line);
        }
        return all;
    }

    ScratchDirectory scratch;
    RunOptions options;

 private:
    static std::string line_of(const std::vector<std::string>& words) {
        std::string line;
        for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
        return line;
    }
    // The function is called as readline does; "--sheet=a" is three words to it.
    RunResult bash(std::vector<std::string> words) {
        std::string quoted;
        int count = 0;
        for (const std::string& word : words) {
            const std::size_t equals = word.starts_with("--") ? word.find('=') : std::string::npos;
            if (equals == std::string::npos) {
                quoted += " '" + word + "'";
                ++count;
                continue;
            }
            const std::string value = word.substr(equals + 1);
            quoted += " " + word.substr(0, equals) + " =" + (value.empty() ? "" : " '" + value + "'");
            count += value.empty() ? 2 : 3;
        }
        return run({"bash", "--norc", "-uc",
                    "source ../script && COMP_WORDS=(" + quoted + ") COMP_CWORD=" +
                        std::to_string(count - 1) + "\n_popupc\nprintf '%s\\n' \"${COMPREPLY[@]-}\""},
                   options);
    }
    RunResult fish(const std::vector<std::string>& words) {
        return run({"fish", "--no-config", "-c", "source ../script; complete -C '" + line_of(words) + "'"},
                   options);
    }
    // zsh completes only at a terminal: one is made, and what is offered is written down instead of shown.
    RunResult zsh(const std::vector<std::string>& words) {
        write_file(scratch / "ask.zsh", R"(zmodload zsh/zpty
zpty shell zsh -f -i
# Looking through the completions of everything takes a second; these are enough.
zpty -w shell 'PROMPT=; all=($fpath); few=(${(M)fpath:#*Completion(|/Base)}); (( $#few )) || few=($all)'
zpty -w shell 'fpath=(.. $few); autoload -U compinit; compinit -u -D; fpath=(.. $all)'
zpty -w shell 'autoload -Uz _files _path_files _list_files'
zpty -w shell 'compadd() {
    if [[ ${@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then builtin compadd "$@"; return $?; fi
    typeset -a hits; builtin compadd -A hits "$@"
    for hit in $hits; do print -r -- $hit >> ../offered; done
    builtin compadd "$@"
}'
zpty -w shell 'popupc_over() { print over >> ../over }; zle -N popupc_over; bindkey "^X" popupc_over; bindkey "^I" complete-word; : > ../offered; print rea""dy'
zpty -r shell ignored '*ready*'
zpty -n -w shell "$1"$'\t'$'\x18'
for i in {1..3000}; do [[ -e ../over ]] && break; sleep 0.02; done
zpty -d shell
[[ -e ../over ]] || { print -u2 "zsh did not answer"; exit 1 }
cat ../offered
)");
        std::filesystem::remove(scratch / "over");
        return run({"timeout", "90", "zsh", "-f", "../ask.zsh", line_of(words)}, options);
    }
};

TEST_P(Completions, OfferTheVerbs) {
    Words verbs;
    std::istringstream help(popupc({"--help"}).out);
    bool listed = false;
    for (std::string line; std::getline(help, line);) {
        if (listed && line.empty()) break;
        if (listed) verbs.insert(line.substr(2, line.find(' ', 2) - 2));
        listed = listed || line == "Verbs:";
    }
    ASSERT_GE(verbs.size(), 7U);
    EXPECT_EQ(offered({"popupc", ""}), verbs);
    EXPECT_EQ(offered({"popupc", "completions", ""}), (Words{"bash", "zsh", "fish"}));
    EXPECT_EQ(offered({"popupc", "manual", ""}), verbs);
}

TEST_P(Completions, OfferTheOptionsOfTheVerb) {
    EXPECT_EQ(offered({"popupc", "build", "--she"}), Words{"--sheet"});
    EXPECT_EQ(offered({"popupc", "build", "x.xml", "--sheet", "a4", "--score"}), Words{"--score-side"});
    EXPECT_EQ(offered({"popupc", "check", "--score"}), Words{});
    EXPECT_EQ(offered({"popupc", "fix", "--in-"}), Words{"--in-place"});
    EXPECT_EQ(offered({"popupc", "build", "-MD"}), Words{"-MD"});
    EXPECT_EQ(offered({"popupc", "--vers"}), Words{"--version"});
}

TEST_P(Completions, OfferTheValuesThatAnOptionTakes) {
    Words papers{"auto"};
    for (const Paper& paper : paper_table()) papers.emplace(paper.name);
    EXPECT_EQ(offered({"popupc", "build", "--sheet", ""}), papers);
    EXPECT_EQ(offered({"popupc", "check", "--color", "a"}), (Words{"auto", "always"}));
    Words formats;
    for (const Format& format : format_table()) formats.emplace(format.suffix.substr(1));
    EXPECT_EQ(offered({"popupc", "build", "--to", ""}), formats);
    Words codes;
    for (const CodeInfo& row : code_table()) {
        if (row.code.starts_with("t")) codes.emplace(row.code);
    }
    EXPECT_EQ(offered({"popupc", "check", "--deny", "t"}), codes);
    EXPECT_EQ(offered({"popupc", "explain", "t"}), codes);
    EXPECT_EQ(offered({"popupc", "list", "f"}), Words{"formats"});
    EXPECT_EQ(offered({"popupc", "build", "--margin", ""}), Words{});
}

TEST_P(Completions, OfferValuesAfterAnEqualsSign) {
    const Words found = offered({"popupc", "build", "--grain=e"});
    // fish offers the whole word.
    EXPECT_EQ(found, GetParam() == "fish" ? Words{"--grain=either"} : Words{"either"});
}

TEST_P(Completions, OfferInputsAndDirectories) {
    EXPECT_EQ(offered({"popupc", "build", ""}), (Words{"my card.xml", "parts.svg", "sub dir"}));
    EXPECT_EQ(offered({"popupc", "check", "-q", "m"}), Words{"my card.xml"});
    EXPECT_EQ(offered({"popupc", "check", "my\\ c"}), Words{"my card.xml"});
}

TEST_P(Completions, OfferFilesToOptionsThatTakeThem) {
    const Words all{"my card.xml", "parts.svg", "note.txt", "cutter.toml", "sub dir"};
    EXPECT_EQ(offered({"popupc", "build", "x.xml", "-o", ""}), all);
    EXPECT_EQ(offered({"popupc", "check", "--config", "c"}), Words{"cutter.toml"});
    // A profile is one of those there are, or a file.
    EXPECT_EQ(offered({"popupc", "build", "--profile", "cu"}), Words{"cutter.toml"});
    EXPECT_EQ(offered({"popupc", "build", "--profile", "lig"}), Words{"lightburn"});
    Words profiles;
    for (const Profile& profile : profile_table()) profiles.insert(profile.name);
    const Words found = offered({"popupc", "build", "--profile", ""});
    EXPECT_TRUE(std::includes(found.begin(), found.end(), profiles.begin(), profiles.end()));
    EXPECT_FALSE(found.contains("note.txt"));
}

TEST_P(Completions, OfferResponseFiles) {
    // zsh looks at the @ as standing before the word.
    EXPECT_EQ(offered({"popupc", "check", "@no"}), Words{GetParam() == "zsh" ? "note.txt" : "@note.txt"});
    EXPECT_EQ(offered({"popupc", "@no"}), Words{GetParam() == "zsh" ? "note.txt" : "@note.txt"});
}

INSTANTIATE_TEST_SUITE_P(Shells, Completions, testing::Values("bash", "zsh", "fish"),
                         [](const auto& info) { return info.param; });

TEST(CompletionScripts, AreOnlyForShellsThatThereAre) {
    const RunResult result = popupc({"completions", "tcsh"});
    EXPECT_EQ(result.exit, 2);
    EXPECT_EQ(result.err,
              "popupc: error: there are no completions for \"tcsh\"\n  hint: shells: bash zsh fish\n");
}

}  // namespace
}  // namespace popup::test
