// Custom properties of CSS (--name), and what stands in their place where a value says var(--name).
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace popup::drawing {

// Values longer than this, once everything is put in, say nothing (CSS Custom Properties Module Level 1, 3.3,
// leaves the bound to the reader), and neither do those with brackets nested deeper.
inline constexpr std::size_t kLongestValue = 4096;
inline constexpr int kDeepestFallback = 32;

// By name, "--" included.
using VariableTexts = std::map<std::string, std::string, std::less<>>;

// What holds for an element: its own custom properties, and what it inherits. Copies share all.
class Variables {
 public:
    // Those of an element in one that has these. `declared` are its own, as they are written: var() in them
    // means those of the same element. Those that depend on themselves, through whatever others, and those
    // that nothing can be put into, are not set; "inherit" and "unset" leave what is inherited, "initial"
    // nothing. Cost: near linear in their text.
    [[nodiscard]] Variables within(const VariableTexts& declared) const;

    // Null where it is not set.
    [[nodiscard]] const std::string* find(std::string_view name) const;

    // A value with all its var() put in: "var(--fold, blue)" is "blue" where --fold is not set, which may be
    // of further ones. nullopt where one is not set that has no fallback (`missing`, if given, gets its
    // name), where the value would be longer than kLongestValue, or where it is no value. A text without
    // var() is itself. Cost: linear in the result, and in how many elements around have variables.
    [[nodiscard]] std::optional<std::string> put_into(std::string_view text,
                                                      std::string* missing = nullptr) const;

 private:
    // Of one element; nullopt: not set, whatever is inherited.
    struct Scope {
        std::map<std::string, std::optional<std::string>, std::less<>> values;
        std::shared_ptr<const Scope> around;
    };
    std::shared_ptr<const Scope> scope_;  // none: nothing is set
};

// Whether a value has a var().
bool has_variable(std::string_view text);

}  // namespace popup::drawing
