#include "base/text/json_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace popup {
namespace {

using Json = nlohmann::ordered_json;

class JsonText {
 public:
    void write(const Json& value, std::size_t depth) {
        if (value.empty() || !value.is_structured()) {
            text_ += scalar(value);
        } else if (value.is_object()) {
            write_object(value, depth);
        } else {
            write_array(value, depth);
        }
    }
    std::string take() { return std::move(text_); }

 private:
    static std::string scalar(const Json& value) {
        return value.dump(-1, ' ', false, Json::error_handler_t::replace);
    }
    void line(std::size_t depth) {
        text_ += '\n';
        text_.append(2 * depth, ' ');
    }
    void write_object(const Json& value, std::size_t depth) {
        char before = '{';
        for (const auto& [key, member] : value.items()) {
            text_ += before;
            line(depth + 1);
            text_ += scalar(key);
            text_ += ": ";
            write(member, depth + 1);
            before = ',';
        }
        line(depth);
        text_ += '}';
    }
    void write_array(const Json& value, std::size_t depth) {
        const bool flat =
            std::none_of(value.begin(), value.end(), [](const Json& v) { return v.is_structured(); });
        char before = '[';
        for (const Json& member : value) {
            text_ += before;
            if (!flat) line(depth + 1);
            if (flat && before == ',') text_ += ' ';
            write(member, depth + 1);
            before = ',';
        }
        if (!flat) line(depth);
        text_ += ']';
    }

    std::string text_;
};

}  // namespace

std::string json_text(const Json& value) { return json_text_within(value, 0) + '\n'; }

std::string json_text_within(const Json& value, std::size_t depth) {
    JsonText text;
    text.write(value, depth);
    return text.take();
}

}  // namespace popup
