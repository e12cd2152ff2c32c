// One object of a DXF file, an entity or a row of a table: its groups by code.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "input/dxf/groups.h"
#include "popup/diagnostics.h"
#include "popup/geometry.h"

namespace popup::dxf {

// Numbers that cannot be read are a located `bad-number` error; asked for, they are 0.
class Record {
 public:
    explicit Record(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    void begin(const Group& head);
    void add(const Group& group) { groups_.push_back(group); }

    [[nodiscard]] std::string_view kind() const { return kind_; }
    [[nodiscard]] int line() const { return line_; }  // of its kind
    [[nodiscard]] const std::vector<Group>& groups() const { return groups_; }
    // False from the first number on that could not be read.
    [[nodiscard]] bool sound() const { return sound_; }

    // The first group of that code; what is not there is `otherwise`.
    [[nodiscard]] std::string_view text(int code, std::string_view otherwise = {}) const;
    double number(int code, double otherwise = 0.0);
    int whole(int code, int otherwise = 0);
    // Groups code and code + 10.
    Vec2 point(int code) { return {number(code), number(code + 10)}; }

    double value(const Group& group);
    int whole_value(const Group& group);

 private:
    [[nodiscard]] const Group* find(int code) const;
    Diagnostics& diagnostics_;
    std::string_view kind_;
    int line_ = 0;
    std::vector<Group> groups_;
    bool sound_ = true;
};

}  // namespace popup::dxf
