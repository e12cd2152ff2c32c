#include "output/still/animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "output/poses.h"
#include "output/still/film.h"
#include "output/still/model.h"
#include "output/still/render.h"

namespace popup {
namespace {

using still::Film;

constexpr PictureSize kSize{480, 360};
constexpr double kFps = 15.0;
constexpr double kMostPixels = 400e6;
constexpr double kRestOpenS = 0.6;  // of its time, where it is open; half as long where it is closed
constexpr int kFewest = 2;          // pictures of the way there

// The openings of the way there: slow at both ends.
std::vector<double> openings(const Sweep& sweep, int count) {
    std::vector<double> result;
    for (int i = 0; i < count; ++i) {
        const double t = static_cast<double>(i) / (count - 1);
        result.push_back(sweep.from_deg + t * t * (3.0 - 2.0 * t) * (sweep.to_deg - sweep.from_deg));
    }
    return result;
}

double rests_of(double duration_s) { return std::min(1.5 * kRestOpenS, 0.5 * duration_s); }

// There and back again, in `duration_s` with the rests.
std::vector<Film::Frame> there_and_back(int count, double duration_s) {
    const int steps = 2 * (count - 1);
    const double rests_s = rests_of(duration_s);
    std::vector<Film::Frame> frames;
    double end_s = 0.0;
    long shown_ms = 0;
    for (int i = 0; i < steps; ++i) {
        const int picture = i < count ? i : steps - i;
        const double rest_s = i == 0 ? rests_s / 3.0 : i == count - 1 ? 2.0 * rests_s / 3.0 : 0.0;
        end_s += (duration_s - rests_s) / steps + rest_s;
        // What rounding takes from one the next one has.
        const long ms = std::max(1L, std::lround(1000.0 * end_s) - shown_ms);
        shown_ms += ms;
        frames.push_back({static_cast<std::size_t>(picture), static_cast<int>(ms)});
    }
    return frames;
}

// nullopt: `locks` was told.
std::optional<Film> film_of(still::Modeller& modeller, const std::vector<double>& openings, View view,
                            PictureSize size, Diagnostics& diagnostics) {
    still::Framer framer(view, size.width, size.height);
    for (const bool measures : {true, false}) {
        for (const double opening : openings) {
            const std::optional<still::Model> model = modeller.at(opening, diagnostics);
            if (!model) return std::nullopt;
            if (measures) {
                framer.measure(*model);
            } else {
                framer.aim(*model);
            }
        }
    }
    still::Framing framing = framer.framing();
    framing.plain = true;
    Film film{size.width, size.height, {}, {}};
    for (const double opening : openings) {
        const std::optional<still::Model> model = modeller.at(opening, diagnostics);
        film.pictures.push_back(still::render(*model, framing, size.width, size.height));
    }
    return film;
}

struct Encoding {
    std::string_view name;
    bool (*encode)(const Film&, std::string&);
    int most_side;    // pixels, of the file format
    double most_fps;  // what viewers show as it is written
};
constexpr Encoding kWebP{"WebP", still::to_webp, 16383, 100.0};
constexpr Encoding kGif{"GIF", still::to_gif, 65535, 50.0};

std::optional<std::vector<SheetFile>> write(const Encoding& encoding, std::span<const SceneCard> cards,
                                            const OutputOptions& options, Diagnostics& diagnostics) {
    const PictureSize size = options.still.size.value_or(kSize);
    if (std::max(size.width, size.height) > encoding.most_side) {
        diagnostics
            .error("picture-too-large", {},
                   fmt::format("pictures of {} × {} pixels; a {} has at most {} a side", size.width,
                               size.height, encoding.name, encoding.most_side))
            .hint("choose a smaller --size");
        return std::nullopt;
    }
    const double fps = options.fps > 0.0 ? std::min(options.fps, encoding.most_fps) : kFps;
    const double there_s = 0.5 * (options.duration_s - rests_of(options.duration_s));
    // Rounding gives viewers no more than they show.
    const double steps = std::min(std::round(fps * there_s), std::floor(encoding.most_fps * there_s + 1e-9));
    const double pictures = std::max<double>(kFewest, steps + 1.0);
    const double pixels = pictures * size.width * size.height;
    if (pixels > kMostPixels) {
        diagnostics
            .error(
                "picture-too-large", {},
                fmt::format("opening takes {:.0f} pictures of {} × {} pixels; together they may have {:.0f} "
                            "million pixels",
                            pictures, size.width, size.height, kMostPixels / 1e6))
            .hint("choose a smaller --size or --fps, or a shorter --duration");
        return std::nullopt;
    }
    const int count = static_cast<int>(pictures);
    const std::vector<View>& views = options.still.views;
    still::Modeller modeller(cards, options.backs, options.still.paper_mm.value_or(0.0));
    std::vector<SheetFile> files;
    for (const View view : views) {
        std::optional<Film> film =
            film_of(modeller, openings(sweep_of(cards), count), view, size, diagnostics);
        if (!film) return std::nullopt;
        film->frames = there_and_back(count, options.duration_s);
        SheetFile file;
        if (views.size() > 1) file.suffix = fmt::format("-{}", kViewNames.at(static_cast<std::size_t>(view)));
        if (!encoding.encode(*film, file.bytes)) {
            diagnostics
                .error("picture-failed", {},
                       fmt::format("the {} could not be made: there is no memory for it", encoding.name))
                .hint("choose a smaller --size");
            return std::nullopt;
        }
        files.push_back(std::move(file));
    }
    return files;
}

}  // namespace

std::optional<std::vector<SheetFile>> write_webp(std::span<const SceneCard> cards,
                                                 const OutputOptions& options, Diagnostics& diagnostics) {
    return write(kWebP, cards, options, diagnostics);
}

std::optional<std::vector<SheetFile>> write_gif(std::span<const SceneCard> cards,
                                                const OutputOptions& options, Diagnostics& diagnostics) {
    return write(kGif, cards, options, diagnostics);
}

}  // namespace popup
