// What the viewer's page is told of its cards.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "output/keys.h"
#include "popup/output.h"

namespace popup {

namespace still {
class Modeller;
}

// {opening: {from_deg, to_deg, rest_deg, seconds} and angles: [deg of each key], where something moves;
//  paper_mm: its thickness, where it is known;
//  pictures: ["data:…"], each file once;
//  views: {name: direction to the eye};
//  cards: [{name, ground: number of the plate on the ground, where the card is shown with a back wall;
//    upright: its spine stands; settles: each part of it that hangs together stands on z = 0 at all openings;
//    plates: [{name, parent: number of a plate before it, left out of those in the world,
//      offset: the pivot in the parent's node, pivot: of its page, turns: x y z w at each key or once,
//      layer: mm towards the front of the plate `cover` that it is drawn from its place on the closed card;
//      page, open: how many mm above that page it is drawn when the card is open;
//      levels: at each key, how many layers before its front a panel of a sheet is drawn from its place;
//      above: of what is glued on its parent, 1, 2, … of those on the parent's front, −1, −2, … on its back;
//      meshes: [{color or picture, back: colour of paper that has another behind, lift of what is drawn,
//      points: x y from the pivot, triangles,
//        place: [ux, uy, u0, vx, vy, v0], u = ux x + uy y + u0 across the picture and v down it, 0 to 1}],
//      cuts, folds: x y of both ends of each edge of its outline}],
//    cover: as said, left out of cards that do not close flat,
//    layer_mm: how thick a layer of `levels` is at least,
//    collisions: [{plates: [a, b], from_deg, to_deg, deepest_deg, depth_mm}],
//    standing: [{name, meshes: [{as above, but points: x y z in the world, drawn instead of lift, and
//      places: u v at each point instead of place}], cuts, folds, lines: x y z of both ends}]}],
//  lists: [text]}
// write_viewer() adds `sheets`, the texts of ViewerSheets::packed.
//
// Plates stand behind their parents. Turns, levels, points, triangles, places, cuts, folds and lines are
// numbers of lists, of which equal ones are there once. A list is a text of numbers: each number less the one
// 1 (triangles, levels), 2, 3 or 4 places before, of turns that of these differences, in units of 0.01 mm or
// layers, 5e-6 of a turn or 1e-6 of a picture, as digits of five bits, lowest first, from "A" to "/" as in
// base 64, 32 added to all digits but a number's last; the lowest bit of a number is its sign. What is false,
// 0 or empty is left out. `modeller` is one of the cards; the page begins as its stills show them. Cost:
// plates × keys.
nlohmann::ordered_json viewer_scene(std::span<const SceneCard> cards, const Keys& keys,
                                    const still::Modeller& modeller, const OutputOptions& options);

// The scene as text; what is no UTF-8 is replaced.
std::string viewer_scene_text(const nlohmann::ordered_json& scene);
// False, and `model-too-large` is told: a scene of so many bytes is more than 400 MB, which browsers do not
// take.
bool browsers_take(std::size_t bytes, Diagnostics& diagnostics);

// The names of all cards, at most three. Valid UTF-8.
std::string viewer_title(std::span<const SceneCard> cards);

}  // namespace popup
