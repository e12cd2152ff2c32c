#include "input/flatlang/syntax/parse.h"

#include <fmt/format.h>

#include "input/flatlang/syntax/parser.h"
#include "input/text.h"

namespace popup::flatlang {

Parsed Parser::run(std::string_view file) {
    result_.syntax.file = file;
    lexical_errors();
    program();
    if (old_names_ > 1) {
        old_name_->hint(
            fmt::format("the same in {} further {}", old_names_ - 1, old_names_ == 2 ? "place" : "places"));
    }
    result_.complete = !errors_;
    return std::move(result_);
}

Parsed parse(std::string_view file, std::string_view text, const ParseOptions& options, Symbols& symbols,
             Diagnostics& diagnostics) {
    if (!options.as_2008 && is_wide_text(text)) {
        diagnostics.error("encoding", {1, 1}, "the program is in UTF-16 or UTF-32, and only UTF-8 is read")
            .hint("save the program as UTF-8");
        Parsed nothing = Parser({}, options, symbols, diagnostics).run(file);
        nothing.complete = false;
        return nothing;
    }
    return Parser(text, options, symbols, diagnostics).run(file);
}

}  // namespace popup::flatlang
