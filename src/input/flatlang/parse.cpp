#include "input/flatlang/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <utility>

#include "input/flatlang/lexer.h"
#include "input/text.h"

namespace popup::flatlang {
namespace {

// Sets of kinds, one bit each.
using Kinds = std::uint64_t;
constexpr Kinds one(TokenKind kind) { return Kinds{1} << static_cast<unsigned>(kind); }
template <class... K>
constexpr Kinds kinds(K... kind) {
    return (one(kind) | ...);
}
// In a set of what may follow: the rule may end here, and then what may follow the rule may.
constexpr Kinds kRuleEnd = Kinds{1} << 63U;

using K = TokenKind;
constexpr Kinds kLiteral = kinds(K::number, K::text, K::kw_true, K::kw_false, K::kw_infinity, K::kw_object);
constexpr Kinds kExpression = kLiteral | kinds(K::name, K::open, K::open_list, K::plus, K::minus);
constexpr Kinds kCompound = kinds(K::kw_if, K::kw_while, K::kw_repeat, K::kw_for_each, K::kw_shape,
                                  K::kw_from, K::kw_replace, K::kw_replace_all);
constexpr Kinds kInner = kExpression | kCompound;  // statements within blocks
constexpr Kinds kStatement = kInner | kinds(K::kw_define, K::kw_safe);

// Operators between two expressions, loosest first.
constexpr std::array<Kinds, 6> kLevels{
    one(K::kw_or),
    one(K::kw_and),
    kinds(K::equal, K::unequal),
    kinds(K::less, K::less_equal, K::greater, K::greater_equal),
    kinds(K::plus, K::minus),
    kinds(K::star, K::slash, K::percent),
};

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
    return first != std::string_view::npos && digits[first] != '.' ? std::numeric_limits<float>::infinity()
                                                                   : 0;
}

// Why a word is wanted: "to close the arguments of" and the word that it is about.
struct Why {
    std::string_view purpose;
    std::size_t about = kNone;
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
};

// One parser for both modes, by recursive descent, a function a rule of the grammar. They differ in what
// happens at a word that does not fit. `failed_` is then set, and every function returns at once, in 2008
// mode to the end of the innermost rule, which skips words until one that may follow it or a rule around it;
// in default mode to the statement, which goes on at the next one.
class Parser {
 public:
    Parser(std::string_view text, const ParseOptions& options, Symbols& symbols, Diagnostics& diagnostics)
        : text_(text),
          options_(options),
          symbols_(symbols),
          diagnostics_(diagnostics),
          lexed_(lex(text, options.as_2008)) {}

    Parsed run(std::string_view file) {
        result_.syntax.file = file;
        tell_lexical_errors();
        program();
        result_.complete = !errors_ && !stopped_early_;
        return std::move(result_);
    }

 private:
    // ---- words

    [[nodiscard]] const Token& token(std::size_t index) const {
        return lexed_.tokens[std::min(index, lexed_.tokens.size() - 1)];
    }
    [[nodiscard]] const Token& here() const { return token(at_); }
    [[nodiscard]] K kind() const { return here().kind; }
    [[nodiscard]] bool at(Kinds set) const { return (one(kind()) & set) != 0; }
    [[nodiscard]] std::string_view word(const Token& token) const {
        return text_.substr(token.begin, token.end - token.begin);
    }
    void skip() { at_ = std::min(at_ + 1, lexed_.tokens.size() - 1); }
    // Goes over a word that fits.
    void take() {
        skip();
        recovering_ = false;
    }
    bool take_if(K wanted) {
        if (kind() != wanted) return false;
        take();
        return true;
    }

    // ---- the tree

    int make(NodeKind kind, Place place, std::vector<int> children = {}) {
        int height = 1;
        for (const int child : children) {
            if (child != kMissing) height = std::max(height, heights_[static_cast<std::size_t>(child)] + 1);
        }
        if (height > 4 * options_.deepest) too_deep(place);
        Node node;
        node.kind = kind;
        node.place = place;
        node.children = std::move(children);
        result_.syntax.nodes.push_back(std::move(node));
        heights_.push_back(height);
        return static_cast<int>(result_.syntax.nodes.size()) - 1;
    }
    Node& node(int index) { return result_.syntax.nodes[static_cast<std::size_t>(index)]; }

    // ---- what is wrong

    [[nodiscard]] std::string found(const Token& token) const {
        switch (token.kind) {
            case K::end:
                return "the end of the file";
            case K::text:
                return fmt::format("the text {}", shown(word(token)));
            case K::number:
                return fmt::format("the number {}", shown(word(token)));
            default:
                return fmt::format("'{}'", shown(word(token)));
        }
    }

    Diagnostic* tell(Place place, std::string message) {
        errors_ = true;
        if (quiet_) return nullptr;
        const Severity severity = options_.as_2008 ? Severity::warning : Severity::error;
        Diagnostic& told = diagnostics_.add(severity, "flatlang-syntax", place, std::move(message));
        if (!options_.as_2008 && ++told_ == kMost) give_up();
        return &told;
    }

    // Nothing more is read.
    void give_up() {
        quiet_ = true;
        stopped_early_ = true;
        failed_ = true;
        at_ = lexed_.tokens.size() - 1;
    }

    void too_deep(Place place) {
        if (!quiet_) {
            diagnostics_
                .error("flatlang-too-deep", place,
                       fmt::format("expressions or blocks stand more than {} deep in each other here",
                                   options_.deepest))
                .hint("give inner expressions names, or move inner blocks into functions");
        }
        errors_ = true;
        give_up();
    }

    // What stands at `index` does not fit. Once a place, and not again until a word fits.
    void complain(std::size_t index, std::string_view wanted, const Why& why) {
        if (recovering_) return;
        recovering_ = true;
        if (index == told_at_) return;
        told_at_ = index;
        const Token& wrong = token(index);
        std::string message = fmt::format("expected {}", wanted);
        if (!why.purpose.empty()) message += fmt::format(" {}", why.purpose);
        if (why.about != Why::kNone) message += fmt::format(" {}", shown(word(token(why.about))));
        message += fmt::format(", but found {}", found(wrong));
        tell(wrong.place, std::move(message));
    }

    void fail(std::size_t index, std::string_view wanted, const Why& why) {
        complain(index, wanted, why);
        failed_ = true;
    }

    // ---- rules and their recovery

    // Runs a rule that `after` may follow where it is used.
    template <class Body>
    int rule(Kinds after, const Body& body) {
        const Kinds anywhere = (anywhere_.empty() ? 0 : anywhere_.back()) | (after & ~kRuleEnd);
        const bool open = (after & kRuleEnd) != 0;
        exact_.push_back((after & ~kRuleEnd) | (open && !exact_.empty() ? exact_.back() : 0));
        anywhere_.push_back(anywhere);
        const int made = body();
        exact_.pop_back();
        anywhere_.pop_back();
        if (failed_ && options_.as_2008) {
            failed_ = false;
            // A second failure at the same word: that one is given up, or there would be no end.
            if (at_ == recovered_at_) skip();
            recovered_at_ = at_;
            while (kind() != K::end && !at(anywhere)) skip();
        }
        return made;
    }

    // True when the word that was wanted is passed; in 2008 mode also when a wrong one before it was dropped,
    // or the one at hand fits behind it.
    bool expect(K wanted, Kinds after, const Why& why) {
        if (kind() == wanted) {
            take();
            return true;
        }
        if (options_.as_2008) {
            if (token(at_ + 1).kind == wanted && kind() != K::end) {
                complain(at_, quoted(wanted), why);
                skip();
                skip();
                return true;
            }
            if ((after & kRuleEnd) != 0) after = (after & ~kRuleEnd) | (exact_.empty() ? 0 : exact_.back());
            if (at(after)) {
                complain(at_, quoted(wanted), why);
                return true;
            }
        }
        fail(at_, quoted(wanted), why);
        return false;
    }

    static std::string quoted(K kind) {
        if (kind == K::name || kind == K::text || kind == K::number) return std::string(to_string(kind));
        return fmt::format("'{}'", to_string(kind));
    }

    // Brackets and blocks are entered and left.
    bool enter() {
        if (++depth_ <= options_.deepest) return true;
        too_deep(here().place);
        return false;
    }
    void leave() { --depth_; }

    // ---- expressions

    int expression(Kinds after) {
        return rule(after, [&] {
            const int left = binary(0, one(K::assign) | kRuleEnd);
            if (failed_ || kind() != K::assign) return left;
            const Place place = here().place;
            take();
            const int right = binary(0, kRuleEnd);
            if (failed_) return kMissing;
            return make(NodeKind::assign, place, {left, right});
        });
    }

    int binary(std::size_t level, Kinds after) {
        if (level == kLevels.size()) return unary(after);
        return rule(after, [&] {
            const Kinds operators = kLevels[level];
            int left = binary(level + 1, operators | kRuleEnd);
            while (!failed_ && at(operators)) {
                const Token& sign = here();
                take();
                const int right = binary(level + 1, operators | kRuleEnd);
                if (failed_) return kMissing;
                left = make(operation(sign.kind), sign.place, {left, right});
            }
            return failed_ ? kMissing : left;
        });
    }

    int unary(Kinds after) {
        return rule(after, [&] {
            if (!at(kExpression)) {
                fail(at_, "a value", {});
                return kMissing;
            }
            const Token& sign = here();
            const bool negative = take_if(K::minus);
            const bool positive = !negative && take_if(K::plus);
            const int value = members(kRuleEnd);
            if (failed_ || (!negative && !positive)) return value;
            return make(negative ? NodeKind::negate : NodeKind::plus, sign.place, {value});
        });
    }

    int members(Kinds after) {
        return rule(after, [&] {
            int left = atom(one(K::dot) | kRuleEnd);
            while (!failed_ && kind() == K::dot) {
                const Place place = here().place;
                take();
                const int right = atom(one(K::dot) | kRuleEnd);
                if (failed_) return kMissing;
                left = make(NodeKind::member, place, {left, right});
            }
            return failed_ ? kMissing : left;
        });
    }

    int atom(Kinds after) {
        return rule(after, [&] {
            const Token& first = here();
            switch (first.kind) {
                case K::number: {
                    take();
                    const int made = make(NodeKind::number, first.place);
                    node(made).number = literal(word(first));
                    return made;
                }
                case K::text: {
                    take();
                    const int made = make(NodeKind::text, first.place);
                    const std::string_view quoted = word(first);
                    node(made).text = quoted.substr(1, quoted.size() - 2);
                    return made;
                }
                case K::kw_true:
                case K::kw_false: {
                    take();
                    const int made = make(NodeKind::truth, first.place);
                    node(made).number = first.kind == K::kw_true ? 1 : 0;
                    return made;
                }
                case K::kw_infinity:
                    take();
                    return make(NodeKind::infinity, first.place);
                case K::kw_object:
                    take();
                    return make(NodeKind::object, first.place);
                case K::open: {
                    const std::size_t opened = at_;
                    take();
                    return brackets(opened);
                }
                case K::open_list: {
                    take();
                    std::vector<int> elements;
                    if (!sequence(K::close_list, {"to close the list", Why::kNone}, elements))
                        return kMissing;
                    return make(NodeKind::list, first.place, std::move(elements));
                }
                case K::name:
                    return named();
                default:
                    fail(at_, "a value", {});
                    return kMissing;
            }
        });
    }

    int brackets(std::size_t /*opened*/) {
        if (!enter()) return kMissing;
        const int value = expression(one(K::close));
        leave();
        if (failed_ || !expect(K::close, kRuleEnd, {"to close the bracket", Why::kNone})) return kMissing;
        return value;
    }

    // Expressions with commas between them, and the closing bracket. What has no value in 2008 mode is left
    // out.
    bool sequence(K closing, const Why& why, std::vector<int>& values) {
        if (!enter()) return false;
        if (at(kExpression) || (!options_.as_2008 && kind() != closing)) {
            while (true) {
                const int value = expression(kinds(K::comma, closing));
                if (failed_) break;
                if (value != kMissing) values.push_back(value);
                if (!take_if(K::comma)) break;
            }
        }
        leave();
        return !failed_ && expect(closing, kRuleEnd, why);
    }

    // A name or a call, and indices behind it.
    int named() {
        const Token& name = here();
        const bool call = token(at_ + 1).kind == K::open;
        if (call && options_.as_2008) {
            // It looked two words ahead here.
            const Kinds third = one(token(at_ + 2).kind);
            if ((third & (kExpression | one(K::close))) == 0) {
                fail(at_ + 2, "a value", {});
                return kMissing;
            }
        }
        int value = kMissing;
        if (call) {
            value = rule(one(K::open_list) | kRuleEnd, [&] {
                const std::size_t callee = at_;
                take();
                std::vector<int> arguments;
                rule(kRuleEnd, [&] {
                    take();
                    if (!sequence(K::close, {"to close the arguments of", callee}, arguments))
                        arguments.clear();
                    return kMissing;
                });
                return make(NodeKind::call, name.place, std::move(arguments));
            });
        } else {
            take();
            value = make(NodeKind::name, name.place);
        }
        node(value).symbol = symbols_.of(word(name));
        if (failed_ || kind() != K::open_list) return value;
        std::vector<int> parts{value};
        while (kind() == K::open_list) {
            take();
            if (!enter()) return value;
            const int index = expression(one(K::close_list));
            leave();
            if (failed_ ||
                !expect(K::close_list, one(K::open_list) | kRuleEnd, {"to close the index of", Why::kNone})) {
                return value;
            }
            parts.push_back(index);
        }
        return make(NodeKind::index, name.place, std::move(parts));
    }

    // ---- statements

    void program() {
        std::vector<int> statements;
        const Place place{1, 1};
        while (true) {
            if (!at(kStatement)) {
                if (options_.as_2008 || kind() == K::end) break;
                stray();
                continue;
            }
            const int made = rule(kStatement | kRuleEnd, [&] { return statement(); });
            if (made != kMissing) statements.push_back(made);
            if (failed_) resume();
        }
        if (kind() != K::end) {
            const Token& wrong = here();
            tell(wrong.place, fmt::format("the program ends here: {} begins no statement", found(wrong)));
            stopped_early_ = true;
        }
        failed_ = false;
        result_.syntax.root = make(NodeKind::block, place, std::move(statements));
        failed_ = false;
    }

    // A word that begins no statement.
    void stray() {
        const Token& wrong = here();
        if (wrong.kind == K::kw_done) {
            tell(wrong.place, "this 'done' closes nothing");
        } else {
            tell(wrong.place, fmt::format("{} begins no statement", found(wrong)));
        }
        skip();
        if (wrong.kind != K::kw_done) resume();
    }

    // Default mode: goes to the next statement.
    void resume() {
        failed_ = quiet_;
        recovering_ = false;
        const Kinds sure = kCompound | kinds(K::kw_define, K::kw_safe, K::kw_done, K::kw_alt, K::kw_else);
        while (kind() != K::end && !at(sure)) {
            const bool first = at_ > 0 && here().place.line > token(at_ - 1).place.line;
            if (first && kind() == K::name) break;
            skip();
        }
    }

    int statement() {
        if (at(kinds(K::kw_define, K::kw_safe))) return rule(kRuleEnd, [&] { return definition(); });
        return rule(kRuleEnd, [&] { return inner_statement(); });
    }

    int inner_statement() {
        const Token& first = here();
        switch (first.kind) {
            case K::kw_if:
                return rule(kRuleEnd, [&] { return choice(); });
            case K::kw_while:
                return rule(kRuleEnd, [&] { return simple(NodeKind::loop_while); });
            case K::kw_repeat:
                return rule(kRuleEnd, [&] { return simple(NodeKind::repeat); });
            case K::kw_for_each:
                return rule(kRuleEnd, [&] { return for_each(); });
            case K::kw_shape:
                return rule(kRuleEnd, [&] { return shape(); });
            case K::kw_from:
                return rule(kRuleEnd, [&] { return from(); });
            case K::kw_replace:
                return rule(kRuleEnd, [&] { return replacement(NodeKind::replace); });
            case K::kw_replace_all:
                return rule(kRuleEnd, [&] { return replacement(NodeKind::replace_all); });
            default: {
                const int value = expression(kRuleEnd);
                if (failed_) return kMissing;
                return make(NodeKind::expression, first.place, {value});
            }
        }
    }

    // Statements until a word that begins none; kMissing when there are none.
    int block(Kinds after) {
        if (!at(kInner)) return kMissing;
        return rule(after, [&] {
            const Place place = here().place;
            std::vector<int> statements;
            if (!enter()) return kMissing;
            while (at(kInner)) {
                const int made = rule(kInner | kRuleEnd, [&] { return inner_statement(); });
                if (made != kMissing) statements.push_back(made);
                if (failed_ && !options_.as_2008) resume();
            }
            leave();
            return make(NodeKind::block, place, std::move(statements));
        });
    }

    // The end of a statement that has a block.
    bool close(std::size_t opened) { return expect(K::kw_done, kRuleEnd, {"to end", opened}); }

    int definition() {
        const std::size_t opened = at_;
        const Place place = here().place;
        const bool safe = take_if(K::kw_safe);
        if (!expect(K::kw_define, one(K::name), {})) return kMissing;
        const std::size_t name = at_;
        if (!expect(K::name, one(K::open), {})) return kMissing;
        const Kinds behind = kInner | one(K::kw_done);
        std::vector<int> parameters;
        if (!expect(K::open, kinds(K::name, K::close), {})) return kMissing;
        if (kind() == K::name) {
            while (true) {
                parameters.push_back(symbols_.of(word(here())));
                if (!expect(K::name, kinds(K::comma, K::close), {})) return kMissing;
                if (!take_if(K::comma)) break;
            }
        }
        if (!expect(K::close, behind, {})) return kMissing;
        const int body = block(one(K::kw_done));
        if (failed_ || !close(opened)) return kMissing;
        const int made = make(NodeKind::define, place, {body});
        node(made).safe = safe;
        node(made).symbol = symbols_.of(word(token(name)));
        node(made).parameters = std::move(parameters);
        return made;
    }

    int condition(Kinds after) {
        return rule(after, [&] {
            if (!expect(K::open, kExpression, {})) return kMissing;
            const int value = expression(one(K::close));
            if (failed_ || !expect(K::close, kRuleEnd, {})) return kMissing;
            return value;
        });
    }

    int choice() {
        const std::size_t opened = at_;
        const Place place = here().place;
        const Kinds next = kinds(K::kw_alt, K::kw_else, K::kw_done);
        std::vector<int> parts;
        bool has_else = false;
        while (at(kinds(K::kw_if, K::kw_alt)) && (parts.empty() || kind() == K::kw_alt)) {
            rule(next, [&] {
                take();
                parts.push_back(condition(kInner | kRuleEnd));
                if (failed_) return kMissing;
                parts.push_back(block(kRuleEnd));
                return kMissing;
            });
            if (failed_) return kMissing;
        }
        if (kind() == K::kw_else) {
            has_else = true;
            rule(one(K::kw_done), [&] {
                take();
                parts.push_back(block(kRuleEnd));
                return kMissing;
            });
            if (failed_) return kMissing;
        }
        if (!close(opened)) return kMissing;
        const int made = make(NodeKind::choose, place, std::move(parts));
        node(made).has_else = has_else;
        return made;
    }

    // while and repeat.
    int simple(NodeKind kind) {
        const std::size_t opened = at_;
        const Place place = here().place;
        take();
        if (!expect(K::open, kExpression, {"after", opened})) return kMissing;
        const int value = expression(one(K::close));
        if (failed_ || !expect(K::close, kInner | one(K::kw_done), {"after", opened})) return kMissing;
        const int body = block(one(K::kw_done));
        if (failed_ || !close(opened)) return kMissing;
        return make(kind, place, {value, body});
    }

    int for_each() {
        const std::size_t opened = at_;
        const Place place = here().place;
        take();
        if (!expect(K::open, one(K::name), {})) return kMissing;
        const std::size_t name = at_;
        if (!expect(K::name, one(K::colon), {}) || !expect(K::colon, kExpression, {})) return kMissing;
        const int list = expression(one(K::close));
        const Kinds behind = kInner | one(K::kw_done);
        if (failed_ || !expect(K::close, behind | one(K::open), {})) return kMissing;
        int filter = kMissing;
        if (take_if(K::open)) {
            filter = expression(one(K::close));
            if (failed_ || !expect(K::close, behind, {})) return kMissing;
        }
        const int body = block(one(K::kw_done));
        if (failed_ || !close(opened)) return kMissing;
        const int made = make(NodeKind::for_each, place, {list, filter, body});
        node(made).symbol = symbols_.of(word(token(name)));
        return made;
    }

    int shape() {
        const std::size_t opened = at_;
        const Place place = here().place;
        take();
        if (!expect(K::open, one(K::text), {})) return kMissing;
        const Token& title = here();
        if (!expect(K::text, one(K::close), {})) return kMissing;
        const int name = make(NodeKind::text, title.place);
        if (title.kind == K::text) node(name).text = word(title).substr(1, word(title).size() - 2);
        if (!expect(K::close, kInner | one(K::kw_done), {})) return kMissing;
        const int body = block(one(K::kw_done));
        if (failed_ || !close(opened)) return kMissing;
        return make(NodeKind::shape, place, {name, body});
    }

    int from() {
        const std::size_t opened = at_;
        const Place place = here().place;
        take();
        if (!expect(K::open, kExpression, {})) return kMissing;
        std::vector<int> parts;
        while (true) {
            const int mark = expression(kinds(K::comma, K::close));
            if (failed_) return kMissing;
            if (mark != kMissing) parts.push_back(mark);
            if (!take_if(K::comma)) break;
        }
        if (!expect(K::close, kInner | one(K::kw_done), {})) return kMissing;
        parts.push_back(block(one(K::kw_done)));
        if (failed_ || !close(opened)) return kMissing;
        return make(NodeKind::from, place, std::move(parts));
    }

    int replacement(NodeKind kind) {
        const std::size_t opened = at_;
        const Place place = here().place;
        take();
        if (!expect(K::open, kExpression, {})) return kMissing;
        const int start = expression(one(K::comma));
        if (failed_ || !expect(K::comma, kExpression, {})) return kMissing;
        const int end = expression(one(K::close));
        if (failed_ || !expect(K::close, kInner | one(K::kw_done), {})) return kMissing;
        const int body = block(one(K::kw_done));
        if (failed_ || !close(opened)) return kMissing;
        return make(kind, place, {start, end, body});
    }

    void tell_lexical_errors() {
        for (const LexicalError& error : lexed_.errors) {
            const std::string piece = shown(word(error.concern));
            switch (error.fault) {
                case LexicalFault::bad_character:
                    tell(error.place, fmt::format("'{}' has no meaning in the language", piece));
                    break;
                case LexicalFault::half_keyword:
                    tell(error.place, "'for' is followed by 'each', one blank between them");
                    break;
                case LexicalFault::half_operator:
                    tell(error.place, "'!' alone is no operator; '!=' is");
                    break;
                case LexicalFault::unfinished:
                    tell(error.place, "a text is not closed before the end of the file");
                    break;
                case LexicalFault::digits_missing:
                    tell(error.place,
                         fmt::format("digits are missing after the dot of the number {}", piece));
                    break;
                case LexicalFault::glued_name:
                    tell(error.place, fmt::format("'{}' stands directly behind a number", piece));
                    break;
            }
        }
    }

    static constexpr int kMost = 20;

    std::string_view text_;
    const ParseOptions& options_;
    Symbols& symbols_;
    Diagnostics& diagnostics_;
    Lexed lexed_;
    Parsed result_;
    std::vector<int> heights_;  // of nodes

    std::size_t at_ = 0;
    int depth_ = 0;
    bool failed_ = false;
    bool recovering_ = false;  // nothing fitted since the last complaint
    bool errors_ = false;
    bool stopped_early_ = false;
    bool quiet_ = false;
    int told_ = 0;
    std::size_t told_at_ = Why::kNone;
    std::size_t recovered_at_ = Why::kNone;
    // For the rules being read: what may follow them or a rule around them, and what may follow right here.
    std::vector<Kinds> anywhere_;
    std::vector<Kinds> exact_;
};

}  // namespace

Parsed parse(std::string_view file, std::string_view text, const ParseOptions& options, Symbols& symbols,
             Diagnostics& diagnostics) {
    return Parser(text, options, symbols, diagnostics).run(file);
}

}  // namespace popup::flatlang
