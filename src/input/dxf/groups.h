// The text of a DXF file as groups: a whole number on a line, and a value on the next.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace popup::dxf {

struct Group {
    int code = 0;
    std::string_view value;  // without blanks at either end
    int line = 0;            // of the value, from 1
};

// Takes groups off a text, one after the other; comments (999) are passed over. Lines end with LF, CR or
// both.
class Groups {
 public:
    // `text` must outlive this object.
    explicit Groups(std::string_view text) : text_(text) {}
    // False at the end of the text, and where it is no group.
    bool next(Group& group);
    // Why next() was false, a sentence without its full stop; empty: the text was at its end.
    [[nodiscard]] const std::string& trouble() const { return trouble_; }
    // The line that next() looks at, from 1.
    [[nodiscard]] int line() const { return line_; }

 private:
    std::string_view take_line();
    std::string_view text_;
    std::size_t at_ = 0;
    int line_ = 1;
    std::string trouble_;
};

}  // namespace popup::dxf
