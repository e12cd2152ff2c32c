#include "output/book/pictures.h"

#include <utility>

#include "output/jpeg.h"

namespace popup::book {
namespace {

constexpr int kBookQuality = 88;
constexpr double kBookDpi = 150.0;

}  // namespace

std::optional<std::vector<ShownPicture>> Pictures::draw(std::span<const Scene> scenes, PictureSize size) {
    auto drawn = illustrator_.draw(scenes, size, diagnostics_);
    if (!drawn) return std::nullopt;
    std::vector<ShownPicture> all;
    for (Picture& one : *drawn) {
        ShownPicture& shown = all.emplace_back();
        if (!to_jpeg(one.pixels, kBookQuality, kBookDpi, shown.jpeg)) {
            diagnostics_.error("picture-failed", {},
                               "a picture of the book could not be made: there is no memory for it");
            return std::nullopt;
        }
        shown.picture = std::move(one);
    }
    return all;
}

}  // namespace popup::book
