#include "cli/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "cli/jobserver.h"

namespace popup::cli {
std::vector<FileFindings> Run::findings() const {
    std::vector<FileFindings> all;
    all.reserve(order.size());
    for (const int index : order) {
        if (index < 0) {
            all.push_back({&unreadable[static_cast<std::size_t>(-1 - index)], {}});
        } else {
            const CompiledDesign& one = compilation.designs[static_cast<std::size_t>(index)];
            all.push_back({&one.diagnostics, one.source.text});
        }
    }
    return all;
}

const Language& language_of(const InputOptions& options, const Source& source) {
    if (const Language* language = find_language(source, options.language)) return *language;
    throw UsageError(fmt::format("{}: the suffix names no language", source.name),
                     {"languages: " + known_languages(), "--from LANGUAGE says what the file holds"});
}

Run run_inputs(const Options& options, Stage until) {
    const std::vector<std::string>& names = options.inputs.names;
    if (std::count(names.begin(), names.end(), "-") > 1) {
        throw UsageError("standard input can be read only once");
    }
    Run run;
    std::vector<Source> sources;
    for (const std::string& name : names) {
        Diagnostics diagnostics(name);
        std::optional<Source> source = read_source(name, diagnostics);
        if (source) {
            language_of(options.inputs, *source);
            run.order.push_back(static_cast<int>(sources.size()));
            sources.push_back(std::move(*source));
        } else {
            run.order.push_back(-1 - static_cast<int>(run.unreadable.size()));
            run.unreadable.push_back(std::move(diagnostics));
        }
    }
    CompileOptions compile_options = options.compile;
    compile_options.read.language = options.inputs.language;
    compile_options.until = until;
    compile_options.progress = progress_meter(options.messages, sources.size());
    NestEffort& nesting = compile_options.layout.nesting;
    nesting.progress = nesting_meter(options.messages);
    // Who asked for a time may find it long enough sooner; else an interrupted run writes nothing.
    if (nesting.seconds && nesting.stop == nullptr) nesting.stop = stop_on_interrupt();
    Jobserver jobserver(options.jobs_given ? nullptr : std::getenv("MAKEFLAGS"));
    ask_before_threads(jobserver, compile_options);
    if (!jobserver.trouble().empty()) say(options.messages, jobserver.trouble());
    run.compilation = compile(std::move(sources), compile_options, options.policy);
    return run;
}

}  // namespace popup::cli
