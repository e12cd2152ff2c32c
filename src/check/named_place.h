// A structure that names what it stands on gives its points beside that fold. While it is checked they are on
// pages, as those of others.
#pragma once

#include <vector>

#include "check/placing.h"

namespace popup {

//     NamedPlace place(structure, info, fold, turns);
//     place.lay(structure);      // points are on pages now, as a document would give them
//     ...                        // it is checked, and perhaps mended
//     place.take_up(structure);  // points lie beside the fold again, with the digits that they had if they
//     stayed
struct NamedPlace {
    NamedPlace(const Structure& structure, const ElementInfo& info, const PageFold& fold,
               const PageTurns& turns);
    void lay(Structure& structure) const;
    void take_up(Structure& structure) const;
    // A point on the pages beside the fold, as the structure writes it; `right`: of the page on its right.
    [[nodiscard]] Vec2 written(Vec2 on_page, bool right) const;

 private:
    struct Side {
        int page = 0;
        Vec2 middle, along;
        bool turned = false;  // the page is read mirrored, and `mended` for good
        bool mended = false;
    };
    [[nodiscard]] const Side& side_of(std::size_t point) const;
    const ElementInfo* info_;
    PageFold fold_;
    Side left_, right_;
    std::vector<DesignPoint> points_;  // as they were
    std::vector<Argument> arguments_;
};

}  // namespace popup
