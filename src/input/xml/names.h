// The words of the popup document: how each is written, what else it has been called, and where it may stand.
// A spelling met in a real file costs a row, or a word in one.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace popup::xml {

enum class Name : std::uint8_t {
    unknown,
    document,  // what stands around the root
    popup,
    version,
    units,
    mainpage,
    width,
    height,
    opens,
    orientation,
    leftcolor,
    rightcolor,
    lefttabcolor,
    righttabcolor,
    structurelist,
    structure,
    type,
    id,
    outerpoints,
    point,
    x,
    y,
    page,
    parentfold,
    begin,
    end,
    drawnlinelist,
    drawnline,
    thickness,
    color,
    parentplate,
    d,  // of a path: <outline d="M …"/>
    image,
    text,
    area,
    href,
    rotate,
    mirror,  // of an outline out of a file
    fit,
    horizon,
    horizonheight,
    font,
    fill,
    folds,     // of what is cut from one sheet: <folds top="12" bottom="8"/>
    t,         // of a touch point: when it was touched
    hole,      // beside the structurelist: <hole d="M …"/>
    argument,  // a structure's value under the name of a parameter, other than the four colours
    on,        // of a parent: the name of a fold or plate
    value,     // of anything that is a single value: <leftcolor value="red"/>
};

// The name that `spelling` has inside `context`, as attribute or child element; `unknown` when it has none
// there. Case, "_" and "-" are disregarded.
Name find_name(Name context, std::string_view spelling);

// How the canonical document writes it.
std::string_view canonical(Name name);

// Where a name that has no meaning in `context` would have one: the outermost such place of a document.
// `unknown` when it has none.
Name home_of(Name context, std::string_view spelling);

// What it is, in half a sentence, for those who write documents; empty for what is no word of the table.
std::string_view about(Name name);

// The parameter of any row of element_table() that `spelling` means inside a structure, in canonical
// spelling; empty when there is none.
std::string_view find_parameter_name(std::string_view spelling);

// True for names that may stand several times in `context` (structures, points, drawn lines).
bool repeats(Name context, Name name);

// True for names that hold one value and no structure of their own.
bool is_scalar(Name name);

// The canonical spellings of everything known in `context`, for hints; of a structure with the parameters of
// all rows.
std::vector<std::string_view> names_in(Name context);

}  // namespace popup::xml
