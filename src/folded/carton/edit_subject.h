// What an edit of a folded shape names, and where that goes.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "folded/carton/vertices.h"
#include "popup/diagnostics.h"
#include "popup/geometry.h"
#include "popup/sheet_edit.h"

namespace popup::folded {

struct Subject {
    std::map<int, Vec3> vertices;  // by vertex, how far it is to move, mm
    std::vector<int> exact;        // corners of these that are named, and move just so
};

// What the edit names; nullopt after `bad-edit`: there is no such vertex, edge or panel, or
// several are called so.
std::optional<Subject> subject_of(const Vertices& shape, const SheetEdit& edit, Diagnostics& diagnostics);

}  // namespace popup::folded
