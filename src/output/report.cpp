#include "output/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/diagnostics/render_diagnostics.h"
#include "base/text/json_text.h"
#include "base/text/numbers.h"
#include "output/cut_report.h"
#include "output/examination_json.h"
#include "popup/compile.h"

namespace popup {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kLength = 6;   // decimals of a millimetre
constexpr int kAngle = 7;    // of a degree
constexpr int kClosure = 9;  // of a millimetre
constexpr int kShare = 6;

Json repairs(const Diagnostics& diagnostics) {
    Json rows = Json::array();
    for (const Diagnostic& one : diagnostics.repairs()) {
        rows.push_back({{"code", one.code},
                        {"element", one.element.empty() ? Json() : Json(one.element)},
                        {"line", one.place.line},
                        {"column", one.place.column},
                        {"before", one.change->before},
                        {"after", one.change->after}});
    }
    return rows;
}

Json findings(const Diagnostics& diagnostics) {
    Json rows = Json::array();
    for (const Diagnostic& one : diagnostics.sorted()) rows.push_back(to_json(one));
    return rows;
}

Json motion(const Assembly& assembly, const Motion& motion) {
    Json angles = Json::array();
    for (const Angle angle : motion.angles) angles.push_back(rounded(angle.deg, kAngle));
    Json row{{"angles", std::move(angles)},
             {"max_closure_error_mm", rounded(motion.max_closure_mm, kClosure)},
             {"flat_closed", nullptr},
             {"flat_error_deg", nullptr}};
    // Of what does not lie flat where its motion begins neither is known.
    if (assembly.sweep.closed_flat) {
        row["flat_closed"] = motion.flat_closed;
        row["flat_error_deg"] = rounded(motion.flat_error_deg, kAngle);
    }
    if (!motion.not_forced.empty()) row["not_forced"] = not_forced_json(assembly, motion.not_forced);
    row.update(examination_json(assembly, motion.examination));
    return row;
}

Json input(const CompiledDesign& one) {
    Json elements;
    if (one.design) {
        const auto& all = one.checked ? one.checked->design().structures : one.design->structures;
        elements = std::count_if(all.begin(), all.end(), [](const Structure& s) { return !s.dropped; });
    }
    const bool stands = one.assembly && !moves(*one.assembly);
    if (stands) elements = 0;
    return {{"file", one.source.name},
            {"elements", std::move(elements)},
            // Of what moves; parts have pieces.
            {"plates", one.assembly ? Json(stands ? 0 : one.assembly->plates.size()) : Json()},
            {"pieces", one.assembly ? Json(one.assembly->pieces.size()) : Json()},
            {"repairs", repairs(one.diagnostics)},
            {"diagnostics", findings(one.diagnostics)},
            {"motion", one.motion ? motion(*one.assembly, *one.motion) : Json()}};
}

Json point(Vec2 p) { return Json::array({rounded(p.x, kLength), rounded(p.y, kLength)}); }

Json layout(const Layout& layout) {
    Json utilisation = Json::array();
    Json used = Json::array();
    Json sizes = Json::array();
    for (const LayoutSheet& sheet : layout.sheets) {
        utilisation.push_back(rounded(sheet.utilisation, kShare));
        used.push_back(point(sheet.used_mm));
        sizes.push_back(point({sheet.width_mm, sheet.height_mm}));
    }
    const bool one_size =
        std::all_of(sizes.begin(), sizes.end(), [&sizes](const Json& size) { return size == sizes.front(); });
    const bool copies = std::any_of(layout.placements.begin(), layout.placements.end(),
                                    [](const Placement& p) { return p.copy > 0; });
    Json placements = Json::array();
    for (const Placement& one : layout.placements) {
        Json row{{"piece", layout.piece_name(one)},
                 {"design", layout.designs.at(static_cast<std::size_t>(one.design)).stem}};
        if (copies) row["copy"] = one.copy + 1;
        row["sheet"] = one.sheet + 1;
        row["x_mm"] = rounded(one.offset.x, kLength);
        row["y_mm"] = rounded(one.offset.y, kLength);
        row["rotation_deg"] = rounded(one.angle.deg, kAngle);
        placements.push_back(std::move(row));
    }
    const Box& free = layout.leftover;
    Json report{{"sheet_mm", sizes.empty() ? Json() : sizes.front()},
                {"sheets", layout.sheets.size()},
                {"utilisation", std::move(utilisation)},
                {"used_mm", std::move(used)},
                {"leftover_mm", free.empty() ? Json()
                                             : Json{{"x", rounded(free.min.x, kLength)},
                                                    {"y", rounded(free.min.y, kLength)},
                                                    {"width", rounded(free.width(), kLength)},
                                                    {"height", rounded(free.height(), kLength)}}},
                {"placements", std::move(placements)}};
    if (!one_size) report["sheets_mm"] = std::move(sizes);
    return report;
}

}  // namespace

std::optional<std::string> write_report(const Compilation& run, const OutputOptions& options,
                                        Diagnostics& diagnostics) {
    Json cut;
    if (run.layout) {
        std::optional<Json> known = cut_report(*run.layout, options, diagnostics);
        if (!known) return std::nullopt;
        cut = std::move(*known);
    }
    Json inputs = Json::array();
    for (const CompiledDesign& one : run.designs) inputs.push_back(input(one));
    Json report{{"version", version()},
                {"inputs", std::move(inputs)},
                {"layout", run.layout ? layout(*run.layout) : Json()},
                {"cut", std::move(cut)}};
    if (!options.files.empty()) report["outputs"] = options.files;
    Json whole_run = findings(run.run_diagnostics);
    if (!whole_run.empty()) report["diagnostics"] = std::move(whole_run);
    return json_text(report);
}

}  // namespace popup
