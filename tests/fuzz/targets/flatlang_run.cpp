// FlatLang programs, read and run, with the limits of look_at_design(); the trail too.
#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_flatlang_run(std::string_view bytes) {
    ReadOptions options;
    options.program.as_2008 = !bytes.empty() && bytes.back() == ' ';
    look_at_design("fuzz.fl", bytes, options);
}

}  // namespace popup::fuzz
