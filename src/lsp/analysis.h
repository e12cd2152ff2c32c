// All that is known of one state of a document, as a value.
//
//     const Analysis analysis = analyse({"/home/a/card.xml", text}, options, Depth::whole);
//     for (const Finding& finding : analysis.findings) ...
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lsp/text.h"
#include "mechanism/footings.h"
#include "popup/compile.h"

namespace popup::lsp {

// How far a document is looked at. Reading and checking take milliseconds; what examines the motion may take
// seconds.
enum class Depth { check, whole };

// A change that a finding, or the whole document, may be mended by.
struct Fix {
    std::string title;
    std::vector<TextEdit> edits;  // never empty
};

struct FindingPlace {
    Span at;
    std::string text;
};

// A diagnostic, with what an editor shows of it.
struct Finding {
    Diagnostic diagnostic;
    Span at;  // what is underlined: a word, a start tag, or the first line
    std::vector<FindingPlace> related;
    std::vector<Fix> fixes;  // of this finding alone, the best first
    bool late = false;       // as mark_late() found
};

// The folds of a card by their names, found when somebody asks for them, and once. For one thread.
class CardOnce {
 public:
    // Of always the same design. Cost: that of check(), the first time.
    const CardFolds& of(const Design& design) {
        if (!card_) card_ = folds_of_card(design);
        return *card_;
    }

 private:
    std::optional<CardFolds> card_;
};

// What a check has left for whoever looks at the motion of the same text: what is done once.
struct Checked {
    CompiledDesign design;
    Footings standing;
    std::shared_ptr<const Text> text;
    std::shared_ptr<CardOnce> card;
};
using Stages = std::shared_ptr<const Checked>;

struct Analysis {
    std::shared_ptr<const Text> text;  // that was looked at
    Depth depth = Depth::check;
    std::vector<Finding> findings;  // worst first, then by place
    Footings standing;              // of the design of a document
    std::optional<Design> design;   // as it was read, where it could be
    std::shared_ptr<CardOnce> card =
        std::make_shared<CardOnce>();  // of the design; the whole has its check's
    // Others that were read or looked for in vain, each once by its whole_path(), and its real_path().
    struct File {
        std::string path, real;
    };
    std::vector<File> files;
    bool may_load_more = false;  // a program that ended with an error before it was done
    Stages stages;               // of a check of a document that has no errors
    // How much of the motion was examined; nullopt: nothing was, or without a memory.
    std::optional<ExaminationMemory::Share> examined;
};

struct AnalysisOptions {
    CompileOptions compile;  // its stage and its progress are not looked at
    DiagnosticPolicy policy;
    const Language* language = nullptr;  // never null
};

// Never throws for bad input. `stages`: of a check of this very text with these options, with which the whole
// goes on; null: it begins at the beginning. Cost: that of compile(), up to `depth`; where the options have a
// memory of the motion, that of what has changed.
Analysis analyse(const Source& source, const AnalysisOptions& options, Depth depth,
                 const Stages& stages = nullptr);

// All repairs of a document, until nothing is left to repair, as one fix; nullopt: there are none, or it has
// errors.
std::optional<Fix> all_repairs(const Source& source, const AnalysisOptions& options);

// Marks the findings of the whole that the check alone did not have: those of the motion, and what comes
// after it.
void mark_late(Analysis& whole, const Analysis& checked);

// Adds the late findings of `before`, placed where their elements are now: shown until a new examination has
// ended. Those whose elements are gone are left out.
void carry_over(const Analysis& before, Analysis& now);

// What a finding at that byte underlines: the word, name or start tag that begins there.
Span underlined(const Text& text, std::size_t at);

}  // namespace popup::lsp
