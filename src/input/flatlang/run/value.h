// Values of FlatLang while a program runs.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/flatlang/syntax/syntax.h"
#include "popup/geometry.h"

namespace popup::flatlang {

enum class Type : std::uint8_t { nil, truth, number, text, list, function, object, vec, matrix };

struct Cell;
class Heap;

// A counted reference to a cell. Empty only where an element or member is missing; nil is a cell.
class Value {
 public:
    Value() = default;
    Value(const Value& other);
    Value(Value&& other) noexcept : cell_(std::exchange(other.cell_, nullptr)) {}
    Value& operator=(Value other) noexcept {
        std::swap(cell_, other.cell_);
        return *this;
    }
    ~Value();

    Cell* operator->() const { return cell_; }
    Cell& operator*() const { return *cell_; }
    explicit operator bool() const { return cell_ != nullptr; }
    // The same cell, not equal values.
    friend bool operator==(const Value&, const Value&) = default;

 private:
    friend class Heap;
    explicit Value(Cell* cell);
    Cell* cell_ = nullptr;
};

// A function that a program has defined. The tree outlives every value.
struct FunctionBody {
    const Syntax* syntax = nullptr;
    int node = kMissing;  // its `define`
};

// What only some cells have.
struct CellExtras {
    std::vector<std::pair<int, Value>> members;  // by symbol, in the order in which they were set
    std::array<double, 9> numbers{};             // vec: x, y, z; matrix: rows right, heading, up
    FunctionBody function;
    // The member that this value was last read as, and of which cell: an assignment to what was read goes
    // there. No reference, or objects would keep each other alive: the serial tells whether it still lives.
    Cell* referent = nullptr;
    std::uint64_t referent_serial = 0;
    int referent_symbol = -1;
};

// Lists are chains of cells: a list has the first of its elements, each element the next. Elements are shared
// between lists that were made from one another; a cell is an element of at most one chain.
struct Cell {
    std::uint32_t uses = 0;
    Type type = Type::nil;
    double number = 0.0;  // number; truth: 0 or 1
    std::string text;     // text
    Value first;          // list: its first element or empty. object: the cell that all references share
    Value next;           // the element after this one, or empty
    std::unique_ptr<CellExtras> extras;
    Heap* heap = nullptr;
    std::uint64_t serial = 0;  // another one each time the cell is used anew

    CellExtras& more();
    // The member, or null.
    [[nodiscard]] const Value* member(int symbol) const;
    void set_member(int symbol, Value value);
    // Where members are kept: of an object, the cell that its references share.
    Cell& owner() { return type == Type::object ? *first : *this; }
    // Remembers, and forgets, that this value was read as a member.
    void set_referent(int symbol, Cell& of);
    void clear_referent() {
        if (extras) extras->referent_symbol = -1;
    }
};

// Lists within lists, when they are copied.
inline constexpr int kDeepestCopy = 10'000;

// Where cells live. Frees long chains without recursion, and everything at its end, cycles too: it outlives
// all values.
class Heap {
 public:
    Heap() = default;
    ~Heap();
    Heap(const Heap&) = delete;
    Heap& operator=(const Heap&) = delete;

    Value nil();
    Value truth(bool value);
    Value number(double value);
    Value text(std::string value);
    Value list(Value first_element);
    Value vec(Vec3 value);
    Value matrix(const std::array<double, 9>& rows);
    Value function(FunctionBody body);
    // A fresh object, or a further reference to one.
    Value object();
    Value object(const Value& same_as);

    // A new cell with the same value and nothing behind it. Of a list all its elements are copied, deeply;
    // objects stay the same one, and a matrix comes out transposed: so the language has it. `budget`: how
    // many cells it may make, less by those it made; when that is not enough, or lists stand deeper within
    // each other than kDeepestCopy, it is 0, and the copy nil.
    Value copy(const Value& value, std::uint64_t& budget) { return copy(value, budget, 0); }

    // Nothing is given back from now on, before everything is: values that end cost nothing.
    void abandon() { abandoned_ = true; }

    // Cells that live, and one more for every 64 bytes of their texts.
    [[nodiscard]] std::uint64_t size() const { return size_ + text_bytes_ / 64; }
    // What writing texts has cost since this was asked last: 1 for every 32 bytes.
    std::uint64_t take_work() {
        const std::uint64_t work = bytes_written_ / 32;
        bytes_written_ %= 32;
        return work;
    }

 private:
    friend class Value;
    Value make(Type type);
    void set_text(Cell& cell, std::string text);
    Value copy(const Value& value, std::uint64_t& budget, int depth);
    void release(Cell* cell);
    std::vector<std::unique_ptr<Cell[]>> blocks_;
    std::vector<Cell*> free_;
    std::uint64_t size_ = 0;
    std::uint64_t text_bytes_ = 0;  // of cells that live
    std::uint64_t bytes_written_ = 0;
    std::uint64_t serials_ = 0;
    bool abandoned_ = false;
};

// Elements of a list, counted.
std::uint64_t length(const Value& list);

// A number as Java's Double.toString writes it: "5.0", "0.10000000149011612", "1.0E8", "NaN".
std::string number_text(double value);
// The number that a text is, as Java's Float.parseFloat reads it; 0 when it is none, or longer than 4096
// bytes.
double text_number(std::string_view text);
// What a value is where a number is wanted, rounded to float.
double to_number(const Value& value, const Symbols& symbols);
// A number as Java casts it to a whole one: towards 0, and the nearest there is; 0 of what is no number.
int whole_number(double value);
// As print() writes it: lists "[1.0, a]", vec "{x, y, z}", objects their __str__. At most about `most` bytes;
// longer texts end there.
std::string to_text(const Value& value, const Symbols& symbols, std::size_t most = std::size_t{64} << 20);
// What `if` takes for true.
bool is_true(const Value& value);

std::string_view type_name(Type type);

}  // namespace popup::flatlang
