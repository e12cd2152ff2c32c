// The manual says what the program does: held against its help, its tables, and what it prints.
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "input/flatlang/folders.h"
#include "input/flatlang/run/builtin.h"
#include "popup/diagnostics.h"
#include "popup/layout.h"
#include "popup/mechanism.h"
#include "support/run_program.h"

namespace popup::test {
namespace {

const std::filesystem::path kSource = POPUP_SOURCE_DIR;
std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

// What stands between blanks; words that begin with a quoted "\&" lose it.
std::vector<std::string> words_of(const std::string& line) {
    std::vector<std::string> words;
    std::istringstream stream(line);
    for (std::string word; stream >> word;) {
        if (word.ends_with("\\&")) word.resize(word.size() - 2);
        words.push_back(word);
    }
    return words;
}

std::string upper(std::string text) {
    for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return text;
}

// The program's verbs, as its help lists them.
std::vector<std::string> verbs() {
    std::vector<std::string> names;
    bool in_list = false;
    for (const std::string& line : lines_of(popupc({"--help"}).out)) {
        if (line == "Verbs:") {
            in_list = true;
        } else if (line.empty()) {
            in_list = false;
        } else if (in_list) {
            names.push_back(words_of(line).front());
        }
    }
    EXPECT_GE(names.size(), 7U);  // or help was not understood
    return names;
}

// A manual page as its lines, each with the section (.Sh) and subsection (.Ss) it stands in.
struct ManLine {
    std::string section, subsection, text;
};

std::vector<ManLine> manual(const std::string& name) {
    std::vector<ManLine> page;
    std::string section;
    std::string subsection;
    for (const std::string& line : lines_of(read_file(kSource / "man" / name))) {
        if (line.starts_with(".Sh ")) {
            section = line.substr(4);
            subsection.clear();
        } else if (line.starts_with(".Ss ")) {
            subsection = line.substr(4);
        }
        page.push_back({section, subsection, line});
    }
    EXPECT_FALSE(page.empty()) << name;
    return page;
}

// ".It Fl o , Fl -output Ar file" as help has it: "-o, --output FILE". Empty: the line is no option's.
std::string option_of(const std::string& line) {
    const std::vector<std::string> words = words_of(line);
    std::string text;
    if (words.size() < 3 || words[0] != ".It" || words[1] != "Fl") return text;
    for (std::size_t i = 1; i < words.size(); ++i) {
        if (words[i] == ",") {
            text += ", ";
        } else if (words[i] == "Fl" && i + 1 < words.size()) {
            text += "-" + words[++i];
        } else if (words[i] == "Ar" && i + 1 < words.size()) {
            text += " " + upper(words[++i]);
        }
    }
    return text;
}

using Options = std::map<std::string, std::set<std::string>>;  // by verb; "popupc" is the program without one

// From headings such as ".Ss Output: build, fix" and the options below them.
Options options_in_manual() {
    Options options;
    for (const ManLine& line : manual("popupc.1")) {
        const std::string option = option_of(line.text);
        if (option.empty()) continue;
        EXPECT_EQ(line.section, "OPTIONS") << line.text;
        const std::size_t colon = line.subsection.find(':');
        EXPECT_NE(colon, std::string::npos) << line.subsection;
        if (colon == std::string::npos) continue;
        for (std::string verb : words_of(line.subsection.substr(colon + 1))) {
            if (verb.ends_with(',')) verb.pop_back();
            EXPECT_TRUE(options[verb].insert(option).second) << verb << " " << option << " stands twice";
        }
    }
    return options;
}

// Lines of help that begin with an option: its names and value, up to two blanks.
std::set<std::string> options_in_help(const std::string& help) {
    std::set<std::string> options;
    for (const std::string& line : lines_of(help)) {
        const std::size_t begin = line.find_first_not_of(' ');
        if (begin == std::string::npos || begin < 2 || line[begin] != '-') continue;
        options.insert(line.substr(begin, line.find("  ", begin) - begin));
    }
    return options;
}

TEST(Manual, HasEveryOptionOfHelpAndNoOther) {
    Options in_help;
    in_help["popupc"] = options_in_help(popupc({"--help"}).out);
    for (const std::string& verb : verbs()) in_help[verb] = options_in_help(popupc({verb, "--help"}).out);
    EXPECT_GT(in_help["build"].size(), 20U);  // or help was not understood
    const Options in_manual = options_in_manual();
    for (const auto& [verb, options] : in_help) {
        const auto found = in_manual.find(verb);
        ASSERT_NE(found, in_manual.end()) << verb;
        EXPECT_EQ(found->second, options) << verb;
    }
    EXPECT_EQ(in_manual.size(), in_help.size());
}

TEST(Manual, HasEveryVerbAndNoOther) {
    const std::vector<std::string> known = verbs();
    const std::set<std::string> in_help(known.begin(), known.end());
    std::set<std::string> explained;
    std::set<std::string> in_synopsis;
    for (const ManLine& line : manual("popupc.1")) {
        const std::vector<std::string> words = words_of(line.text);
        if (words.size() == 3 && line.subsection == "Verbs" && words[0] == ".It") explained.insert(words[2]);
        if (words.size() == 2 && line.section == "SYNOPSIS" && words[0] == ".Cm")
            in_synopsis.insert(words[1]);
    }
    EXPECT_EQ(explained, in_help);
    EXPECT_EQ(in_synopsis, in_help);
}

TEST(Manual, HasEveryFormatPaperAndListAndNoOther) {
    std::set<std::string> formats;
    std::set<std::string> papers;
    std::set<std::string> lists;
    bool about_list = false;
    for (const ManLine& line : manual("popupc.1")) {
        const std::vector<std::string> words = words_of(line.text);
        if (words.empty()) continue;
        if (line.subsection == "Formats" && line.text.starts_with(".It Pa ")) {
            for (const std::string& word : words) {
                if (word.starts_with('.') && word != ".It") formats.insert(word);
            }
        }
        if (line.text.starts_with(".Cm a6 ")) {
            for (std::size_t i = 1; i < words.size(); i += 2) papers.insert(words[i]);
        }
        if (words[0] == ".It") about_list = line.text == ".It Cm list";
        if (about_list && words[0] == ".Cm") lists.insert(words[1]);
        if (line.section != "DESCRIPTION") about_list = false;
    }
    std::set<std::string> real_formats;
    for (const auto& row : nlohmann::json::parse(popupc({"list", "formats", "--json"}).out))
        real_formats.insert(row["suffix"].get<std::string>());
    EXPECT_EQ(formats, real_formats);
    std::set<std::string> real_papers;
    for (const Paper& paper : paper_table()) real_papers.emplace(paper.name);
    EXPECT_EQ(papers, real_papers);
    ASSERT_FALSE(lists.empty());
    for (const std::string& list : lists) EXPECT_EQ(popupc({"list", list}).exit, 0) << list;
    // What is refused is told what there is.
    const std::string all = popupc({"list", "nothing"}).err;
    const std::size_t colon = all.find("lists: ");
    ASSERT_NE(colon, std::string::npos) << all;
    const std::vector<std::string> known = words_of(lines_of(all.substr(colon + 7)).front());
    EXPECT_EQ(lists, std::set<std::string>(known.begin(), known.end()));
}

// "6 v-fold: A B C ; G E H J I"
TEST(Manual, HasEveryElementTypeWithItsPointsInOrder) {
    std::vector<std::string> in_manual;
    for (const ManLine& line : manual("popup.5")) {
        if (line.section != "TYPES" || !line.text.starts_with(".It Li ")) continue;
        const std::vector<std::string> words = words_of(line.text);
        // What is drawn alone has no points.
        ASSERT_GT(words.size(), 3U) << line.text;
        ASSERT_NE(words.size(), 5U) << line.text;
        if (words.size() > 4) {
            ASSERT_EQ(words[4], "Pq") << line.text;
        }
        std::string entry = words[2] + " " + words[3] + ":";
        for (std::size_t i = 5; i < words.size(); ++i) entry += " " + words[i];
        in_manual.push_back(entry);
    }
    std::vector<std::string> real;
    for (const ElementInfo& info : element_table()) {
        std::string entry =
            (info.code < 0 ? "-" : std::to_string(info.code)) + " " + std::string(info.name) + ":";
        bool extra = false;
        for (const PointInfo& point : info.points) {
            if (point.page == PointPage::extra && !extra) entry += " ;";
            extra = extra || point.page == PointPage::extra;
            entry += " " + std::string(point.letter);
        }
        real.push_back(entry);
    }
    EXPECT_EQ(in_manual, real);
}

// ".Li at , width ;" and so on, as many as are said of the same kind.
std::string measures_said(const ElementInfo& info, Said said) {
    std::string line;
    for (const MeasureInfo& measure : info.measures) {
        if (measure.said == said) line += (line.empty() ? ".Li " : " , ") + std::string(measure.name);
    }
    return line;
}

// The lists of the section MEASURES, of the rows of the elements: types with the same measures together, then
// each measure, with its meanings where it has several.
std::string measures_for_manual() {
    std::vector<std::pair<std::string, std::string>> types;  // what is said, and of which
    std::vector<std::string> names;
    std::map<std::string, std::vector<std::pair<std::string, std::string>>> abouts;
    const auto add = [](auto& list, const std::string& what, std::string_view type) {
        for (auto& [known, its_types] : list) {
            if (known != what) continue;
            its_types += " , " + std::string(type);
            return;
        }
        list.emplace_back(what, type);
    };
    for (const ElementInfo& info : element_table()) {
        std::string said = measures_said(info, Said::always) + "\n";
        if (const std::string more = measures_said(info, Said::unless_zero); !more.empty())
            said += "and, of 0 where nothing else is said,\n" + more + "\n";
        if (const std::string more = measures_said(info, Said::drawing); !more.empty())
            said += "and, seldom needed,\n" + more + "\n";
        add(types, said, info.name);
        for (const MeasureInfo& measure : info.measures) {
            const std::string name(measure.name);
            if (!abouts.contains(name)) names.push_back(name);
            std::string about(measure.about);
            about[0] =
                static_cast<char>(about[0] >= 'a' && about[0] <= 'z' ? about[0] - 'a' + 'A' : about[0]);
            if (measure.kind == MeasureKind::angle) about += ", in degrees";
            for (std::size_t i = 0; i < measure.words.size(); ++i)
                about += (i == 0 ? ": " : " or ") + std::string(measure.words[i]);
            if (measure.relative) about += "; by how much more than it has";
            add(abouts[name], about, info.name);
        }
    }
    std::string page = ".Bl -tag -width version\n";
    for (const auto& [said, its_types] : types) page += ".It Sy " + its_types + "\n" + said;
    page += ".El\n.Pp\nThey say:\n.Bl -tag -width version\n";
    for (const std::string& name : names) {
        page += ".It Li " + name + "\n";
        for (const auto& [about, its_types] : abouts[name]) {
            page += about + ".\n";
            if (abouts[name].size() > 1) page += ".Pq " + its_types + "\n";
        }
    }
    return page + ".El\n";
}

TEST(Manual, HasEveryMeasureOfEveryElement) {
    const std::filesystem::path page = kSource / "man/popup.5";
    const std::string text = read_file(page);
    const std::string begin = ".\\\" What follows is made of the tables: POPUP_UPDATE=1 writes it anew.\n";
    const std::string end = ".\\\" What was made of the tables ends here.\n";
    const std::size_t from = text.find(begin);
    const std::size_t to = text.find(end);
    ASSERT_TRUE(from != std::string::npos && to != std::string::npos && from < to);
    const std::string made = text.substr(0, from + begin.size()) + measures_for_manual() + text.substr(to);
    const char* update = std::getenv("POPUP_UPDATE");
    if (update != nullptr && std::string(update) == "1") write_file(page, made);
    EXPECT_EQ(read_file(page), made) << page << " is out of date: POPUP_UPDATE=1 writes it anew";
}

TEST(Manual, HasEveryElementAndAttributeOfTheSchema) {
    std::set<std::string> elements;
    std::set<std::string> attributes;
    for (const ManLine& line : manual("popup.5")) {
        if (line.section != "ELEMENTS OF THE DOCUMENT") continue;
        const std::vector<std::string> words = words_of(line.text);
        if (words.empty()) continue;
        std::set<std::string>* found = nullptr;
        if (words[0] == ".Ss" || words[0] == ".Sy") found = &elements;
        if (line.text.starts_with(".It Li ")) found = &attributes;
        if (found == nullptr) continue;
        for (std::string word : words) {
            if (word.ends_with(',')) word.pop_back();
            found->insert(word);
        }
    }
    tinyxml2::XMLDocument schema;
    ASSERT_EQ(schema.LoadFile((kSource / "schemas/popup.xsd").c_str()), tinyxml2::XML_SUCCESS);
    std::size_t seen = 0;
    std::vector<const tinyxml2::XMLElement*> open{schema.RootElement()};
    while (!open.empty()) {
        const tinyxml2::XMLElement* at = open.back();
        open.pop_back();
        for (const auto* child = at->FirstChildElement(); child != nullptr;
             child = child->NextSiblingElement())
            open.push_back(child);
        const std::string kind = at->Name();
        const char* name = at->Attribute("name");
        if (name == nullptr || (kind != "xs:element" && kind != "xs:attribute")) continue;
        ++seen;
        EXPECT_TRUE((kind == "xs:element" ? elements : attributes).contains(name)) << kind << " " << name;
    }
    EXPECT_GT(seen, 20U);
}

TEST(Manual, NamesOnlyCodesThatThereAre) {
    std::size_t seen = 0;
    for (const ManLine& line : manual("popup.5")) {
        if (!line.text.starts_with(".Bq Li ")) continue;
        ++seen;
        EXPECT_NE(find_code(words_of(line.text)[2]), nullptr) << line.text;
    }
    EXPECT_GT(seen, 15U);
}

TEST(Manual, TheExampleDocumentChecksCleanAndIsCanonical) {
    std::string example;
    bool inside = false;
    for (const ManLine& line : manual("popup.5")) {
        if (line.section != "EXAMPLES") continue;
        if (line.text == ".Ed") inside = false;
        if (inside) example += line.text + "\n";
        if (line.text == ".Bd -literal") inside = true;
    }
    ASSERT_NE(example.find("<popup"), std::string::npos);
    const ScratchDirectory scratch;
    write_file(scratch / "owl.xml", example);
    RunOptions options;
    options.directory = scratch.path();
    const RunResult checked = popupc({"check", "--strict", "owl.xml"}, options);
    EXPECT_EQ(checked.exit, 0);
    EXPECT_EQ(checked.err, "");
    EXPECT_EQ(popupc({"fix", "owl.xml"}, options).out, example);
    if (!have_program("xmllint")) GTEST_SKIP() << "xmllint is not installed: the schema was not asked";
    const RunResult valid =
        run({"xmllint", "--noout", "--schema", (kSource / "schemas/popup.xsd").string(), "owl.xml"}, options);
    EXPECT_EQ(valid.exit, 0) << valid.err;
}

// What programs can call without loading or defining anything: what stands in tables, and what is defined of
// it.
std::set<std::string> builtins() {
    std::set<std::string> names;
    for (const auto table : {flatlang::turtle_builtins(), flatlang::number_builtins(),
                             flatlang::list_builtins(), flatlang::program_builtins()}) {
        for (const flatlang::Builtin& row : table) names.emplace(row.name);
    }
    for (const std::string& line : lines_of(std::string(flatlang::prelude()))) {
        if (line.starts_with("define ")) names.insert(line.substr(7, line.find('(') - 7));
    }
    std::erase_if(names, [](const std::string& name) { return name.starts_with("__"); });
    names.insert("quote");  // which is no function: its argument is not evaluated
    return names;
}

TEST(FlatlangManual, HasEveryBuiltinAndNoOther) {
    std::set<std::string> explained;
    for (const ManLine& line : manual("popupc-flatlang.7")) {
        if (line.section != "BUILTINS" || !line.text.starts_with(".It Fn ")) continue;
        EXPECT_TRUE(explained.insert(words_of(line.text)[2]).second) << line.text << " stands twice";
    }
    EXPECT_EQ(explained, builtins());
    EXPECT_GT(explained.size(), 60U);
}

// The functions that a section explains, as items or in its text.
std::set<std::string> explained_functions(const std::string& section) {
    std::set<std::string> names;
    for (const ManLine& line : manual("popupc-flatlang.7")) {
        if (line.section != section) continue;
        const std::vector<std::string> words = words_of(line.text);
        if (line.text.starts_with(".It Fn ")) names.insert(words[2]);
        if (line.text.starts_with(".Fn ")) names.insert(words.begin() + 1, words.end());
    }
    return names;
}

TEST(FlatlangManual, HasWhatTheKitDefines) {
    std::set<std::string> files;
    for (const ManLine& line : manual("popupc-flatlang.7")) {
        if (line.section != "KIT" || !(line.text.starts_with(".Pa ") || line.text.starts_with(".Ss ")))
            continue;
        for (const std::string& word : words_of(line.text)) {
            if (word.starts_with("kit/")) files.insert(word.substr(4));
        }
    }
    std::set<std::string> functions = explained_functions("KIT");
    functions.merge(explained_functions("CARDS"));
    for (const std::string_view file : flatlang::kit_files()) {
        const bool listed = files.erase(std::string(file)) == 1;
        EXPECT_TRUE(listed || file == "all.fl" || file == "base.fl") << file;
        for (const std::string& line : lines_of(std::string(*flatlang::kit_file(file)))) {
            if (!line.starts_with("define ") || line.starts_with("define __")) continue;
            EXPECT_TRUE(functions.contains(line.substr(7, line.find('(') - 7))) << line;
        }
    }
    EXPECT_EQ(files, std::set<std::string>()) << "there is no such file";
}

TEST(FlatlangManual, HasWhatMakesCards) {
    const std::set<std::string> explained = explained_functions("CARDS");
    for (const flatlang::Builtin& row : flatlang::card_builtins()) {
        // Those of elements are named as these are.
        EXPECT_TRUE(row.data != nullptr || explained.contains(std::string(row.name))) << row.name;
    }
}

// The programs on the page: those that are whole, and those that go on from what stands before them.
TEST(FlatlangManual, TheProgramsInItRun) {
    const ScratchDirectory scratch;
    RunOptions options;
    options.directory = scratch.path();
    std::map<std::string, std::vector<std::string>> programs;  // by section
    bool inside = false;
    for (const ManLine& line : manual("popupc-flatlang.7")) {
        if (line.text == ".Ed") inside = false;
        if (inside) {
            std::string text = line.text;
            text.erase(std::remove(text.begin(), text.end(), '\\'), text.end());
            programs[line.section].back() += text + "\n";
        }
        if (line.text.starts_with(".Bd -literal")) {
            inside = true;
            programs[line.section].emplace_back();
        }
    }
    const auto findings = [&](const std::string& program) {
        write_file(scratch / "page.fl", program);
        // A disc in them is turned by hand.
        const RunResult checked =
            popupc({"check", "page.fl", "--print", "printed", "--allow", "not-forced"}, options);
        return std::to_string(checked.exit) + checked.err;
    };
    const auto only = [&](const std::string& section) {
        EXPECT_EQ(programs[section].size(), 1U) << section;
        return programs[section].front();
    };
    for (const std::string section : {"DESCRIPTION", "OBJECTS", "KIT", "CARDS", "EXAMPLES"}) {
        EXPECT_FALSE(programs[section].empty()) << section;
        for (const std::string& program : programs[section]) EXPECT_EQ(findings(program), "0") << section;
    }
    write_file(scratch / "page.fl", only("THE TURTLE"));
    const auto trail = nlohmann::json::parse(popupc({"build", "page.fl", "--emit", "trail"}, options).out);
    EXPECT_EQ(trail["status"], "ok");
    EXPECT_EQ(trail["segments"].size(), 2U);
    // It says in comments what it does.
    const std::string square = "repeat (4) forward(1) left(90) done\n";
    EXPECT_EQ(findings("define f(x) print(\"called\", x) done\n" + only("TEXT") + "print(a)\n" + square),
              "0");
    EXPECT_EQ(read_file(scratch / "printed"), "called 3.0\n7.0\n");
    EXPECT_EQ(findings(only("PARTS") + square + "print(teeth)"), "0");
    EXPECT_EQ(read_file(scratch / "printed"), "12.0\n");
}

TEST(Manual, MandocFindsNoError) {
    if (!have_program("mandoc")) GTEST_SKIP() << "mandoc is not installed";
    std::vector<std::string> pages{"popupc.1", "popup.5", "popupc-cluster.7", "popupc-flatlang.7"};
    for (const std::string& verb : verbs()) pages.push_back("popupc-" + verb + ".1");
    for (const std::string& page : pages) {
        const RunResult result =
            run({"mandoc", "-W", "error", "-T", "utf8", (kSource / "man" / page).string()});
        EXPECT_EQ(result.exit, 0) << page << "\n" << result.err;
        EXPECT_EQ(result.err, "") << page;
        EXPECT_GT(result.out.size(), page.starts_with("popupc-") ? 500U : 5000U) << page;
    }
}

TEST(VerbManuals, AreWhatTheProgramMakesOfItsHelp) {
    std::set<std::string> pages;
    for (const std::string& verb : verbs()) {
        const std::filesystem::path page = kSource / "man" / ("popupc-" + verb + ".1");
        pages.insert(page.filename());
        const RunResult made = popupc({"manual", verb});
        ASSERT_EQ(made.exit, 0) << made.err;
        const char* update = std::getenv("POPUP_UPDATE");
        if (update != nullptr && std::string(update) == "1") write_file(page, made.out);
        EXPECT_EQ(read_file(page), made.out) << page << " is out of date: POPUP_UPDATE=1 writes it anew";
    }
    for (const auto& entry : std::filesystem::directory_iterator(kSource / "man")) {
        const std::string name = entry.path().filename();
        EXPECT_TRUE(!name.starts_with("popupc-") || !name.ends_with(".1") || pages.contains(name))
            << name << " is about no verb";
    }
}

TEST(VerbManuals, AreSetByManOnATerminal) {
    if (!have_program("man")) GTEST_SKIP() << "man is not installed (man-db)";
    if (!have_program("script")) GTEST_SKIP() << "script is not installed (bsdutils)";
    RunOptions options;
    options.environment = {{"MANPAGER", "cat"}, {"TERM", "dumb"}};
    const RunResult shown =
        run({"script", "-qec", std::string(kPopupc) + " manual list", "/dev/null"}, options);
    EXPECT_EQ(shown.exit, 0);
    EXPECT_NE(shown.out.find("POPUPC-LIST(1)"), std::string::npos) << shown.out;
    EXPECT_EQ(shown.out.find(".Sh"), std::string::npos) << shown.out;
}

TEST(VerbManuals, HaveEveryOptionOfHelpAndEveryExample) {
    for (const std::string& verb : verbs()) {
        std::set<std::string> options;
        std::set<std::string> examples;
        for (const ManLine& line : manual("popupc-" + verb + ".1")) {
            const std::string option = option_of(line.text);
            if (!option.empty()) options.insert(option);
            if (line.section != "EXAMPLES") continue;
            std::string text = line.text;
            text.erase(std::remove(text.begin(), text.end(), '\\'), text.end());
            examples.insert("  " + text);
        }
        const std::string help = popupc({verb, "--help"}).out;
        EXPECT_EQ(options, options_in_help(help)) << verb;
        bool in_examples = false;
        for (const std::string& line : lines_of(help)) {
            if (line.empty()) in_examples = false;
            EXPECT_TRUE(!in_examples || examples.contains(line)) << verb << ":" << line;
            in_examples = in_examples || line == "Examples:";
        }
    }
}

TEST(VerbManuals, LintFindsNothingInThem) {
    if (!have_program("mandoc")) GTEST_SKIP() << "mandoc is not installed";
    for (const std::string& verb : verbs()) {
        const RunResult result =
            run({"mandoc", "-T", "lint", (kSource / "man" / ("popupc-" + verb + ".1")).string()});
        for (const std::string& line : lines_of(result.out + result.err)) {
            // What is installed here is not the page's affair.
            if (line.find("referenced manual not found") == std::string::npos &&
                line.find("outdated mandoc.db") == std::string::npos) {
                ADD_FAILURE() << line;
            }
        }
    }
}

}  // namespace
}  // namespace popup::test
