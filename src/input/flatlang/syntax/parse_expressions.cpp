#include <fmt/format.h>

#include <charconv>
#include <limits>

#include "input/flatlang/syntax/parser.h"

namespace popup::flatlang {
namespace {

using K = TokenKind;

NodeKind operation(TokenKind kind) {
    switch (kind) {
        case K::kw_or:
            return NodeKind::either;
        case K::kw_and:
            return NodeKind::both;
        case K::equal:
            return NodeKind::equal;
        case K::unequal:
            return NodeKind::unequal;
        case K::less:
            return NodeKind::less;
        case K::less_equal:
            return NodeKind::less_equal;
        case K::greater:
            return NodeKind::greater;
        case K::greater_equal:
            return NodeKind::greater_equal;
        case K::plus:
            return NodeKind::add;
        case K::minus:
            return NodeKind::subtract;
        case K::star:
            return NodeKind::multiply;
        case K::slash:
            return NodeKind::divide;
        default:
            return NodeKind::remainder;
    }
}

// Rounded to float. Digits with at most one dot; too many of them are infinity, too small ones 0.
double literal(std::string_view digits) {
    float value = 0;
    const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (problem != std::errc::result_out_of_range) return value;
    const std::size_t first = digits.find_first_not_of('0');
    const bool large = first != std::string_view::npos && digits[first] != '.';
    return large ? std::numeric_limits<float>::infinity() : 0.0F;
}

}  // namespace

int Parser::expression(Kinds after) {
    return rule(after, [&] {
        const Place place = here().place;
        const int left = binary(0, one(K::assign) | kRuleEnd);
        if (failed_ || !take_if(K::assign)) return left;
        const int right = binary(0, kRuleEnd);
        return failed_ ? kMissing : make(NodeKind::assign, place, {left, right});
    });
}

int Parser::binary(std::size_t level, Kinds after) {
    if (level == kLevels.size()) return unary(after);
    return rule(after, [&] {
        const Place place = here().place;
        const Kinds operators = kLevels[level];
        int left = binary(level + 1, operators | kRuleEnd);
        while (!failed_ && at(operators)) {
            const K sign = kind();
            take();
            const int right = binary(level + 1, operators | kRuleEnd);
            if (!failed_) left = make(operation(sign), place, {left, right});
        }
        return failed_ ? kMissing : left;
    });
}

int Parser::unary(Kinds after) {
    return rule(after, [&] {
        pass_old_name();
        if (!at(kExpression)) {
            fail(at_, "a value");
            return kMissing;
        }
        const Place place = here().place;
        const bool negative = take_if(K::minus);
        const bool positive = !negative && take_if(K::plus);
        const int value = members(kRuleEnd);
        if (failed_ || (!negative && !positive)) return value;
        return make(negative ? NodeKind::negate : NodeKind::plus, place, {value});
    });
}

int Parser::members(Kinds after) {
    return rule(after, [&] {
        const Place place = here().place;
        int left = atom(one(K::dot) | kRuleEnd);
        while (!failed_ && take_if(K::dot)) {
            const int right = atom(one(K::dot) | kRuleEnd);
            if (!failed_) left = make(NodeKind::member, place, {left, right});
        }
        return failed_ ? kMissing : left;
    });
}

int Parser::atom(Kinds after) {
    return rule(after, [&] {
        pass_old_name();
        const std::size_t begin = at_;
        const Token& first = here();
        if (first.kind == K::name) return named();
        if (first.kind == K::open) {
            take();
            return bracket(begin, kRuleEnd);
        }
        if (first.kind == K::open_list) {
            take();
            std::vector<int> elements;
            if (!sequence(K::close_list, "in the list after", {"to close the list after", begin}, elements))
                return kMissing;
            return make(NodeKind::list, first.place, std::move(elements));
        }
        if (!at(kLiteral)) {
            fail(at_, "a value");
            return kMissing;
        }
        take();
        if (first.kind == K::text) return text_node(first);
        if (first.kind == K::kw_infinity) return make(NodeKind::infinity, first.place);
        if (first.kind == K::kw_object) return make(NodeKind::object, first.place);
        const bool number = first.kind == K::number;
        const int made = make(number ? NodeKind::number : NodeKind::truth, first.place);
        if (number) {
            node(made).number = literal(word(first));
            node(made).text = word(first);
        }
        if (first.kind == K::kw_true) node(made).number = 1;
        return made;
    });
}

int Parser::bracket(std::size_t opened, Kinds after) {
    if (!enter()) return kMissing;
    const int value = expression(one(K::close));
    leave();
    if (failed_ || !expect(K::close, after, {"to close the bracket after", opened})) return kMissing;
    return value;
}

bool Parser::sequence(K closing, std::string_view inside, const Why& why, std::vector<int>& values) {
    if (!enter()) return false;
    if (as_2008_ ? at(kExpression) : kind() != closing) {
        do {
            const int value = expression(kinds(K::comma, closing));
            if (value != kMissing) values.push_back(value);
        } while (!failed_ && take_if(K::comma));
    }
    leave();
    if (failed_) return false;
    if (!as_2008_ && at(kExpression | one(K::colon)) && !begins_line(at_)) {
        fail(at_, fmt::format("',' or {}", wanted(closing)), {inside, why.about});
    }
    return !failed_ && expect(closing, kRuleEnd, why);
}

int Parser::named() {
    const std::size_t begin = at_;
    const Token& name = here();
    const bool call = token(at_ + 1).kind == K::open;
    if (call && as_2008_ && (one(token(at_ + 2).kind) & (kExpression | one(K::close))) == 0) {
        // It looked as far to tell a call from a name, and then stood before the name.
        fail(at_ + 2, "a value");
        return kMissing;
    }
    std::vector<int> arguments;
    if (call) {
        rule(one(K::open_list) | kRuleEnd, [&] {
            take();
            // In 2008 mode a call with a mistake in its brackets has no arguments.
            return rule(kRuleEnd, [&] {
                take();
                if (!sequence(K::close, "in the arguments of", {"to close the arguments of", begin},
                              arguments))
                    arguments.clear();
                return kMissing;
            });
        });
    } else {
        take();
    }
    const int value = make(call ? NodeKind::call : NodeKind::name, name.place, std::move(arguments));
    node(value).symbol = symbol(name);
    std::vector<int> parts{value};
    while (!failed_ && take_if(K::open_list)) {
        if (!enter()) return value;
        const int index = expression(one(K::close_list));
        leave();
        if (failed_ ||
            !expect(K::close_list, one(K::open_list) | kRuleEnd, {"to close the index of", begin})) {
            return value;
        }
        parts.push_back(index);
    }
    return parts.size() == 1 ? value : make(NodeKind::index, name.place, std::move(parts));
}

}  // namespace popup::flatlang
