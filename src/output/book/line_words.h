// How a book tells the lines of its sheets apart: by the colours and dashes of the run's profile.
#pragma once

#include <string>
#include <vector>

#include "popup/profile.h"

namespace popup::book {

// What sheets have of lines.
struct LinesThere {
    bool folds = false;
    bool inner_cuts = false;
};

// The sentences about printing, scoring and cutting, in the order in which that is done:
//
//     line_words(profile_table().front(), {true, false})[2]  // "Cut the solid red lines."
//
// Colours are named by the plain word that is nearest, such as "blue"; dashes are named where the profile
// dashes. Of lines that the profile leaves out nothing is said but that.
std::vector<std::string> line_words(const Profile& profile, const LinesThere& lines);

}  // namespace popup::book
