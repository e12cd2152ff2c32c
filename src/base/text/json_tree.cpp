#include "base/text/json_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/text/place_at.h"
#include "base/text/shown.h"

namespace popup {
namespace {

// Counts what the parser has read: of the library one learns of values, not of where they stand.
struct CountingIterator {
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    const char* at = nullptr;
    const char** read = nullptr;

    reference operator*() const { return *at; }
    CountingIterator& operator++() {
        *read = ++at;
        return *this;
    }
    CountingIterator operator++(int) {
        const CountingIterator before = *this;
        ++*this;
        return before;
    }
    friend bool operator==(const CountingIterator& a, const CountingIterator& b) { return a.at == b.at; }
};

// Takes the parser's events.
class TreeMaker {
 public:
    TreeMaker(std::string_view text, std::string_view syntax_code, const char*& read,
              Diagnostics& diagnostics)
        : text_(text), syntax_code_(syntax_code), read_(read), diagnostics_(diagnostics) {}

    bool null() { return scalar(std::monostate{}); }
    bool boolean(bool value) { return scalar(value); }
    bool number_integer(std::int64_t value) { return scalar(static_cast<double>(value)); }
    bool number_unsigned(std::uint64_t value) { return scalar(static_cast<double>(value)); }
    bool number_float(double value, const std::string& /*as_written*/) { return scalar(value); }
    bool string(std::string& value) { return scalar(std::move(value)); }
    bool binary(nlohmann::json::binary_t& /*value*/) { return false; }
    bool start_object(std::size_t /*count*/) { return open(JsonObject{}); }
    bool start_array(std::size_t /*count*/) { return open(JsonList{}); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }
    bool key(std::string& name) {
        auto& members = std::get<JsonObject>(open_.back()->value);
        const std::size_t at = next_token();
        seen_ = here();
        if (members.size() == kMembersLimit) {
            return refuse(at, fmt::format("an object has more than {} members", kMembersLimit));
        }
        const auto same = [&](const JsonMember& member) { return member.name == name; };
        if (std::any_of(members.begin(), members.end(), same)) {
            return refuse(at, fmt::format("the object has two members \"{}\"", shown(name)));
        }
        members.push_back({std::move(name), {}});
        return true;
    }
    bool parse_error(std::size_t /*position*/, const std::string& /*last*/,
                     const nlohmann::json::exception& error) {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while …"
        std::string_view what = error.what();
        for (const std::string_view before : {"] ", ": "}) {
            if (const std::size_t at = what.find(before); at != std::string_view::npos)
                what.remove_prefix(at + before.size());
        }
        const std::size_t at = here() > 0 && here() < text_.size() ? here() - 1 : here();
        if (ends_early(what)) return refuse(text_.size(), "this is not JSON: " + where_it_ends());
        // What editors of scripts allow, and JSON does not.
        const std::size_t before = at == 0 ? at : text_.find_last_not_of(" \t\r\n", at - 1);
        const bool closes = at < text_.size() && (text_[at] == ']' || text_[at] == '}');
        if (closes && before < at && text_[before] == ',')
            return refuse(before, fmt::format("this is not JSON: a comma stands before '{}'", text_[at]));
        return refuse(at, fmt::format("this is not JSON: {}", one_line(what)));
    }

    [[nodiscard]] JsonValue& root() { return root_; }

 private:
    [[nodiscard]] static bool ends_early(std::string_view what) {
        return what.find("unexpected end of input") != std::string_view::npos;
    }
    [[nodiscard]] std::string where_it_ends() const {
        if (open_.empty()) return "the text ends where a value is missing";
        const Place begin = place_at(text_, open_.back()->at);
        return fmt::format("the text ends before the '{}' at {}:{} is closed", text_[open_.back()->at],
                           begin.line, begin.column);
    }
    // The library quotes what it read last.
    static std::string one_line(std::string_view text) {
        std::string line(text.substr(0, 200));
        std::replace_if(
            line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
        return line;
    }
    [[nodiscard]] std::size_t here() const { return static_cast<std::size_t>(read_ - text_.data()); }
    // Where the token begins that ends here: behind the last one, which may have been read one byte too far.
    [[nodiscard]] std::size_t next_token() const {
        const std::size_t at = text_.find_first_not_of(" \t\r\n,:", seen_);
        return std::min(at, here());
    }
    bool refuse(std::size_t at, std::string why) {
        diagnostics_.error(syntax_code_, place_at(text_, at), std::move(why));
        return false;
    }
    JsonValue& put(JsonValue value) {
        if (open_.empty()) return root_ = std::move(value);
        if (auto* list = std::get_if<JsonList>(&open_.back()->value))
            return list->emplace_back(std::move(value));
        return std::get<JsonObject>(open_.back()->value).back().value = std::move(value);
    }
    bool counted() {
        if (++values_ <= kValuesLimit) return true;
        diagnostics_.error("document-too-large", place_at(text_, here()),
                           fmt::format("the document has more than {} values", kValuesLimit));
        return false;
    }
    template <typename T>
    bool scalar(T&& value) {
        if (!counted()) return false;
        JsonValue one;
        one.at = next_token();
        one.value = std::forward<T>(value);
        put(std::move(one));
        seen_ = here();
        return true;
    }
    template <typename T>
    bool open(T&& empty) {
        if (!counted()) return false;
        const std::size_t at = here() - 1;
        if (open_.size() == kDepthLimit) {
            return refuse(at, fmt::format("values are nested more than {} deep", kDepthLimit));
        }
        seen_ = here();
        // Only the innermost open value grows, so those around it stay where they are.
        open_.push_back(&put({std::forward<T>(empty), at}));
        return true;
    }
    bool close() {
        open_.pop_back();
        seen_ = here();
        return true;
    }

    std::string_view text_;
    std::string_view syntax_code_;
    const char*& read_;
    Diagnostics& diagnostics_;
    JsonValue root_;
    std::vector<JsonValue*> open_;
    std::size_t seen_ = 0;  // everything before has been made a value of
    std::size_t values_ = 0;
};

}  // namespace

const JsonValue* JsonValue::member(std::string_view name) const {
    const JsonObject* members = object();
    if (members == nullptr) return nullptr;
    const auto found = std::find_if(members->begin(), members->end(),
                                    [name](const JsonMember& member) { return member.name == name; });
    return found == members->end() ? nullptr : &found->value;
}

std::optional<JsonValue> read_json(std::string_view text, std::string_view syntax_code,
                                   Diagnostics& diagnostics) {
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
        diagnostics.error("empty-input", {},
                          text.empty() ? "the file is empty" : "the file holds only blanks");
        return std::nullopt;
    }
    const char* read = text.data();
    TreeMaker maker(text, syntax_code, read, diagnostics);
    const char* end = text.data() + text.size();
    if (!nlohmann::json::sax_parse(CountingIterator{text.data(), &read}, CountingIterator{end, &read},
                                   &maker))
        return std::nullopt;
    return std::move(maker.root());
}

}  // namespace popup
