// A DXF file as what it holds: layers, blocks and entities, in its own units and coordinates, y up.
//
// Read are ASCII files from R12 to 2018. Group codes are those of the DXF reference of AutoCAD 2018.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/dxf/colors.h"
#include "parts/tracing.h"
#include "popup/diagnostics.h"
#include "popup/path.h"

namespace popup::dxf {

inline constexpr int kLinetypeByLayer = -1;
inline constexpr int kLinetypeByBlock = -2;

struct Layer {
    std::string name;
    int color = kForeground;
    std::optional<Color> rgb;  // above `color`
    int linetype = 0;
    bool off = false;     // or not plotted
    bool frozen = false;  // with the blocks that are put there
};

struct Linetype {
    std::string name;  // in lower case
    drawing::Dash dash = drawing::Dash::none;
};

// A block that is drawn at a place, or at each of a grid of places.
struct Insert {
    std::string block;  // its key
    std::string title;  // as it is written
    Vec2 at;
    Vec2 scale{1.0, 1.0};
    double turn = 0.0;  // radians, counter-clockwise
    int columns = 1, rows = 1;
    Vec2 spacing;
};

struct Entity {
    int line = 0;   // where its name stands
    int layer = 0;  // index into Document::layers
    int color = kByLayer;
    std::optional<Color> rgb;
    int linetype = kLinetypeByLayer;  // or an index into Document::linetypes
    bool mirrored = false;            // it is seen from behind: x runs to the left
    bool hidden = false;
    Path path;
    int insert = -1;   // index into Document::inserts
    int skipped = -1;  // index into Document::kinds: it is nothing that could be cut
};

struct Block {
    std::string name;   // its key
    std::string title;  // as it is written
    Vec2 base;
    bool elsewhere = false;  // in another file
    std::vector<Entity> entities;
};

struct Document {
    std::optional<int> units;    // $INSUNITS
    std::optional<bool> metric;  // $MEASUREMENT
    int units_line = 0;
    std::vector<Layer> layers;        // the first is "0"
    std::vector<Linetype> linetypes;  // the first is continuous
    std::vector<Block> blocks;
    std::vector<Insert> inserts;
    std::vector<std::string> kinds;  // "TEXT"
    std::vector<Entity> entities;
};

// The key of a table: names are the same whatever the case of their letters.
std::string key_of(std::string_view name);

// True of binary DXF and of DWG.
bool is_binary(std::string_view text);

// Errors, located: `dxf-binary`, `empty-input`, `dxf-syntax`, `bad-number`, `dxf-curve`. Warning
// `dxf-no-end`. Cost: linear. No recursion.
std::optional<Document> read_document(std::string_view text, Diagnostics& diagnostics);

}  // namespace popup::dxf
