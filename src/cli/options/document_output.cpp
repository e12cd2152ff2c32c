// Where verbs that change documents write them.
#include <CLI/CLI.hpp>

#include "cli/options/options.h"

namespace popup::cli {

void add_document_output_options(CLI::App& verb, FixOptions& output, const std::string& in_place) {
    CLI::Option* as_diff =
        verb.add_flag("--diff", output.diff, "print what would change as a unified diff; write nothing")
            ->configurable(false)
            ->group("Output");
    CLI::Option* over_input =
        verb.add_flag("--in-place", output.in_place, in_place)->configurable(false)->group("Output");
    CLI::Option* elsewhere =
        verb.add_option("-o,--output", output.output, "write the document here (default: standard output)")
            ->type_name("FILE")
            ->configurable(false)
            ->group("Output");
    as_diff->excludes(over_input)->excludes(elsewhere);
    over_input->excludes(elsewhere);
}

}  // namespace popup::cli
