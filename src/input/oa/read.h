// Designs of webOAcard as an input language: cards of one sheet that open to 90°.
#pragma once

#include <optional>
#include <string_view>

#include "popup/language.h"

namespace popup::oa {

// The row's function, as language.h promises it. The assembly is one piece, the card: its back is the cover
// on the left and its floor that on the right, `face-3` stands for faces[3], `face-3/top` runs back from it,
// and `face-3/2` is a second part of it. All joints but the covers' are parallels; the sweep goes to 90°.
// Paper that no fold leads to is no part of it: `oa-loose` names it where it was not cut out as a hole.
// Besides the findings of card.h and sheet.h: `oa-no-card`, where back or floor have no paper left.
// Cost: near linear in corners, as long as each plate meets few others.
std::optional<Assembly> read(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);
// An object whose first member is "settings" or "faces".
bool recognises(std::string_view text);

}  // namespace popup::oa
