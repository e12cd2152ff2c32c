#include "base/system/digest.h"

#include <nettle/base16.h>
#include <nettle/sha2.h>

#include <cstdint>

namespace popup {

std::string sha256_bytes(std::string_view bytes) {
    sha256_ctx context{};
    sha256_init(&context);
    sha256_update(&context, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
    std::string digest(SHA256_DIGEST_SIZE, '\0');
    sha256_digest(&context, digest.size(), reinterpret_cast<std::uint8_t*>(digest.data()));
    return digest;
}

std::string sha256(std::string_view bytes) {
    const std::string digest = sha256_bytes(bytes);
    std::string text(BASE16_ENCODE_LENGTH(digest.size()), '0');
    base16_encode_update(text.data(), digest.size(), reinterpret_cast<const std::uint8_t*>(digest.data()));
    return text;
}

}  // namespace popup
