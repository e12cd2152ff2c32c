// Popup documents: what is read patches to itself, and the canonical document is read as the same.
#include "output/xml.h"

#include <optional>

#include "fuzz/targets/target.h"
#include "popup/edit.h"

namespace popup::fuzz {

void look_at_xml(std::string_view bytes) {
    const Source source{"fuzz.xml", std::string(bytes)};
    Diagnostics told(source.name);
    const std::optional<Design> design = read_design(source, {}, told);
    expect_told(told, bytes);
    expect(design.has_value() == !told.has_errors(), "a design, or an error");
    Diagnostics of_format(source.name);
    const std::optional<std::string> formatted = format_document(source, of_format);
    expect_told(of_format, bytes);
    if (formatted) {
        Diagnostics again(source.name);
        expect(format_document({source.name, *formatted}, again) == formatted, "a formatted document stays");
    }
    if (!design) return;
    expect(language_table().front().patch(source, *design) == bytes, "without changes the text stays");
    const std::string written = write_document(*design);
    Diagnostics of_written(source.name);
    const auto rewritten = read_design({source.name, written}, {true, {}, {}}, of_written);
    expect(rewritten.has_value(), "a written document is read");
    expect(write_document(*rewritten) == written, "a written document is written the same");
    look_at_design(source.name, bytes);
}

}  // namespace popup::fuzz
