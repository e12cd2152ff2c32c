// The entities that the document type declaration of a drawing defines. Old Illustrator files write the
// styles of all lines as such.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace popup::drawing {

//     const Entities entities("<!DOCTYPE svg [<!ENTITY st1 \"stroke:#f00;\">]>");
//     entities.expanded("&st1;fill:none")  // "stroke:#f00;fill:none"
class Entities {
 public:
    static constexpr std::size_t kMost = 1000;     // that are kept
    static constexpr std::size_t kLongest = 1000;  // bytes of one, with those in it expanded
    static constexpr std::size_t kLongestName = 100;
    static constexpr std::size_t kLongestValue = 10'000;
    static constexpr std::size_t kInAll = 50'000'000;  // of all values that were asked for

    Entities() = default;
    // Of the text before the root element. Only texts that stand in the declaration itself count: no file is
    // looked at, nothing that a parameter entity brings, and in an entity only those that are defined before
    // it. Of several with one name the first. Cost: linear.
    explicit Entities(std::string_view prolog);

    // The value with these in place of their references; nullopt where it has none of them, would be longer
    // than kLongestValue, or kInAll is used up.
    [[nodiscard]] std::optional<std::string> expanded(std::string_view value);

 private:
    [[nodiscard]] std::optional<std::string> expanded(std::string_view value, std::size_t longest) const;
    std::map<std::string, std::string, std::less<>> values_;
    std::size_t left_ = kInAll;
};

}  // namespace popup::drawing
