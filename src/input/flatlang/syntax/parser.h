// The parser's state, its recovery, and the rules of the grammar; only parse*.cpp include it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/flatlang/syntax/complaints.h"
#include "input/flatlang/syntax/kinds.h"
#include "input/flatlang/syntax/lexer.h"
#include "input/flatlang/syntax/parse.h"

namespace popup::flatlang {

inline constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

// What a word is wanted for: "to close the arguments of" and the word that it is about.
struct Why {
    std::string_view purpose;
    std::size_t about = kNowhere;
};

// One parser for both modes, by recursive descent, a function a rule of the grammar. They differ in what
// happens at a word that does not fit. `failed_` is then set, and functions return at once: in 2008 mode to
// the end of the innermost rule, which skips words until one that may follow it or a rule around it; in
// default mode to the header or the statement, and what is behind that is read on.
class Parser {
 public:
    Parser(std::string_view text, const ParseOptions& options, Symbols& symbols, Diagnostics& diagnostics)
        : text_(text),
          as_2008_(options.as_2008),
          deepest_(options.deepest),
          symbols_(symbols),
          diagnostics_(diagnostics),
          lexed_(lex(text, options.as_2008)),
          last_(lexed_.tokens.size() - 1) {}

    Parsed run(std::string_view file);

 private:
    using K = TokenKind;

    // Words.

    [[nodiscard]] const Token& token(std::size_t index) const {
        return lexed_.tokens[std::min(index, last_)];
    }
    [[nodiscard]] const Token& here() const { return token(at_); }
    [[nodiscard]] K kind() const { return here().kind; }
    [[nodiscard]] bool at(Kinds set) const { return (one(kind()) & set) != 0; }
    [[nodiscard]] bool begins_line(std::size_t index) const {
        return index == 0 || token(index).place.line > token(index - 1).place.line;
    }
    [[nodiscard]] std::string_view word(const Token& token) const {
        return text_.substr(token.begin, token.end - token.begin);
    }
    int symbol(const Token& token) { return symbols_.of(word(token)); }
    void skip() { at_ = std::min(at_ + 1, last_); }
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

    // The tree.

    // Beyond the limit children are left out, so that there is no deeper tree; nothing more is read then.
    int make(NodeKind kind, Place place, std::vector<int> children = {});
    Node& node(int index) { return result_.syntax.nodes[static_cast<std::size_t>(index)]; }

    // Empty when the word is no text, as broken programs have it.
    int text_node(const Token& token);

    // What is wrong.

    // `cause`: the word at which it showed.
    Diagnostic* tell(std::size_t cause, Complaint complaint);

    // Nothing more is read.
    void give_up();
    void too_deep(Place place, std::string message);
    void lexical_errors();

    // What stands at `index` does not fit. Told once a place, and not again until a word fits.
    void complain(std::size_t index, const std::string& wanted, const Why& why);
    void fail(std::size_t index, const std::string& wanted, const Why& why = {});

    // `:width`, as names of parameters were written once. True when there was one; its name is at hand then.
    bool pass_old_name();

    // Recovery.

    // Runs a rule that `after` may follow where it is used.
    template <class Body>
    int rule(Kinds after, const Body& body) {
        const Kinds words = after & ~kRuleEnd;
        const bool open = (after & kRuleEnd) != 0;
        const Kinds anywhere = words | (anywhere_.empty() ? 0 : anywhere_.back());
        anywhere_.push_back(anywhere);
        exact_.push_back(words | (open && !exact_.empty() ? exact_.back() : 0));
        const int made = body();
        exact_.pop_back();
        anywhere_.pop_back();
        if (failed_ && as_2008_) {
            failed_ = false;
            // A second failure at the same word: that one is given up, or there would be no end.
            if (at_ == recovered_at_) skip();
            recovered_at_ = at_;
            while (kind() != K::end && !at(anywhere)) skip();
        }
        return made;
    }

    // True when the word that was wanted is passed; in 2008 mode also when a wrong one before it was dropped,
    // or when the one at hand fits behind it.
    bool expect(K kind_wanted, Kinds after, const Why& why);

    // Default mode: behind the brackets that were opened since `begin`, if they are closed before another
    // statement surely begins; else, at the first word of a line, and for `header`s any word may be that.
    void resume(std::size_t begin, bool header);
    static int opens(const Token& token) {
        return token.kind == K::open || token.kind == K::open_list ? 1 : 0;
    }
    static int closes(const Token& token) {
        return token.kind == K::close || token.kind == K::close_list ? 1 : 0;
    }

    // Default mode: a word that begins no statement and ends no block.
    void stray();

    // Brackets and blocks are entered and left.
    bool enter();
    void leave() { --depth_; }

    // Expressions; parse_expressions.cpp. `after` is what may follow where the rule is used.

    int expression(Kinds after);
    int binary(std::size_t level, Kinds after);
    int unary(Kinds after);
    int members(Kinds after);
    int atom(Kinds after);

    // An expression and the closing bracket behind it.
    int bracket(std::size_t opened, Kinds after);

    // Expressions with commas between them, and the closing bracket. What has no value in 2008 mode is left
    // out.
    bool sequence(K closing, std::string_view inside, const Why& why, std::vector<int>& values);

    // A name or a call, and indices behind it.
    int named();

    // Statements; parse_statements.cpp. Like those of expressions they return a node, or kMissing.

    // Default mode: goes on after the statement that begins there. 1 when it may have had a block that was
    // not recognised, whose done is to be passed over; else 0.
    int resume_after(std::size_t begin);
    void program();

    int statement() {
        return rule(kRuleEnd, [&] { return at(kDefinition) ? definition() : inner_statement(); });
    }

    int inner_statement();

    // What stands between the first word of a statement and its block. False when the statement is given up:
    // in 2008 mode, when it does not fit.
    template <class Body>
    bool header(const Body& body) {
        const std::size_t begin = at_;
        if (body()) return true;
        if (as_2008_ || quiet_) return false;
        resume(begin, true);
        broken_header_ = true;
        return true;
    }

    // Statements until a word that begins none; kMissing when there are none.
    int block(Kinds after);

    // Default mode: whether the innermost block ends here, though not always as it should.
    [[nodiscard]] bool ends_block() const;

    // Default mode: a definition where none may be.
    void inner_definition();

    // A statement that has a block, from its first word on. `body` reads all but that and `done`.
    template <class Body>
    int compound(const Body& body) {
        const std::size_t opened = at_;
        const bool outer_broken = std::exchange(broken_header_, false);
        open_.push_back(opened);
        const int made = body();
        open_.pop_back();
        const bool broken = std::exchange(broken_header_, outer_broken);
        if (failed_ || !close(opened, broken)) return kMissing;
        return made;
    }

    // Its `done`. `broken`: its first line did not fit, and it may be written as there was no done yet; that
    // one is missing is not told then.
    bool close(std::size_t opened, bool broken);

    int definition();
    // The brackets with the parameters.
    bool signature(std::vector<int>& parameters);
    int choice();

    // An opening bracket, expressions with commas between them, a closing bracket. `least` to `most` of them.
    bool expressions(std::size_t begin, std::size_t least, std::size_t most, std::vector<int>& values);

    // A statement of expressions in brackets, and a block.
    int simple(NodeKind kind, std::size_t least, std::size_t most);

    int loop() { return simple(kind() == K::kw_while ? NodeKind::loop_while : NodeKind::repeat, 1, 1); }

    int replacement() {
        return simple(kind() == K::kw_replace ? NodeKind::replace : NodeKind::replace_all, 2, 2);
    }

    int from();
    int for_each();
    int shape();

    static constexpr int kMost = 20;  // mistakes that are told, in default mode

    std::string_view text_;
    bool as_2008_;
    int deepest_;
    Symbols& symbols_;
    Diagnostics& diagnostics_;
    Lexed lexed_;
    std::size_t last_;  // the token `end`
    Parsed result_;
    std::vector<int> heights_;  // of nodes

    std::size_t at_ = 0;
    int depth_ = 0;
    bool failed_ = false;
    bool recovering_ = false;  // nothing fitted since the last complaint
    bool errors_ = false;
    bool quiet_ = false;  // given up
    int told_ = 0;        // mistakes, those that are muted among them
    std::size_t told_at_ = kNowhere;
    std::size_t muted_from_ = kNowhere;  // from this token on nothing is told
    std::size_t recovered_at_ = kNowhere;
    // For the rules being read: what may follow them or a rule around them, and what may follow right here.
    std::vector<Kinds> anywhere_;
    std::vector<Kinds> exact_;

    std::vector<std::size_t> open_;  // first words of the statements whose blocks are being read
    bool broken_header_ = false;     // of the innermost of them
    // The first `done` that stands below another statement than the one it ends, and that one.
    std::pair<std::size_t, std::size_t> misplaced_{kNowhere, kNowhere};
    Diagnostic* old_name_ = nullptr;  // where the first is told
    int old_names_ = 0;
};

}  // namespace popup::flatlang
