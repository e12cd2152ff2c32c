#include "input/drawing/read.h"

#include <utility>

#include "assembly/settle.h"
#include "base/text/utf8.h"
#include "input/drawing/fold_like.h"
#include "input/drawing/notation.h"
#include "input/drawing/trace.h"
#include "input/text.h"
#include "input/xml/allowances.h"
#include "input/xml/encoding.h"
#include "input/xml/locate.h"
#include "parts/drawn_parts.h"

namespace popup::drawing {

std::optional<Tracing> read_tracing(const Source& source, const ReadOptions& options,
                                    Diagnostics& diagnostics) {
    if (!xml::check_encoding(source.text, diagnostics)) return std::nullopt;
    const auto located = xml::locate(source.text, diagnostics, xml::Doctype::skip);
    if (!located) return std::nullopt;
    xml::read_allowances(*located, xml::AllowanceScope::document, diagnostics);
    return trace(*located, options, diagnostics);
}

namespace {

std::optional<FlatParts> parts_of(Tracing&& tracing, Diagnostics& diagnostics) {
    settle_uses(tracing, diagnostics);
    return make_parts(tracing, diagnostics);
}

}  // namespace

std::optional<FlatParts> read_parts(const Source& source, const ReadOptions& options,
                                    Diagnostics& diagnostics) {
    auto tracing = read_tracing(source, options, diagnostics);
    return tracing ? parts_of(std::move(*tracing), diagnostics) : std::nullopt;
}

DrawnAs shown_by(const Tracing& tracing) {
    return tracing.by_layers && has_folds(tracing) ? DrawnAs::folded : DrawnAs::parts;
}

std::optional<Assembly> flat_assembly(Tracing&& tracing, Diagnostics& diagnostics) {
    std::optional<FlatParts> parts = parts_of(std::move(tracing), diagnostics);
    if (!parts) return std::nullopt;
    Assembly assembly = assembly_of(std::move(*parts));
    settle_numbers(assembly);
    return assembly;
}

bool recognises(std::string_view text) {
    text = without_mark(text);
    while (true) {
        text = trimmed(text);
        std::string_view closing;
        if (text.starts_with("<?")) closing = "?>";
        if (text.starts_with("<!--")) closing = "-->";
        if (text.starts_with("<!DOCTYPE")) return trimmed(text.substr(9)).starts_with("svg");
        if (closing.empty()) break;
        const std::size_t end = text.find(closing);
        if (end == std::string_view::npos) return false;
        text.remove_prefix(end + closing.size());
    }
    if (!text.starts_with('<')) return false;
    const std::string_view name = text.substr(1, text.find_first_of(" \t\r\n/>", 1) - 1);
    return name == "svg" || name.ends_with(":svg");
}

}  // namespace popup::drawing
