// What structures stand on by name: "gutter", "bird.centre".
#pragma once

#include "input/xml/fields.h"
#include "popup/design.h"

namespace popup::xml {

// Finds who makes the folds and plates that structures name. Precondition: all structures have ids. A name
// that nothing has, or nothing before the structure, is an error.
class GroundNames {
 public:
    GroundNames(Design& design, Reporter& reporter) : design_(design), reporter_(reporter) {}
    // Cost: near linear in structures.
    void resolve();

 private:
    void unknown(std::size_t number, std::size_t dot);
    Design& design_;
    Reporter& reporter_;
};

}  // namespace popup::xml
