#include <webp/encode.h>
#include <webp/mux.h>

#include <memory>

#include "output/still/film.h"

namespace popup::still {
namespace {

constexpr float kQuality = 85.0F;
constexpr int kMethod = 2;  // of 0, quick, to 6, small

struct DeleteEncoder {
    void operator()(WebPAnimEncoder* encoder) const { WebPAnimEncoderDelete(encoder); }
};
struct FreePicture {
    void operator()(WebPPicture* picture) const { WebPPictureFree(picture); }
};

}  // namespace

bool to_webp(const Film& film, std::string& bytes) {
    WebPAnimEncoderOptions options;
    WebPConfig config;
    if (WebPAnimEncoderOptionsInit(&options) == 0 || WebPConfigInit(&config) == 0) return false;
    config.quality = kQuality;
    config.method = kMethod;
    const std::unique_ptr<WebPAnimEncoder, DeleteEncoder> encoder(
        WebPAnimEncoderNew(film.width, film.height, &options));
    if (encoder == nullptr) return false;
    int time_ms = 0;
    for (const Film::Frame& frame : film.frames) {
        WebPPicture picture;
        if (WebPPictureInit(&picture) == 0) return false;
        const std::unique_ptr<WebPPicture, FreePicture> freed(&picture);
        picture.width = film.width;
        picture.height = film.height;
        picture.use_argb = 1;
        if (WebPPictureImportRGB(&picture, film.pictures[frame.picture].rgb.data(), 3 * film.width) == 0 ||
            WebPAnimEncoderAdd(encoder.get(), &picture, time_ms, &config) == 0)
            return false;
        time_ms += frame.ms;
    }
    WebPData data;
    WebPDataInit(&data);
    const bool good = WebPAnimEncoderAdd(encoder.get(), nullptr, time_ms, nullptr) != 0 &&
                      WebPAnimEncoderAssemble(encoder.get(), &data) != 0;
    if (good) bytes.assign(reinterpret_cast<const char*>(data.bytes), data.size);
    WebPDataClear(&data);
    return good;
}

}  // namespace popup::still
