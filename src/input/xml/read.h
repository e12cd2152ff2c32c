// The popup XML document as an input language.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "popup/language.h"

namespace popup::xml {

// The row's functions, as language.h promises them.
Reading read_document(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);
// The design alone.
std::optional<Design> read(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);
std::string patch(const Source& source, const Design& design);
// The same of a design that has been edited: structures that were added are written behind the others, and
// what stands at `gone` is taken out.
std::string patch(const Source& source, const Design& design, std::span<const TextRange> gone);

// Bytes [begin, end) of a source, and what stands there in place of them.
struct PatchEdit {
    std::size_t begin;
    std::size_t end;
    std::string text;
};
// What patch() changes, in the order of the text; none overlap.
std::vector<PatchEdit> patch_edits(const Source& source, const Design& design,
                                   std::span<const TextRange> gone = {});
// The text with these changes.
std::string patched(std::string_view text, std::span<const PatchEdit> edits);

// Names structures that have no id of their own, as reading does: the n-th is e<n>; where an author has taken
// that name, it has the next free number behind all structures, so that the others keep theirs.
void name_structures(Design& design);

}  // namespace popup::xml
