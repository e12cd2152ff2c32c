// Dielines of forty panels and more, as drawings: what is asked of a carton of that size is asked of these.
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

}  // namespace popup::test
