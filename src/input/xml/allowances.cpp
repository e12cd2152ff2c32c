#include "input/xml/allowances.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/text/nearest.h"
#include "input/text.h"
#include "input/xml/encoding.h"
#include "input/xml/names.h"

namespace popup::xml {
namespace {

constexpr std::string_view kVerb = "allow";
constexpr std::string_view kForm = "write popupc: allow CODE, CODE: and a reason if you like";

class AllowanceReader {
 public:
    AllowanceReader(const Located& located, AllowanceScope scope, Diagnostics& diagnostics)
        : located_(located),
          scope_(scope),
          diagnostics_(diagnostics),
          words_(located.text),
          ends_(located.text) {}

    std::vector<Allowance> run() {
        for (const LocatedComment& comment : located_.comments) {
            if (!read(comment)) break;
        }
        return std::move(for_elements_);
    }

 private:
    // False after an error.
    bool read(const LocatedComment& comment) {
        at_ = comment.begin + located_.text.substr(comment.begin).find(kAddress);
        const Place place = words_.at(at_);
        at_ += kAddress.size();
        end_ = comment.end;
        const std::string_view verb = word();
        if (verb != kVerb) {
            std::string message = verb.empty() ? "this comment is meant for popupc and says nothing"
                                               : fmt::format("popupc knows no comment '{}'", shown(verb));
            diagnostics_.warning("bad-allow", place, std::move(message)).hint(std::string(kForm));
            return true;
        }
        const auto within = scope_ == AllowanceScope::elements ? element_of(comment) : std::nullopt;
        bool any = false;
        bool strange = false;
        for (std::string_view code = word(); !code.empty(); code = word()) {
            any = true;
            const Place here = words_.at(static_cast<std::size_t>(code.data() - located_.text.data()));
            if (!known(code, here, strange)) continue;
            if (++count_ > kAllowancesLimit) {
                diagnostics_.error(
                    "document-too-large", here,
                    fmt::format("comments of the document allow more than {} codes", kAllowancesLimit));
                return false;
            }
            Allowance made{std::string(code), here, within, {}, false};
            if (within) {
                for_elements_.push_back(std::move(made));
            } else {
                diagnostics_.allow(std::move(made));
            }
        }
        if (!any) {
            diagnostics_.warning("bad-allow", place, "this comment allows nothing: it names no code")
                .hint(std::string(kForm));
        }
        return true;
    }

    // The next word of the comment; empty at its end, or at the colon before a reason.
    std::string_view word() {
        while (at_ < end_ && (is_blank(located_.text[at_]) || located_.text[at_] == ',')) ++at_;
        const std::size_t begin = at_;
        while (at_ < end_ && !is_blank(located_.text[at_]) && located_.text[at_] != ',' &&
               located_.text[at_] != ':') {
            ++at_;
        }
        return located_.text.substr(begin, at_ - begin);
    }

    // Whether a comment can allow this. Words that are like no code are told once a comment: they are a
    // reason that its colon is missing for.
    bool known(std::string_view code, Place place, bool& strange) {
        const CodeInfo* row = find_code(code);
        if (row != nullptr && row->severity != Severity::error) return true;
        if (row != nullptr) {
            diagnostics_.warning("bad-allow", place,
                                 fmt::format("'{}' is an error, and errors cannot be allowed", code));
            return false;
        }
        if (strange) return false;
        std::vector<std::string_view> names;
        for (const CodeInfo& one : code_table()) names.push_back(one.code);
        const std::string written = shown(code);
        constexpr std::size_t kShortestSlip = 4;  // of shorter words anything is like something
        std::vector<std::string> near;
        // Looking for what is meant costs more than reading does, and nobody reads that many hints.
        constexpr std::size_t kMostHints = 100;
        if (code.size() >= kShortestSlip && ++unknown_ <= kMostHints)
            near = nearest(lower(written), names, 1);
        strange = near.empty();
        Diagnostic& made = diagnostics_.warning("bad-allow", place,
                                                fmt::format("there is no diagnostic '{}' to allow", written));
        if (near.empty()) {
            made.hint("a reason stands behind a colon: " + std::string("popupc: allow CODE: reason"));
        } else {
            made.hint(fmt::format("perhaps '{}' is meant", near.front()));
        }
        return false;
    }

    // Where the structure is that the comment is for; nullopt: for the document.
    std::optional<std::pair<Place, Place>> element_of(const LocatedComment& comment) {
        const std::vector<LocatedElement>& elements = located_.elements;
        if (comment.around == kNoElement) return std::nullopt;
        if (const auto inside = structure_around(comment.begin)) return extent(*inside);
        // Before one: the next element is a child of the very list that the comment stands in.
        const bool before = is_list(comment.around) && comment.next < elements[comment.around].after &&
                            is_structure(comment.next) && !text_between(comment);
        return before ? std::optional(extent(comment.next)) : std::nullopt;
    }

    // Comments come in order, so that the lists and their children are walked once altogether.
    std::optional<Offset> structure_around(Offset at) {
        const std::vector<LocatedElement>& elements = located_.elements;
        while (list_ < elements[0].after && (!is_list(list_) || elements[list_].end <= at)) {
            list_ = elements[list_].after;
            child_ = list_ + 1;
        }
        if (list_ >= elements[0].after || elements[list_].begin > at) return std::nullopt;
        while (child_ < elements[list_].after && elements[child_].end <= at) child_ = elements[child_].after;
        if (child_ >= elements[list_].after || elements[child_].begin > at) return std::nullopt;
        return is_structure(child_) ? std::optional(child_) : std::nullopt;
    }

    [[nodiscard]] bool is_list(Offset element) const {
        return find_name(Name::popup, located_.name(element)) == Name::structurelist;
    }
    [[nodiscard]] bool is_structure(Offset element) const {
        return find_name(Name::structurelist, located_.name(element)) == Name::structure;
    }
    [[nodiscard]] bool text_between(const LocatedComment& comment) const {
        const auto first =
            std::partition_point(located_.texts.begin(), located_.texts.end(),
                                 [&](const LocatedText& one) { return one.begin < comment.end; });
        return first != located_.texts.end() && first->begin < located_.elements[comment.next].begin;
    }

    std::pair<Place, Place> extent(Offset element) {
        return {located_.elements[element].place, ends_.at(located_.elements[element].end)};
    }

    const Located& located_;
    AllowanceScope scope_;
    Diagnostics& diagnostics_;
    PlaceCounter words_;  // two, because each counts forwards only
    PlaceCounter ends_;
    std::vector<Allowance> for_elements_;
    std::size_t at_ = 0;
    std::size_t end_ = 0;
    std::size_t count_ = 0;    // codes allowed
    std::size_t unknown_ = 0;  // words that may have been meant for codes
    Offset list_ = 1;
    Offset child_ = 2;
};

}  // namespace

std::vector<Allowance> read_allowances(const Located& located, AllowanceScope scope,
                                       Diagnostics& diagnostics) {
    if (located.comments.empty()) return {};
    return AllowanceReader(located, scope, diagnostics).run();
}

void allow_for_elements(std::vector<Allowance> allowances, const std::vector<Structure>& structures,
                        Diagnostics& diagnostics) {
    const auto key = [](Place at) { return std::pair(at.line, at.column); };
    for (Allowance& one : allowances) {
        // Structures stand in the order of the document.
        const auto at = std::partition_point(
            structures.begin(), structures.end(),
            [&](const Structure& made) { return key(made.place) < key(one.within->first); });
        if (at != structures.end() && at->place == one.within->first) one.element = at->id;
        diagnostics.allow(std::move(one));
    }
}

}  // namespace popup::xml
