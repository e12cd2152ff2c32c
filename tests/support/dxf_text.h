// DXF texts for tests, a row of groups at a time.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/dxf/read.h"
#include "support/designs.h"

namespace popup::test {

// "0 LINE|8 CUT|10 5" as groups: a code, a blank and a value, with "|" between.
inline std::string dxf_groups(std::string_view rows) {
    std::string text;
    while (!rows.empty()) {
        const std::size_t end = rows.find('|');
        const std::string_view row = rows.substr(0, end);
        const std::size_t blank = row.find(' ');
        text += row.substr(0, blank);
        text += '\n';
        if (blank != std::string_view::npos) text += row.substr(blank + 1);
        text += '\n';
        rows.remove_prefix(end == std::string_view::npos ? rows.size() : end + 1);
    }
    return text;
}

// A file in mm. `tables` and `blocks` are what stands in these sections.
inline std::string dxf_file(std::string_view entities, std::string_view tables = {},
                            std::string_view blocks = {}, std::string_view header = "9 $INSUNITS|70 4") {
    const auto section = [](std::string_view name, std::string_view rows) {
        return rows.empty() ? std::string()
                            : dxf_groups("0 SECTION|2 " + std::string(name)) + dxf_groups(rows) +
                                  dxf_groups("0 ENDSEC");
    };
    return section("HEADER", header) + section("TABLES", tables) + section("BLOCKS", blocks) +
           dxf_groups("0 SECTION|2 ENTITIES") + dxf_groups(entities) + dxf_groups("0 ENDSEC|0 EOF");
}

struct TracedDxf {
    std::optional<drawing::Tracing> tracing;
    std::string told;  // "warning not-cut: …\n" a finding
    std::vector<Diagnostic> findings;

    [[nodiscard]] const drawing::TracedLine& line(std::size_t i = 0) const {
        return tracing.value().lines.at(i);
    }
};

inline TracedDxf traced_dxf(const std::string& text, const ReadOptions& options = {}) {
    Diagnostics diagnostics("box.dxf");
    TracedDxf result;
    result.tracing = dxf::read_tracing(Source{"box.dxf", text}, options, diagnostics);
    result.told = findings(diagnostics);
    result.findings = diagnostics.sorted();
    return result;
}

}  // namespace popup::test
