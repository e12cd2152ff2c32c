// The model as a page to look at: one HTML file that needs no network.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "popup/output.h"

namespace popup {

// A page of three tabs: the model, the sheets as the SVG output draws them, and what was found.
//
// The model is all cards in 3D with plain WebGL 2: drag to turn, wheel or pinch to zoom, a slider and a play
// button for the opening, plates named under the pointer, plates red at the openings at which they cross
// others, these openings as marks on the slider and in a list, edges and the thickness of the paper as
// switches. What stands still has no slider. Cards lie or stand side by side as stills show them
// (output/still/still.h), and a still is there where there is no WebGL 2, or no script. Plates are
// placed as in glTF: meshes of plate_mesh() and standing_meshes(), keys of choose_keys(), spherical linear
// interpolation between them, several cards side by side. The world is popupc's: mm, z up, the gutter along
// y, an open card in the plane z = 0. It begins with what the still shows.
//
// Guarantees: one file. Its policy (CSP) allows its own style and its own script, by their SHA-256, pictures
// that are in it, and nothing else; no text of a document is read as markup or script. Pictures are the bytes
// of their files, each file once. Points are rounded to 0.01 mm, turns to 5e-6, which is 0.001 mm at 200 mm,
// other lengths to 1e-6 mm; the same input gives the same bytes. Behind the page's address
// "#view=front&at=30" says how it begins; the views are iso, front, back, left, right and top. window.popupc
// says where each plate is: page.js has it.
//
// Errors: those of choose_keys() and write_svg(), `picture-failed`, and `model-too-large` for a page of more
// than 400 MB, which browsers do not take. Precondition: at least one card; has_model() of all assemblies,
// and motions of those that move. Cost: plates × keys, a still, and an SVG document a sheet. Length: some
// 60 KB, 4 to 12 bytes a plate and key, some 5 a corner and 4 a triangle, a fifth of the SVG documents, and
// four thirds of the pictures.
std::optional<std::string> write_viewer(const RunPage& page, const OutputOptions& options,
                                        Diagnostics& diagnostics);

// Makes what the page has of the cards alone: the model and the still, ten elevenths of the work. Its thread
// tells nothing: where it fails, write_viewer() tries again and says why.
std::shared_ptr<BegunPage> begin_viewer(std::vector<SceneCard> cards, const OutputOptions& options);

// The same, with the still as a file of its own beside it: JPEG, 480 × 360 pixels.
struct ViewerFiles {
    std::string page;
    std::string still;
};
std::optional<ViewerFiles> make_viewer(const RunPage& page, const OutputOptions& options,
                                       Diagnostics& diagnostics);

}  // namespace popup
