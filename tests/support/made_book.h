// Books of samples, for tests of what they say.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "output/book/book.h"
#include "popup/compile.h"
#include "popup/write.h"
#include "support/designs.h"

namespace popup::test {

inline Source sample_source(const std::string& name) {
    Diagnostics diagnostics("samples");
    std::optional<Source> source =
        read_source(std::string(POPUP_SOURCE_DIR) + "/samples/" + name, diagnostics);
    POPUP_INVARIANT(source.has_value());
    return std::move(*source);
}

inline Compilation compiled(std::vector<Source> sources, CompileOptions options = {}) {
    options.read.drawing.as = DrawnAs::folded;
    fit_layout(options);
    return compile(std::move(sources), options, {});
}

// What a writer of pages is given.
struct MadeBook {
    explicit MadeBook(const std::vector<std::string>& samples, const CompileOptions& options = {}) {
        std::vector<Source> sources;
        for (const std::string& name : samples) sources.push_back(sample_source(name));
        make(std::move(sources), options);
    }
    void make(std::vector<Source> sources, const CompileOptions& options) {
        run = compiled(std::move(sources), options);
        for (const CompiledDesign& one : run.designs) {
            EXPECT_TRUE(one.pattern) << findings(one.diagnostics);
            cards.push_back(
                {&*one.assembly, one.motion ? &*one.motion : nullptr, "", nullptr, &*one.pattern});
        }
        POPUP_INVARIANT(run.layout.has_value());
    }
    MadeBook() = default;
    [[nodiscard]] RunPage page() const { return {cards, &*run.layout, {}, false}; }
    [[nodiscard]] book::Book made() const { return book::make_book(page(), {}); }

    Compilation run;
    std::vector<SceneCard> cards;
};

inline std::string need(const book::Book& book, const std::string& name) {
    for (const auto& [what, value] : book.needs) {
        if (what == name) return value;
    }
    return {};
}

inline std::vector<std::string> titles(const book::Book& book) {
    std::vector<std::string> all;
    for (const book::CardPart& card : book.cards) {
        for (const book::Chapter& chapter : card.chapters) {
            all.push_back(chapter.title);
            for (const book::Step& step : chapter.steps) all.push_back("  " + step.title);
        }
    }
    return all;
}

inline const book::Step& step_named(const book::Book& book, const std::string& title) {
    for (const book::CardPart& card : book.cards) {
        for (const book::Chapter& chapter : card.chapters) {
            for (const book::Step& step : chapter.steps) {
                if (step.title == title) return step;
            }
        }
    }
    ADD_FAILURE() << title;
    static const book::Step kNone;
    return kNone;
}

}  // namespace popup::test
