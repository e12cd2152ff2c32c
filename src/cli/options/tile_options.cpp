#include "cli/options/tile_options.h"

#include <algorithm>

#include "cli/files/outputs.h"
#include "cli/options/value_option.h"
#include "output/tiles.h"

namespace popup::cli {
namespace {

SheetChoice paper_named(std::string_view text) {
    const std::optional<SheetChoice> paper = parse_sheet(text);
    if (paper && paper->name != "auto") return *paper;
    std::vector<std::string_view> names;
    for (const Paper& row : paper_table()) names.push_back(row.name);
    throw UsageError(fmt::format("--tile takes {}, or a size, not \"{}\"", fmt::join(names, ", "), text),
                     {"it is the paper in the printer; write a size as 300x200, 300x200mm or 12x8.5in"},
                     names);
}

}  // namespace

void add_tile_options(CLI::App& verb, Options& options) {
    std::optional<TileOptions>& tile = options.compile.output.tile;
    std::optional<Length>& margin = options.build.tile_margin;
    value(verb, "--tile", "PAPER", "print .pdf on pages of this paper, to glue together: a4, letter, WxH ...",
          "Print",
          [&tile](std::string_view text) {
              const SheetChoice paper = paper_named(text);
              tile = TileOptions{paper.width_mm, paper.height_mm};
          })
        ->configurable(false);
    value(verb, "--tile-margin", "LENGTH", "edge of each page that stays free of the drawing (default 10mm)",
          "Print",
          [&margin](std::string_view text) { margin = length_option("--tile-margin", text, kTileBandMm); })
        ->configurable(false);
}

void finish_tiles(Options& options, const OutputPlan& plan) {
    std::optional<TileOptions>& tile = options.compile.output.tile;
    const std::optional<Length>& margin = options.build.tile_margin;
    if (!tile) {
        if (!margin) return;
        throw UsageError("--tile-margin needs --tile, which names the printer's paper",
                         {"add --tile a4, or leave out --tile-margin"});
    }
    if (margin) tile->margin_mm = margin->mm;
    const bool has_pdf = std::any_of(plan.outputs.begin(), plan.outputs.end(),
                                     [](const PlannedOutput& one) { return one.format->suffix == ".pdf"; });
    if (!has_pdf) {
        throw UsageError("--tile prints a .pdf, and no output is one",
                         {"add -o card.pdf, or leave out --tile"});
    }
    Diagnostics told;
    if (!can_tile(options.compile.output, told)) refuse_usage(told);
}

}  // namespace popup::cli
