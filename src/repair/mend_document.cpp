#include "repair/mend_document.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "output/xml.h"
#include "repair/short_numbers.h"

namespace popup {
namespace {

constexpr int kMostRounds = 8;

// The document with its repairs, their numbers as short as they may be for nothing to be repaired again: an
// element that is gets one decimal more, until it has as many as documents have.
std::optional<Compilation> with_short_numbers(const CompiledDesign& one, const Language& language,
                                              const CompileOptions& options) {
    DecimalsOf decimals;
    const int few = short_decimals(one.checked->design().unit);
    for (int tried = few; tried < kMostDecimals; ++tried) {
        Design design = one.checked->design();
        shorten_numbers(design, one.source.text, decimals);
        Compilation made =
            compile({Source{one.source.name, language.patch(one.source, design)}}, options, {});
        const std::vector<Diagnostic> repairs = made.designs.front().diagnostics.repairs();
        if (!made.has_errors() && repairs.empty()) return made;
        for (const Diagnostic& repair : repairs) {
            if (repair.element.empty()) return std::nullopt;
            int& own = decimals.try_emplace(repair.element, few).first->second;
            own = std::max(own, tried + 1);
        }
        if (made.has_errors()) return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace

std::optional<std::string> mended_document(const CompiledDesign& one, const Language& language,
                                           const CompileOptions& options) {
    std::string text = one.source.text;
    const Language* back = &language;
    const bool drawn = language.drawn;
    if (drawn) back = find_language({}, "xml");
    CompileOptions again = options;
    again.read.language = back->name;
    again.until = Stage::motion;
    again.motion.examine = false;  // it repairs nothing, and what it finds has been told
    again.threads = 1;
    again.progress = {};
    const CompiledDesign* latest = &one;
    Compilation next;
    if (drawn) {
        text = write_document(one.checked->design());
        next = compile({Source{one.source.name, text}}, again, {});
        latest = &next.designs.front();
    }
    for (int round = 0; round < kMostRounds && !next.has_errors(); ++round) {
        std::string patched = back->patch(latest->source, latest->checked->design());
        if (patched == text) return text;
        Compilation whole = compile({Source{one.source.name, std::move(patched)}}, again, {});
        // Numbers are rounded where that is all: what is rounded while more is to be repaired may not settle.
        const bool settled = !whole.has_errors() && whole.designs.front().diagnostics.repairs().empty();
        std::optional<Compilation> shorter;
        if (settled) shorter = with_short_numbers(*latest, *back, again);
        next = shorter ? std::move(*shorter) : std::move(whole);
        text = next.designs.front().source.text;
        if (next.has_errors()) break;
        latest = &next.designs.front();
    }
    return std::nullopt;
}

}  // namespace popup
