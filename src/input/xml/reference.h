// Character and entity references: "&amp;", "&#49;", "&#x31;".
#pragma once

#include <cstddef>
#include <string_view>

namespace popup::xml {

struct Reference {
    enum class Fault { none, no_reference, unknown_entity, forbidden_character };
    Fault fault = Fault::none;
    std::size_t length = 0;       // bytes from "&" to after ";"; of a fault: to where reading stopped
    std::size_t utf8_length = 0;  // bytes of the character it stands for
};

// Reads the reference at the start of `text`. Only the five entities that XML itself defines are known.
// Precondition: `text` starts with "&".
Reference read_reference(std::string_view text);

}  // namespace popup::xml
