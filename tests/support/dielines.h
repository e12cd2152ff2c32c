// Dielines of cartons as drawings, most of forty panels and more: what is asked of cartons so large is asked
// of these.
#pragma once

#include <string>

namespace popup::test {

// A tube of `sides` walls and a glue flap, closed at both ends by pointed flaps that meet in the middle: 3 n
// + 1 panels. Folds of walls say their angles in whole degrees, so the tube only closes when it is refined.
std::string pointed_tube(int sides);
// A tube of `sides` walls and a glue flap. Each wall has a short flap at both ends, and each flap a tab that
// is tucked in behind the wall: 5 n + 1 panels.
std::string locked_tube(int sides);
// A tray with three rolled walls, a lid that is tucked in, and flaps that lock: 42 panels.
std::string locked_tray();
// A tray whose four walls are rolled in, with a strip so wide, mm, between the outer and the inner wall: 13
// panels. Inner walls stand on the base and meet in its corners. Without `angles` no fold says how far it
// goes.
std::string rolled_tray(double roll, bool angles);
// A mailer of one piece: rolled sides, and a lid on the back with a tuck. With `ears` two hang on either: 20
// panels, without 16.
std::string tucked_mailer(bool angles, bool ears);

// A tray with corners on its front and its back that lie on the side walls: 9 panels.
std::string tray_with_corners();

}  // namespace popup::test
