#include "output/painted_pictures.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include "base/system/digest.h"
#include "output/qpdf.h"
#include "popup/image.h"

namespace popup {
namespace {

using Bytes = std::shared_ptr<const std::string>;
using Object = QPDFObjectHandle;

// Of a stand-in: one row.
constexpr int kStandInWidth = 16;

// Gives a surface the file that it was made of. The surface keeps the bytes alive.
void attach_file(cairo_surface_t* surface, const char* kind, const Bytes& bytes) {
    auto* kept = new Bytes(bytes);
    const auto give_back = [](void* data) { delete static_cast<Bytes*>(data); };
    if (cairo_surface_set_mime_data(surface, kind, reinterpret_cast<const unsigned char*>(bytes->data()),
                                    bytes->size(), give_back, kept) != CAIRO_STATUS_SUCCESS) {
        delete kept;
    }
}

// A picture that several sheets show stands in a document once.
void name_it(cairo_surface_t* surface, const std::string& digest) {
    attach_file(surface, CAIRO_MIME_TYPE_UNIQUE_ID, std::make_shared<const std::string>(digest));
}

// Pixels as Cairo has them: a word each, its channels multiplied by alpha.
template <bool opaque>
void fill_row(const std::uint8_t* from, std::size_t width, unsigned char* row) {
    for (std::size_t x = 0; x < width; ++x, from += 4, row += 4) {
        const std::uint32_t alpha = opaque ? 255U : from[3];
        const auto scaled = [&](std::uint32_t channel) {
            return opaque ? channel : (channel * alpha + 127U) / 255U;
        };
        const std::uint32_t pixel =
            alpha << 24 | scaled(from[0]) << 16 | scaled(from[1]) << 8 | scaled(from[2]);
        std::memcpy(row, &pixel, sizeof pixel);
    }
}

// Null if there is no memory for it.
Surface surface_of(const std::uint8_t* rgba, int width, int height, bool opaque) {
    Surface surface(
        cairo_image_surface_create(opaque ? CAIRO_FORMAT_RGB24 : CAIRO_FORMAT_ARGB32, width, height));
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) return nullptr;
    cairo_surface_flush(surface.get());
    unsigned char* data = cairo_image_surface_get_data(surface.get());
    const int stride = cairo_image_surface_get_stride(surface.get());
    for (int y = 0; y < height; ++y) {
        const std::uint8_t* from = rgba + 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(y);
        unsigned char* row = data + static_cast<std::ptrdiff_t>(y) * stride;
        if (opaque)
            fill_row<true>(from, static_cast<std::size_t>(width), row);
        else
            fill_row<false>(from, static_cast<std::size_t>(width), row);
    }
    cairo_surface_mark_dirty(surface.get());
    return surface;
}

// Of a JPEG also its file, which documents take as it is. Null where it cannot be decoded.
Surface whole(const Image& image) {
    const std::optional<ImagePixels> pixels = pixels_of(image);
    if (!pixels) return nullptr;
    Surface surface = surface_of(pixels->rgba.data(), pixels->width, pixels->height, pixels->opaque);
    if (surface == nullptr) return nullptr;
    if (image.format == ImageFormat::jpeg) attach_file(surface.get(), CAIRO_MIME_TYPE_JPEG, image.bytes);
    name_it(surface.get(), sha256(*image.bytes));
    return surface;
}

Object colors_of(const PngRows& rows) {
    if (rows.channels == 3) return Object::newName("/DeviceRGB");
    if (rows.palette.empty()) return Object::newName("/DeviceGray");
    return Object::newArray({Object::newName("/Indexed"), Object::newName("/DeviceRGB"),
                             Object::newInteger(static_cast<int>(rows.palette.size() / 3) - 1),
                             Object::newString(rows.palette)});
}

void put(const PngRows& rows, int width, int height, Object& picture) {
    Object as_packed = Object::newDictionary();
    as_packed.replaceKey("/Predictor", Object::newInteger(15));
    as_packed.replaceKey("/Colors", Object::newInteger(rows.channels));
    as_packed.replaceKey("/BitsPerComponent", Object::newInteger(rows.bits));
    as_packed.replaceKey("/Columns", Object::newInteger(width));
    picture.replaceStreamData(rows.bytes, Object::newName("/FlateDecode"), as_packed);
    Object says = picture.getDict();
    says.replaceKey("/Width", Object::newInteger(width));
    says.replaceKey("/Height", Object::newInteger(height));
    says.replaceKey("/BitsPerComponent", Object::newInteger(rows.bits));
    says.replaceKey("/ColorSpace", colors_of(rows));
}

bool may_be_stand_in(Object& object) {
    if (!object.isImage()) return false;
    Object says = object.getDict();
    // A JPEG of that size cannot be read as pixels here, and is none.
    Object packing = says.getKey("/Filter");
    if (!packing.isName() || packing.getName() != "/FlateDecode") return false;
    const auto is = [&says](const char* key, int value) {
        Object number = says.getKey(key);
        return number.isInteger() && number.getIntValue() == value;
    };
    return is("/Width", kStandInWidth) && is("/Height", 1);
}

std::string bytes_of(QPDF& pdf) {
    QPDFWriter writer(pdf);
    writer.setOutputMemory();
    writer.setDeterministicID(true);
    writer.setStreamDataMode(qpdf_s_preserve);
    writer.write();
    const std::shared_ptr<Buffer> buffer = writer.getBufferSharedPointer();
    return {reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()};
}

}  // namespace

std::optional<PaintedPictures::Picture> PaintedPictures::stand_in(const Image& image) {
    std::optional<PngRows> rows = png_rows(image);
    if (!rows) return std::nullopt;
    const std::string digest = sha256(*image.bytes);
    std::array<std::uint8_t, 4 * kStandInWidth> rgba{};
    std::string pixels;
    for (std::size_t i = 0; i < rgba.size(); ++i) {
        const bool is_alpha = i % 4 == 3;
        rgba.at(i) = is_alpha ? 0xFF : static_cast<std::uint8_t>(digest[pixels.size()]);
        if (!is_alpha) pixels += digest[pixels.size()];
    }
    Surface surface = surface_of(rgba.data(), kStandInWidth, 1, true);
    if (surface == nullptr) return std::nullopt;
    name_it(surface.get(), digest);
    rows_[pixels] = {std::move(*rows), image.width, image.height};
    return Picture{std::move(surface), {1.0 * image.width / kStandInWidth, 1.0 * image.height}};
}

const PaintedPictures::Picture& PaintedPictures::of(const Image& image) {
    const auto [known, fresh] = made_.try_emplace(image.bytes.get());
    if (!fresh) return known->second;
    std::optional<Picture> stand_in_of_it;
    if (use_ == For::document) stand_in_of_it = stand_in(image);
    known->second = stand_in_of_it ? std::move(*stand_in_of_it) : Picture{whole(image)};
    return known->second;
}

void put_rows(const PaintedPictures& pictures, std::string& document) {
    if (pictures.rows_.empty()) return;
    QPDF pdf;
    pdf.setSuppressWarnings(true);
    pdf.processMemoryFile("document", document.data(), document.size());
    for (Object& object : pdf.getAllObjects()) {
        if (!may_be_stand_in(object)) continue;
        const std::shared_ptr<Buffer> pixels = object.getStreamData();
        const auto found = pictures.rows_.find(
            std::string(reinterpret_cast<const char*>(pixels->getBuffer()), pixels->getSize()));
        if (found != pictures.rows_.end())
            put(found->second.rows, found->second.width, found->second.height, object);
    }
    document = bytes_of(pdf);
}

}  // namespace popup
