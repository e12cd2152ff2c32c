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
    Table{program_builtins}, Table{card_builtins},   Table{sheet_builtins},
};

// The names that programs use for what could be overwritten; "__forward" and the like cannot be lost.
constexpr std::string_view kPrelude = R"(
define forward(amt) __forward(amt) done  ; goes ahead, by so many inches
define backward(amt) __backward(amt) done  ; goes back, without turning round
define left(amt) __left(amt) done  ; turns to the left, in degrees
define right(amt) __right(amt) done  ; turns to the right, in degrees
define roll(amt) __roll(amt) done  ; turns about the way ahead, in degrees: the right side dips
define pitch(amt) __pitch(amt) done  ; turns about the way to the right, in degrees: the nose rises
define up() __up() done  ; lifts the pen: what follows is not drawn
define down() __down() done  ; sets the pen down: what follows is drawn
define mark(name) __mark(name) done  ; gives the place where the turtle is a name
define backto(name) __backto(name) done  ; goes back to the nearest mark of that name on the way here
define part(name) __part(name) done  ; begins a part of that name
define object(name) __named_object(name) done  ; makes an object, which prints as that name

define turtle(size) __turtle_triangle(size / 4) __turtle_triangle(size) done  ; draws a triangle that shows where the turtle is
define __turtle_triangle(side)
  left(90)
  forward(side / 2)
  repeat(2) right(120) forward(side) done
  right(120)
  forward(side / 2)
  right(90)
done

define cons(element, list) __cons(element, list) done  ; the list with an element before it
define first(list) __first(list) done  ; the first element of a list
define rest(list) __rest(list) done  ; the list without its first element
define last(list) __last(list) done  ; the last element of a list
define element(list, index) __element(list, index) done  ; the element of a list at an index, from 0
define append(a, b) __join(a, b) done  ; the elements of two lists in one
define append2(a, b) __join(a, b) done  ; the elements of two lists in one
define join(a, b) __join(a, b) done  ; the elements of two lists in one
define rev(list) __reversed(list) done  ; the list from its end to its beginning
define flatten(list) __flatten(list) done  ; the elements of a list and of the lists in it, in one list
define eq(a, b) __eq(a, b) done  ; whether two values print alike
define find(value, list, skip) __find(value, list, skip) done  ; where a value is in a list, behind so many others like it
define findListWithFirst(value, list, skip) __find_list(value, list, skip) done  ; of a list of lists the one that begins with a value
define findIndexOfListWithFirst(value, list, skip, start) __find_list_index(value, list, skip, start) done  ; where in a list of lists the one is that begins with a value
define split(value, list, skip) __split(value, list, skip) done  ; the list before and behind a value
define splitAtIndex(index, list) __splitAtIndex(index, list) done  ; the list before and from an index on
define copyList(begin, end, list) __copy_list(begin, end, list) done  ; the elements from one index to another
define remove(value, list, times) __remove(value, list, times) done  ; takes a value out of a list, at most so many times
define sub(a, b, list) __replaceNode(a, b, list) done  ; puts one value in the place of another, in the list itself
define subList(a, b, list) __replaceList(a, b, list) done  ; puts the elements of a list in the place of a value, in the list itself
define ins(a, b, list) __insertNode(a, b, list) done  ; puts a value behind another, in the list itself
define insList(a, b, list) __insertList(a, b, list) done  ; puts the elements of a list behind a value, in the list itself

define eval(text) __eval(text) done  ; runs a text as a program
define hpgl(file) __hpgl(file) done  ; asks for a plotter file; -o does that here
define setPartMode(on) __setPartMode(on) done  ; whether polygons keep their places in the plotter file
define showPolygons(on) __showPolygons(on) done  ; is accepted, and does nothing
define showSoup() __showSoup() done  ; prints the lines that were drawn
define showMachine() __showMachine() done  ; is accepted, and does nothing
define jitter(a, b) __jitter(a, b) done  ; is accepted, and does nothing
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
