#include <fmt/format.h>

#include <algorithm>

#include "input/flatlang/syntax/parser.h"

namespace popup::flatlang {

int Parser::resume_after(std::size_t begin) {
    // A statement with a block has looked after its brackets itself.
    const bool whole = (one(token(begin).kind) & (kCompound | kDefinition)) != 0;
    resume(whole ? at_ : begin, false);
    return word(token(begin)) == "for" ? 1 : 0;
}

void Parser::program() {
    std::vector<int> statements;
    int lost = 0;
    while (kind() != K::end) {
        const std::size_t begin = at_;
        if (at(kStatement)) {
            const int made = rule(kStatement | kRuleEnd, [&] { return statement(); });
            if (made != kMissing) statements.push_back(made);
            if (failed_) lost += resume_after(begin);
        } else if (kind() == K::kw_done && lost > 0) {
            --lost;
            skip();
        } else if (as_2008_) {
            tell(at_, {here().place,
                       fmt::format("{} begins no statement, and the program ends here", found(text_, here())),
                       {},
                       {}});
            break;
        } else {
            stray();
        }
    }
    result_.syntax.root = make(NodeKind::block, {1, 1}, std::move(statements));
}

int Parser::inner_statement() {
    return rule(kRuleEnd, [&] {
        const Place place = here().place;
        switch (kind()) {
            case K::kw_if:
                return choice();
            case K::kw_while:
            case K::kw_repeat:
                return loop();
            case K::kw_for_each:
                return for_each();
            case K::kw_shape:
                return shape();
            case K::kw_from:
                return from();
            case K::kw_replace:
            case K::kw_replace_all:
                return replacement();
            default:
                break;
        }
        const int value = expression(kRuleEnd);
        return failed_ ? kMissing : make(NodeKind::expression, place, {value});
    });
}

int Parser::block(Kinds after) {
    if (!at(kInner) && as_2008_) return kMissing;
    return rule(after, [&] {
        const Place place = here().place;
        std::vector<int> statements;
        int lost = 0;
        if (!enter()) return kMissing;
        while (kind() != K::end) {
            const std::size_t begin = at_;
            if (at(kInner)) {
                const int made = rule(kInner | kRuleEnd, [&] { return inner_statement(); });
                if (made != kMissing) statements.push_back(made);
                if (failed_) lost += resume_after(begin);
            } else if (kind() == K::kw_done && lost > 0) {
                --lost;
                skip();
            } else if (as_2008_ || ends_block()) {
                break;
            } else if (at(kDefinition)) {
                inner_definition();
            } else {
                stray();
            }
        }
        leave();
        return statements.empty() ? kMissing : make(NodeKind::block, place, std::move(statements));
    });
}

bool Parser::ends_block() const {
    const Token& opening = token(open_.back());
    if (kind() == K::kw_done) return true;
    if (at(kBlockEnd)) return opening.kind == K::kw_if;
    // Not deeper than what it would be in: a done is missing before it.
    return at(kDefinition) && here().place.column <= opening.place.column;
}

void Parser::inner_definition() {
    const Token& around = token(open_.back());
    tell(at_, {here().place,
               "functions are defined outside of all blocks",
               {fmt::format("move it before the {} at {}, or end that with 'done' first",
                            found(text_, around), shown(around.place))},
               {{around.place, std::string(word(around))}}});
    const std::size_t begin = at_;
    definition();
    if (failed_) resume_after(begin);
}

bool Parser::close(std::size_t opened, bool broken) {
    if (as_2008_) return expect(K::kw_done, kRuleEnd, {"to end", opened});
    const Token& opening = token(opened);
    const Token& closing = here();
    if (closing.kind == K::kw_done) {
        if (misplaced_.first == kNowhere && begins_line(at_) && begins_line(opened) &&
            opening.place.column != closing.place.column && !open_.empty() &&
            token(open_.back()).place.column == closing.place.column) {
            misplaced_ = {at_, opened};
        }
        take();
        return true;
    }
    failed_ = true;
    if (std::exchange(recovering_, true) || told_at_ == at_) return false;
    told_at_ = at_;
    errors_ = true;
    // Who wrote it otherwise than with done has been told so.
    if (broken) return false;
    Complaint complaint{
        opening.place,
        fmt::format("this {} has no 'done' before {}", found(text_, opening), found(text_, closing)),
        {},
        {}};
    if (closing.kind != K::end) complaint.related.push_back({closing.place, std::string(word(closing))});
    if (misplaced_.first != kNowhere && misplaced_.first > opened) {
        const Token& inner = token(misplaced_.second);
        complaint.hints.push_back(
            fmt::format("the 'done' at {} ends the {} at {}, but stands below what is around that; one "
                        "may be missing before it",
                        shown(token(misplaced_.first).place), found(text_, inner), shown(inner.place)));
    }
    tell(at_, std::move(complaint));
    return false;
}

int Parser::definition() {
    const Place place = here().place;
    const bool safe = kind() == K::kw_safe;
    Token name;
    std::vector<int> parameters;
    const int body = compound([&] {
        const bool fits = header([&] {
            if (take_if(K::kw_safe) && !expect(K::kw_define, one(K::name), {"after 'safe'"})) return false;
            if (!safe) take();
            name = here();
            if (!as_2008_ && name.kind != K::name && token(at_ + 1).kind == K::open) {
                // What else stands there was meant to be the name.
                complain(at_, wanted(K::name), {"for the function"});
                take();
                return signature(parameters);
            }
            return expect(K::name, one(K::open), {"for the function"}) && signature(parameters);
        });
        return fits ? block(one(K::kw_done)) : kMissing;
    });
    if (failed_) return kMissing;
    const int made = make(NodeKind::define, place, {body});
    node(made).safe = safe;
    node(made).symbol = symbol(name);
    node(made).parameters = std::move(parameters);
    return made;
}

bool Parser::signature(std::vector<int>& parameters) {
    const std::size_t name = at_ - 1;
    if (!expect(K::open, kinds(K::name, K::close), {"before the parameters of", name})) return false;
    if (pass_old_name() || kind() == K::name) {
        do {
            pass_old_name();
            parameters.push_back(symbol(here()));
            if (!expect(K::name, kinds(K::comma, K::close), {"for a parameter of", name})) return false;
        } while (take_if(K::comma));
    }
    return expect(K::close, kInner | one(K::kw_done), {"to close the parameters of", name});
}

int Parser::choice() {
    const Place place = here().place;
    std::vector<int> parts;
    bool has_else = false;
    const auto part = [&](Kinds after) {
        rule(after, [&] {
            const std::size_t begin = at_;
            const bool otherwise = kind() == K::kw_else;
            take();
            if (!otherwise && !header([&] {
                    parts.push_back(rule(kInner | kRuleEnd, [&] {
                        if (!expect(K::open, kExpression, {"after", begin})) return kMissing;
                        return bracket(begin, kRuleEnd);
                    }));
                    return !failed_;
                })) {
                return kMissing;
            }
            parts.push_back(block(kRuleEnd));
            return kMissing;
        });
    };
    compound([&] {
        part(kBlockEnd);
        while (!failed_ && kind() == K::kw_alt) part(kBlockEnd);
        if (!failed_ && kind() == K::kw_else) {
            has_else = true;
            part(one(K::kw_done));
        }
        while (!failed_ && !as_2008_ && at(kinds(K::kw_alt, K::kw_else))) {
            tell(at_, {here().place,
                       fmt::format("{} stands after the 'else' of this 'if'", found(text_, here())),
                       {},
                       {{place, "if"}}});
            part(kBlockEnd);
        }
        return kMissing;
    });
    if (failed_) return kMissing;
    const int made = make(NodeKind::choose, place, std::move(parts));
    node(made).has_else = has_else;
    return made;
}

bool Parser::expressions(std::size_t begin, std::size_t least, std::size_t most, std::vector<int>& values) {
    if (!expect(K::open, kExpression, {"after", begin})) return false;
    for (std::size_t count = 1;; ++count) {
        const Kinds behind = count < least  ? one(K::comma)
                             : count < most ? kinds(K::comma, K::close)
                                            : one(K::close);
        values.push_back(expression(behind));
        if (failed_) return false;
        if (count < least) {
            if (!expect(K::comma, kExpression, {"between the values of", begin})) return false;
        } else if (count == most || !take_if(K::comma)) {
            break;
        }
    }
    return expect(K::close, kInner | one(K::kw_done), {"to close the bracket after", begin});
}

int Parser::simple(NodeKind kind, std::size_t least, std::size_t most) {
    const std::size_t begin = at_;
    std::vector<int> parts;
    compound([&] {
        take();
        if (!header([&] { return expressions(begin, least, most, parts); })) return kMissing;
        parts.push_back(block(one(K::kw_done)));
        return kMissing;
    });
    return failed_ ? kMissing : make(kind, token(begin).place, std::move(parts));
}

int Parser::from() {
    const int made = simple(NodeKind::from, 1, kNowhere);
    if (made == kMissing) return kMissing;
    // Marks that could not be read are left out.
    std::vector<int>& parts = node(made).children;
    if (!parts.empty()) parts.erase(std::remove(parts.begin(), parts.end() - 1, kMissing), parts.end() - 1);
    return made;
}

int Parser::for_each() {
    const std::size_t begin = at_;
    Token name;
    int list = kMissing;
    int filter = kMissing;
    const int body = compound([&] {
        take();
        const bool fits = header([&] {
            // What is wrong with its first word is told already; what is missing after that follows from it.
            if (!as_2008_ && kind() != K::open && word(token(begin)) != to_string(K::kw_for_each)) {
                failed_ = true;
                return false;
            }
            if (!expect(K::open, one(K::name), {"after", begin})) return false;
            name = here();
            if (!expect(K::name, one(K::colon), {"for the element"})) return false;
            if (!expect(K::colon, kExpression, {"between the element and the list of", begin})) return false;
            list = expression(one(K::close));
            const Kinds behind = kInner | one(K::kw_done);
            if (failed_ || !expect(K::close, behind, {"to close the bracket after", begin})) return false;
            if (!take_if(K::open)) return true;
            filter = expression(one(K::close));
            return !failed_ && expect(K::close, behind, {"to close the condition of", begin});
        });
        return fits ? block(one(K::kw_done)) : kMissing;
    });
    if (failed_) return kMissing;
    const int made = make(NodeKind::for_each, token(begin).place, {list, filter, body});
    node(made).symbol = symbol(name);
    return made;
}

int Parser::shape() {
    const std::size_t begin = at_;
    Token title = here();
    const int body = compound([&] {
        take();
        const bool fits = header([&] {
            if (!expect(K::open, one(K::text), {"after", begin})) return false;
            title = here();
            return expect(K::text, one(K::close), {"for the name of", begin}) &&
                   expect(K::close, kInner | one(K::kw_done), {"to close the bracket after", begin});
        });
        return fits ? block(one(K::kw_done)) : kMissing;
    });
    if (failed_) return kMissing;
    const int name = text_node(title);
    return make(NodeKind::shape, token(begin).place, {name, body});
}

}  // namespace popup::flatlang
