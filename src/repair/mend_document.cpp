#include "repair/mend_document.h"

#include <utility>

#include "output/xml.h"

namespace popup {
namespace {

constexpr int kMostRounds = 8;

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
        text = patched;
        next = compile({Source{one.source.name, std::move(patched)}}, again, {});
        if (next.has_errors()) break;
        latest = &next.designs.front();
    }
    return std::nullopt;
}

}  // namespace popup
