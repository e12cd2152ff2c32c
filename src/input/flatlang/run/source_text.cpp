#include "input/flatlang/run/source_text.h"

#include <array>
#include <utility>
#include <vector>

namespace popup::flatlang {
namespace {

std::string_view sign(NodeKind kind) {
    switch (kind) {
        case NodeKind::add:
            return "+";
        case NodeKind::subtract:
            return "-";
        case NodeKind::multiply:
            return "*";
        case NodeKind::divide:
            return "/";
        case NodeKind::remainder:
            return "%";
        case NodeKind::less:
            return "<";
        case NodeKind::less_equal:
            return "<=";
        case NodeKind::greater:
            return ">";
        case NodeKind::greater_equal:
            return ">=";
        case NodeKind::equal:
            return "==";
        case NodeKind::unequal:
            return "!=";
        case NodeKind::both:
            return "and";
        case NodeKind::either:
            return "or";
        case NodeKind::assign:
            return "=";
        default:
            return {};
    }
}

bool is_arithmetic(NodeKind kind) {
    return kind == NodeKind::add || kind == NodeKind::subtract || kind == NodeKind::multiply ||
           kind == NodeKind::divide || kind == NodeKind::remainder;
}

// What the statement that cannot be quoted begins with.
std::string_view word(NodeKind kind) {
    switch (kind) {
        case NodeKind::choose:
            return "if";
        case NodeKind::loop_while:
            return "while";
        case NodeKind::for_each:
            return "for each";
        case NodeKind::shape:
            return "shape";
        case NodeKind::from:
            return "from";
        case NodeKind::replace:
            return "replace";
        case NodeKind::replace_all:
            return "replaceAll";
        case NodeKind::define:
            return "fundef";
        case NodeKind::index:
            return "index";
        default:
            return "literal";
    }
}

class Quoting {
 public:
    Quoting(const Syntax& syntax, Heap& heap, const Symbols& symbols)
        : syntax_(syntax), heap_(heap), symbols_(symbols) {}

    Value list_of(std::vector<Value> elements) {
        Value list = heap_.list({});
        Value* end = &list->first;
        for (Value& element : elements) {
            *end = std::move(element);
            end = &(*end)->next;
        }
        return list;
    }

    Value text(std::string_view words) { return heap_.text(std::string(words)); }

    Value children(const Node& at, std::string_view separator) {
        std::vector<Value> elements;
        for (const int child : at.children) {
            if (!separator.empty() && !elements.empty()) elements.push_back(text(separator));
            elements.push_back(quote(child));
        }
        return list_of(std::move(elements));
    }

    Value quote(int index) {
        if (index == kMissing) return text("{{broken}}");
        const Node& at = syntax_.nodes[static_cast<std::size_t>(index)];
        switch (at.kind) {
            case NodeKind::number:
                return text(at.text);
            case NodeKind::text:
                return text("\"" + at.text + "\"");
            case NodeKind::truth:
                return text(at.number != 0.0 ? "true" : "false");
            case NodeKind::name:
                return text(symbols_.name(at.symbol));
            case NodeKind::call:
                return list_of({text(symbols_.name(at.symbol)), text("("), children(at, ","), text(")")});
            case NodeKind::expression:
            case NodeKind::plus:
                return quote(at.children.empty() ? kMissing : at.children.front());
            case NodeKind::block:
                return children(at, {});
            case NodeKind::repeat:
                return list_of({text("repeat"), text("("), quote(at.children[0]), text(")"),
                                quote(at.children.size() > 1 ? at.children[1] : kMissing), text("done")});
            case NodeKind::negate:
                return list_of({text("-"), quote(at.children.front())});
            case NodeKind::list: {
                std::vector<Value> elements{text("[")};
                for (const int child : at.children) {
                    if (elements.size() > 1) elements.push_back(text(", "));
                    elements.push_back(quote(child));
                }
                elements.push_back(text("]"));
                return list_of(std::move(elements));
            }
            case NodeKind::member:
                return list_of({quote(at.children[0]), text("."), quote(at.children[1])});
            default:
                break;
        }
        if (const std::string_view between = sign(at.kind); !between.empty()) {
            return list_of({text("("), quote(at.children[0]), text(" " + std::string(between) + " "),
                            quote(at.children[1]), text(")")});
        }
        return list_of({text(word(at.kind)), text("{{broken}}")});
    }

 private:
    const Syntax& syntax_;
    Heap& heap_;
    const Symbols& symbols_;
};

class Printing {
 public:
    Printing(const Syntax& syntax, const Symbols& symbols) : syntax_(syntax), symbols_(symbols) {}

    void block(int index, int level) {
        if (index == kMissing) return;
        for (const int statement : node(index).children) {
            if (statement != kMissing) this->statement(statement, level);
        }
    }

    std::string out;

    void line(int level, std::string_view text) {
        out += std::string(2 * static_cast<std::size_t>(level), ' ');
        out += text;
        out += '\n';
    }

 private:
    [[nodiscard]] const Node& node(int index) const { return syntax_.nodes[static_cast<std::size_t>(index)]; }

    [[nodiscard]] std::string joined(const std::vector<int>& children, std::size_t from,
                                     std::size_t to) const {
        std::string text;
        for (std::size_t i = from; i < to; ++i) text += (i > from ? ", " : "") + expression(children[i]);
        return text;
    }

    [[nodiscard]] std::string expression(int index) const {
        if (index == kMissing) return {};
        const Node& at = node(index);
        switch (at.kind) {
            case NodeKind::number:
                return at.text;
            case NodeKind::text:
                return "\"" + at.text + "\"";
            case NodeKind::truth:
                return at.number != 0.0 ? "true" : "false";
            case NodeKind::infinity:
                return "infinity";
            case NodeKind::object:
                return "__object__";
            case NodeKind::name:
                return symbols_.name(at.symbol);
            case NodeKind::call:
                return symbols_.name(at.symbol) + "(" + joined(at.children, 0, at.children.size()) + ")";
            case NodeKind::index: {
                std::string text = expression(at.children.front());
                for (std::size_t i = 1; i < at.children.size(); ++i) {
                    text += "[" + expression(at.children[i]) + "]";
                }
                return text;
            }
            case NodeKind::list:
                return "[" + joined(at.children, 0, at.children.size()) + "]";
            case NodeKind::member:
                return expression(at.children[0]) + "." + expression(at.children[1]);
            case NodeKind::negate:
                return "-" + expression(at.children.front());
            case NodeKind::plus:
            case NodeKind::expression:
                return expression(at.children.empty() ? kMissing : at.children.front());
            default:
                break;
        }
        const std::string between(sign(at.kind));
        if (between.empty()) return {};
        const std::string a = expression(at.children[0]);
        const std::string b = expression(at.children[1]);
        return is_arithmetic(at.kind) ? "(" + a + between + b + ")" : a + " " + between + " " + b;
    }

    void statement(int index, int level) {
        const Node& at = node(index);
        const auto body = [&](std::string_view head, int block_index) {
            line(level, head);
            block(block_index, level + 1);
            line(level, "done");
        };
        const int last = at.children.empty() ? kMissing : at.children.back();
        switch (at.kind) {
            case NodeKind::choose: {
                for (std::size_t i = 0; i + 1 < at.children.size(); i += 2) {
                    line(level, (i == 0 ? "if (" : "alt (") + expression(at.children[i]) + ")");
                    block(at.children[i + 1], level + 1);
                }
                if (at.has_else) {
                    line(level, "else ");
                    block(last, level + 1);
                }
                return line(level, "done");
            }
            case NodeKind::loop_while:
                return body("while(" + expression(at.children[0]) + ")", last);
            case NodeKind::repeat:
                return body("repeat(" + expression(at.children[0]) + ")", last);
            case NodeKind::for_each:
                return body("for each (" + symbols_.name(at.symbol) + " : " + expression(at.children[0]) +
                                ")" +
                                (at.children[1] == kMissing ? "" : " (" + expression(at.children[1]) + ")"),
                            last);
            case NodeKind::shape:
                return body("shape(" + expression(at.children[0]) + ")", last);
            case NodeKind::from:
                return body("from(" + joined(at.children, 0, at.children.size() - 1) + ")", last);
            case NodeKind::replace:
            case NodeKind::replace_all:
                return body(std::string(word(at.kind)) + "(" + joined(at.children, 0, 2) + ")", last);
            default:
                return line(level, expression(index));
        }
    }

    const Syntax& syntax_;
    const Symbols& symbols_;
};

std::string parameters(const Node& definition, const Symbols& symbols) {
    std::string text;
    for (const int symbol : definition.parameters) text += (text.empty() ? "" : ", ") + symbols.name(symbol);
    return text;
}

}  // namespace

Value source_list(const FunctionBody& function, Heap& heap, const Symbols& symbols) {
    const Node& definition = function.syntax->nodes[static_cast<std::size_t>(function.node)];
    Quoting quoting(*function.syntax, heap, symbols);
    std::vector<Value> names{quoting.text("(")};
    for (const int symbol : definition.parameters) {
        if (names.size() > 1) names.push_back(quoting.text(", "));
        names.push_back(quoting.text(symbols.name(symbol)));
    }
    names.push_back(quoting.text(")"));
    const int block = definition.children.empty() ? kMissing : definition.children.front();
    return quoting.list_of({quoting.text("define"), quoting.text(symbols.name(definition.symbol)),
                            quoting.list_of(std::move(names)),
                            block == kMissing ? heap.list({}) : quoting.quote(block), quoting.text("done")});
}

std::string words_of(const Value& list, const Symbols& symbols, std::size_t most) {
    std::string text;
    std::vector<Value> after{list->first};
    bool first = true;
    while (!after.empty() && text.size() < most) {
        Value at = std::move(after.back());
        after.pop_back();
        if (!at) continue;
        after.push_back(at->next);
        if (at->type == Type::list) {
            after.push_back(at->first);
            continue;
        }
        if (!std::exchange(first, false)) text += ' ';
        text += to_text(at, symbols, most);
    }
    return text;
}

std::string pretty(const FunctionBody& function, const Symbols& symbols) {
    const Node& definition = function.syntax->nodes[static_cast<std::size_t>(function.node)];
    Printing printing(*function.syntax, symbols);
    printing.line(0,
                  "define " + symbols.name(definition.symbol) + "(" + parameters(definition, symbols) + ")");
    if (!definition.children.empty()) printing.block(definition.children.front(), 1);
    printing.line(0, "done");
    return std::move(printing.out);
}

}  // namespace popup::flatlang
