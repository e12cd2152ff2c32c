// Edits in a file, made on one document: all of them or none, and what they make is read.
#include "fuzz/targets/target.h"
#include "popup/edit.h"

namespace popup::fuzz {

void look_at_edits(std::string_view bytes) {
    static const Source document{"card.xml", R"(<popup version="3.0" units="mm">
  <mainpage width="200" height="150"/>
  <structurelist>
    <structure type="step" id="box">
      <outerpoints>-30,20 -30,-20 30,20 30,-20</outerpoints>
      <parentfold page="0"><begin x="0" y="-75"/><end x="0" y="75"/></parentfold>
    </structure>
  </structurelist>
</popup>
)"};
    Diagnostics told("edits.txt");
    const auto edits = read_edits(bytes, told);
    expect_told(told, bytes);
    if (told.has_errors() || edits.size() > 12) return;
    Diagnostics of_document(document.name);
    const auto edited = edit_document(document, edits, {}, told, of_document);
    expect_told(told, bytes);
    if (!edited || edited->refused) return;
    Diagnostics again(document.name);
    expect(read_design({document.name, edited->text}, {}, again).has_value(), "what edits make is read");
}

}  // namespace popup::fuzz
