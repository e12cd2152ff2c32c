// Values as a glTF file holds them.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

#include "popup/assembly.h"

namespace popup {

// A colour channel of sRGB as light, 0 to 1; six decimals, because pow() differs between processors in the
// last bit.
double linear(std::uint8_t channel);

// Lengths are rounded to 1e-6 mm, so that the bytes do not depend on the processor.
float metres(double mm);
std::vector<double> metres(Vec3 mm);

// glTF text is UTF-8, and names hold file names: bytes that are none become U+FFFD.
std::string valid_utf8(std::string_view text);

// Bytes of one buffer view.
class BufferBytes {
 public:
    template <typename T>
    std::size_t append(std::span<const T> values) {
        const std::size_t at = bytes_.size();
        bytes_.resize(at + values.size_bytes());
        if (!values.empty()) std::memcpy(bytes_.data() + at, values.data(), values.size_bytes());
        return at;
    }
    [[nodiscard]] const std::vector<unsigned char>& bytes() const { return bytes_; }
    void release() { bytes_ = {}; }

 private:
    std::vector<unsigned char> bytes_;
};

// Collects what is written without the copies of a string stream.
class StringBuffer : public std::streambuf {
 public:
    std::string text;

 protected:
    std::streamsize xsputn(const char* data, std::streamsize count) override {
        text.append(data, static_cast<std::size_t>(count));
        return count;
    }
    int_type overflow(int_type c) override {
        if (c != traits_type::eof()) text += static_cast<char>(c);
        return c;
    }
};

}  // namespace popup
