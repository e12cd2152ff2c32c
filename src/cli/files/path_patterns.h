// Patterns of paths as a gitignore file has them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace popup {

// A list of patterns, of which the last that matches a path decides.
//
// "*" and "?" stand for characters other than "/", "[a-z]" and "[!a-z]" for one of them, a backslash takes a
// character's meaning away. "**" as a whole part of the path stands for any number of parts. A pattern with a
// "/" at its begin or in its middle is matched with the whole path, others with its last part, however deep.
// With "/" at its end it is for directories only. "!" before it turns it round. Bytes are compared, whatever
// the locale.
class PathPatterns {
 public:
    PathPatterns() = default;
    // The lines of a file: empty ones and those that begin with "#" say nothing; blanks at the end are left
    // out, unless there is a backslash before them.
    explicit PathPatterns(std::string_view lines);

    // Adds one pattern, as a line of a file would.
    void add(std::string_view line);
    [[nodiscard]] bool empty() const { return patterns_.empty(); }
    // What the last matching pattern says of a path, relative to where the patterns stand, without "/" at
    // either end: true, or false for one with "!". nullopt: none matches.
    // Cost, for each pattern: the product of the lengths, at most.
    [[nodiscard]] std::optional<bool> says(std::string_view path, bool directory) const;

 private:
    struct Pattern {
        std::vector<std::string> parts;
        bool turned = false;       // "!"
        bool directories = false;  // "/" at its end
        bool last_part = false;    // no other "/"
    };
    std::vector<Pattern> patterns_;
};

}  // namespace popup
