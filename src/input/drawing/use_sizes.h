// How much use elements stand for, counted before any of it is drawn: ten levels of ten uses each are ten
// lines of a drawing, and ten thousand million elements of what it shows.
#pragma once

#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "input/xml/locate.h"

namespace popup::drawing {

class UseSizes {
 public:
    using Ids = std::unordered_map<std::string_view, xml::Offset>;  // of elements, by their ids
    struct Size {
        std::size_t elements = 0;
        std::size_t bytes = 0;  // of their start tags
    };

    // `prefix`: of the names of SVG, "" or such as "svg:". All must outlive this.
    UseSizes(const xml::Located& located, std::string_view prefix, const Ids& ids)
        : located_(located), prefix_(prefix), ids_(ids) {}

    // What is looked at where a use stands for `target`, with all that the uses in it stand for: never more
    // than that, so that what is refused for it would be refused later. What may be hidden counts as nothing,
    // a use inside what it stands for, too; numbers end at kMost. Precondition: no style sheet hides
    // elements. Cost: linear in the elements in all that is stood for, once; no recursion.
    Size of(xml::Offset target);

    static constexpr std::size_t kMost = std::size_t{1} << 40U;

 private:
    [[nodiscard]] std::string_view attribute(xml::Offset element, std::string_view name) const;
    [[nodiscard]] std::string_view tag_of(xml::Offset element) const;
    [[nodiscard]] bool may_be_hidden(xml::Offset element) const;
    [[nodiscard]] xml::Offset target_of(xml::Offset use) const;

    enum class State : char { unknown, begun, known };
    struct Known {
        Size size;
        State state = State::unknown;
    };
    const xml::Located& located_;
    std::string_view prefix_;
    const Ids& ids_;
    std::unordered_map<xml::Offset, Known> known_;  // by target
};

}  // namespace popup::drawing
