// Findings on their way to the user.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/options.h"
#include "findings/findings.h"
#include "popup/compile.h"

namespace popup::cli {

// Tells all findings in the order given, worst first within each, then those of the run, then (several
// inputs, not --quiet, not a machine format) one line that counts them, with the time that the run took where
// it goes to standard error.
// False when they could not be written where the user wants them; that has then been said.
bool report(const MessageOptions& options, const std::vector<FileFindings>& files, const Diagnostics& run);
bool report(const MessageOptions& options, Findings findings);

// The same, but how many there are of each kind instead. Precondition: the format is one that has them
// (text, short, json).
bool report_statistics(const MessageOptions& options, Findings findings);

// Text for standard output. False when it cannot be written; that has then been said, except when its reader
// has gone.
bool print(std::string_view text);

// A line on standard error that --verbose asks for.
void say(const MessageOptions& options, std::string_view line);
// A line on standard error that only --quiet keeps back.
void announce(const MessageOptions& options, std::string_view line);
// Such a line where a document that is about to be replaced has other names, which keep the old one.
void announce_links(const MessageOptions& options, const std::string& document);

// True when text that goes to the user may be coloured.
bool colorful(const MessageOptions& options);

// Text on standard error, as it is; where a progress bar may stand, it makes way.
void say_between(const MessageOptions& options, std::string_view text);

// How thick the closed card of a design that was examined is; empty for others.
std::string layers_line(const CompiledDesign& one);

// For each design that was examined, where --verbose asks for it: how thick the closed card is.
void say_layers(const MessageOptions& options, const Compilation& compilation);

// Shows on standard error how far the search for places on sheets is, where --progress wants that: at most
// one line a second, and none for what is done at once. Otherwise an empty function.
std::function<void(const NestProgress&)> nesting_meter(const MessageOptions& options);

// From now on the first interrupt (Ctrl-C) sets the flag that is returned, and the second ends the process.
const std::atomic<bool>* stop_on_interrupt();

// "popupc: error: …" with its hints, on standard error.
void report_usage(const UsageError& error);

// True when standard output is a pipe that nobody reads any more.
bool reader_has_gone();

// For std::set_new_handler(): says that memory has run out, and ends the run as a signal would. Libraries
// catch whatever is thrown in them, and some then go on with less than they should have made.
[[noreturn]] void end_out_of_memory();

}  // namespace popup::cli
