// FlatLang's turtle, led by words.
#pragma once

#include <gtest/gtest.h>

#include <charconv>
#include <cstddef>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "input/flatlang/turtle/turtle.h"

namespace popup::flatlang::test {

// Calls of a turtle, written short: "f 1" forward, "l 90" left, "note v" remembers pos(), "drawto v 0.5",
// "drawfrom shape mark", blocks as "shape name { … }", "from mark,mark { … }", "replace start end { … }".
class Script {
 public:
    Script(Turtle& turtle, std::string_view calls) : turtle_(turtle) {
        std::istringstream in{std::string(calls)};
        for (std::string word; in >> word;) words_.push_back(word);
        run(0, words_.size());
    }

    [[nodiscard]] Outcome last() const { return last_; }

 private:
    double number(std::size_t i) const {
        double value = 0;
        std::from_chars(words_[i].data(), words_[i].data() + words_[i].size(), value);
        return value;
    }
    // `begin` is the word after "{"; where the "}" that belongs to it is.
    std::size_t end_of_block(std::size_t begin) const {
        int depth = 1;
        while (true) {
            if (words_[begin] == "{") ++depth;
            if (words_[begin] == "}" && --depth == 0) return begin;
            ++begin;
        }
    }
    // Runs a block whose "{" is at `brace`; where the "}" is.
    std::size_t block(std::size_t brace) {
        const std::size_t end = end_of_block(brace + 1);
        run(brace + 1, end);
        return end;
    }
    void run(std::size_t i, std::size_t end) {
        for (; i < end; ++i) {
            const std::string& word = words_[i];
            if (word == "f") {
                turtle_.forward(number(++i));
            } else if (word == "l") {
                turtle_.left(number(++i));
            } else if (word == "roll") {
                turtle_.roll(number(++i));
            } else if (word == "pitch") {
                turtle_.pitch(number(++i));
            } else if (word == "up" || word == "down") {
                turtle_.pen(word == "down");
            } else if (word == "mark") {
                turtle_.mark(words_[++i]);
            } else if (word == "back") {
                turtle_.back_to(words_[++i]);
            } else if (word == "part") {
                turtle_.part(words_[++i], {1, static_cast<int>(i)});
            } else if (word == "note") {
                noted_[words_[++i]] = turtle_.pose().at;
            } else if (word == "drawto") {
                turtle_.draw_to(noted_.at(words_[i + 1]), number(i + 2));
                i += 2;
            } else if (word == "draw") {
                last_ = turtle_.draw(words_[++i], std::nullopt);
            } else if (word == "drawfrom") {
                last_ = turtle_.draw(words_[i + 1], words_[i + 2]);
                i += 2;
            } else if (word == "clear") {
                turtle_.clear();
            } else if (word == "shape") {
                turtle_.begin_shape(words_[i + 1]);
                i = block(i + 2);
                turtle_.end_shape();
            } else if (word == "replace" || word == "replaceall") {
                turtle_.begin_replacement(words_[i + 1], words_[i + 2], word == "replaceall");
                i = block(i + 3);
                last_ = turtle_.end_replacement();
            } else if (word == "from") {
                std::vector<Turtle::Cursor> marks;
                std::istringstream names(words_[i + 1]);
                for (std::string name; std::getline(names, name, ',');) {
                    marks.push_back(turtle_.find_above(name).value());
                }
                const Turtle::Cursor here = turtle_.cursor();
                for (const Turtle::Cursor mark : marks) {
                    turtle_.set_cursor(mark);
                    block(i + 2);
                }
                turtle_.set_cursor(here);
                i = end_of_block(i + 3);
            } else {
                ADD_FAILURE() << "no such call: " << word;
            }
        }
    }

    Turtle& turtle_;
    std::vector<std::string> words_;
    std::map<std::string, Vec3> noted_;
    Outcome last_ = Outcome::done;
};

}  // namespace popup::flatlang::test
