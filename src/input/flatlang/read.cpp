#include "input/flatlang/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "assembly/settle.h"
#include "input/flatlang/pieces/pieces.h"
#include "input/flatlang/run/interpreter.h"
#include "input/flatlang/trail_json.h"
#include "input/text.h"

namespace popup::flatlang {
namespace {

void tell_ignored_files(const ProgramRun& run, Diagnostics& diagnostics) {
    const auto tell = [&diagnostics](const std::vector<AskedFile>& files, std::string_view function) {
        if (files.empty()) return;
        diagnostics
            .remark("flatlang-output-ignored", files.back().place,
                    fmt::format("{}() writes no file here: \"{}\"", function, shown(files.back().name)))
            .hint("-o FILE says what is written");
    };
    tell(run.hpgl, "hpgl");
    tell(run.laser, "laser");
}

// False where a card or a sheet is not all that the program makes.
bool makes_one_thing(const ProgramRun& run, Diagnostics& diagnostics) {
    const Place place = run.sheet ? run.sheet->place : run.card->design->page_place;
    const std::string_view made = run.sheet ? "sheet" : "card";
    if (run.sheet && run.card) {
        diagnostics
            .error("flatlang-card-and-parts", place,
                   fmt::format("the program makes a sheet of cuts and folds here, and a card on line {}",
                               run.card->design->page_place.line))
            .hint("a program makes a card, a sheet or parts; write two programs");
        return false;
    }
    if (run.trail.segments.empty()) return true;
    diagnostics
        .error("flatlang-card-and-parts", place,
               fmt::format("the program makes a {} here, and its turtle draws {} line{} besides", made,
                           run.trail.segments.size(), run.trail.segments.size() == 1 ? "" : "s"))
        .hint(run.sheet ? "a program makes a sheet or parts; lift the pen with up(), or write two programs"
                        : "a program makes a card or parts; lift the pen with up(), or write two programs");
    return false;
}

}  // namespace

bool recognises(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) return false;
    const char c = text[begin];
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    return letter || c == ';';
}

Reading read(const Source& source, const ReadOptions& options, Diagnostics& diagnostics) {
    ProgramRun run = run_program(source, options, diagnostics);
    Reading reading;
    reading.printed = std::move(run.printed);
    reading.files = std::move(run.files);
    reading.missing.assign(run.missing.begin(), run.missing.end());
    if (diagnostics.has_errors_as_given() || run.status == RunStatus::runtime_fail ||
        run.status == RunStatus::timeout) {
        return reading;
    }
    tell_ignored_files(run, diagnostics);
    if (run.card || run.sheet) {
        if (!makes_one_thing(run, diagnostics)) return reading;
        if (run.sheet) {
            reading.creases = std::move(run.sheet->pattern);
            reading.creases->file = source.name;
            reading.creases->stem = source.stem();
        } else {
            reading.design = finished(std::move(*run.card), source);
        }
        return reading;
    }
    // It may be there for others to load, and is nothing by itself: a design as little as parts.
    if (run.trail.segments.empty() && run.defines) return reading;
    if (auto parts = make_parts(run.trail, diagnostics)) {
        reading.assembly = assembly_of(std::move(*parts));
        settle_numbers(*reading.assembly);
    }
    return reading;
}

std::string trail(const Source& source, const ReadOptions& options, Diagnostics& diagnostics,
                  std::vector<std::string>& files) {
    ProgramRun run = run_program(source, options, diagnostics);
    std::move(run.files.begin(), run.files.end(), std::back_inserter(files));
    return trail_json(run);
}

}  // namespace popup::flatlang
