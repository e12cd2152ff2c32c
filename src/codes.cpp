// Every diagnostic code with the paragraph that `popupc explain` prints: the rows of all rooms in one table.
// A room's rows stand in its own codes.cpp; a code that several rooms give stands in the first of them.
#include "base/diagnostics/codes.h"

#include <algorithm>
#include <vector>

#include "batch/codes.h"
#include "check/codes.h"
#include "cli/codes.h"
#include "edit/codes.h"
#include "fabrication/codes.h"
#include "findings/codes.h"
#include "folded/codes.h"
#include "input/assembly/codes.h"
#include "input/codes.h"
#include "input/cp/codes.h"
#include "input/drawing/card/codes.h"
#include "input/drawing/codes.h"
#include "input/dxf/codes.h"
#include "input/flatlang/codes.h"
#include "input/fold/codes.h"
#include "input/oa/codes.h"
#include "input/xml/codes.h"
#include "layout/codes.h"
#include "mechanism/codes.h"
#include "motion/codes.h"
#include "output/codes.h"
#include "parts/codes.h"
#include "pattern/codes.h"
#include "popup/diagnostics.h"
#include "repair/codes.h"
#include "run/codes.h"
#include "trace/codes.h"

namespace popup {
namespace {

std::vector<CodeInfo> sorted_rows() {
    std::vector<CodeInfo> rows;
    for (const std::span<const CodeInfo> room :
         {base_codes(),     input_codes(),     xml_codes(),         drawing_codes(), drawn_card_codes(),
          flatlang_codes(), assembly_codes(),  fold_codes(),        dxf_codes(),     oa_codes(),
          parts_codes(),    mechanism_codes(), check_codes(),       folded_codes(),  motion_codes(),
          pattern_codes(),  layout_codes(),    fabrication_codes(), output_codes(),  run_codes(),
          findings_codes(), repair_codes(),    batch_codes(),       cli_codes(),     trace_codes(),
          edit_codes(),     cp_codes()}) {
        rows.insert(rows.end(), room.begin(), room.end());
    }
    std::ranges::sort(rows, {}, &CodeInfo::code);
    return rows;
}

}  // namespace

std::span<const CodeInfo> code_table() {
    static const std::vector<CodeInfo> table = sorted_rows();
    return table;
}

const CodeInfo* find_code(std::string_view code) {
    const std::span<const CodeInfo> table = code_table();
    const auto row = std::ranges::lower_bound(table, code, {}, &CodeInfo::code);
    return row != table.end() && row->code == code ? &*row : nullptr;
}

}  // namespace popup
