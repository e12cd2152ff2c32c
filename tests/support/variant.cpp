// Compiled twice: what tests are linked with.
#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup::test {

// POPUP_SANITIZED_PROGRAM: the tests themselves are not, but the program that they start is.
#if defined(__SANITIZE_ADDRESS__) || defined(POPUP_SANITIZED_PROGRAM)
const bool kSanitized = true;
#else
const bool kSanitized = false;
#endif
const char* const kPopupc = POPUPC_BINARY;

}  // namespace popup::test
