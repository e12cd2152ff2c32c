// Where places may lie in a text.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "base/text/utf8.h"

namespace popup::test {

// Lines of a text, each with the columns that it has, the one behind its last character among them.
inline std::vector<int> columns(std::string_view text) {
    std::vector<int> lines{1};
    for (std::size_t at = 0; at < text.size();) {
        const Character next = first_character(text.substr(at));
        at += next.bytes;
        if (next.code == '\n') {
            lines.push_back(1);
        } else {
            ++lines.back();
        }
    }
    return lines;
}

}  // namespace popup::test
