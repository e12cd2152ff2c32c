// Rounds of projections, by which the vertices of a shape come near to where its panels fit.
#pragma once

#include <Eigen/Core>

#include "folded/carton/shape.h"

namespace popup::folded {

// Where vertices come to that begin at `start` (x, y and z by vertex): in each round every panel goes to
// where it fits best, merged vertices to their mean and the corners of two panels to their best plane, and
// each vertex to the mean of what is wanted of it, and of where it began with the weight `hold` (Bouaziz et
// al., Shape-Up, 2012). Cost: linear in corners, a round; there are some hundred.
Eigen::VectorXd project_shape(const Shape& shape, const ShapeJoins& joins, const Eigen::VectorXd& start,
                              double hold);

}  // namespace popup::folded
