// Compiled twice: what tests are linked with.
#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup::test {

#ifdef __SANITIZE_ADDRESS__
const bool kSanitized = true;
#else
const bool kSanitized = false;
#endif
const char* const kPopupc = POPUPC_BINARY;

}  // namespace popup::test
