#include "parts/flat_parts.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

namespace popup {
namespace {

void add_plates(const FlatPart& part, int number, Assembly& assembly) {
    Piece& piece = assembly.pieces.back();
    const bool stands = !part.faces.empty();
    const std::size_t count = stands ? part.faces.size() : part.paper.size();
    for (std::size_t i = 0; i < count; ++i) {
        Plate plate;
        plate.name = count == 1 ? part.name : fmt::format("{}/{}", part.name, i + 1);
        plate.piece = number;
        plate.outline = stands ? part.faces[i].shape : part.paper[i];
        if (stands) plate.stands = part.faces[i].frame;
        piece.plates.push_back(static_cast<int>(assembly.plates.size()));
        assembly.plates.push_back(std::move(plate));
    }
}

void add_lines(const FlatPart& part, int number, Assembly& assembly) {
    for (const FlatLine& line : part.lines) {
        for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
            assembly.lines.push_back(
                {line.kind, {line.points[i], line.points[i + 1]}, number, -1, -1, line.fold_angle});
        }
    }
}

template <typename T>
void add_prints(std::vector<T> prints, Piece& piece) {
    piece.prints.insert(piece.prints.end(), std::make_move_iterator(prints.begin()),
                        std::make_move_iterator(prints.end()));
}

}  // namespace

Assembly assembly_of(FlatParts parts) {
    Assembly assembly;
    for (FlatPart& part : parts.parts) {
        const int number = static_cast<int>(assembly.pieces.size());
        Piece& piece = assembly.pieces.emplace_back();
        piece.name = part.name;
        piece.place = part.place;
        add_plates(part, number, assembly);
        add_lines(part, number, assembly);
        if (!part.traces.empty()) assembly.traces.push_back({part.name, number, std::move(part.traces)});
        piece.paper = std::move(part.paper);
        piece.slits = std::move(part.slits);
        add_prints(std::move(part.fills), piece);
        add_prints(std::move(part.strokes), piece);
        add_prints(std::move(part.texts), piece);
    }
    for (Trace& trace : parts.traces) assembly.traces.push_back(std::move(trace));
    return assembly;
}

}  // namespace popup
