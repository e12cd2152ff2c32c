// Comments that allow findings.
#include "fuzz/targets/target.h"
#include "input/xml/allowances.h"
#include "input/xml/encoding.h"
#include "input/xml/locate.h"

namespace popup::fuzz {

void look_at_allow(std::string_view bytes) {
    for (const xml::AllowanceScope scope : {xml::AllowanceScope::document, xml::AllowanceScope::elements}) {
        Diagnostics told("fuzz.xml");
        if (!xml::check_encoding(bytes, told)) return;
        const auto located = xml::locate(bytes, told, xml::Doctype::skip);
        if (located) {
            for (const Allowance& one : xml::read_allowances(*located, scope, told)) {
                expect(one.within.has_value(), "it is for a structure");
                expect(find_code(one.code) != nullptr, "it is for a code of the table");
            }
        }
        expect_told(told, bytes);
    }
}

}  // namespace popup::fuzz
