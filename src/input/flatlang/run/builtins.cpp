// The tables of builtins, and what the language itself makes of them.
#include <array>
#include <string>
#include <unordered_map>

#include "input/flatlang/run/builtin.h"

namespace popup::flatlang {
namespace {

using Table = std::span<const Builtin> (*)();
constexpr std::array kTables{
    Table{turtle_builtins},  Table{number_builtins}, Table{list_builtins},
    Table{program_builtins}, Table{card_builtins},
};

// The names that programs use for what could be overwritten; "__forward" and the like cannot be lost.
constexpr std::string_view kPrelude = R"(
define forward(amt) __forward(amt) done
define backward(amt) __backward(amt) done
define left(amt) __left(amt) done
define right(amt) __right(amt) done
define roll(amt) __roll(amt) done
define pitch(amt) __pitch(amt) done
define up() __up() done
define down() __down() done
define mark(name) __mark(name) done
define backto(name) __backto(name) done
define part(name) __part(name) done
define object(name) __named_object(name) done

define turtle(size) __turtle_triangle(size / 4) __turtle_triangle(size) done
define __turtle_triangle(side)
  left(90)
  forward(side / 2)
  repeat(2) right(120) forward(side) done
  right(120)
  forward(side / 2)
  right(90)
done

define cons(element, list) __cons(element, list) done
define first(list) __first(list) done
define rest(list) __rest(list) done
define last(list) __last(list) done
define element(list, index) __element(list, index) done
define append(a, b) __join(a, b) done
define append2(a, b) __join(a, b) done
define join(a, b) __join(a, b) done
define rev(list) __reversed(list) done
define flatten(list) __flatten(list) done
define eq(a, b) __eq(a, b) done
define find(value, list, skip) __find(value, list, skip) done
define findListWithFirst(value, list, skip) __find_list(value, list, skip) done
define findIndexOfListWithFirst(value, list, skip, start) __find_list_index(value, list, skip, start) done
define split(value, list, skip) __split(value, list, skip) done
define splitAtIndex(index, list) __splitAtIndex(index, list) done
define copyList(begin, end, list) __copy_list(begin, end, list) done
define remove(value, list, times) __remove(value, list, times) done
define sub(a, b, list) __replaceNode(a, b, list) done
define subList(a, b, list) __replaceList(a, b, list) done
define ins(a, b, list) __insertNode(a, b, list) done
define insList(a, b, list) __insertList(a, b, list) done

define eval(text) __eval(text) done
define hpgl(file) __hpgl(file) done
define setPartMode(on) __setPartMode(on) done
define showPolygons(on) __showPolygons(on) done
define showSoup() __showSoup() done
define showMachine() __showMachine() done
define jitter(a, b) __jitter(a, b) done
)";

}  // namespace

const Builtin* find_builtin(std::string_view name) {
    static const std::unordered_map<std::string_view, const Builtin*> all = [] {
        std::unordered_map<std::string_view, const Builtin*> rows;
        for (const Table table : kTables) {
            for (const Builtin& row : table()) rows.emplace(row.name, &row);
        }
        return rows;
    }();
    const auto row = all.find(name);
    return row == all.end() ? nullptr : row->second;
}

std::vector<std::string_view> builtin_names() {
    std::vector<std::string_view> names;
    for (const Table table : kTables) {
        for (const Builtin& row : table()) names.push_back(row.name);
    }
    return names;
}

std::string_view prelude() { return kPrelude; }

}  // namespace popup::flatlang
