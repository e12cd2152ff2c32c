// Crease patterns line by line, and where the folds of what is made of them end.
#pragma once

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "popup/assembly.h"
#include "popup/crease_pattern.h"
#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/language.h"

namespace popup::test {

inline void add_line(CreasePattern& pattern, std::vector<Vec2> points, bool closed, CreaseUse use,
                     std::optional<double> deg = {}) {
    CreaseLine line;
    line.points = std::move(points);
    line.closed = closed;
    line.use = use;
    line.fold_deg = deg;
    pattern.lines.push_back(std::move(line));
}

// A drawing that is read as a folded sheet, its lines as `rules` say; nullopt: it cannot be.
inline std::optional<CreasePattern> read_folded(const std::filesystem::path& path,
                                                std::vector<LineRule> rules = {}) {
    Diagnostics diagnostics;
    const auto source = read_source(path.string(), diagnostics);
    if (!source) return std::nullopt;
    ReadOptions options;
    options.drawing.as = DrawnAs::folded;
    options.drawing.lines = std::move(rules);
    return read_source_text(*source, options, diagnostics).creases;
}

// How many folds end at an angle, degrees, mountains below 0; to a thousandth.
inline std::map<double, int> ends_of(const Assembly& assembly) {
    std::map<double, int> ends;
    for (const Line& line : assembly.lines) {
        if (line.kind != LineKind::mountain && line.kind != LineKind::valley) continue;
        const double deg = line.fold_angle.value_or(0.0) * 180.0 / std::numbers::pi;
        ++ends[std::round((line.kind == LineKind::mountain ? -deg : deg) * 1e3) / 1e3];
    }
    return ends;
}

// What was told with a code.
inline std::vector<Diagnostic> told(const Diagnostics& diagnostics, const std::string& code) {
    std::vector<Diagnostic> found;
    for (const Diagnostic& one : diagnostics.sorted()) {
        if (one.code == code) found.push_back(one);
    }
    return found;
}

}  // namespace popup::test
