#include "input/dxf/read.h"

#include "input/dxf/document.h"
#include "input/dxf/groups.h"
#include "input/dxf/trace.h"

namespace popup::dxf {

std::optional<drawing::Tracing> read_tracing(const Source& source, const ReadOptions& options,
                                             Diagnostics& diagnostics) {
    const std::optional<Document> document = read_document(source.text, diagnostics);
    return document ? trace(*document, options, diagnostics) : std::nullopt;
}

bool recognises(std::string_view text) {
    if (is_binary(text)) return true;
    Groups groups(text);
    Group group;
    return groups.next(group) && group.code == 0 && group.value == "SECTION";
}

}  // namespace popup::dxf
