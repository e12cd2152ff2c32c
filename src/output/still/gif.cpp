#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "output/still/film.h"

namespace popup::still {
namespace {

constexpr int kColors = 256;

int append_bytes(GifFileType* file, const GifByteType* data, int length) {
    static_cast<std::string*>(file->UserData)
        ->append(reinterpret_cast<const char*>(data), static_cast<std::size_t>(length));
    return length;
}

// A part of a picture.
struct Part {
    int left = 0, top = 0, right = 0, bottom = 0;  // the last two not with it
};

// What differs between two pictures; a pixel at least, so that a frame without change has its time.
Part changed(const Pixels& from, const Pixels& to) {
    Part part{to.width, to.height, 0, 0};
    for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
            const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(to.width) +
                                        static_cast<std::size_t>(x));
            if (std::equal(to.rgb.begin() + static_cast<std::ptrdiff_t>(at),
                           to.rgb.begin() + static_cast<std::ptrdiff_t>(at + 3),
                           from.rgb.begin() + static_cast<std::ptrdiff_t>(at)))
                continue;
            part = {std::min(part.left, x), std::min(part.top, y), std::max(part.right, x + 1),
                    std::max(part.bottom, y + 1)};
        }
    }
    return part.right == 0 ? Part{0, 0, 1, 1} : part;
}

struct FreeMap {
    void operator()(ColorMapObject* map) const { GifFreeMapObject(map); }
};

class Writer {
 public:
    Writer(const Film& film, std::string& bytes) : film_(film) {
        int error = 0;
        file_ = EGifOpen(&bytes, append_bytes, &error);
    }
    ~Writer() {
        int error = 0;
        if (file_ != nullptr) EGifCloseFile(file_, &error);
    }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    bool run() {
        if (file_ == nullptr) return false;
        EGifSetGifVersion(file_, true);
        if (EGifPutScreenDesc(file_, film_.width, film_.height, 8, 0, nullptr) != GIF_OK || !loops())
            return false;
        const Pixels* shown = nullptr;
        // Times of GIF are hundredths of a second; what rounding takes from one the next one has.
        int time_ms = 0;
        int written_cs = 0;
        for (const Film::Frame& frame : film_.frames) {
            const Pixels& picture = film_.pictures[frame.picture];
            const Part part =
                shown == nullptr ? Part{0, 0, film_.width, film_.height} : changed(*shown, picture);
            time_ms += frame.ms;
            const int delay_cs = std::max(1, (time_ms + 5) / 10 - written_cs);
            written_cs += delay_cs;
            if (!put(picture, part, delay_cs)) return false;
            shown = &picture;
        }
        int error = 0;
        return EGifCloseFile(std::exchange(file_, nullptr), &error) == GIF_OK;
    }

 private:
    bool loops() {
        constexpr std::array<GifByteType, 3> kForEver{1, 0, 0};
        return EGifPutExtensionLeader(file_, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
               EGifPutExtensionBlock(file_, 11, "NETSCAPE2.0") == GIF_OK &&
               EGifPutExtensionBlock(file_, kForEver.size(), kForEver.data()) == GIF_OK &&
               EGifPutExtensionTrailer(file_) == GIF_OK;
    }

    bool put(const Pixels& picture, const Part& part, int delay_cs) {
        const int width = part.right - part.left;
        const int height = part.bottom - part.top;
        const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        for (auto& channel : channels_) channel.resize(count);
        indices_.resize(count);
        std::size_t i = 0;
        for (int y = part.top; y < part.bottom; ++y) {
            const unsigned char* rgb = picture.rgb.data() + 3 * (static_cast<std::size_t>(y) *
                                                                     static_cast<std::size_t>(picture.width) +
                                                                 static_cast<std::size_t>(part.left));
            for (int x = 0; x < width; ++x, ++i) {
                for (auto& channel : channels_) channel[i] = *rgb++;
            }
        }
        const std::unique_ptr<ColorMapObject, FreeMap> map(GifMakeMapObject(kColors, nullptr));
        if (map == nullptr) return false;
        int colors = kColors;
        if (GifQuantizeBuffer(static_cast<unsigned>(width), static_cast<unsigned>(height), &colors,
                              channels_[0].data(), channels_[1].data(), channels_[2].data(), indices_.data(),
                              map->Colors) != GIF_OK)
            return false;
        GraphicsControlBlock control{DISPOSE_DO_NOT, false, delay_cs, NO_TRANSPARENT_COLOR};
        std::array<GifByteType, 4> extension{};
        const std::size_t size = EGifGCBToExtension(&control, extension.data());
        if (EGifPutExtension(file_, GRAPHICS_EXT_FUNC_CODE, static_cast<int>(size), extension.data()) !=
                GIF_OK ||
            EGifPutImageDesc(file_, part.left, part.top, width, height, false, map.get()) != GIF_OK)
            return false;
        for (int y = 0; y < height; ++y) {
            if (EGifPutLine(file_, indices_.data() + static_cast<std::ptrdiff_t>(y) * width, width) != GIF_OK)
                return false;
        }
        return true;
    }

    const Film& film_;
    GifFileType* file_ = nullptr;
    std::array<std::vector<GifByteType>, 3> channels_;
    std::vector<GifByteType> indices_;
};

}  // namespace

bool to_gif(const Film& film, std::string& bytes) { return Writer(film, bytes).run(); }

}  // namespace popup::still
