// The examination with what it looks at made once.
#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "motion/linkage.h"
#include "motion/plate_shape.h"
#include "motion/recall.h"
#include "motion/seen_pairs.h"
#include "popup/motion.h"

namespace popup {

// Of all plates, by number, for an examination with these options.
std::vector<PlateShape> plate_shapes(const Assembly& assembly, const MotionOptions& options);

// As examine(assembly, options) of popup/motion.h, from the assembly's linkage and shapes. `recall`: what an
// earlier one has left, and what this one leaves; null: nothing.
Examination examine(const Assembly& assembly, Linkage& linkage, std::span<const PlateShape> shapes,
                    const MotionOptions& options, Recall* recall = nullptr);

// As examine(), for one who asks whether anything crosses at all: as soon as a contact is certain, *crossed
// becomes true, and nothing is decided from there on.
Examination examine_until_crossed(const Assembly& assembly, Linkage& linkage,
                                  std::span<const PlateShape> shapes, const MotionOptions& options,
                                  bool* crossed);

// Pairs of plates, the smaller number first.
using PlatePairs = std::set<std::pair<int, int>>;
// Whether nothing crosses over the whole sweep but the pairs that are set aside: whether examine() would
// decide all of it and find no other contact. False, too, where its work would run out. Adds to `poses` how
// many poses of pairs were looked at. `seen`: of this assembly, and set to what its folds do; what it knows
// is not looked at again. Cost: that of examine() for the rest, up to the first contact that is certain.
bool is_clear(const Assembly& assembly, Linkage& linkage, std::span<const PlateShape> shapes,
              const MotionOptions& options, const PlatePairs& aside, SeenPairs& seen, std::size_t& poses);

}  // namespace popup
