// Options of inputs that are programs, and what becomes of what programs print.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "popup/diagnostics.h"
#include "popup/language.h"

namespace CLI {
class App;
}

namespace popup::cli {

struct MessageOptions;
struct Options;
struct Run;

struct PrintOptions {
    std::string file;  // --print; empty: standard error
};

// -D, -I, --flatlang and the limits.
void add_run_options(CLI::App& verb, Options& options);
// The same, and --print.
void add_program_options(CLI::App& verb, Options& options);

// UsageError when --print has the place of another output of a check.
void check_print_options(const Options& options);

// What the programs of the run printed, in argument order, as it goes to --print FILE: of one input as it is;
// of several what each printed stands below a line "== NAME ==".
std::string printed_text(const Run& run);

// The same for a terminal: what one would act on is made visible, but for tabs and line breaks.
std::string shown_on_terminal(std::string_view printed);

// Puts it on standard error where no file is named.
void tell_printed(const Options& options, const Run& run);

// Writes it to the file that is named, if one is. False with an `unwritable-output` error when it cannot be
// written.
bool write_printed(const Options& options, const Run& run, Diagnostics& diagnostics);

// UsageError when `output` would be written over a file that an input of this run has loaded.
void check_loaded(const Run& run, const std::string& output);

// The same of what the source loads as it is read: pictures, drawings, programs. It is read for this only
// where one of the outputs is there already.
void check_loaded(const Source& source, const ReadOptions& options,
                  std::initializer_list<std::string_view> outputs);

// The same of what it has loaded.
void check_loaded(const std::vector<std::string>& loaded, std::initializer_list<std::string_view> outputs);

// All files that programs have loaded, in the order in which they were, each once.
std::vector<std::string> loaded_files(const Run& run);

}  // namespace popup::cli
