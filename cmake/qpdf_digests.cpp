// What the archive of qpdf asks of gnutls, by nettle, which popupc has already.
//
// gnutls and the eight libraries that it loads took three tenths of each start of the program. qpdf needs it
// for encryption; the documents that popupc writes need one digest, for their identifiers.
// So the program (cmake/archives.cmake) has these functions of gnutls' interface, as gnutls 3.7 declares them
// in gnutls/crypto.h, and does not load it. Digests are nettle's, which gnutls computes them with, too.
// Ciphers and random numbers are refused, and qpdf throws. popupc writes and reads no encrypted documents.

#include <nettle/nettle-meta.h>

#include <cstddef>
#include <cstdint>
#include <vector>

// gnutls' name for a digest that is being computed.
struct hash_hd_st {
    const nettle_hash* kind;
    std::vector<std::uint64_t> state;  // in words, so that it is aligned for whatever nettle keeps in it
};

namespace {

constexpr int kInvalidRequest = -50;          // GNUTLS_E_INVALID_REQUEST
constexpr int kUnimplementedFeature = -1250;  // GNUTLS_E_UNIMPLEMENTED_FEATURE

// The digest that has this number in gnutls_digest_algorithm_t; null if qpdf has no use for it.
const nettle_hash* digest_of(int algorithm) {
    switch (algorithm) {
        case 2:
            return &nettle_md5;
        case 6:
            return &nettle_sha256;
        case 7:
            return &nettle_sha384;
        case 8:
            return &nettle_sha512;
        default:
            return nullptr;
    }
}

}  // namespace

extern "C" {

int gnutls_hash_init(hash_hd_st** handle, int algorithm) {
    const nettle_hash* kind = digest_of(algorithm);
    if (!kind) return kUnimplementedFeature;
    constexpr std::size_t kWord = sizeof(std::uint64_t);
    *handle = new hash_hd_st{kind, std::vector<std::uint64_t>((kind->context_size + kWord - 1) / kWord)};
    kind->init((*handle)->state.data());
    return 0;
}

int gnutls_hash(hash_hd_st* handle, const void* bytes, std::size_t count) {
    handle->kind->update(handle->state.data(), count, static_cast<const std::uint8_t*>(bytes));
    return 0;
}

// `digest` may be null: then what was begun is only freed.
void gnutls_hash_deinit(hash_hd_st* handle, void* digest) {
    if (digest) {
        handle->kind->digest(handle->state.data(), handle->kind->digest_size,
                             static_cast<std::uint8_t*>(digest));
    }
    delete handle;
}

int gnutls_cipher_init(void**, int, const void*, const void*) { return kUnimplementedFeature; }
int gnutls_cipher_encrypt2(void*, const void*, std::size_t, void*, std::size_t) { return kInvalidRequest; }
int gnutls_cipher_decrypt2(void*, const void*, std::size_t, void*, std::size_t) { return kInvalidRequest; }
void gnutls_cipher_deinit(void*) {}
unsigned gnutls_cipher_get_key_size(int) { return 0; }
int gnutls_rnd(int, void*, std::size_t) { return kUnimplementedFeature; }
const char* gnutls_strerror(int) { return "popupc was built without ciphers"; }

}  // extern "C"
