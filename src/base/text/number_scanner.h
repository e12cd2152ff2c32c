// Numbers as SVG runs them together: "1-2.5.5e-3" is 1, -2.5, 0.005.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace popup {

// Takes numbers off a text, one after the other.
class NumberScanner {
 public:
    explicit NumberScanner(std::string_view text) : text_(text) {}

    // The next number, after blanks and at most one comma. Nullopt, and nothing is taken, where there is
    // none. What no double holds is infinite.
    std::optional<double> number();
    // The same for a digit 0 or 1, which the next number may follow at once.
    std::optional<bool> flag();
    // The next character, blanks before it skipped; '\0' at the end.
    char peek();
    void skip(std::size_t count) { at_ += count; }
    void skip_separator();
    [[nodiscard]] std::size_t position() const { return at_; }
    [[nodiscard]] std::string_view rest() const { return text_.substr(at_); }

 private:
    void skip_blanks();
    std::string_view text_;
    std::size_t at_ = 0;
};

// All of `text` as numbers between blanks or commas; nullopt when there is anything else in it.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

}  // namespace popup
