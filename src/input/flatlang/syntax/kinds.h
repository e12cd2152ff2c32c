// Sets of kinds of words, and which words the rules of the grammar begin with.
#pragma once

#include <array>
#include <cstdint>

#include "input/flatlang/syntax/lexer.h"

namespace popup::flatlang {

// One bit a kind.
using Kinds = std::uint64_t;
constexpr Kinds one(TokenKind kind) { return Kinds{1} << static_cast<unsigned>(kind); }
template <class... K>
constexpr Kinds kinds(K... kind) {
    return (one(kind) | ...);
}
// In a set of what may follow: the rule may end here, and then what may follow the rule may.
inline constexpr Kinds kRuleEnd = Kinds{1} << 63U;

inline constexpr Kinds kLiteral = kinds(TokenKind::number, TokenKind::text, TokenKind::kw_true,
                                        TokenKind::kw_false, TokenKind::kw_infinity, TokenKind::kw_object);
inline constexpr Kinds kExpression = kLiteral | kinds(TokenKind::name, TokenKind::open, TokenKind::open_list,
                                                      TokenKind::plus, TokenKind::minus);
// Statements with a block of their own, but for definitions.
inline constexpr Kinds kCompound =
    kinds(TokenKind::kw_if, TokenKind::kw_while, TokenKind::kw_repeat, TokenKind::kw_for_each,
          TokenKind::kw_shape, TokenKind::kw_from, TokenKind::kw_replace, TokenKind::kw_replace_all);
inline constexpr Kinds kDefinition = kinds(TokenKind::kw_define, TokenKind::kw_safe);
inline constexpr Kinds kInner = kExpression | kCompound;  // statements within blocks
inline constexpr Kinds kStatement = kInner | kDefinition;
// What ends a block.
inline constexpr Kinds kBlockEnd = kinds(TokenKind::kw_done, TokenKind::kw_alt, TokenKind::kw_else);

// Operators between two expressions, loosest first.
inline constexpr std::array<Kinds, 6> kLevels{
    one(TokenKind::kw_or),
    one(TokenKind::kw_and),
    kinds(TokenKind::equal, TokenKind::unequal),
    kinds(TokenKind::less, TokenKind::less_equal, TokenKind::greater, TokenKind::greater_equal),
    kinds(TokenKind::plus, TokenKind::minus),
    kinds(TokenKind::star, TokenKind::slash, TokenKind::percent),
};

}  // namespace popup::flatlang
