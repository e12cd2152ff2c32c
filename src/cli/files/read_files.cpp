#include "cli/files/read_files.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <filesystem>
#include <optional>

#include "cli/files/tree_walk.h"
#include "cli/options/config_file.h"
#include "cli/options/dependency_options.h"
#include "popup/files.h"

namespace popup::cli {
namespace {

using Identity = std::pair<dev_t, ino_t>;

// Of a regular file, by whatever links it is reached.
std::optional<Identity> identity_of(const std::string& name) {
    struct stat status {};
    if (name.empty() || name == "-" || ::stat(name.c_str(), &status) != 0 || !S_ISREG(status.st_mode))
        return std::nullopt;
    return Identity{status.st_dev, status.st_ino};
}

// A later run would read what this one writes.
void spare_own_names(const std::string& output, std::string_view by) {
    const std::string file = std::filesystem::path(output).filename();
    for (const std::string_view own : {kIgnoreFile, kConfigName}) {
        if (file != own) continue;
        throw UsageError(fmt::format("{} would write {}, which popupc would read in later runs", by, output),
                         {std::string(kAnotherFileHint)});
    }
}

}  // namespace

void ReadFiles::add(const std::string& name, std::string_view as) {
    if (const auto identity = identity_of(name)) files_.try_emplace(*identity, Reading{name, as});
}

void ReadFiles::spare(const std::string& output, std::string_view by, std::string_view hint) const {
    if (is_standard_output(output)) return;
    const auto identity = identity_of(output);
    const auto found = identity ? files_.find(*identity) : files_.end();
    if (found == files_.end()) {
        spare_own_names(output, by);
        return;
    }
    const auto& [name, as] = found->second;
    throw UsageError(
        fmt::format("{} would overwrite {}, {}{}", by, output, as,
                    name == output ? std::string() : fmt::format(": it is the same file as {}", name)),
        {std::string(hint)});
}

ReadFiles files_read(const Options& options, const std::vector<std::string>& inputs,
                     const std::vector<std::string>& ignore_files) {
    ReadFiles read;
    for (const std::string& name : inputs) read.add(name, "an input");
    for (const std::string& name : ignore_files) read.add(name, "which says what a directory leaves out");
    for (const std::string& name : options.settings_files) read.add(name, "which options are read from");
    read.add(options.build.profile_file, "the profile");
    if (!options.judge.write_baseline) read.add(options.judge.baseline, "the baseline");
    return read;
}

void spare(const ReadFiles& read, const Options& options) {
    for (const std::string& output : options.build.outputs) read.spare(output, "-o");
    // A document that is made of a drawing does not replace it.
    const bool drawn = options.compile.read.drawing.as.has_value();
    read.spare(options.fix.output, "-o", drawn ? kAnotherFileHint : kInPlaceHint);
    read.spare(options.messages.file, "--diagnostics");
    read.spare(options.print.file, "--print");
    if (options.build.dependencies.wanted) read.spare(dependency_file_name(options), "the dependency file");
    if (options.judge.write_baseline) read.spare(options.judge.baseline, "--write-baseline");
}

}  // namespace popup::cli
