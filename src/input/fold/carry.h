// What a FOLD file says beside its pattern, taken along for whoever writes FOLD again.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "base/text/json_tree.h"
#include "popup/crease_pattern.h"

namespace popup::fold {

// How many elements the frame has that was read; 0: it does not list them, and no column can speak of them.
struct ElementCounts {
    std::size_t vertices = 0, edges = 0, faces = 0;
};

// The members and columns of `frames`, the frame that was read and those that it inherits from, nearest
// first, and of the file what begins with "file_"; the nearest one of a name counts. Elements and
// other_frames are the caller's.
//
// A list under a key of vertices_, edges_ or faces_ with one value an element is a column, and all else is a
// member. Not taken along, because whoever writes the file says it anew: the unit, frames and their parents,
// places, edges, their letters, angles and lengths, faces, what is next to what, and popupc's own keys.
// faceOrders that are triples of the frame's faces and a side are a member, whose numbers are those of the
// file. Other ones, edgeOrders, and lists of elements with another number of values, are `left_out`: they
// speak of elements by their numbers. Cost: linear in the text.
CarriedKeys carry(std::string_view text, const JsonValue& file, std::span<const JsonValue* const> frames,
                  const ElementCounts& counts);

// The value that begins at `at`, without the white space that stands outside of texts. Precondition:
// read_json() took the text.
std::string compact_value(std::string_view text, std::size_t at);

}  // namespace popup::fold
