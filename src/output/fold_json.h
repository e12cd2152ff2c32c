// JSON as FOLD files are laid out by hand: a row a vertex, an edge or a face.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace popup {

// Appends to one text. Whoever derives from it opens and closes lists and objects in pairs; commas and line
// ends follow. Depth 1 is that of a file's keys. A text that is no UTF-8 is written with replacement
// characters.
//
//     begin_key(1, "edges_vertices");
//     begin_list();
//     next_row(2);
//     indices({0, 1});
//     end_rows(1);
class FoldJson {
 public:
    static constexpr int kDecimals = 6;  // of all numbers that are no indices

 protected:
    [[nodiscard]] std::string text() const { return fmt::to_string(out_); }
    void append(std::string_view text) { out_.append(text.data(), text.data() + text.size()); }
    void quoted(std::string_view text);
    void number(double value);
    void numbers(std::initializer_list<double> values);       // as a list
    void indices(const std::vector<std::size_t>& values);     // likewise
    void next_item();                                         // of a list in one row
    void next_row(std::size_t depth);                         // of a list or object of many
    void begin_key(std::size_t depth, std::string_view key);  // its value follows
    void begin_list();
    void end_items();                  // of a list in one row
    void end_rows(std::size_t depth);  // of a list of many
    void begin_object();
    void end_object(std::size_t depth);
    void text_key(std::size_t depth, std::string_view key, std::string_view text);
    void list_key(std::size_t depth, std::string_view key, const std::vector<std::string_view>& texts);

 private:
    void new_line(std::size_t depth);

    fmt::memory_buffer out_;
    bool first_ = false;  // nothing stands yet in the list or object that is open
};

}  // namespace popup
