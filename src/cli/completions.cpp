// Scripts by which bash, zsh and fish complete the program's command line, made from the parser.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/program_view.h"
#include "cli/report.h"
#include "cli/verbs.h"
#include "popup/compile.h"

namespace popup::cli {
namespace {

// What a value or an argument can be.
enum class Kind { none, words, inputs, files };

Kind completion_kind(const OptionView& option, bool positional) {
    if (option.traits.flag) return Kind::none;
    if (!option.words.empty()) return Kind::words;
    if (positional) return option.traits.key == "INPUT" ? Kind::inputs : Kind::files;
    return option.traits.files ? Kind::files : Kind::none;
}

std::vector<std::string> input_suffixes() {
    std::vector<std::string> suffixes;
    for (const Language& language : language_table()) {
        if (!language.suffix.empty()) suffixes.emplace_back(language.suffix);
    }
    return suffixes;
}

std::string replaced(std::string text, std::string_view what, std::string_view with) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
        text.replace(at, what.size(), with);
    }
    return text;
}

// In single quotes for bash and zsh.
std::string shell_quoted(const std::string& text) { return "'" + replaced(text, "'", R"('\'')") + "'"; }

std::string fish_quoted(const std::string& text) {
    return "'" + replaced(replaced(text, "\\", "\\\\"), "'", "\\'") + "'";
}

// ---- bash

std::string bash_action(const OptionView& option, bool positional) {
    switch (completion_kind(option, positional)) {
        case Kind::none:
            return ":";
        case Kind::words:
            // Words of which some are files as well, by their suffix.
            return fmt::format(
                "_popupc_words {}{}", shell_quoted(fmt::format("{}", fmt::join(option.words, " "))),
                option.traits.suffix.empty() ? "" : "; _popupc_files + " + option.traits.suffix);
        case Kind::inputs:
            return fmt::format("_popupc_files {}", fmt::join(input_suffixes(), " "));
        case Kind::files:
            return "_popupc_files";
    }
    broken_invariant("a value is of one kind", __FILE__, __LINE__);
}

std::string bash_names(const VerbView& verb) {
    std::string names;
    for (const OptionView& option : verb.options) {
        names += fmt::format("{}{}", names.empty() ? "" : " ", fmt::join(option.names, " "));
    }
    return names;
}

std::string bash_script(const ProgramView& program) {
    std::string text =
        R"(# bash completion for popupc, made by "popupc completions bash".

# What the word begins with, without its quotes.
_popupc_plain() {
    local word=$cur
    case $word in \'* | \"*) word=${word:1} ;; esac
    printf '%s' "${word//\\/}"
}

_popupc_words() {
    mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur")
}

# Directories, and files with the suffixes given, or all; after "+" besides what was found before.
_popupc_files() {
    local suffix plain found
    plain=$(_popupc_plain)
    if [[ ${1-} == + ]]; then shift; else COMPREPLY=(); fi
    compopt -o filenames 2>/dev/null
    if (($# == 0)); then
        mapfile -t found < <(compgen -f -- "$plain")
    else
        mapfile -t found < <(
            compgen -d -- "$plain"
            for suffix; do compgen -f -X "!*$suffix" -- "$plain"; done
        )
    fi
    COMPREPLY+=("${found[@]}")
}

_popupc() {
    local IFS=$' \t\n' cur prev verb i
    cur=${COMP_WORDS[COMP_CWORD]}
    prev=${COMP_WORDS[COMP_CWORD - 1]}
    COMPREPLY=()
    # "--sheet=a4" comes as three words.
    if [[ $cur == = ]]; then
        cur=
    elif [[ $prev == = && COMP_CWORD -gt 1 ]]; then
        prev=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    verb=
    for ((i = 1; i < COMP_CWORD; ++i)); do
        case ${COMP_WORDS[i]} in
            -*) ;;
            *)
                verb=${COMP_WORDS[i]}
                break
                ;;
        esac
    done
    # A response file: the shell may take the @ for a word of its own, but replaces it as well.
    if [[ $prev == @ || $cur == @* ]]; then
        cur=${cur#@}
        _popupc_files
        COMPREPLY=("${COMPREPLY[@]/#/@}")
        return
    fi
    case $verb,$prev in
)";
    for (const VerbView& verb : program.verbs) {
        for (const OptionView& option : verb.options) {
            if (option.traits.flag) continue;
            std::string names;
            for (const std::string& name : option.names) {
                names += fmt::format("{}{},{}", names.empty() ? "" : " | ", verb.name, name);
            }
            text += fmt::format("        {})\n            {}\n            return\n            ;;\n", names,
                                bash_action(option, false));
        }
    }
    text += "    esac\n    if [[ $cur == -* ]]; then\n        case $verb in\n";
    text += fmt::format("            '') _popupc_words {} ;;\n", shell_quoted(bash_names(program.self)));
    for (const VerbView& verb : program.verbs) {
        text +=
            fmt::format("            {}) _popupc_words {} ;;\n", verb.name, shell_quoted(bash_names(verb)));
    }
    text += "        esac\n        return\n    fi\n    case $verb in\n";
    std::string verbs;
    for (const VerbView& verb : program.verbs) verbs += (verbs.empty() ? "" : " ") + verb.name;
    text += fmt::format("        '') _popupc_words {} ;;\n", shell_quoted(verbs));
    for (const VerbView& verb : program.verbs) {
        if (verb.positionals.empty()) continue;
        text += fmt::format("        {}) {} ;;\n", verb.name, bash_action(verb.positionals.front(), true));
    }
    return text + "    esac\n} &&\n    complete -F _popupc popupc\n";
}

// ---- zsh

std::string zsh_action(const OptionView& option, bool positional) {
    switch (completion_kind(option, positional)) {
        case Kind::none:
            return " ";
        case Kind::words: {
            const std::string words = fmt::format("{}", fmt::join(option.words, " "));
            if (option.traits.suffix.empty()) return fmt::format("({})", words);
            return fmt::format("_popupc_either \"{}\" {}", words, option.traits.suffix);
        }
        case Kind::inputs: {
            std::vector<std::string> suffixes = input_suffixes();
            for (std::string& suffix : suffixes) suffix.erase(0, 1);
            return fmt::format("_files -g \"*.({})\"", fmt::join(suffixes, "|"));
        }
        case Kind::files:
            return "_files";
    }
    broken_invariant("a value is of one kind", __FILE__, __LINE__);
}

// What stands in brackets or before a colon.
std::string zsh_text(std::string text) {
    for (const char* special : {"\\", "[", "]", ":"})
        text = replaced(text, special, std::string("\\") + special);
    return text;
}

std::string zsh_option(const OptionView& option) {
    std::string names;
    for (const std::string& name : option.names) {
        names += names.empty() ? "" : ",";
        names += name;
        // A value may follow "-o" in the same word or the next, and "--output" after "=" or in the next.
        if (!option.traits.flag) names += name.starts_with("--") ? "=" : "+";
    }
    if (option.names.size() > 1) names = "{" + names + "}";
    const std::string before = option.traits.repeatable ? "'*'"
                               : option.names.size() > 1
                                   ? shell_quoted(fmt::format("({})", fmt::join(option.names, " ")))
                                   : std::string();
    std::string about = fmt::format("[{}]", zsh_text(option.about));
    if (!option.traits.flag) about += fmt::format(":{}:{}", zsh_text(option.type), zsh_action(option, false));
    return before + names + shell_quoted(about);
}

std::string zsh_script(const ProgramView& program) {
    std::string text = R"(#compdef popupc
# zsh completion for popupc, made by "popupc completions zsh".

# One of these words, or a file with this suffix; what _arguments adds comes first.
_popupc_either() {
    local suffix=$argv[-1]
    local -a words
    words=(${=argv[-2]})
    _alternative 'words:word:compadd -a words' "files:file:_files -g '*$suffix'"
}

_popupc() {
    local curcontext="$curcontext" state line
    typeset -A opt_args
    if compset -P @; then
        _files
        return
    fi
    _arguments -C \
)";
    for (const OptionView& option : program.self.options) {
        text += fmt::format("        {} \\\n", zsh_option(option));
    }
    text +=
        R"(        '1:verb:->verb' \
        '*::argument:->arguments' && return
    case $state in
        verb)
            local -a verbs
            verbs=(
)";
    for (const VerbView& verb : program.verbs) {
        text += fmt::format("                {}\n",
                            shell_quoted(fmt::format("{}:{}", verb.name, zsh_text(verb.about))));
    }
    text += R"(            )
            _describe verb verbs
            ;;
        arguments)
            curcontext="${curcontext%:*:*}:popupc-$words[1]:"
            case $words[1] in
)";
    for (const VerbView& verb : program.verbs) {
        text += fmt::format("                {})\n                    _arguments -s", verb.name);
        for (const OptionView& option : verb.options) {
            text += fmt::format(" \\\n                        {}", zsh_option(option));
        }
        for (const OptionView& one : verb.positionals) {
            const std::string spec = fmt::format("{}:{}:{}", one.traits.repeatable ? "*" : "1",
                                                 one.names.front(), zsh_action(one, true));
            text += fmt::format(" \\\n                        {}", shell_quoted(spec));
        }
        text += "\n                    ;;\n";
    }
    return text + R"(            esac
            ;;
    esac
}

if [ "$funcstack[1]" = "_popupc" ]; then
    _popupc "$@"
else
    compdef _popupc popupc
fi
)";
}

// ---- fish

std::string fish_values(const OptionView& option) {
    switch (completion_kind(option, false)) {
        case Kind::none:
            return option.traits.flag ? "" : " -x";
        case Kind::words: {
            const std::string words = fmt::format("{}", fmt::join(option.words, " "));
            if (option.traits.suffix.empty()) return " -x -a " + fish_quoted(words);
            return fmt::format(
                " -x -a {}", fish_quoted(fmt::format("{} (__popupc_files {})", words, option.traits.suffix)));
        }
        case Kind::inputs:
        case Kind::files:
            return " -r -F";
    }
    broken_invariant("a value is of one kind", __FILE__, __LINE__);
}

std::string fish_option(const OptionView& option, const std::string& condition) {
    std::string line = fmt::format("complete -c popupc -n {}", fish_quoted(condition));
    for (const std::string& name : option.names) {
        if (name.starts_with("--")) {
            line += " -l " + name.substr(2);
        } else {
            // Of one letter, or, such as -MD, of several after one dash.
            line += (name.size() == 2 ? " -s " : " -o ") + name.substr(1);
        }
    }
    return line + fish_values(option) + " -d " + fish_quoted(option.about) + "\n";
}

std::string fish_positional(const OptionView& one, const std::string& condition) {
    const std::string line = fmt::format("complete -c popupc -n {}", fish_quoted(condition));
    switch (completion_kind(one, true)) {
        case Kind::words:
            return line + fmt::format(" -a {}\n", fish_quoted(fmt::format("{}", fmt::join(one.words, " "))));
        case Kind::inputs:
            return line + fmt::format(" -a '(__popupc_files {})'\n", fmt::join(input_suffixes(), " "));
        case Kind::files:
            return line + " -F\n";
        case Kind::none:
            return {};
    }
    broken_invariant("a value is of one kind", __FILE__, __LINE__);
}

std::string fish_script(const ProgramView& program) {
    std::string text = R"(# fish completion for popupc, made by "popupc completions fish".

# True when the verb on the command line is one of those named; without names, when there is none yet.
function __popupc_verb
    set -l words (commandline -opc)
    set -e words[1]
    for word in $words
        string match -q -- '-*' $word; and continue
        contains -- $word $argv
        return
    end
    test (count $argv) -eq 0
end

# Directories, and files with the suffixes given.
function __popupc_files
    set -l word (commandline -ct)
    set -l suffixes (string escape --style=regex -- $argv | string join '|')
    complete -C "__fish_command_without_completions $word" | string match -r -- "^.*(?:/|$suffixes)\$"
end

# Response files.
function __popupc_response_files
    set -l word (commandline -ct | string sub -s 2)
    complete -C "__fish_command_without_completions $word" | string replace -r '^' @
end

complete -c popupc -f
complete -c popupc -n 'string match -q -- "@*" (commandline -ct)' -a '(__popupc_response_files)'
)";
    for (const OptionView& option : program.self.options) text += fish_option(option, "__popupc_verb");
    for (const VerbView& verb : program.verbs) {
        text += fmt::format("complete -c popupc -n __popupc_verb -a {} -d {}\n", verb.name,
                            fish_quoted(verb.about));
    }
    for (const VerbView& verb : program.verbs) {
        const std::string condition = "__popupc_verb " + verb.name;
        text += "\n";
        for (const OptionView& option : verb.options) text += fish_option(option, condition);
        if (!verb.positionals.empty()) text += fish_positional(verb.positionals.front(), condition);
    }
    return text;
}

struct Shell {
    std::string_view name;
    std::string (*script)(const ProgramView&);
};
constexpr Shell kShells[] = {{"bash", bash_script}, {"zsh", zsh_script}, {"fish", fish_script}};

const Shell& shell_of(std::string_view name) {
    std::vector<std::string_view> names;
    for (const Shell& shell : kShells) {
        if (shell.name == name) return shell;
        names.push_back(shell.name);
    }
    throw UsageError(fmt::format("there are no completions for \"{}\"", name),
                     {fmt::format("shells: {}", fmt::join(names, " "))}, names);
}

}  // namespace

CLI::App* add_completions(CLI::App& app, Options& options) {
    CLI::App* verb = app.add_subcommand("completions", "A script by which a shell completes command lines");
    verb->add_option_function<std::string>(
            "SHELL",
            [&options](const std::string& text) {
                shell_of(text);
                options.topic = text;
            },
            "bash, zsh or fish")
        ->required()
        ->type_name("");
    verb->footer(
        "Examples:\n"
        "  popupc completions bash > ~/.local/share/bash-completion/completions/popupc\n"
        "  popupc completions zsh > ~/.zfunc/_popupc\n"
        "  popupc completions fish > ~/.config/fish/completions/popupc.fish\n"
        "\nAn installed popupc has brought them along.");
    return verb;
}

int run_completions(const Options& options) {
    return print(shell_of(options.topic).script(view_program())) ? exit_done : exit_unusable;
}

}  // namespace popup::cli
