// Which element of a FOLD file each element of a mesh came from.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "output/fold_mesh.h"
#include "popup/crease_pattern.h"

namespace popup {

// By vertex, edge and face of the mesh: the element of the file; -1: it came from none.
struct FoldSources {
    std::vector<int> vertices, edges, faces;
};

// Elements are known by where they are, within what mending a sheet moves: 0.5 mm, or 1/400 of the longer
// side of the file's sheet if that is more. A vertex is that of the file nearest to it; an edge that which
// both its ends lie on, the one nearest to its middle; a face the first in which the middle of its largest
// triangle lies. So all parts of an edge, a face or a slit's vertex that was split have the same source, and
// of what was drawn several times the first counts; of equally near ones that of the element's own face comes
// first. Precondition: pages of the mesh are in the file's coordinates, as those of folded sheets are. Cost:
// near linear in elements.
FoldSources fold_sources(const FoldMesh& mesh, const CarriedKeys& carried);

// The file's faceOrders, as JSON, in numbers of the mesh's faces: above, below, and on which side of the one
// below, whose front may be the back of the file's. nullopt where a face of the one is not one of the other:
// it was divided, or joined with others, or is no paper.
std::optional<std::vector<std::array<int, 3>>> face_orders(const FoldMesh& mesh, const CarriedKeys& carried,
                                                           const FoldSources& sources, std::string_view json);

// The texts of a member that is a list of them, those with a namespace only: the others are said anew.
std::vector<std::string> own_words(const CarriedKeys& carried, std::string_view key);

// By edge of the mesh: how far its pattern asks for it to be folded in the end, degrees in [0, 180]; 0 where
// it asks for no fold. Edges and lines correspond as in fold_sources().
std::vector<double> asked_angles(const FoldMesh& mesh, const CreasePattern& creases);

}  // namespace popup
