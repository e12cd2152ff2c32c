#include "input/dxf/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "input/text.h"

namespace popup::dxf {

void Record::begin(const Group& head) {
    kind_ = head.value;
    line_ = head.line;
    groups_.clear();
    sound_ = true;
}

const Group* Record::find(int code) const {
    const auto found = std::find_if(groups_.begin(), groups_.end(),
                                    [code](const Group& group) { return group.code == code; });
    return found == groups_.end() ? nullptr : &*found;
}

std::string_view Record::text(int code, std::string_view otherwise) const {
    const Group* group = find(code);
    return group == nullptr ? otherwise : group->value;
}

double Record::number(int code, double otherwise) {
    const Group* group = find(code);
    return group == nullptr ? otherwise : value(*group);
}

int Record::whole(int code, int otherwise) {
    const Group* group = find(code);
    return group == nullptr ? otherwise : whole_value(*group);
}

double Record::value(const Group& group) {
    std::string_view text = group.value;
    if (text.starts_with('+')) text.remove_prefix(1);
    double number = 0.0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc{} && stop == text.data() + text.size() && std::isfinite(number)) return number;
    diagnostics_.error("bad-number", {group.line, 1},
                       fmt::format("group {} of this {} is \"{}\", which is no number", group.code,
                                   shown(kind_), shown(group.value)));
    sound_ = false;
    return 0.0;
}

int Record::whole_value(const Group& group) {
    constexpr double kMost = 2147483647.0;
    const double number = value(group);
    if (number == std::floor(number) && std::abs(number) <= kMost) return static_cast<int>(number);
    diagnostics_.error("bad-number", {group.line, 1},
                       fmt::format("group {} of this {} is \"{}\", which is no whole number", group.code,
                                   shown(kind_), shown(group.value)));
    sound_ = false;
    return 0;
}

}  // namespace popup::dxf
