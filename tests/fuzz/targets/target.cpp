#include "fuzz/targets/target.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace popup::fuzz {

void expect(bool holds, const std::string& what) {
    if (!holds) throw Broken(what);
}

void expect_told(const Diagnostics& diagnostics, std::string_view text) {
    const auto lines = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
    for (const Diagnostic& told : diagnostics.sorted()) {
        const std::string one = told.code + ": " + told.message;
        expect(find_code(told.code) != nullptr, "a code of the table: " + one);
        expect(!told.message.empty(), "a message that says something: " + one);
        expect(told.message.find('\n') == std::string::npos, "a message of one line: " + one);
        expect(told.place.line >= 0 && told.place.line <= lines, "a line of the text: " + one);
        expect((told.place.line >= 1) == (told.place.column >= 1), "a line with a column: " + one);
    }
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
