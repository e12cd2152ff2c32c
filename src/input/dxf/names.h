// Names as files of all ages write them, in UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace popup::dxf {

class Names {
 public:
    void take_version(std::string_view acadver);
    void take_code_page(std::string_view page);
    // \U+XXXX is that character. Of bytes that are no UTF-8, those of ANSI_1252 become what they are there,
    // and those of other code pages U+FFFD.
    [[nodiscard]] std::string decoded(std::string_view name) const;

 private:
    bool utf8_ = false;  // for certain
    bool latin_ = true;
};

}  // namespace popup::dxf
