// What a policy denies of a drawing of a folded sheet that was edited.
#pragma once

#include <string>

#include "popup/compile.h"
#include "popup/diagnostics.h"
#include "popup/files.h"

namespace popup::edit {

// Whether a policy makes errors of what is none by itself.
bool denies(const DiagnosticPolicy& policy);

// Whether the edited drawing has more errors of a code than the drawing had, of all that compile() finds of
// folded sheets up to the pattern; those of such codes that it did not have in these words are added to
// `of_document`, whose policy says what an error is. Cost: one compilation, and one more where the first
// finds an error.
bool brings_denied(const Source& before, const std::string& after, const CompileOptions& options,
                   Diagnostics& of_document);

}  // namespace popup::edit
