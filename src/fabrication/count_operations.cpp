#include "fabrication/count_operations.h"

#include "base/nth.h"

namespace popup {

OperationCounts count_operations(const Layout& layout, const Profile& profile) {
    OperationCounts found{};
    const auto count = [&found](Operation operation, std::size_t more = 1) { nth(found, operation) += more; };
    for (const Placement& placement : layout.placements) {
        const Pattern& pattern = layout.designs.at(static_cast<std::size_t>(placement.design)).pattern;
        const PatternPiece& piece = pattern.pieces.at(static_cast<std::size_t>(placement.piece));
        for (const PatternPrint& one : piece.prints) count(operation_of(one.print));
        count(Operation::glue, piece.targets.size());
        count(Operation::label, piece.labels.size());
        if (profile.marks_glue()) {
            const bool names = profile.marks_on == MarksOn::front || profile.marks_on == MarksOn::back;
            count(Operation::mark, piece.targets.size());
            for (const Label& label : piece.labels)
                count(Operation::mark, names || label.kind != LabelKind::piece ? 1 : 0);
            if (!names && piece.hidden_number) count(Operation::mark);
        }
        for (const PatternLine& line : piece.lines) {
            const Operation what = operation_of(line, profile);
            count(what);
            if (profile.perforates(what)) count(Operation::perforation);
        }
        for (const Contour& cut : piece.cuts) count(operation_of(cut, profile));
    }
    return found;
}

}  // namespace popup
