// Where what stood in a text stands once it has been edited.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "input/xml/encoding.h"
#include "input/xml/read.h"
#include "popup/diagnostics.h"

namespace popup::edit {

//     const std::vector<xml::PatchEdit> changes = xml::patch_edits(source, design, gone);
//     const std::string after = xml::patched(source.text, changes);
//     MovedPlaces(source.text, changes, after).move(finding);  // of the text before; now of the text after
class MovedPlaces {
 public:
    // The texts and changes must outlive this. Cost: linear in the texts.
    MovedPlaces(std::string_view before, std::span<const xml::PatchEdit> changes, std::string_view after);
    // nullopt: what stood there was taken out, or the place is in the middle of what was changed. A place
    // that is none stays none.
    [[nodiscard]] std::optional<Place> of(Place place) const;
    // Moves the places of a finding; false, and some are moved, where one of them is no more.
    bool move(Diagnostic& finding) const;

 private:
    xml::PlaceTable before_, after_;
    std::span<const xml::PatchEdit> changes_;
};

}  // namespace popup::edit
