// Compiled twice: what tests are linked with.
#include "support/run_here.h"
#include "support/run_program.h"
#include "support/sanitized.h"

#ifdef __SANITIZE_ADDRESS__
#include <cstdio>

// src/main.cpp has this for its main() here.
int popupc_main(int argc, char** argv);

// What stands in ASAN_OPTIONS goes before these. 1, what sanitizers end with by themselves, is an exit status
// of popupc's. Of where memory was allocated, more than three callers take half of a short run to note.
// NOLINTNEXTLINE(bugprone-reserved-identifier)
extern "C" const char* __asan_default_options() { return "exitcode=86:malloc_context_size=3"; }
#endif

namespace popup::test {

// POPUP_SANITIZED_PROGRAM, POPUP_TSAN_PROGRAM: the tests themselves are not, but the program that they start
// is.
#if defined(__SANITIZE_ADDRESS__) || defined(POPUP_SANITIZED_PROGRAM) || defined(POPUP_TSAN_PROGRAM)
const bool kSanitized = true;
#else
const bool kSanitized = false;
#endif

#ifdef __SANITIZE_ADDRESS__
namespace {

// What main() throws ends it. Whoever calls this ends with _exit(): what tests keep until their own end, such
// as directories, is not the fork's to clear away.
int run_here(int argc, char** argv) noexcept {
    const int status = popupc_main(argc, argv);
    std::fflush(nullptr);
    return status;
}

}  // namespace

int (*const kPopupcHere)(int argc, char** argv) = run_here;
#else
int (*const kPopupcHere)(int argc, char** argv) = nullptr;
#endif

#ifdef POPUP_TSAN_PROGRAM
const int kSanitizersThreads = 1;
#else
const int kSanitizersThreads = 0;
#endif

const char* const kPopupc = POPUPC_BINARY;

}  // namespace popup::test
