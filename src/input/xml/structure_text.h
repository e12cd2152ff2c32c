// One structure as the canonical document writes it.
#pragma once

#include <string>
#include <string_view>

#include "input/xml/page_names.h"
#include "popup/design.h"

namespace popup::xml {

// By how much what is inside of a line with this indent stands further in: a tab where that ends with one,
// else two blanks.
std::string_view indent_step(std::string_view indent);

// Its lines, each with a final line break. The first begins with `indent`; what is inside of it stands an
// indent_step() further in a level. `pages`: of the document that is written. `automatic`: an id that was not
// given is left to the reader. `source`: the text that the design was read from; what it draws out of a file
// then stays so, and else becomes path data.
std::string structure_text(const Design& design, const Structure& structure, const PageNames& pages,
                           const std::string& indent, bool automatic, std::string_view source = {});

}  // namespace popup::xml
