// What pages are called where a document is written: by the elements whose pieces they are.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "popup/design.h"

namespace popup::xml {

// A page has the id of its element for a name, if that is given: unlike its number, the name stays when
// another element is put in before it. The base page, number 0, has no name. Elements that are dropped have
// no page.
class PageNames {
 public:
    // `version`: that of the document that is written.
    PageNames(const Design& design, std::string_view version);
    // What is written for a page that nobody wrote yet: in documents of version 3.0 or later its name; in
    // older ones, and where it has none, its number.
    [[nodiscard]] std::string of(int page) const;
    // What stays where an author wrote a name, which older documents get a warning for: the name as it is
    // now; where there is none any more, the number.
    [[nodiscard]] std::string name_of(int page) const;

 private:
    std::vector<std::string_view> ids_;  // of each page; empty: it has none
    bool in_use_;
};

}  // namespace popup::xml
