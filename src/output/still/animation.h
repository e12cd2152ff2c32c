// The card opening and closing, as a moving picture.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "popup/output.h"

namespace popup {

// One file for each view. Cards stand as in stills (output/still/still.h), and the camera sees all of the
// motion. The card opens and closes in options.duration_s seconds, slowly at both ends, and rests a moment
// when it is open and when it is closed. Then it begins again. While it moves there are options.fps pictures
// a second, 15 if that is 0.
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
