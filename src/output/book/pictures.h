// Pictures of a book with their files.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "output/book/scene.h"

namespace popup::book {

inline constexpr PictureSize kCoverPicture{720, 498};
inline constexpr PictureSize kStepPicture{500, 333};
inline constexpr PictureSize kSmallPicture{300, 225};

struct ShownPicture {
    Picture picture;
    std::string jpeg;  // its file
};

class Pictures {
 public:
    Pictures(std::span<const SceneCard> cards, bool printed_backs, Diagnostics& diagnostics)
        : illustrator_(cards, printed_backs), diagnostics_(diagnostics) {}
    // The scenes of one step. nullopt: `locks` or `picture-failed` was told.
    std::optional<std::vector<ShownPicture>> draw(std::span<const Scene> scenes, PictureSize size);

 private:
    Illustrator illustrator_;
    Diagnostics& diagnostics_;
};

}  // namespace popup::book
