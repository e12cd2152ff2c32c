// The entities that are lines, as paths.
#pragma once

#include <string>
#include <string_view>

#include "input/dxf/record.h"
#include "popup/path.h"

namespace popup::dxf {

// True of kinds that make_line() makes a path of.
bool is_line(std::string_view kind);
// Appends the path of a LINE, ARC, CIRCLE, ELLIPSE, LWPOLYLINE or SPLINE, in the coordinates of its entity.
// What has no size is an empty path. Returns what is wrong with it, a sentence without its full stop; empty:
// nothing that is not told already.
std::string make_line(Record& record, Path& path);

// A POLYLINE, whose corners are records of their own.
class OldPolyline {
 public:
    // False where it is a mesh.
    bool begin(Record& record);
    void corner(Record& vertex);
    void end(Path& path);

 private:
    bool closed_ = false;
    bool spline_ = false;
    bool begun_ = false;
    double bulge_ = 0.0;  // of the corner before
    Vec2 first_;
    Path path_;
};

}  // namespace popup::dxf
