// Comments by which a document allows findings: <!-- popupc: allow collision: they are meant to touch -->
#pragma once

#include <vector>

#include "input/xml/locate.h"
#include "popup/design.h"
#include "popup/diagnostics.h"

namespace popup::xml {

// Documents with more codes in such comments than this are refused, to bound the work.
inline constexpr std::size_t kAllowancesLimit = 10'000;

// What comments can be for: the whole document only, or its structures as well. A comment inside a structure,
// or before one with nothing but blanks and comments between, is for that one; all others are for the
// document.
enum class AllowanceScope { document, elements };

// Reads the comments that are meant for this program. Those for the whole document are told to `diagnostics`
// at once; those for structures are returned, with their place in the source and without an id.
// `bad-allow` warnings for what is not understood; `document-too-large` for more codes than the limit.
std::vector<Allowance> read_allowances(const Located& located, AllowanceScope scope,
                                       Diagnostics& diagnostics);

// Tells `diagnostics` of these, with the ids of the structures they are for.
void allow_for_elements(std::vector<Allowance> allowances, const std::vector<Structure>& structures,
                        Diagnostics& diagnostics);

}  // namespace popup::xml
