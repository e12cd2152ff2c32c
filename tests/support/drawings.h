// Drawings for tests, and what is read of them.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/drawing/read.h"
#include "parts/flat_parts.h"
#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/language.h"

namespace popup::test {

struct ReadDrawing {
    std::optional<FlatParts> list;
    std::vector<Diagnostic> findings;

    // "3:5 bad-path\n" a finding, worst first.
    [[nodiscard]] std::string codes() const {
        std::string text;
        for (const Diagnostic& one : findings) {
            text += std::to_string(one.place.line) + ":" + std::to_string(one.place.column) + " " + one.code +
                    "\n";
        }
        return text;
    }
    [[nodiscard]] const std::vector<FlatPart>& parts() const { return list.value().parts; }
    [[nodiscard]] const FlatPart& part(std::size_t i = 0) const { return list.value().parts.at(i); }
};

inline ReadDrawing read_drawing(std::string text, bool strict = false) {
    Diagnostics diagnostics("drawing.svg");
    const Source source{"drawing.svg", std::move(text)};
    ReadDrawing reading;
    reading.list = drawing::read_parts(source, ReadOptions{strict, {}, {}}, diagnostics);
    reading.findings = diagnostics.sorted();
    return reading;
}

// Of 100 × 100 mm, a unit a millimetre, everything stroked; `body` begins on line 2.
inline std::string drawing(std::string_view body) {
    return "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' "
           "xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' width='100mm' height='100mm' "
           "viewBox='0 0 100 100' fill='none' stroke='red'>\n" +
           std::string(body) + "\n</svg>";
}

inline double area(const FlatPart& part) {
    double sum = 0.0;
    for (const Polygon& paper : part.paper) sum += popup::area(paper);
    return sum;
}

inline Box bounds(const FlatPart& part) {
    Box box;
    for (const Polygon& paper : part.paper) {
        for (const Vec2 p : paper.outer) box.extend(p);
    }
    return box;
}

}  // namespace popup::test
