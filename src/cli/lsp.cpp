#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/verbs.h"
#include "live/browser.h"
#include "lsp/session.h"

namespace popup::cli {

namespace {

// A view that nobody looks at ends soon: editors may ask for many.
constexpr const char* kIdle = "5m";

// The options that the server was started with, which a view has too. They make it show what the server
// finds.
std::vector<std::string> view_options(const Options& options) {
    std::vector<std::string> words = options.arguments;
    const auto verb = std::find(words.begin(), words.end(), "lsp");
    if (verb != words.end()) words.erase(verb);
    std::erase(words, "--stdio");
    return words;
}

std::string open_view(const std::vector<std::string>& options, const std::string& path) {
    std::error_code trouble;
    if (!std::filesystem::exists(path, trouble)) return "there is no file yet: save the document first";
    const std::string program = std::filesystem::read_symlink("/proc/self/exe", trouble);
    std::vector<std::string> words{program.empty() ? "popupc" : program, "view"};
    words.insert(words.end(), options.begin(), options.end());
    words.insert(words.end(), {"--idle", kIdle, "--", path});
    if (!live::start_by_itself(words)) return "popupc view cannot be started";
    return {};
}

}  // namespace

CLI::App* add_lsp(CLI::App& app, Options& options) {
    CLI::App* verb = app.add_subcommand("lsp", "Serve editors by the Language Server Protocol, as you type");
    // Many clients say how they talk to a server; there is only this way.
    verb->add_flag_callback(
            "--stdio", [] {}, "standard input and output, which is the only way; clients may say so")
        ->configurable(false)
        ->group("Input");
    verb->add_flag("--strict", options.compile.read.strict, "unknown markup is an error, not a warning")
        ->group("Input");
    add_check_options(*verb, options);
    add_motion_options(*verb, options);
    add_run_options(*verb, options);
    add_policy_options(*verb, options);
    add_config_options(*verb, options);
    verb->footer(
        "Examples:\n"
        "  popupc lsp\n"
        "  popupc lsp --werror --clearance 0.5mm\n"
        "\nEditors start it and talk to it; it serves popup documents (.xml) and FlatLang programs (.fl). "
        "What\n"
        "check takes from a popupc.toml it takes from the one of the directory it is started in. Exit status "
        "0\n"
        "after the client has asked it to shut down and to exit, else 1.");
    return verb;
}

int run_lsp(const Options& options) {
    check_motion_options(options);
    lsp::ServerOptions server;
    server.compile = options.compile;
    // Tried with every key that is pressed, they would take too long.
    server.compile.fitting_size = {};
    server.compile.clearing_move = {};
    server.compile.move_command = {};  // a fix makes the move
    server.policy = options.policy;
    server.open_view = [words = view_options(options)](const std::string& path) {
        return open_view(words, path);
    };
    // A request that asks too much is refused, and the next one answered.
    std::set_new_handler(nullptr);
    const int code = lsp::serve(STDIN_FILENO, STDOUT_FILENO, server);
    // Nothing is kept in this process that would have to be written, and an examination may take seconds
    // more.
    std::_Exit(code);
}

}  // namespace popup::cli
