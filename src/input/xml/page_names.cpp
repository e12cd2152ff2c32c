#include "input/xml/page_names.h"

#include "popup/mechanism.h"

namespace popup::xml {

PageNames::PageNames(const Design& design, std::string_view version) : ids_(1), in_use_(version >= "3.0") {
    for (const Structure& structure : design.structures) {
        const ElementInfo* info = structure.dropped ? nullptr : find_element(structure.type);
        if (info == nullptr || !info->glued) continue;
        ids_.push_back(structure.id_given ? std::string_view(structure.id) : std::string_view());
    }
}

std::string PageNames::of(int page) const { return in_use_ ? name_of(page) : std::to_string(page); }

std::string PageNames::name_of(int page) const {
    const auto number = static_cast<std::size_t>(page);
    if (page < 0 || number >= ids_.size() || ids_[number].empty()) return std::to_string(page);
    return std::string(ids_[number]);
}

}  // namespace popup::xml
