// The files of a run, as a user of the library plans and writes them.
#include "popup/write.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/designs.h"
#include "support/run_program.h"

namespace popup {
namespace {

Source sample(const std::string& name) {
    return {name, test::read_file(std::string(POPUP_SOURCE_DIR) + "/samples/" + name)};
}

Compilation compiled(const std::string& name) { return compile({sample(name)}, {}, {}); }

// The one error that keeps a plan from being made.
Diagnostic refused(const OutputRequest& request) {
    Diagnostics told;
    EXPECT_FALSE(plan_outputs(request, told));
    const std::vector<Diagnostic> all = told.sorted();
    EXPECT_EQ(all.size(), 1U);
    return all.empty() ? Diagnostic{} : all.front();
}

TEST(PlanOutputs, RefusesWhatCannotBeWrittenTogether) {
    const std::string input = std::string(POPUP_SOURCE_DIR) + "/samples/bird.xml";
    EXPECT_EQ(refused({.outputs = {""}}).message, "an output has no name");
    EXPECT_EQ(refused({.outputs = {"a.nothing"}}).message, "a.nothing: the suffix names no format");
    EXPECT_EQ(refused({.outputs = {"-"}}).message, "the format of standard output is not known");
    EXPECT_EQ(refused({.outputs = {"a.svg", "./a.svg"}}).message, "a.svg and ./a.svg are the same output");
    EXPECT_EQ(refused({.outputs = {"a.svg"}, .others = {{"a.svg", {}}}}).message,
              "a.svg is named twice as an output");
    EXPECT_EQ(refused({.outputs = {"-"}, .format = "svg", .streams = {"the log"}}).message,
              "standard output has more than one user: the log, -o -");
    EXPECT_EQ(refused({.outputs = {"a.xml"}, .inputs = {"b.xml", "c.xml"}}).message,
              "a.xml is one document, and there are 2 inputs");
    EXPECT_EQ(refused({.outputs = {input}, .inputs = {input}}).message,
              input + " is an input; a build does not overwrite it");
    EXPECT_EQ(refused({.outputs = {"a.glb"}, .inputs = {"parts.svg"}}).message,
              "parts.svg: this describes flat parts, and has no moving model for a.glb");
    EXPECT_EQ(refused({.outputs = {"a.nothing"}}).code, "unwritable-output");
}

TEST(PlanOutputs, FindsTheFormatOfEachOutput) {
    Diagnostics told;
    const auto plan = plan_outputs({.outputs = {"a.SVG", "b.glb", "-"}, .format = "pdf"}, told);
    ASSERT_TRUE(plan);
    ASSERT_EQ(plan->outputs.size(), 3U);
    EXPECT_EQ(plan->outputs[0].format->suffix, ".svg");
    EXPECT_EQ(plan->outputs[1].format->suffix, ".glb");
    EXPECT_EQ(plan->outputs[2].format->suffix, ".pdf");
}

TEST(WriteFiles, WritesAllOfThemOrNone) {
    const test::ScratchDirectory scratch;
    const std::string svg = scratch / "bird.svg";
    const std::string lost = scratch / "no-such-folder/bird.pdf";
    Diagnostics told;
    Compilation run = compiled("bird.xml");
    const auto plan = plan_outputs({.outputs = {svg, lost}}, told);
    ASSERT_TRUE(plan);
    EXPECT_FALSE(write_files(*plan, {}, run));
    EXPECT_TRUE(output_refused(run.run_diagnostics));
    EXPECT_FALSE(std::filesystem::exists(svg));

    run = compiled("bird.xml");
    const auto good = plan_outputs({.outputs = {svg}}, told);
    EXPECT_EQ(write_files(*good, {}, run), std::vector<std::string>{svg});
    EXPECT_TRUE(std::filesystem::exists(svg));
}

TEST(WriteFiles, WantsARunThatWentAsFarAsTheSheets) {
    Diagnostics told;
    const auto plan = plan_outputs({.outputs = {"a.svg"}}, told);
    ASSERT_TRUE(plan);
    Compilation nothing = compile({}, {}, {});
    EXPECT_FALSE(make_files(*plan, {}, nothing));
    EXPECT_TRUE(output_refused(nothing.run_diagnostics));
}

OutputOptions two_threads() {
    OutputOptions options;
    options.threads = 2;
    return options;
}

// Sheets and files of a run of which what can be was begun by threads.
std::vector<PendingFile> made_by(int threads, const std::vector<Source>& sources, const OutputPlan& plan) {
    CompileOptions options;
    options.until = Stage::pattern;
    options.output.threads = threads;
    Compilation run = compile(sources, options, {});
    const BegunFiles begun = begin_files(plan, options.output, run);
    EXPECT_EQ(begun.pages.size(), threads > 1 ? 1U : 0U);
    EXPECT_EQ(begun.models.size(), threads > 1 ? 2U : 0U);
    lay_out_run(run, options);
    return make_files(plan, options.output, run, begun).value_or(std::vector<PendingFile>{});
}

TEST(BeginFiles, GivesTheSameFilesAsWithoutIt) {
    Diagnostics told;
    // Two pages and three models, of which one of a kind is begun, and what is never begun.
    const auto plan = plan_outputs(
        {.outputs = {"a.html", "b.svg", "c.html", "d.book.html", "e.glb", "f.fold", "g.glb"}}, told);
    ASSERT_TRUE(plan);
    for (const std::vector<std::string>& names :
         {std::vector<std::string>{"bird.xml"}, {"castle.xml"}, {"bird.xml", "castle.xml"}}) {
        std::vector<Source> sources;
        for (const std::string& name : names) sources.push_back(sample(name));
        const std::vector<PendingFile> alone = made_by(1, sources, *plan);
        const std::vector<PendingFile> beside = made_by(2, sources, *plan);
        ASSERT_EQ(beside.size(), alone.size());
        ASSERT_GE(alone.size(), 7U);
        for (std::size_t i = 0; i < alone.size(); ++i) {
            EXPECT_EQ(beside[i].path, alone[i].path);
            EXPECT_TRUE(beside[i].bytes == alone[i].bytes) << alone[i].path;
        }
    }
}

// What is told, too: of a FOLD file that says more than is written again, once.
TEST(BeginFiles, TellsTheSameAsWithoutIt) {
    const std::string path = std::string(POPUP_SOURCE_DIR) + "/tests/cases/folded/orders-joined.fold";
    const Source source{"orders-joined.fold", test::read_file(path)};
    const auto told_with = [&source](int threads) {
        Diagnostics of_plan;
        const auto plan = plan_outputs({.outputs = {"a.fold", "a.html", "a.glb", "b.fold"}}, of_plan);
        CompileOptions options;
        options.output.threads = threads;
        Compilation run = compile({source}, options, {});
        const BegunFiles begun = begin_files(*plan, options.output, run);
        EXPECT_TRUE(make_files(*plan, options.output, run, begun));
        return test::findings(run.run_diagnostics);
    };
    const std::string alone = told_with(1);
    EXPECT_NE(alone.find("fold-left-out"), std::string::npos) << alone;
    EXPECT_EQ(told_with(2), alone);
}

TEST(BeginFiles, MayBeForgotten) {
    Diagnostics told;
    const auto plan = plan_outputs({.outputs = {"a.html"}}, told);
    ASSERT_TRUE(plan);
    const Compilation run = compiled("castle.xml");
    for (int i = 0; i < 20; ++i) EXPECT_EQ(begin_files(*plan, two_threads(), run).pages.size(), 1U);
}

bool begins_nothing(const OutputPlan& plan, const OutputOptions& options, const Compilation& run) {
    const BegunFiles begun = begin_files(plan, options, run);
    return begun.pages.empty() && begun.models.empty();
}

TEST(BeginFiles, BeginsNothingOfWhatIsNotWritten) {
    Diagnostics told;
    const auto plan = plan_outputs({.outputs = {"a.html"}}, told);
    ASSERT_TRUE(plan);
    EXPECT_TRUE(begins_nothing(*plan, two_threads(), compile({}, {}, {})));
    const Compilation broken = compile({Source{"bad.xml", "<popup"}}, {}, {});
    EXPECT_TRUE(begins_nothing(*plan, two_threads(), broken));
    const auto sheets = plan_outputs({.outputs = {"a.svg"}}, told);
    EXPECT_TRUE(begins_nothing(*sheets, two_threads(), compiled("castle.xml")));
    CompileOptions short_of_motion;
    short_of_motion.until = Stage::assembly;
    const Compilation halted = compile({sample("castle.xml")}, short_of_motion, {});
    EXPECT_TRUE(begins_nothing(*plan, two_threads(), halted));
}

// What is wrong with a model is told when the page is made, as without threads.
TEST(BeginFiles, TellsWhatFailed) {
    Diagnostics told;
    const auto plan = plan_outputs({.outputs = {"a.html"}}, told);
    ASSERT_TRUE(plan);
    CompileOptions options;
    options.output.threads = 2;
    options.output.fps = 1e6;
    options.output.duration_s = 1e6;
    Compilation run = compile({sample("castle.xml")}, options, {});
    const BegunFiles begun = begin_files(*plan, options.output, run);
    EXPECT_FALSE(make_files(*plan, options.output, run, begun));
    EXPECT_TRUE(output_refused(run.run_diagnostics));
}

TEST(WriteFiles, SparesInputsFromFurtherSheets) {
    const test::ScratchDirectory scratch;
    const std::string input = scratch / "card-2.svg";
    test::write_file(input, "an input");
    Diagnostics told;
    const auto plan = plan_outputs({.outputs = {scratch / "card.svg"}, .inputs = {input}}, told);
    ASSERT_TRUE(plan);
    const Compilation run;
    EXPECT_TRUE(spares_inputs(*plan, {{scratch / "card.svg", "", false}}, run, told));
    EXPECT_FALSE(spares_inputs(*plan, {{input, "", false}}, run, told));
    EXPECT_EQ(told.sorted().front().message,
              input + " is an input, and a further sheet would be written over it");
}

}  // namespace
}  // namespace popup
