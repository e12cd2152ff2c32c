// popupc.toml, as `build` reads it.
#include <CLI/CLI.hpp>

#include "cli/options/command_line.h"
#include "cli/options/config_file.h"
#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_toml(std::string_view bytes) {
    static cli::Options options;
    static const std::unique_ptr<CLI::App> program = cli::declare_program(options, cli::verb_table());
    static const CLI::App* const verb = program->get_subcommand("build");
    const NamedBytes file(bytes);
    try {
        const cli::ConfigFile read = cli::read_config(file.name(), *program, *verb);
        expect(read.text == bytes, "the text is kept");
    } catch (const cli::UsageError& refused) {
        expect(std::string_view(refused.what()).size() > 1, "a refusal says why");
    }
}

}  // namespace popup::fuzz
