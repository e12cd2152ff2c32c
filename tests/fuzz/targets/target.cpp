#include "fuzz/targets/target.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace popup::fuzz {

void expect_told(const Diagnostics& diagnostics, std::string_view text, bool returns_end_lines) {
    const std::vector<Diagnostic> all = diagnostics.sorted();
    if (all.empty()) return;
    int lines = 1;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool alone = text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n');
        if (text[i] == '\n' || (returns_end_lines && alone)) ++lines;
    }
    for (const Diagnostic& told : all) {
        const auto of = [&](std::string_view what) {
            return [&told, what] { return fmt::format("{}: {}: {}", what, told.code, told.message); };
        };
        expect(find_code(told.code) != nullptr, of("a code of the table"));
        expect(!told.message.empty(), of("a message that says something"));
        expect(told.message.find('\n') == std::string::npos, of("a message of one line"));
        expect(told.place.line >= 0 && told.place.line <= lines, of("a line of the text"));
        expect((told.place.line >= 1) == (told.place.column >= 1), of("a line with a column"));
    }
}

bool is_one_of(std::size_t n, std::string_view bytes) {
    // FNV-1a, so that no library decides which inputs these are.
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
    return (hash >> 32) % n == 0;
}

NamedBytes::NamedBytes(std::string_view bytes) : fd_(::memfd_create("fuzz", MFD_CLOEXEC)) {
    if (fd_ < 0 || ::write(fd_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
        throw std::runtime_error("no memory for a file");
    name_ = fmt::format("/proc/self/fd/{}", fd_);
}

NamedBytes::~NamedBytes() { ::close(fd_); }

std::size_t Choices::below(std::size_t n) {
    if (n <= 1) return 0;
    std::size_t value = byte();
    if (n > 256) value = 256 * value + byte();
    return value % n;
}

double Choices::between(double low, double high) {
    const unsigned first = byte();
    return low + (high - low) * (256.0 * first + byte()) / 65535.0;
}

}  // namespace popup::fuzz
