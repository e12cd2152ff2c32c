// Assemblies as an input language: docs/assembly.md.
#pragma once

#include <optional>
#include <string_view>

#include "popup/language.h"

namespace popup::assembly_text {

// The row's function, as language.h promises it. What is read of the text of an assembly is that assembly,
// every number of it; `file` is the file that its places are of, as the text says. Errors, located:
// `assembly-syntax`, `assembly-value` (a value is missing, of the wrong sort or out of range),
// `assembly-name` (a plate, piece or picture that is not there), `assembly-fault` (something that an assembly
// guarantees does not hold), `document-too-large`. Warning, in strict mode an error: `unknown-member`.
std::optional<Assembly> read(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);
// An object whose first member is "assembly".
bool recognises(std::string_view text);

}  // namespace popup::assembly_text
