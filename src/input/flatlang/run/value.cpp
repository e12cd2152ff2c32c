#include "input/flatlang/run/value.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>

namespace popup::flatlang {
namespace {

constexpr std::size_t kBlock = 256;
// Of lists within lists, and of objects whose text is an object, when they are written.
constexpr int kDeepestText = 2000;

}  // namespace

Value::Value(Cell* cell) : cell_(cell) { ++cell_->uses; }

Value::Value(const Value& other) : cell_(other.cell_) {
    if (cell_ != nullptr) ++cell_->uses;
}

Value::~Value() {
    if (cell_ != nullptr && --cell_->uses == 0) cell_->heap->release(cell_);
}

CellExtras& Cell::more() {
    if (!extras) extras = std::make_unique<CellExtras>();
    return *extras;
}

const Value* Cell::member(int symbol) const {
    if (!extras) return nullptr;
    for (const auto& [name, value] : extras->members) {
        if (name == symbol) return &value;
    }
    return nullptr;
}

void Cell::set_member(int symbol, Value value) {
    for (auto& [name, old] : more().members) {
        if (name != symbol) continue;
        old = std::move(value);
        return;
    }
    extras->members.emplace_back(symbol, std::move(value));
}

void Cell::set_referent(int symbol, Cell& of) {
    CellExtras& here = more();
    here.referent = &of;
    here.referent_serial = of.serial;
    here.referent_symbol = symbol;
}

Heap::~Heap() {
    // What still lives refers to itself in a circle: nothing is counted any more, cells go as they stand.
    const auto forget = [](Value& value) { value.cell_ = nullptr; };
    for (const std::unique_ptr<Cell[]>& block : blocks_) {
        for (std::size_t i = 0; i < kBlock; ++i) {
            Cell& cell = block[i];
            forget(cell.first);
            forget(cell.next);
            if (!cell.extras) continue;
            for (auto& [name, value] : cell.extras->members) forget(value);
        }
    }
}

Value Heap::make(Type type) {
    if (free_.empty()) {
        blocks_.push_back(std::make_unique<Cell[]>(kBlock));
        for (std::size_t i = kBlock; i > 0; --i) free_.push_back(&blocks_.back()[i - 1]);
    }
    Cell* cell = free_.back();
    free_.pop_back();
    cell->type = type;
    cell->heap = this;
    cell->serial = ++serials_;
    ++size_;
    return Value(cell);
}

void Heap::release(Cell* cell) {
    if (abandoned_) return;
    std::vector<Cell*> dying{cell};
    const auto let_go = [&dying](Value& value) {
        Cell* behind = std::exchange(value.cell_, nullptr);
        if (behind != nullptr && --behind->uses == 0) dying.push_back(behind);
    };
    while (!dying.empty()) {
        Cell& one = *dying.back();
        dying.pop_back();
        let_go(one.first);
        let_go(one.next);
        if (one.extras) {
            for (auto& [name, value] : one.extras->members) let_go(value);
            one.extras.reset();
        }
        text_bytes_ -= one.text.size();
        if (one.text.capacity() > 64) {
            one.text = std::string();
        } else {
            one.text.clear();
        }
        one.number = 0.0;
        one.type = Type::nil;
        one.serial = 0;
        free_.push_back(&one);
        --size_;
    }
}

Value Heap::nil() { return make(Type::nil); }

Value Heap::truth(bool value) {
    Value made = make(Type::truth);
    made->number = value ? 1.0 : 0.0;
    return made;
}

Value Heap::number(double value) {
    Value made = make(Type::number);
    made->number = value;
    return made;
}

void Heap::set_text(Cell& cell, std::string text) {
    text_bytes_ += text.size();
    bytes_written_ += text.size();
    cell.text = std::move(text);
}

Value Heap::text(std::string value) {
    Value made = make(Type::text);
    set_text(*made, std::move(value));
    return made;
}

Value Heap::list(Value first_element) {
    Value made = make(Type::list);
    made->first = std::move(first_element);
    return made;
}

Value Heap::vec(Vec3 value) {
    Value made = make(Type::vec);
    made->more().numbers = {value.x, value.y, value.z};
    return made;
}

Value Heap::matrix(const std::array<double, 9>& rows) {
    Value made = make(Type::matrix);
    made->more().numbers = rows;
    return made;
}

Value Heap::function(FunctionBody body) {
    Value made = make(Type::function);
    made->more().function = body;
    return made;
}

Value Heap::object() {
    Value made = make(Type::object);
    made->first = make(Type::nil);
    return made;
}

Value Heap::object(const Value& same_as) {
    Value made = make(Type::object);
    made->first = same_as->first;
    return made;
}

Value Heap::copy(const Value& value, std::uint64_t& budget, int depth) {
    if (depth > kDeepestCopy) budget = 0;
    if (budget == 0) return nil();
    --budget;
    switch (value->type) {
        case Type::list: {
            Value made = list({});
            Value last;
            for (Value at = value->first; at; at = at->next) {
                Value element = copy(at, budget, depth + 1);
                if (budget == 0) return nil();
                (last ? last->next : made->first) = element;
                last = std::move(element);
            }
            if (value->extras) made->more().members = value->extras->members;
            return made;
        }
        case Type::object:
            return object(value);
        case Type::matrix: {
            const std::array<double, 9>& m = value->extras->numbers;
            Value made = matrix({m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]});
            made->more().members = value->extras->members;
            return made;
        }
        case Type::nil:
        case Type::truth:
        case Type::number:
        case Type::text:
        case Type::function:
        case Type::vec:
            break;
    }
    Value made = make(value->type);
    made->number = value->number;
    if (!value->text.empty()) set_text(*made, value->text);
    if (value->extras) {
        made->more().members = value->extras->members;
        made->extras->numbers = value->extras->numbers;
        made->extras->function = value->extras->function;
    }
    return made;
}

std::uint64_t length(const Value& list) {
    std::uint64_t count = 0;
    for (const Value* at = &list->first; *at; at = &(*at)->next) ++count;
    return count;
}

std::string number_text(double value) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value < 0 ? "-Infinity" : "Infinity";
    if (value == 0.0) return std::signbit(value) ? "-0.0" : "0.0";
    std::array<char, 40> buffer{};
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::scientific).ptr;
    const std::string_view written(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
    const std::size_t e = written.find('e');
    int exponent = 0;
    const char* from = written.data() + e + (written[e + 1] == '+' ? 2 : 1);
    std::from_chars(from, written.data() + written.size(), exponent);
    std::string sign, digits;
    for (const char c : written.substr(0, e)) {
        if (c == '-') sign = "-";
        if (c >= '0' && c <= '9') digits += c;
    }
    const auto padded = [](const std::string& text) { return text.empty() ? std::string("0") : text; };
    if (exponent < -3 || exponent >= 7) {
        return sign + digits[0] + "." + padded(digits.substr(1)) + "E" + std::to_string(exponent);
    }
    if (exponent < 0) {
        return sign + "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
    }
    const auto whole = static_cast<std::size_t>(exponent) + 1;
    if (digits.size() < whole) digits.resize(whole, '0');
    return sign + digits.substr(0, whole) + "." + padded(digits.substr(whole));
}

namespace {

// Of a decimal number that no float holds, without a sign: whether it is too small, and not too large.
bool is_below_one(std::string_view text) {
    const std::size_t mark = std::min(text.find_first_of("eE"), text.size());
    const std::string_view digits = text.substr(0, mark);
    const std::size_t first = std::min(digits.find_first_not_of("0."), digits.size());
    const std::size_t dot = std::min(digits.find('.'), digits.size());
    long exponent = 0;
    if (mark < text.size()) {
        std::string_view written = text.substr(mark + 1);
        const bool below = written.starts_with('-');
        if (below || written.starts_with('+')) written.remove_prefix(1);
        constexpr long kBeyond = 1'000'000;  // more than there are digits
        const auto [end, problem] =
            std::from_chars(written.data(), written.data() + written.size(), exponent);
        if (problem == std::errc::result_out_of_range) exponent = kBeyond;
        if (below) exponent = -exponent;
    }
    // The first digit stands for so many tens.
    return exponent + static_cast<long>(dot) - static_cast<long>(first) <= 0;
}

}  // namespace

double text_number(std::string_view text) {
    constexpr std::size_t kLongest = 4096;
    if (text.size() > kLongest) return 0.0;
    const auto is_space = [](char c) { return static_cast<unsigned char>(c) <= ' '; };
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    bool negative = false;
    if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
        negative = text.front() == '-';
        text.remove_prefix(1);
    }
    const auto signed_value = [negative](double value) { return negative ? -value : value; };
    if (text == "Infinity") return signed_value(std::numeric_limits<double>::infinity());
    if (text == "NaN") return std::numeric_limits<double>::quiet_NaN();
    if (text.empty() || (text.front() != '.' && (text.front() < '0' || text.front() > '9'))) return 0.0;
    if (const char last = text.back(); last == 'f' || last == 'F' || last == 'd' || last == 'D') {
        text.remove_suffix(1);
    }
    float value = 0.0F;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size()) return 0.0;
    if (error == std::errc::result_out_of_range) {
        // Too small is 0 and too large infinite; from_chars does not say which.
        return signed_value(is_below_one(text) ? 0.0 : std::numeric_limits<double>::infinity());
    }
    if (error != std::errc()) return 0.0;
    return signed_value(static_cast<double>(value));
}

namespace {

// "0.0#": two decimals at most, one at least.
std::string short_decimal(double value) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value < 0 ? "-Infinity" : "Infinity";
    std::array<char, 400> buffer{};
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, 2).ptr;
    std::string text(buffer.data(), end);
    if (text.back() == '0') text.pop_back();
    return text;
}

void append_text(const Value& value, const Symbols& symbols, std::size_t most, int depth, std::string& out) {
    if (out.size() >= most) return;
    if (depth > kDeepestText) {
        out += "...";
        return;
    }
    switch (value->type) {
        case Type::nil:
            out += "nil";
            return;
        case Type::truth:
            out += value->number != 0.0 ? "true" : "false";
            return;
        case Type::number:
            out += number_text(value->number);
            return;
        case Type::text:
            out.append(value->text, 0, most - out.size());
            return;
        case Type::list:
            out += '[';
            for (const Value* at = &value->first; *at && out.size() < most; at = &(*at)->next) {
                if (at != &value->first) out += ", ";
                append_text(*at, symbols, most, depth + 1, out);
            }
            out += ']';
            return;
        case Type::function: {
            const FunctionBody& body = value->extras->function;
            const Node& node = body.syntax->nodes[static_cast<std::size_t>(body.node)];
            out += symbols.name(node.symbol) + "(";
            for (std::size_t i = 0; i < node.parameters.size(); ++i) {
                out += (i > 0 ? ", " : "") + symbols.name(node.parameters[i]);
            }
            out += ')';
            return;
        }
        case Type::object: {
            const std::optional<int> known = symbols.find("__str__");
            const Value* text = known ? value->first->member(*known) : nullptr;
            if (text == nullptr) {
                out += "nil";
            } else {
                append_text(*text, symbols, most, depth + 1, out);
            }
            return;
        }
        case Type::vec: {
            const std::array<double, 9>& v = value->extras->numbers;
            out += "{" + number_text(v[0]) + ", " + number_text(v[1]) + ", " + number_text(v[2]) + "}";
            return;
        }
        case Type::matrix: {
            const std::array<double, 9>& m = value->extras->numbers;
            for (std::size_t row = 0; row < 3; ++row) {
                for (std::size_t i = 0; i < 3; ++i) out += short_decimal(m[3 * row + i]) + " ";
                out += "0.0\n";
            }
            out += "0.0 0.0 0.0 1.0";
            return;
        }
    }
}

}  // namespace

double to_number(const Value& value, const Symbols& symbols) {
    switch (value->type) {
        case Type::number:
            return static_cast<double>(static_cast<float>(value->number));
        case Type::text:
            return text_number(value->text);
        case Type::object:
            return text_number(to_text(value, symbols, 4096));
        case Type::nil:
        case Type::truth:
        case Type::list:
        case Type::function:
        case Type::vec:
        case Type::matrix:
            break;
    }
    return 0.0;
}

std::string to_text(const Value& value, const Symbols& symbols, std::size_t most) {
    std::string text;
    append_text(value, symbols, most, 0, text);
    return text;
}

int whole_number(double value) {
    if (std::isnan(value)) return 0;
    constexpr double kLeast = std::numeric_limits<int>::min();
    constexpr double kMost = std::numeric_limits<int>::max();
    return static_cast<int>(std::clamp(value, kLeast, kMost));
}

bool is_true(const Value& value) {
    switch (value->type) {
        case Type::nil:
        case Type::vec:
        case Type::matrix:
            return false;
        case Type::truth:
        case Type::number:
            return value->number != 0.0;
        case Type::text:
            return !value->text.empty();
        case Type::list:
            return static_cast<bool>(value->first);
        case Type::function:
        case Type::object:
            return true;
    }
    return false;
}

std::string_view type_name(Type type) {
    switch (type) {
        case Type::nil:
            return "nil";
        case Type::truth:
            return "a boolean";
        case Type::number:
            return "a number";
        case Type::text:
            return "a text";
        case Type::list:
            return "a list";
        case Type::function:
            return "a function";
        case Type::object:
            return "an object";
        case Type::vec:
            return "a vector";
        case Type::matrix:
            return "a matrix";
    }
    return "";
}

}  // namespace popup::flatlang
