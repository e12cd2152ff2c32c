// What structures stand on by name: "gutter", "bird.centre".
#pragma once

#include <initializer_list>
#include <string_view>

#include "input/xml/fields.h"
#include "input/xml/values.h"
#include "popup/design.h"

namespace popup::xml {

// Whether the parent is named; the name is read, to be resolved when all structures have theirs. What else
// would say where it is, `instead`, is then an error.
bool read_ground_name(const Fields& fields, std::initializer_list<Name> instead, std::string_view version,
                      Values& values, NamedGround& on);

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
