// One target of fuzz/targets under libFuzzer: a program each, POPUP_FUZZ_NAME its target's name.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string_view>

#include "fuzz/targets/target.h"

#define POPUP_LOOK_AT_2(name) look_at_##name
#define POPUP_LOOK_AT(name) POPUP_LOOK_AT_2(name)

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        popup::fuzz::POPUP_LOOK_AT(POPUP_FUZZ_NAME)({reinterpret_cast<const char*>(data), size});
    } catch (const std::exception& broken) {
        std::fprintf(stderr, "BROKEN: %s\n", broken.what());
        std::abort();
    }
    return 0;
}
