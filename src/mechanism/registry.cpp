// The table of elements. A new element is one row here and one file beside this one.
#include <algorithm>
#include <array>
#include <charconv>
#include <string>

#include "mechanism/rows.h"

namespace popup {
namespace {

// Names are compared without regard to case, `_` and `-`.
std::string plain(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '_' || c == '-') continue;
        out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return out;
}

const std::vector<ElementInfo>& infos() {
    static const std::vector<ElementInfo> table = [] {
        std::vector<ElementInfo> list;
        for (const ElementRow& row : element_rows()) list.push_back(row.info);
        return list;
    }();
    return table;
}

}  // namespace

std::span<const ElementRow> element_rows() {
    static const std::array<ElementRow, 9> rows{kStep,         kInvertedStep,  kBeak,
                                                kInvertedBeak, kAngledStep,    kInvertedAngledStep,
                                                kVFold,        kInvertedVFold, kTent};
    return rows;
}

std::span<const ElementInfo> element_table() { return infos(); }

const ElementInfo* find_element(std::string_view name_or_code) {
    int code = -1;
    const char* end = name_or_code.data() + name_or_code.size();
    const auto parsed = std::from_chars(name_or_code.data(), end, code);
    const bool number = parsed.ec == std::errc() && parsed.ptr == end && code >= 0;
    const std::string name = plain(name_or_code);
    for (const ElementInfo& info : infos()) {
        if (number ? info.code == code : plain(info.name) == name) return &info;
    }
    return nullptr;
}

const ElementRow& element_row(const ElementInfo& info) {
    const auto rows = element_rows();
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const ElementRow& r) { return r.info.name == info.name; });
    POPUP_INVARIANT(row != rows.end());
    return *row;
}

}  // namespace popup
