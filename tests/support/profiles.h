// Profiles, options and views as tests want them.
#pragma once

#include <cstddef>
#include <string_view>

#include "output/sheet_drawing.h"
#include "popup/output.h"
#include "popup/profile.h"

namespace popup::test {

inline Pen& pen_of(Profile& profile, Operation operation) {
    return profile.pens[static_cast<std::size_t>(operation)];
}

// Slits are an operation of their own where inner cuts are moved for the kerf.
inline Profile with_slits(std::string_view name) {
    Profile profile = *find_profile(name);
    pen_of(profile, Operation::inner_cut).kerf_mm = 0.1;
    return profile;
}

inline OutputOptions options_for(std::string_view profile, bool backs, ScoreSide side, bool apart) {
    OutputOptions options;
    options.profile = *find_profile(profile);
    options.backs = backs;
    options.score_side = side;
    options.print_and_cut = apart;
    return options;
}

inline SheetView view_of(int sheet, bool back, SheetView::Part part = SheetView::Part::whole) {
    SheetView view;
    view.sheet = sheet;
    view.back = back;
    view.part = part;
    return view;
}

}  // namespace popup::test
