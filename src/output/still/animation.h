// The card opening and closing, as a moving picture.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "popup/output.h"

namespace popup {

// One file a view, seen as output/still/still.h says, from a place from which all of the motion is seen. It
// goes from where the sweep begins to where it ends and back, slowly at both ends, with a rest there, in
// options.duration_s seconds at options.fps pictures a second, and begins again.
//
// WebP: lossy, quality 85, at most 100 pictures a second. GIF: 256 colours a picture, of which only what has
// changed is written, at most 50 a second, for viewers slow down what is quicker. The same bytes with the
// same versions of libwebp or giflib.
//
// Errors: `picture-too-large` (more than 400 million pixels in all pictures of the way there, or more a side
// than the format has: WebP 16383, GIF 65535), `picture-failed`, `locks`. Cost: that of so many stills, and
// of encoding twice as many. Memory: 3 bytes a pixel of the pictures of the way there.
std::optional<std::vector<SheetFile>> write_webp(std::span<const SceneCard> cards,
                                                 const OutputOptions& options, Diagnostics& diagnostics);
std::optional<std::vector<SheetFile>> write_gif(std::span<const SceneCard> cards,
                                                const OutputOptions& options, Diagnostics& diagnostics);

}  // namespace popup
