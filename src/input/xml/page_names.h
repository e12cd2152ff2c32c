// What pages are called where a document is written: by the elements whose pieces they are.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "popup/design.h"

namespace popup::xml {

// In documents of version 3.0 or later a page is named by the id of its element, if that is given, so that no
// name changes when another element is put in before it. Other pages, and those of older documents, are
// numbers: 0 is the base page. Elements that are dropped have no page.
class PageNames {
 public:
    // `version`: that of the document that is written.
    PageNames(const Design& design, std::string_view version);
    [[nodiscard]] std::string of(int page) const;

 private:
    std::vector<std::string_view> ids_;  // of each page; empty: it has none
};

}  // namespace popup::xml
