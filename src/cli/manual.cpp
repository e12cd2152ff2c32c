// Manual pages of verbs, made from the parser with the texts of --help.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdio>
#include <sstream>

#include "cli/options/command_line.h"
#include "cli/program_view.h"
#include "cli/report.h"
#include "cli/verbs.h"

namespace popup::cli {
namespace {

// Of the pages' texts, not of the day on which one is made.
constexpr std::string_view kDate = "November 22, 2026";

std::string lower(std::string text) {
    for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

std::string upper(std::string text) {
    for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return text;
}

// A word as it is: backslashes, and what would begin a request or turn into another hyphen.
std::string escaped(const std::string& word) {
    std::string text;
    for (std::size_t i = 0; i < word.size(); ++i) {
        if (word[i] == '\\') {
            text += "\\e";
        } else if (word[i] == '-' && (i == 0 || word[i - 1] == '-')) {
            text += "\\-";
        } else {
            text += word[i];
        }
    }
    return text.starts_with('.') || text.starts_with('\'') ? "\\&" + text : text;
}

// The text as lines of a page, each sentence beginning one, no longer than a lint of pages likes.
std::string filled(const std::string& text) {
    constexpr std::size_t kWidth = 78;
    std::string page;
    std::size_t column = 0;
    std::istringstream words(text);
    bool ended = false;
    for (std::string word; words >> word;) {
        const std::string shown = escaped(word);
        if (column > 0) {
            const bool fits = column + 1 + shown.size() <= kWidth && !ended;
            page += fits ? ' ' : '\n';
            column = fits ? column + 1 : 0;
        }
        page += shown;
        column += shown.size();
        ended = word.ends_with('.') || word.ends_with('?') || word.ends_with('!');
    }
    return page + "\n";
}

// "o , Fl -output Ar file"
std::string item(const OptionView& option) {
    std::string line = ".It";
    for (const std::string& name : option.names) {
        line += fmt::format("{} Fl {}", line == ".It" ? "" : " ,", name.substr(1));
    }
    if (!option.type.empty()) line += " Ar " + lower(option.type);
    return line + "\n";
}

// A verb's footer in parts: examples, other lists with what stands above each, and the paragraphs around
// them.
struct Footer {
    struct List {
        std::string heading;
        std::vector<std::string> lines;
    };
    std::vector<std::string> examples;
    std::vector<List> lists;
    std::string exit_status;
    std::string remarks;
};

Footer parts_of(const std::string& text) {
    Footer footer;
    std::istringstream lines(text);
    std::string paragraph;
    const auto close = [&] {
        if (paragraph.empty()) return;
        const bool about_exit = lower(paragraph).find("exit status") != std::string::npos;
        (about_exit ? footer.exit_status : footer.remarks) += paragraph;
        paragraph.clear();
    };
    bool in_list = false;  // of footer.lists
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("  ")) {
            if (!paragraph.empty()) {
                footer.lists.push_back({std::exchange(paragraph, {}), {}});
                in_list = true;
            }
            (in_list ? footer.lists.back().lines : footer.examples).push_back(line.substr(2));
        } else if (line.empty()) {
            in_list = false;
            close();
        } else if (line != "Examples:") {
            in_list = false;
            paragraph += line + " ";
        }
    }
    close();
    return footer;
}

std::string literal(const std::vector<std::string>& lines) {
    std::string text = ".Bd -literal -offset indent\n";
    for (const std::string& line : lines) {
        for (const char c : line) text += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
        text += "\n";
    }
    return text + ".Ed\n";
}

std::string manual_page(const VerbView& verb) {
    const Footer footer = parts_of(verb.footer);
    const bool has_inputs = std::any_of(verb.positionals.begin(), verb.positionals.end(),
                                        [](const OptionView& one) { return one.traits.key == "INPUT"; });
    std::string page = fmt::format(
        ".\\\" Made by \"popupc manual {0}\" from the texts of \"popupc {0} \\-\\-help\".\n"
        ".Dd {1}\n.Dt POPUPC-{2} 1\n.Os\n.Sh NAME\n.Nm popupc-{0}\n.Nd {3}\n"
        ".Sh SYNOPSIS\n.Nm popupc\n.Cm {0}\n.Op Ar options\n",
        verb.name, kDate, upper(verb.name), lower(verb.about.substr(0, 1)) + verb.about.substr(1));
    for (const OptionView& one : verb.positionals) {
        const std::string name = lower(one.names.front()) + (one.traits.repeatable ? " ..." : "");
        page += one.required ? fmt::format(".Ar {}\n", name) : fmt::format(".Op Ar {}\n", name);
    }
    if (verb.takes_edit) page += ".Op Ar edit ...\n";
    page += ".Sh DESCRIPTION\n" + filled(verb.about + ".") + filled(footer.remarks);
    if (footer.remarks.empty()) page.pop_back();
    for (const Footer::List& list : footer.lists)
        page += ".Pp\n" + filled(list.heading) + literal(list.lines);
    page +=
        ".Pp\nThis page has the options of the verb in short.\nAll of it is said at length in\n.Xr popupc 1 "
        ".\n";
    if (!verb.positionals.empty()) page += ".Bl -tag -width Ds\n";
    for (const OptionView& one : verb.positionals) {
        page += fmt::format(".It Ar {}\n{}", lower(one.names.front()), filled(one.about));
    }
    if (!verb.positionals.empty()) page += ".El\n";
    page += ".Sh OPTIONS\n";
    for (const std::string& group : verb.groups) {
        if (verb.groups.size() > 1) page += fmt::format(".Ss {}\n", group);
        page += ".Bl -tag -width Ds\n";
        for (const OptionView& option : verb.options) {
            if (option.group == group) page += item(option) + filled(option.about);
        }
        page += ".El\n";
    }
    if (!footer.exit_status.empty()) page += ".Sh EXIT STATUS\n" + filled(footer.exit_status);
    if (!footer.examples.empty()) {
        page += ".Sh EXAMPLES\n" + literal(footer.examples);
    }
    return page + fmt::format(".Sh SEE ALSO\n.Xr popupc 1{}\n", has_inputs ? " ,\n.Xr popup 5" : "");
}

const VerbView& verb_named(const ProgramView& program, std::string_view name) {
    const auto found = std::find_if(program.verbs.begin(), program.verbs.end(),
                                    [name](const VerbView& verb) { return verb.name == name; });
    POPUP_INVARIANT(found != program.verbs.end());
    return *found;
}

// Lets man set the page for a terminal. False: there is no man, or it could not.
bool shown_by_man(const std::string& page) {
    std::FILE* man = ::popen("man -l - 2>/dev/null", "w");
    if (man == nullptr) return false;
    // Who leaves the pager early has seen enough.
    const auto before = std::signal(SIGPIPE, SIG_IGN);
    std::fwrite(page.data(), 1, page.size(), man);
    const bool done = ::pclose(man) == 0;
    std::signal(SIGPIPE, before);
    return done;
}

}  // namespace

CLI::App* add_manual(CLI::App& app, Options& options) {
    CLI::App* verb = app.add_subcommand("manual", "The manual page of a verb");
    verb->add_option_function<std::string>(
            "VERB",
            [&options](const std::string& text) {
                std::vector<std::string_view> known;
                for (const Verb& one : verb_table()) known.push_back(one.name);
                options.topic = text;
                if (std::find(known.begin(), known.end(), text) != known.end()) return;
                auto hints = did_you_mean(text, known);
                hints.push_back(fmt::format("verbs: {}", fmt::join(known, " ")));
                throw UsageError(fmt::format("there is no verb \"{}\"", text), hints, known);
            },
            "build, check or any other verb")
        ->required()
        ->type_name("");
    verb->footer(
        "Examples:\n"
        "  popupc manual build\n"
        "  popupc manual build > popupc-build.1\n"
        "\nOn a terminal man shows the page; elsewhere it is printed as mdoc, which man and mandoc read.");
    return verb;
}

int run_manual(const Options& options) {
    const ProgramView program = view_program();
    const std::string page = manual_page(verb_named(program, options.topic));
    if (::isatty(STDOUT_FILENO) != 0 && shown_by_man(page)) return exit_done;
    return print(page) ? exit_done : exit_unusable;
}

}  // namespace popup::cli
