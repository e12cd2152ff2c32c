#include "input/drawing/variables.h"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/strong_components.hpp>
#include <utility>
#include <vector>

#include "input/text.h"

namespace popup::drawing {
namespace {

constexpr std::string_view kVar = "var(";

bool is_name_letter(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x80U || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           c == '-' || c == '_';
}

// Where a string that begins at `at` ends: behind its second quote, or where the text does.
std::size_t behind_string(std::string_view text, std::size_t at) {
    const char quote = text[at];
    for (++at; at < text.size() && text[at] != quote; ++at) {
        if (text[at] == '\\') ++at;
    }
    return std::min(at + 1, text.size());
}

// Where the next var( begins that stands for a value, and is no part of a string or of a longer name.
std::size_t find_variable(std::string_view text, std::size_t from) {
    for (std::size_t i = from; i < text.size();) {
        if (text[i] == '"' || text[i] == '\'') {
            i = behind_string(text, i);
        } else if ((i == 0 || !is_name_letter(text[i - 1])) && text.size() - i >= kVar.size() &&
                   lower(text.substr(i, kVar.size())) == kVar) {
            return i;
        } else {
            ++i;
        }
    }
    return std::string_view::npos;
}

// One var(…) of a text.
struct Reference {
    std::string_view name;                     // with "--"
    std::optional<std::string_view> fallback;  // what stands behind the first comma
    std::size_t end = 0;                       // behind its bracket
};

// nullopt where it is none, is not closed, or has brackets nested too deep.
std::optional<Reference> parse_reference(std::string_view text, std::size_t at) {
    const std::size_t begin = at + kVar.size();
    std::size_t comma = std::string_view::npos;
    std::size_t end = begin;
    for (int depth = 1; end < text.size();) {
        const char c = text[end];
        if (c == '"' || c == '\'') {
            end = behind_string(text, end);
            continue;
        }
        if (c == '(' && ++depth > kDeepestFallback) return std::nullopt;
        if (c == ')' && --depth == 0) break;
        if (c == ',' && depth == 1 && comma == std::string_view::npos) comma = end;
        ++end;
    }
    if (end >= text.size()) return std::nullopt;
    Reference found;
    found.end = end + 1;
    found.name = trimmed(text.substr(begin, std::min(comma, end) - begin));
    if (comma < end) found.fallback = trimmed(text.substr(comma + 1, end - comma - 1));
    const bool is_name = found.name.size() > 2 && found.name.starts_with("--") &&
                         std::all_of(found.name.begin(), found.name.end(), is_name_letter);
    return is_name ? std::optional(found) : std::nullopt;
}

using Find = std::function<const std::string*(std::string_view)>;

// Appends a text with its references put in. Goes into fallbacks, which are nested no deeper than
// parse_reference() allows.
bool append(std::string_view text, const Find& find, std::string& out, std::string* missing) {
    for (std::size_t from = 0;;) {
        const std::size_t at = find_variable(text, from);
        const std::string_view plain = text.substr(from, at == std::string_view::npos ? at : at - from);
        if (out.size() + plain.size() > kLongestValue) return false;
        out += plain;
        if (at == std::string_view::npos) return true;
        const std::optional<Reference> one = parse_reference(text, at);
        if (!one) return false;
        if (const std::string* value = find(one->name)) {
            if (out.size() + value->size() > kLongestValue) return false;
            out += *value;
        } else if (!one->fallback) {
            if (missing != nullptr) *missing = one->name;
            return false;
        } else if (!append(*one->fallback, find, out, missing)) {
            return false;
        }
        from = one->end;
    }
}

std::optional<std::string> filled(std::string_view text, const Find& find, std::string* missing) {
    std::string out;
    if (!append(text, find, out, missing)) return std::nullopt;
    return std::string(trimmed(out));
}

// Calls use(name) of all variables that a text names, those in fallbacks too.
template <typename Use>
void each_name(std::string_view text, const Use& use) {
    std::size_t at = find_variable(text, 0);
    while (at != std::string_view::npos) {
        const std::optional<Reference> one = parse_reference(text, at);
        if (one) use(one->name);
        // What is in its fallback comes next.
        at = find_variable(text, at + kVar.size());
    }
}

// The declared ones, in an order in which each follows those that it names; without those that depend on
// themselves.
std::vector<const VariableTexts::value_type*> in_order(const VariableTexts& declared) {
    std::vector<const VariableTexts::value_type*> rows;
    std::map<std::string_view, std::size_t> number;
    for (const auto& row : declared) {
        number.emplace(row.first, rows.size());
        rows.push_back(&row);
    }
    boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS> names(rows.size());
    std::vector<char> names_itself(rows.size(), 0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i]->second.size() > kLongestValue) continue;
        each_name(rows[i]->second, [&](std::string_view name) {
            const auto found = number.find(name);
            if (found == number.end()) return;
            if (found->second == i) names_itself[i] = 1;
            boost::add_edge(i, found->second, names);
        });
    }
    // Components have ascending numbers, each after those that it leads to.
    std::vector<std::size_t> component(rows.size());
    const std::size_t count =
        rows.empty()
            ? 0
            : boost::strong_components(names, boost::make_iterator_property_map(
                                                  component.begin(), boost::get(boost::vertex_index, names)));
    std::vector<std::vector<std::size_t>> members(count);
    for (std::size_t i = 0; i < rows.size(); ++i) members[component[i]].push_back(i);
    std::vector<const VariableTexts::value_type*> ordered;
    for (const std::vector<std::size_t>& one : members) {
        if (one.size() == 1 && names_itself[one.front()] == 0) ordered.push_back(rows[one.front()]);
    }
    return ordered;
}

}  // namespace

bool has_variable(std::string_view text) { return find_variable(text, 0) != std::string_view::npos; }

Variables Variables::within(const VariableTexts& declared) const {
    if (declared.empty()) return *this;
    auto scope = std::make_shared<Scope>();
    scope->around = scope_;
    for (const auto& [name, text] : declared) {
        const std::string word = lower(text);
        // What is declared hides what is inherited, whether it comes to be set or not.
        if (word != "inherit" && word != "unset") scope->values.emplace(name, std::nullopt);
    }
    Variables made;
    made.scope_ = scope;
    for (const auto* row : in_order(declared)) {
        const auto at = scope->values.find(row->first);
        if (at == scope->values.end() || row->second.size() > kLongestValue ||
            lower(row->second) == "initial")
            continue;
        at->second = made.put_into(row->second);
    }
    return made;
}

const std::string* Variables::find(std::string_view name) const {
    for (const Scope* scope = scope_.get(); scope != nullptr; scope = scope->around.get()) {
        const auto found = scope->values.find(name);
        if (found != scope->values.end()) return found->second ? &*found->second : nullptr;
    }
    return nullptr;
}

std::optional<std::string> Variables::put_into(std::string_view text, std::string* missing) const {
    return filled(
        text, [this](std::string_view name) { return find(name); }, missing);
}

}  // namespace popup::drawing
