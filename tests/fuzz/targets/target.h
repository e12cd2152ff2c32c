// What fuzzing does with bytes: one function a target, and what they all expect of a reader.
//
// A target is a file, NAME.cpp, with look_at_NAME(), and a row in targets.inc. libFuzzer drives the function
// (fuzz/libfuzzer/driver.cpp, built by clang), and the ordinary tests look with it at every find that was
// kept (fuzz/finds_test.cpp, fuzz/finds/NAME). What does not hold is thrown as Broken, with what it is.
#pragma once

#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

#include "popup/diagnostics.h"
#include "popup/language.h"

namespace popup::fuzz {

struct Broken : std::logic_error {
    using std::logic_error::logic_error;
};

// Throws Broken where it does not hold. `what` may be a function that says it: millions of inputs hold what
// is expected of them, and none of those texts is read.
template <typename What>
void expect(bool holds, const What& what) {
    if (holds) return;
    if constexpr (std::invocable<const What&>)
        throw Broken(what());
    else
        throw Broken(std::string(what));
}

// What every finding on a text promises: a code of the table, one line that says something, and a place in
// the text, or none. `returns_end_lines`: a carriage return ends a line too, by itself, as in DXF.
void expect_told(const Diagnostics& diagnostics, std::string_view text, bool returns_end_lines = false);

// Whether an input is one of every `n`: for what takes many times as long as all else that is looked at, and
// would be looked at again and again. It depends on the bytes alone, so that what is found is found again.
bool is_one_of(std::size_t n, std::string_view bytes);

// Bytes as a file that is read by its name, and never touches a disk.
class NamedBytes {
 public:
    explicit NamedBytes(std::string_view bytes);
    NamedBytes(const NamedBytes&) = delete;
    NamedBytes& operator=(const NamedBytes&) = delete;
    ~NamedBytes();
    [[nodiscard]] const std::string& name() const { return name_; }

 private:
    int fd_;
    std::string name_;
};

// How often what is accepted is emitted as an assembly, read again, and emitted again: always, or of one
// input in eight. It takes three times as long as all else.
enum class Emit { always, seldom };

// Reads a file of this name with these bytes, and takes what it describes as far as its pattern. What is
// accepted holds what assemblies promise, closes at openings between, and is read again as it is emitted.
// Programs have little time, and no files are read.
void look_at_design(const std::string& name, std::string_view bytes, const ReadOptions& options = {},
                    Emit emit = Emit::seldom);

// Numbers out of bytes, for inputs that are made and not read: zeros when there are no more.
class Choices {
 public:
    explicit Choices(std::string_view bytes) : bytes_(bytes) {}
    [[nodiscard]] bool left() const { return at_ < bytes_.size(); }
    unsigned byte() { return left() ? static_cast<unsigned char>(bytes_[at_++]) : 0U; }
    // 0 to n - 1; 0 for n = 0. n is at most 65 536.
    std::size_t below(std::size_t n);
    // From low to high, in 65 536 steps.
    double between(double low, double high);

 private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

#define POPUP_FUZZ_TARGET(name, longest, seeds, dictionary) void look_at_##name(std::string_view bytes);
#include "fuzz/targets/targets.inc"
#undef POPUP_FUZZ_TARGET

}  // namespace popup::fuzz
