#include "live/token.h"

#include <sys/random.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <system_error>

namespace popup::live {

std::string new_token() {
    std::array<unsigned char, 16> bytes{};
    for (std::size_t have = 0; have < bytes.size();) {
        const ssize_t got = ::getrandom(bytes.data() + have, bytes.size() - have, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw std::system_error(errno, std::generic_category(), "getrandom");
        have += static_cast<std::size_t>(got);
    }
    std::string token;
    for (const unsigned char byte : bytes) {
        token += "0123456789abcdef"[byte >> 4U];
        token += "0123456789abcdef"[byte & 15U];
    }
    return token;
}

bool same_secret(std::string_view given, std::string_view secret) {
    if (given.size() != secret.size()) return false;
    volatile unsigned char differs = 0;
    for (std::size_t i = 0; i < given.size(); ++i) {
        differs = static_cast<unsigned char>(differs | (given[i] ^ secret[i]));
    }
    return differs == 0;
}

}  // namespace popup::live
