// FlatLang's parser, in both modes.
#include "fuzz/targets/target.h"
#include "input/flatlang/syntax/parse.h"

namespace popup::fuzz {

void look_at_flatlang_parse(std::string_view bytes) {
    for (const bool as_2008 : {false, true}) {
        flatlang::Symbols symbols;
        Diagnostics told("fuzz.fl");
        const flatlang::Parsed parsed =
            flatlang::parse("fuzz.fl", bytes, {.as_2008 = as_2008}, symbols, told);
        expect_told(told, bytes);
        expect(!parsed.complete || !told.has_errors(), "a whole tree, or errors");
    }
}

}  // namespace popup::fuzz
