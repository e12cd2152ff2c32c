#include "input/flatlang/syntax/parse.h"

#include <fmt/format.h>

#include "input/flatlang/syntax/parser.h"

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
    return Parser(text, options, symbols, diagnostics).run(file);
}

}  // namespace popup::flatlang
