#include "gallery/entry.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "output/gallery/gallery.h"
#include "output/viewer/viewer.h"
#include "popup/write.h"

namespace popup {
namespace {

const std::string kToGallery = "../" + std::string(kGalleryIndex);

std::string file_named(const GalleryDesign& design, std::string_view suffix) {
    return std::string(kGalleryFolder) + "/" + design.name + std::string(suffix);
}

GalleryTile tile_for(const GalleryDesign& design) {
    GalleryTile tile;
    tile.title = Source{design.label, {}}.stem();
    tile.file = design.label;
    tile.page = file_named(design, ".html");
    return tile;
}

std::vector<Diagnostic> findings_of(const CompiledDesign& one, const Diagnostics& run) {
    std::vector<Diagnostic> all = one.diagnostics.sorted();
    for (Diagnostic& other : run.sorted()) all.push_back(std::move(other));
    return all;
}

// The size of the open card; of what is no card that of its largest piece.
Vec2 size_of(const CompiledDesign& one, double scale) {
    if (one.design) return {scale * one.design->width_mm, scale * one.design->height_mm};
    Vec2 largest;
    if (!one.pattern) return largest;
    for (const PatternPiece& piece : one.pattern->pieces) {
        const Vec2 size{piece.bounds.max.x - piece.bounds.min.x, piece.bounds.max.y - piece.bounds.min.y};
        if (size.x * size.y > largest.x * largest.y) largest = size;
    }
    return {scale * largest.x, scale * largest.y};
}

void tell_design(const CompiledDesign& one, const std::optional<Layout>& layout, double scale,
                 GalleryTile& tile) {
    std::map<std::string, std::size_t> counts;
    if (one.design) {
        for (const Structure& structure :
             one.checked ? one.checked->design().structures : one.design->structures) {
            if (!structure.dropped) ++counts[structure.type];
        }
    }
    tile.elements.assign(counts.begin(), counts.end());
    const Vec2 size = size_of(one, scale);
    tile.width_mm = size.x;
    tile.height_mm = size.y;
    if (one.assembly) tile.pieces = one.assembly->pieces.size();
    if (layout) tile.sheets = layout->sheets.size();
}

// The page, and where there is a picture, that.
bool show(const GalleryDesign& design, const Compilation& run, const OutputOptions& options,
          Diagnostics& diagnostics, GalleryEntry& entry) {
    const CompiledDesign& one = run.designs.front();
    GalleryTile& tile = *entry.row.tile;
    const auto add = [&entry](const std::string& name, std::string bytes) {
        entry.files.push_back({name, std::move(bytes)});
    };
    if (has_model(*one.assembly)) {
        const SceneCard card{
            &*one.assembly, one.motion ? &*one.motion : nullptr, {}, one.creases ? &*one.creases : nullptr};
        auto made = make_viewer({{&card, 1}, &*run.layout, entry.row.findings}, options, diagnostics);
        if (!made) return false;
        tile.picture = file_named(design, ".jpg");
        add(tile.page, std::move(made->page));
        add(tile.picture, std::move(made->still));
        return true;
    }
    auto picture = sheet_picture(*run.layout, options, diagnostics);
    if (!picture) return false;
    auto page = write_plain_page(tile, kToGallery, &*run.layout, entry.row.findings, options, diagnostics);
    if (!page) return false;
    tile.picture = file_named(design, ".png");
    add(tile.page, std::move(*page));
    add(tile.picture, std::move(*picture));
    return true;
}

// A page that has nothing but what was found.
void show_errors(GalleryEntry& entry) {
    GalleryTile& tile = *entry.row.tile;
    tile.picture.clear();
    tile.findings.clear();
    tile.errors.clear();
    tell_findings(entry.row.findings, tile);
    Diagnostics none;
    auto page = write_plain_page(tile, kToGallery, nullptr, entry.row.findings, {}, none);
    entry.files.clear();
    entry.files.push_back({tile.page, std::move(*page)});
}

void settle_outputs(GalleryEntry& entry) {
    for (const PendingFile& file : entry.files)
        entry.row.result.outputs.push_back(digest_of(file.path, file.bytes));
    for (const Diagnostic& one : entry.row.findings) {
        if (one.severity == Severity::error) ++entry.row.result.errors;
        if (one.severity == Severity::warning) ++entry.row.result.warnings;
    }
}

}  // namespace

GalleryEntry make_entry(const GalleryDesign& design, Source source, const CompileOptions& options,
                        const DiagnosticPolicy& policy) {
    GalleryEntry entry;
    entry.row.label = design.label;
    std::vector<Source> sources;
    sources.push_back(std::move(source));
    Compilation run = compile(std::move(sources), options, policy);
    CompiledDesign& one = run.designs.front();
    entry.printed = std::move(one.printed);
    entry.further_files = std::move(one.further_files);
    entry.missing_files = std::move(one.missing_files);
    const bool is_empty = !one.design && !one.assembly && !one.creases && !run.has_errors();
    if (!is_empty) {
        refuse_definitions(run);
        GalleryTile& tile = entry.row.tile.emplace(tile_for(design));
        tell_design(one, run.layout, options.layout.scale, tile);
        entry.row.findings = findings_of(one, run.run_diagnostics);
        Diagnostics& told = run.run_diagnostics;
        if (run.has_errors() || !run.layout || !show(design, run, options.output, told, entry)) {
            entry.row.result.status = output_refused(told) ? JobStatus::unusable : JobStatus::failed;
            entry.row.findings = findings_of(one, told);
            show_errors(entry);
        } else {
            tell_findings(entry.row.findings, tile);
        }
    } else {
        entry.row.findings = findings_of(one, run.run_diagnostics);
    }
    settle_outputs(entry);
    return entry;
}

GalleryEntry failed_entry(const GalleryDesign& design, JobStatus status, const Diagnostics& diagnostics) {
    GalleryEntry entry;
    entry.row.label = design.label;
    entry.row.result.status = status;
    entry.row.tile = tile_for(design);
    entry.row.findings = diagnostics.sorted();
    show_errors(entry);
    settle_outputs(entry);
    return entry;
}

}  // namespace popup
