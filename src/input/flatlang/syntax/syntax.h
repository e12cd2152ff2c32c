// A FlatLang program as a tree.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "popup/diagnostics.h"

namespace popup::flatlang {

// Names as numbers, the same for equal names, of all programs that one interpreter reads.
class Symbols {
 public:
    int of(std::string_view name);
    [[nodiscard]] std::optional<int> find(std::string_view name) const;
    [[nodiscard]] const std::string& name(int symbol) const {
        return names_[static_cast<std::size_t>(symbol)];
    }

 private:
    std::unordered_map<std::string, int> numbers_;
    std::vector<std::string> names_;
};

// What a node is. In brackets its children; `E` is an expression, `?` may be kMissing.
enum class NodeKind : std::uint8_t {
    // expressions
    number,    // `number`, rounded to float as the language has it
    text,      // `text`, between the quotes as written: escapes are not decoded
    truth,     // `number` is 1 (true) or 0
    infinity,  //
    object,    // __object__
    name,      // `symbol`
    call,      // `symbol` [arguments E…]
    index,     // [name or call, indices E…], at least one index
    list,      // [elements E…]
    member,    // [E, E]: left.right. a.b.c is member(member(a, b), c)
    negate,    // [E]
    plus,      // [E]: a + before an expression
    add,
    subtract,
    multiply,
    divide,
    remainder,  // [E, E]
    less,
    less_equal,
    greater,
    greater_equal,
    equal,
    unequal,
    both,
    either,
    assign,  // [E, E]
    // statements
    expression,   // [E]: a statement that is one
    define,       // `symbol`, `parameters`, `safe` [block?]
    choose,       // if: [condition E, block?, condition E, block?, …, otherwise block?]: pairs, then, when
                  // `has_else`, one more
    loop_while,   // [condition E, block?]
    repeat,       // [count E, block?]
    for_each,     // `symbol` [list E, condition E?, block?]
    shape,        // [name E, block?]
    from,         // [marks E…, block?]
    replace,      // [start E, end E, block?]
    replace_all,  // likewise
    block,        // [statements…]
};

inline constexpr int kMissing = -1;

struct Node {
    NodeKind kind = NodeKind::block;
    bool safe = false;      // define
    bool has_else = false;  // choose
    int symbol = -1;
    double number = 0.0;
    Place place;  // of its first token
    std::string text;
    std::vector<int> children;    // indices into Syntax::nodes, or kMissing
    std::vector<int> parameters;  // define: symbols
};

// `nodes[root]` is a block. Every child has a smaller index than its parent.
struct Syntax {
    std::string file;  // as the user named it, for findings
    std::vector<Node> nodes;
    int root = kMissing;
};

}  // namespace popup::flatlang
