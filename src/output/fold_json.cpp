#include "output/fold_json.h"

#include <iterator>
#include <nlohmann/json.hpp>

#include "base/text/numbers.h"

namespace popup {

void FoldJson::quoted(std::string_view text) {
    append(nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

void FoldJson::number(double value) { append_number(out_, value, kDecimals); }

void FoldJson::numbers(std::initializer_list<double> values) {
    std::string_view before = "[";
    for (const double value : values) {
        append(before);
        number(value);
        before = ", ";
    }
    append("]");
}

void FoldJson::indices(const std::vector<std::size_t>& values) {
    fmt::format_to(std::back_inserter(out_), "[{}]", fmt::join(values, ", "));
}

void FoldJson::next_item() {
    if (!first_) append(", ");
    first_ = false;
}

void FoldJson::new_line(std::size_t depth) { append("\n" + std::string(2 * depth, ' ')); }

void FoldJson::next_row(std::size_t depth) {
    if (!first_) append(",");
    first_ = false;
    new_line(depth);
}

void FoldJson::begin_key(std::size_t depth, std::string_view key) {
    next_row(depth);
    quoted(key);
    append(": ");
}

void FoldJson::begin_list() {
    append("[");
    first_ = true;
}

void FoldJson::end_items() {
    append("]");
    first_ = false;
}

void FoldJson::end_rows(std::size_t depth) {
    new_line(depth);
    end_items();
}

void FoldJson::begin_object() {
    append("{");
    first_ = true;
}

void FoldJson::end_object(std::size_t depth) {
    new_line(depth);
    append("}");
    first_ = false;
}

void FoldJson::text_key(std::size_t depth, std::string_view key, std::string_view text) {
    begin_key(depth, key);
    quoted(text);
}

void FoldJson::list_key(std::size_t depth, std::string_view key, const std::vector<std::string_view>& texts) {
    begin_key(depth, key);
    begin_list();
    for (const std::string_view text : texts) {
        next_item();
        quoted(text);
    }
    end_items();
}

}  // namespace popup
