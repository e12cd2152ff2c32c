// Which of many edits it is that something comes with.
#pragma once

#include <cstddef>
#include <span>

#include "popup/edit.h"

namespace popup::edit {

// The place of an edit that brings what holds once all edits are made and does not hold before the first:
// `holds(count)` is asked of the first `count` of them. It does not hold before that edit, and does after it;
// edits further on may take it away and bring it again. No edits: an empty place. Cost: log2 of the edits
// questions.
template <typename Holds>
Place place_of_first(std::span<const EditLine> edits, const Holds& holds) {
    std::size_t before = 0;
    std::size_t after = edits.size();
    while (after > before + 1) {
        const std::size_t middle = before + (after - before) / 2;
        (holds(middle) ? after : before) = middle;
    }
    return edits.empty() ? Place{} : edits[after - 1].place;
}

}  // namespace popup::edit
