// The numbers of pieces that are glued flat, where nobody sees them later.
#pragma once

#include <optional>
#include <vector>

#include "pattern/labels.h"
#include "popup/assembly.h"
#include "popup/pattern.h"

namespace popup {

class HiddenNumbers {
 public:
    // `assembly` must outlive it.
    explicit HiddenNumbers(const Assembly& assembly);

    // On the piece, on the side that is glued: face to face with the number on its target, if there is room
    // for that, else where the piece covers the paper of its base. Nothing where there is no room either, and
    // where no joint says how the piece lies. Cost: linear in the corners of both plates.
    [[nodiscard]] std::optional<Label> of(const GluedArea& glued,
                                          const std::optional<TextSpot>& target) const;

 private:
    const Assembly& in_;
    std::vector<const Rigid*> how_;  // of each plate: how it lies on its base
};

}  // namespace popup
