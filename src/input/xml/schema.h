// The XML schema of the canonical popup document.
#pragma once

#include <string>

namespace popup::xml {

// schemas/popup.xsd (XSD 1.0), made from element_table() and the tables of units and limits; a test holds the
// shipped file against it. XSD 1.0 cannot tell the number of points from the type, so that is said in words.
std::string render_schema();

}  // namespace popup::xml
