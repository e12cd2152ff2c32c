#include "support/doc_page.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <set>
#include <sstream>

#include "support/run_program.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::string text_of(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

std::vector<std::string> words_of(const std::string& text) {
    std::vector<std::string> words;
    std::istringstream stream(text);
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

// What a run took is another at each.
std::string without_times(const std::string& text) {
    static const std::regex kTimes(R"( in [0-9.]+ s|, [0-9.]+ a second)");
    return std::regex_replace(text, kTimes, " in N");
}

// The note that a line of Markdown is; an empty word when it is none.
DocNote note_of(const std::string& line, int number) {
    constexpr std::string_view kBegin = "<!-- test: ";
    constexpr std::string_view kEnd = " -->";
    if (!line.starts_with(kBegin) || !line.ends_with(kEnd)) return {};
    const std::string inside = line.substr(kBegin.size(), line.size() - kBegin.size() - kEnd.size());
    if (inside.starts_with("not run: ")) return {"not run", inside.substr(9), number};
    const std::size_t blank = inside.find(' ');
    if (blank == std::string::npos) return {inside, "", number};
    return {inside.substr(0, blank), inside.substr(blank + 1), number};
}

// Carries out the steps of one page.
class Runner {
 public:
    Runner(const fs::path& page, DocRun& result) : page_(page.filename()), result_(result) {
        options_.directory = scratch_.path();
        options_.environment["PATH"] = fs::path(kPopupc).parent_path().string() + ":/usr/bin:/bin";
        options_.environment["LC_ALL"] = "C";
        options_.environment["NO_COLOR"] = "1";
        options_.environment["SOURCE"] = POPUP_SOURCE_DIR;
        options_.environment["MAKEFLAGS"] = "";
    }

    // `lines` becomes what the block says when it is told anew.
    void carry_out(const DocStep& step, std::vector<std::string>& lines) {
        if (step.language.empty()) {
            by_itself(step.notes.front());
            return;
        }
        if (step.note("not run") != nullptr) return;
        if (const DocNote* needs = step.note("needs")) {
            for (const std::string& program : words_of(needs->rest)) {
                if (have_program(program)) continue;
                result_.skipped.push_back("line " + std::to_string(step.line) + ": " + program +
                                          " is not installed");
                return;
            }
        }
        if (const DocNote* file = step.note("file")) {
            save(file->rest, text_of(step.lines));
        } else if (const DocNote* same = step.note("is")) {
            const std::string text = read_file(fs::path(POPUP_SOURCE_DIR) / same->rest);
            if (text != text_of(step.lines)) fault(step.line, "the block is not " + same->rest);
            lines = lines_of(text);
            save(fs::path(same->rest).filename(), text);
        } else if (const DocNote* prints = step.note("prints")) {
            const RunResult run = shell(prints->rest);
            if (run.out != text_of(step.lines))
                differs(step.line, prints->rest, run.out + run.err, step.lines);
            lines = lines_of(run.out);
        } else if (step.language == "console") {
            console(step, lines);
        } else if (step.language == "sh") {
            const RunResult run = shell("set -e\n" + text_of(step.lines));
            if (run.exit != 0) fault(step.line, "the block fails:\n" + run.out + run.err);
        } else if (step.language != "text") {
            fault(step.line, "nothing says how this block of " + step.language + " is used");
        }
    }

 private:
    // Settings of a popupc.toml count where the page has one.
    RunResult shell(const std::string& command) {
        ++result_.ran;
        options_.environment["POPUPC_NO_CONFIG"] = fs::exists(scratch_ / "popupc.toml") ? "" : "1";
        return run({"sh", "-c", command}, options_);
    }

    void by_itself(const DocNote& note) {
        const std::vector<std::string> words = words_of(note.rest);
        if (note.word == "copy" && !words.empty()) {
            const fs::path from = fs::path(POPUP_SOURCE_DIR) / words.front();
            const fs::path to = scratch_.path() / (words.size() > 1 ? fs::path(words[1]) : from.filename());
            fs::create_directories(to.parent_path());
            std::error_code error;
            fs::copy(from, to, fs::copy_options::recursive, error);
            if (error) fault(note.line, "cannot copy " + words.front() + ": " + error.message());
        } else if (note.word == "run") {
            const RunResult run = shell(note.rest);
            if (run.exit != 0) fault(note.line, note.rest + "\nfails:\n" + run.out + run.err);
        } else {
            fault(note.line, "there is no test \"" + note.word + "\", or no block follows it");
        }
    }

    void console(const DocStep& step, std::vector<std::string>& lines) {
        lines.clear();
        for (std::size_t i = 0; i < step.lines.size();) {
            const int line = step.line + 1 + static_cast<int>(i);
            if (!step.lines[i].starts_with("$ ")) {
                fault(line, "a block of console begins with a command");
                return;
            }
            std::string command = step.lines[i].substr(2);
            lines.push_back(step.lines[i++]);
            for (; command.ends_with('\\') && i < step.lines.size(); ++i) {
                command += "\n" + step.lines[i];
                lines.push_back(step.lines[i]);
            }
            std::vector<std::string> expected;
            while (i < step.lines.size() && !step.lines[i].starts_with("$ "))
                expected.push_back(step.lines[i++]);
            const std::string printed = shell("{ " + command + "\n} 2>&1").out;
            const bool same = without_times(printed) == without_times(text_of(expected));
            if (!same) differs(line, command, printed, expected);
            const std::vector<std::string> told = same ? expected : lines_of(printed);
            lines.insert(lines.end(), told.begin(), told.end());
        }
    }

    void save(const fs::path& name, const std::string& text) {
        fs::create_directories((scratch_.path() / name).parent_path());
        write_file(scratch_.path() / name, text);
    }

    void differs(int line, const std::string& command, const std::string& printed,
                 const std::vector<std::string>& expected) {
        fault(line, "`" + command + "` prints\n" + printed + "and the page says\n" + text_of(expected));
    }

    void fault(int line, const std::string& what) {
        result_.wrong.push_back(page_ + ":" + std::to_string(line) + ": " + what);
    }

    std::string page_;
    DocRun& result_;
    ScratchDirectory scratch_;
    RunOptions options_;
};

// The lines of a page that stand in no fenced block; others are empty.
std::vector<std::string> prose(const std::string& text) {
    std::vector<std::string> lines = lines_of(text);
    bool inside = false;
    for (std::string& line : lines) {
        const bool fence = line.starts_with("```");
        if (fence) inside = !inside;
        if (fence || inside) line.clear();
    }
    return lines;
}

}  // namespace

const DocNote* DocStep::note(const std::string& word) const {
    const auto at =
        std::find_if(notes.begin(), notes.end(), [&word](const DocNote& one) { return one.word == word; });
    return at == notes.end() ? nullptr : &*at;
}

std::vector<DocStep> doc_steps(const std::string& text) {
    const std::set<std::string> alone{"copy", "run"};
    std::vector<DocStep> steps;
    std::vector<DocNote> waiting;
    const auto leave_alone = [&] {
        for (const DocNote& note : waiting) steps.push_back({"", {}, {note}, note.line});
        waiting.clear();
    };
    bool inside = false;
    int number = 0;
    for (const std::string& line : lines_of(text)) {
        ++number;
        if (line.starts_with("```")) {
            if (!inside) {
                const std::string language = line.substr(3);
                steps.push_back({language.empty() ? "no language" : language, {}, waiting, number});
                waiting.clear();
            }
            inside = !inside;
        } else if (inside) {
            steps.back().lines.push_back(line);
        } else if (const DocNote note = note_of(line, number); !note.word.empty()) {
            if (alone.contains(note.word)) leave_alone();
            waiting.push_back(note);
            if (alone.contains(note.word)) leave_alone();
        } else {
            leave_alone();
        }
    }
    leave_alone();
    return steps;
}

DocRun run_doc_page(const fs::path& page) {
    DocRun result;
    const std::string text = read_file(page);
    Runner runner(page, result);
    std::vector<std::string> lines = lines_of(text);
    // Blocks may grow and shrink: what comes after one then stands elsewhere.
    std::ptrdiff_t shift = 0;
    for (const DocStep& step : doc_steps(text)) {
        std::vector<std::string> anew = step.lines;
        runner.carry_out(step, anew);
        const auto first = lines.begin() + step.line + shift;
        const auto length = static_cast<std::ptrdiff_t>(step.lines.size());
        if (step.language.empty() || anew == step.lines) continue;
        lines.insert(lines.erase(first, first + length), anew.begin(), anew.end());
        shift += static_cast<std::ptrdiff_t>(anew.size()) - length;
    }
    result.text = text_of(lines);
    return result;
}

std::vector<DocLink> doc_links(const std::string& text) {
    std::vector<DocLink> links;
    int number = 0;
    for (const std::string& line : prose(text)) {
        ++number;
        for (std::size_t at = line.find("]("); at != std::string::npos; at = line.find("](", at + 1)) {
            const std::size_t end = line.find(')', at);
            if (end != std::string::npos) links.push_back({line.substr(at + 2, end - at - 2), number});
        }
    }
    return links;
}

std::vector<std::string> doc_anchors(const std::string& text) {
    std::vector<std::string> anchors;
    for (const std::string& line : prose(text)) {
        if (!line.starts_with('#')) continue;
        std::string anchor;
        for (const char c : line.substr(std::min(line.find(' ') + 1, line.size()))) {
            const auto byte = static_cast<unsigned char>(c);
            if (c == ' ' || c == '-') anchor += '-';
            if (c == '_' || byte >= 0x80 || std::isalnum(byte) != 0)
                anchor += static_cast<char>(std::tolower(byte));
        }
        anchors.push_back(anchor);
    }
    return anchors;
}

}  // namespace popup::test
