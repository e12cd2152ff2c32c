#include <fmt/format.h>

#include "input/flatlang/syntax/parser.h"

namespace popup::flatlang {

int Parser::make(NodeKind kind, Place place, std::vector<int> children) {
    int height = 1;
    for (const int child : children) {
        if (child != kMissing) height = std::max(height, heights_[static_cast<std::size_t>(child)] + 1);
    }
    if (height > kTreeLevels * deepest_) {
        too_deep(here().place,
                 fmt::format("more than {} operations hang on one another here", kTreeLevels * deepest_));
        children.clear();
        height = 1;
    }
    Node node;
    node.kind = kind;
    node.place = place;
    node.children = std::move(children);
    result_.syntax.nodes.push_back(std::move(node));
    heights_.push_back(height);
    return static_cast<int>(result_.syntax.nodes.size()) - 1;
}

int Parser::text_node(const Token& token) {
    const int made = make(NodeKind::text, token.place);
    if (token.kind == K::text) node(made).text = text_.substr(token.begin + 1, token.end - token.begin - 2);
    return made;
}

Diagnostic* Parser::tell(std::size_t cause, Complaint complaint) {
    errors_ = true;
    if (quiet_) return nullptr;
    // Each costs a look ahead, told or not.
    const bool enough = !as_2008_ && ++told_ >= kMost;
    if (cause >= muted_from_) {
        if (enough) give_up();
        return nullptr;
    }
    const Severity severity = as_2008_ ? Severity::warning : Severity::error;
    Diagnostic& told =
        diagnostics_.add(severity, "flatlang-syntax", complaint.place, std::move(complaint.message));
    told.hints = std::move(complaint.hints);
    told.related = std::move(complaint.related);
    if (enough) give_up();
    return &told;
}

void Parser::give_up() {
    errors_ = true;
    quiet_ = true;
    failed_ = true;
    at_ = last_;
}

void Parser::too_deep(Place place, std::string message) {
    if (!quiet_) {
        diagnostics_.error("flatlang-too-deep", place, std::move(message))
            .hint("give a part of it a name, or make it a function, and go on with that");
    }
    give_up();
}

void Parser::lexical_errors() {
    for (const LexicalError& error : lexed_.errors) {
        tell(0, lexical_complaint(text_, lexed_, error));
        if (error.fault == LexicalFault::unfinished && !as_2008_) {
            // What quotation marks enclose is the wrong half of the text from there on.
            muted_from_ = std::min(first_text_over_lines(text_, lexed_.tokens), last_);
        }
    }
}

void Parser::complain(std::size_t index, const std::string& wanted, const Why& why) {
    if (std::exchange(recovering_, true) || index == told_at_) return;
    told_at_ = index;
    std::string message = fmt::format("expected {}", wanted);
    if (!why.purpose.empty()) message += fmt::format(" {}", why.purpose);
    if (why.about != kNowhere) message += fmt::format(" {}", found(text_, token(why.about)));
    const Token& wrong = token(index);
    message += fmt::format(", but found {}", found(text_, wrong));
    Complaint complaint{
        wrong.place, std::move(message), hints_at(text_, lexed_.tokens, std::min(index, last_)), {}};
    if (why.about != kNowhere && token(why.about).place.line != wrong.place.line) {
        complaint.related.push_back({token(why.about).place, std::string(word(token(why.about)))});
    }
    tell(index, std::move(complaint));
}

void Parser::fail(std::size_t index, const std::string& wanted, const Why& why) {
    complain(index, wanted, why);
    failed_ = true;
}

bool Parser::pass_old_name() {
    if (as_2008_ || kind() != K::colon || token(at_ + 1).kind != K::name) return false;
    if (++old_names_ == 1) {
        old_name_ = tell(at_, {here().place,
                               fmt::format("a ':' stands before the name {}", found(text_, token(at_ + 1))),
                               {"names of parameters are written without a mark"},
                               {}});
        if (old_name_ == nullptr) old_names_ = 0;
    }
    errors_ = true;
    skip();
    return true;
}

bool Parser::expect(K kind_wanted, Kinds after, const Why& why) {
    if (take_if(kind_wanted)) return true;
    if (as_2008_) {
        if (token(at_ + 1).kind == kind_wanted) {
            complain(at_, wanted(kind_wanted), why);
            skip();
            skip();
            return true;
        }
        if ((after & kRuleEnd) != 0 && !exact_.empty()) after |= exact_.back();
        if (at(after)) {
            complain(at_, wanted(kind_wanted), why);
            return true;
        }
    }
    fail(at_, wanted(kind_wanted), why);
    return false;
}

void Parser::resume(std::size_t begin, bool header) {
    failed_ = quiet_;
    recovering_ = false;
    constexpr Kinds kSure = kCompound | kDefinition | kBlockEnd;
    int open = 0;
    for (std::size_t i = begin; i < at_; ++i) open += opens(token(i)) - closes(token(i));
    const std::size_t wrong = at_;
    while (open > 0 && kind() != K::end && !at(kSure)) {
        open += opens(here()) - closes(here());
        skip();
        if (open == 0) return;
    }
    at_ = wrong;
    while (kind() != K::end && !at(kSure)) {
        if (begins_line(at_) && (header || kind() == K::name)) return;
        skip();
    }
}

void Parser::stray() {
    if (pass_old_name()) return;
    const Token& wrong = here();
    Complaint complaint{wrong.place, {}, hints_at(text_, lexed_.tokens, at_), {}};
    if (wrong.kind == K::kw_done || closes(wrong) > 0) {
        complaint.message = fmt::format("this {} closes nothing", found(text_, wrong));
    } else if (at(kBlockEnd)) {
        complaint.message = fmt::format("this {} belongs to no 'if'", found(text_, wrong));
    } else {
        complaint.message = fmt::format("{} begins no statement", found(text_, wrong));
    }
    const bool block_end = at(kBlockEnd);
    const std::size_t begin = at_;
    if (told_at_ != at_) tell(at_, std::move(complaint));
    skip();
    if (!block_end) resume(begin, false);
}

bool Parser::enter() {
    if (++depth_ <= deepest_) return true;
    too_deep(here().place,
             fmt::format("brackets or blocks stand more than {} deep in each other here", deepest_));
    return false;
}

}  // namespace popup::flatlang
