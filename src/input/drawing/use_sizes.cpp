#include "input/drawing/use_sizes.h"

#include <algorithm>

#include "input/drawing/vocabulary.h"
#include "input/text.h"

namespace popup::drawing {

using xml::Offset;

std::string_view UseSizes::attribute(Offset element, std::string_view name) const {
    const std::size_t end = element + 1 < located_.elements.size()
                                ? located_.elements[element + 1].first_attribute
                                : located_.attributes.size();
    for (std::size_t i = located_.elements[element].first_attribute; i < end; ++i) {
        const xml::LocatedAttribute& one = located_.attributes[i];
        if (located_.text.substr(one.name, one.name_length) == name)
            return located_.text.substr(one.value, one.value_length);
    }
    return {};
}

std::string_view UseSizes::tag_of(Offset element) const {
    std::string_view name = located_.name(element);
    if (!name.starts_with(prefix_)) return {};
    name.remove_prefix(prefix_.size());
    return name.find(':') == std::string_view::npos ? name : std::string_view{};
}

bool UseSizes::may_be_hidden(Offset element) const {
    // Of a switch one element is drawn, and where conditions do not hold, none.
    for (const std::string_view condition : {"requiredExtensions", "systemLanguage"}) {
        if (!attribute(element, condition).empty()) return true;
    }
    return tag_of(element) == "switch" || !attribute(element, "display").empty() ||
           attribute(element, "style").find("none") != std::string_view::npos;
}

// 0: the use stands for nothing that is known.
Offset UseSizes::target_of(Offset use) const {
    std::string_view href = trimmed(attribute(use, "href"));
    if (href.empty()) href = trimmed(attribute(use, "xlink:href"));
    if (!href.starts_with('#')) return 0;
    const auto found = ids_.find(href.substr(1));
    return found == ids_.end() ? 0 : found->second;
}

UseSizes::Size UseSizes::of(Offset target) {
    struct Frame {
        Offset target = 0, next = 0;
        Size size;
    };
    const auto add = [](Size& to, const Size& more) {
        to.elements = std::min(kMost, to.elements + more.elements);
        to.bytes = std::min(kMost, to.bytes + more.bytes);
    };
    std::vector<Frame> stack;
    const auto begin = [&](Offset one) {
        known_[one].state = State::begun;
        stack.push_back({one, one, {}});
    };
    if (known_[target].state == State::unknown) begin(target);
    while (!stack.empty()) {
        Frame& frame = stack.back();
        if (frame.next >= located_.elements[frame.target].after) {
            known_[frame.target] = {frame.size, State::known};
            stack.pop_back();
            continue;
        }
        const Offset element = frame.next;
        const xml::LocatedElement& at = located_.elements[element];
        const std::string_view tag = tag_of(element);
        const bool is_target = element == frame.target;
        const Role role = tag == "symbol" && is_target ? Role::container : role_of(tag);
        const bool is_looked_at = !tag.empty() && role != Role::silent && role != Role::unknown;
        if (is_looked_at && role == Role::use && !may_be_hidden(element)) {
            const Offset other = target_of(element);
            if (other != 0 && known_[other].state == State::unknown) {
                begin(other);  // and come back to this use
                continue;
            }
            if (other != 0) add(frame.size, known_[other].size);
        }
        if (is_looked_at) add(frame.size, {1, at.tag_end - at.begin});
        const bool goes_in = is_looked_at && role == Role::container && !may_be_hidden(element);
        frame.next = goes_in ? element + 1 : at.after;
    }
    return known_[target].size;
}

}  // namespace popup::drawing
