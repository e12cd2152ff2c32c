// Every shipped sample is a test: it needs no repair, compiles to every format, and each file is read back by
// a program we did not write.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/run_program.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSamples = fs::path(POPUP_SOURCE_DIR) / "samples";

std::vector<std::string> names_with(const std::string& suffix) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(kSamples)) {
        if (entry.path().extension() == suffix) names.push_back(entry.path().stem());
    }
    std::sort(names.begin(), names.end());
    return names;
}
// Documents, and programs that make cards.
std::vector<std::string> sample_names() {
    std::vector<std::string> names;
    for (const std::string suffix : {".xml", ".fl"}) {
        for (const std::string& name : names_with(suffix)) names.push_back(name + suffix);
    }
    return names;
}

// Of a directory of samples, those with this suffix, from `samples/`.
std::vector<fs::path> samples_in(const std::string& directory, const std::string& suffix = "") {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(kSamples / directory)) {
        if (entry.is_regular_file() && (suffix.empty() || entry.path().extension() == suffix))
            paths.push_back(directory / entry.path().filename());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

class Sample : public testing::TestWithParam<std::string> {
 protected:
    [[nodiscard]] fs::path document() const { return kSamples / GetParam(); }
    [[nodiscard]] bool is_program() const { return document().extension() == ".fl"; }
};

TEST_P(Sample, NeedsNoRepairAndHasNothingDoubtful) {
    const RunResult result = popupc({"check", document()});
    EXPECT_EQ(result.exit, 0) << result.err;
    EXPECT_EQ(result.err, "");
    if (is_program()) return;
    const RunResult diff = popupc({"fix", "--diff", document()});
    EXPECT_EQ(diff.exit, 0);
    EXPECT_EQ(diff.out, "");
}

const std::vector<std::string> kSuffixes{"svg", "pdf", "glb", "gltf", "xml", "json"};

// Writes all formats, each file named `name` and its suffix.
void build_all(const fs::path& document, const fs::path& out, const std::string& name, int threads) {
    std::vector<std::string> words{"build", document, "-j", std::to_string(threads)};
    for (const std::string& suffix : kSuffixes) {
        words.push_back("-o");
        words.push_back(out / (name + "." + suffix));
    }
    const RunResult result = popupc(words);
    ASSERT_EQ(result.exit, 0) << result.err;
}

TEST_P(Sample, CompilesToEveryFormat) {
    const ScratchDirectory out;
    build_all(document(), out.path(), "a", 2);
    for (const std::string& suffix : kSuffixes)
        EXPECT_FALSE(read_file(out / ("a." + suffix)).empty()) << suffix;
}

// What is looked at from outside: the same files as above, so sanitized there is nothing more to learn.
class SampleOutputs : public Sample {};

TEST_P(SampleOutputs, AreTheSameTwiceAndWithAnyThreads) {
    const ScratchDirectory out;
    build_all(document(), out.path(), "a", 1);
    build_all(document(), out.path(), "b", 2);
    for (const std::string& suffix : kSuffixes) {
        const std::string a = read_file(out / ("a." + suffix));
        std::string b = read_file(out / ("b." + suffix));
        // The report names the files it was asked for.
        for (std::size_t at = 0; suffix == "json" && (at = b.find("\"b", at)) != std::string::npos; ++at) {
            if (b[at + 2] == '.' || b[at + 2] == '-') b[at + 1] = 'a';
        }
        EXPECT_FALSE(a.empty()) << suffix;
        EXPECT_TRUE(a == b) << suffix << " differs between two runs";
    }
}

TEST_P(SampleOutputs, SeamsStayClosedAtEveryDegree) {
    const RunResult result = popupc({"build", document(), "--angles", "0:180:1", "--emit", "motion"});
    ASSERT_EQ(result.exit, 0) << result.err;
    const auto motion = nlohmann::json::parse(result.out);
    ASSERT_EQ(motion.at("frames").size(), 181u);
    for (const auto& frame : motion.at("frames")) EXPECT_LE(frame.at("closure_error_mm").get<double>(), 1e-9);
    EXPECT_TRUE(motion.at("flat_closed").get<bool>());
}

TEST_P(SampleOutputs, ModelHoldsTogetherByItsOwnNumbers) {
    const ScratchDirectory out;
    ASSERT_EQ(popupc({"build", document(), "-o", out / "a.glb"}).exit, 0);
    const RunResult measured = run({std::string(POPUP_TOOLS_DIR) + "/glb_view", "measure", out / "a.glb"});
    EXPECT_EQ(measured.exit, 0) << measured.out << measured.err;
}

TEST_P(SampleOutputs, ModelPassesTheKhronosValidator) {
    if (std::getenv("POPUP_GLTF_VALIDATOR") == nullptr || !have_program("node")) {
        GTEST_SKIP()
            << "POPUP_GLTF_VALIDATOR does not name a node_modules with gltf-validator, or there is no node";
    }
    const ScratchDirectory out;
    ASSERT_EQ(popupc({"build", document(), "-o", out / "a.glb", "-o", out / "a.gltf"}).exit, 0);
    const fs::path script = fs::path(POPUP_SOURCE_DIR) / "tests/tools/validate_gltf.mjs";
    const RunResult result = run({"node", script, out / "a.glb", out / "a.gltf"});
    EXPECT_EQ(result.exit, 0) << result.out << result.err;
}

TEST_P(SampleOutputs, DocumentAndItsRewritingFollowTheSchema) {
    if (!have_program("xmllint")) GTEST_SKIP() << "xmllint (libxml2-utils) is not installed";
    const ScratchDirectory out;
    ASSERT_EQ(popupc({"build", document(), "-o", out / "a.xml", "-o", out / "a.svg"}).exit, 0);
    const fs::path schema = fs::path(POPUP_SOURCE_DIR) / "schemas/popup.xsd";
    std::vector<std::string> words{"xmllint", "--noout", "--schema", schema, out / "a.xml"};
    if (!is_program()) words.push_back(document());
    const RunResult result = run(words);
    EXPECT_EQ(result.exit, 0) << result.err;
    EXPECT_EQ(run({"xmllint", "--noout", out / "a.svg"}).exit, 0);
    // Written anew and written once more: the same design. Pictures are named from where a document lies.
    fs::copy(kSamples / "pictures", out / "pictures");
    ASSERT_EQ(popupc({"build", out / "a.xml", "-o", out / "b.xml"}).exit, 0);
    EXPECT_EQ(read_file(out / "a.xml"), read_file(out / "b.xml"));
}

TEST_P(SampleOutputs, SheetsPassQpdf) {
    if (!have_program("qpdf")) GTEST_SKIP() << "qpdf is not installed";
    const ScratchDirectory out;
    ASSERT_EQ(popupc({"build", document(), "-o", out / "a.pdf"}).exit, 0);
    const RunResult result = run({"qpdf", "--check", out / "a.pdf"});
    EXPECT_EQ(result.exit, 0) << result.out << result.err;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '-' || c == '.'; }, '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(Shipped, Sample, testing::ValuesIn(sample_names()), test_name);
INSTANTIATE_TEST_SUITE_P(Shipped, SampleOutputs, testing::ValuesIn(sample_names()), test_name);

// Drawings of flat parts.
class SampleDrawing : public testing::TestWithParam<std::string> {
 protected:
    [[nodiscard]] fs::path drawing() const { return kSamples / (GetParam() + ".svg"); }
};

TEST_P(SampleDrawing, HasNothingDoubtful) {
    const RunResult result = popupc({"check", "--strict", drawing()});
    EXPECT_EQ(result.exit, 0) << result.err;
    EXPECT_EQ(result.err, "");
}

TEST_P(SampleDrawing, CompilesToSheetsTheSameTwiceAndTheyReadBackTheSame) {
    const ScratchDirectory out;
    for (const std::string run : {"a", "b"}) {
        RunOptions options;
        if (run == "b")
            options.environment["GLIBC_TUNABLES"] = "glibc.cpu.hwcaps=-FMA,-AVX2_Usable,-FMA4,-AVX2";
        const RunResult result =
            popupc({"build", drawing(), "-j", run == "a" ? "1" : "2", "-o", out / (run + ".svg"), "-o",
                    out / (run + ".pdf"), "-o", out / (run + ".json")},
                   options);
        ASSERT_EQ(result.exit, 0) << result.err;
    }
    for (const std::string suffix : {".svg", ".pdf"}) {
        EXPECT_TRUE(read_file(out / ("a" + suffix)) == read_file(out / ("b" + suffix))) << suffix;
    }
    const RunResult again = popupc({"build", out / "a.svg", "-o", out / "c.json"});
    EXPECT_EQ(again.err, "");
    const auto pieces = [&](const std::string& file) {
        std::vector<std::string> names;
        const auto report = nlohmann::json::parse(read_file(out / file));
        for (const auto& row : report.at("layout").at("placements")) names.push_back(row.at("piece"));
        std::sort(names.begin(), names.end());
        return names;
    };
    EXPECT_EQ(pieces("a.json"), pieces("c.json"));
    EXPECT_GE(pieces("a.json").size(), 5U);
    if (have_program("xmllint")) {
        EXPECT_EQ(run({"xmllint", "--noout", drawing(), out / "a.svg"}).exit, 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Shipped, SampleDrawing, testing::ValuesIn(names_with(".svg")), [](const auto& info) {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

// What `fix` writes, numbers rounded to six decimals as they are, must need no second fix.
TEST(Fix, IsDoneAfterOneRunOnEveryRepairThereIs) {
    const ScratchDirectory out;
    int seen = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(POPUP_SOURCE_DIR) / "tests/cases/repair")) {
        if (entry.path().extension() != ".xml") continue;
        SCOPED_TRACE(entry.path().filename().string());
        ++seen;
        ASSERT_EQ(popupc({"fix", entry.path(), "-o", out / "fixed.xml"}).exit, 0);
        const RunResult again = popupc({"fix", "--diff", out / "fixed.xml"});
        EXPECT_EQ(again.exit, 0) << again.err;
        EXPECT_EQ(again.out, "");
        // That a repaired card has room for its elements is not promised.
        const RunResult checked =
            popupc({"check", "--allow", "protrusion", "--allow", "collision", out / "fixed.xml"});
        EXPECT_EQ(checked.exit, 0) << checked.err;
    }
    EXPECT_GE(seen, 15);
}

TEST(Samples, AreAtLeastTwelveAndUseEveryElement) {
    const auto names = sample_names();
    EXPECT_GE(names.size(), 12u);
    std::string all;
    for (const std::string& name : names) all += read_file(kSamples / name);
    for (const std::string type : {"step", "inverted-step", "beak", "inverted-beak", "angled-step",
                                   "inverted-angled-step", "v-fold", "inverted-v-fold", "tent"}) {
        EXPECT_NE(all.find("type=\"" + type + "\""), std::string::npos) << type;
    }
}

TEST(Samples, CreatureHasTwentySixElements) {
    const RunResult result = popupc({"build", kSamples / "creature.xml", "--emit", "design"});
    ASSERT_EQ(result.exit, 0) << result.err;
    EXPECT_EQ(nlohmann::json::parse(result.out).at("structures").size(), 26u);
}

TEST(Samples, OfFoldedSheetsHaveNothingDoubtful) {
    std::vector<std::string> words{"check", "--as", "folded"};
    for (const fs::path& path : samples_in("folded")) words.push_back(kSamples / path);
    EXPECT_GT(words.size(), 3U + 2U);
    const RunResult result = popupc(words);
    EXPECT_EQ(result.exit, 0) << result.err;
    EXPECT_EQ(result.err.find("warning"), std::string::npos) << result.err;
}

// Where processors have fused multiply-add, glibc computes sine and cosine with it; outputs must not show it.
TEST(Samples, OutputsDoNotDependOnTheProcessor) {
    const ScratchDirectory out;
    std::vector<fs::path> names;
    for (const std::string& name : sample_names()) names.emplace_back(name);
    for (const std::string& name : names_with(".dxf")) names.emplace_back(name + ".dxf");
    for (const fs::path& path : samples_in("flatlang", ".fl")) names.push_back(path);
    for (const fs::path& path : samples_in("folded")) names.push_back(path);
    for (const std::string run : {"a", "b"}) {
        RunOptions options;
        if (run == "b")
            options.environment["GLIBC_TUNABLES"] = "glibc.cpu.hwcaps=-FMA,-AVX2_Usable,-FMA4,-AVX2";
        for (const fs::path& name : names) {
            const std::string stem = name.stem().string() + run;
            std::vector<std::string> words{"build", kSamples / name,       "-o", out / (stem + ".glb"),
                                           "-o",    out / (stem + ".svg"), "-o", out / (stem + ".pdf")};
            if (name.parent_path() == "folded") words.insert(words.end(), {"--as", "folded"});
            const RunResult result = popupc(words, options);
            ASSERT_EQ(result.exit, 0) << result.err;
        }
    }
    for (const fs::path& name : names) {
        for (const std::string suffix : {".glb", ".svg", ".pdf"}) {
            const std::string stem = name.stem();
            EXPECT_TRUE(read_file(out / (stem + "a" + suffix)) == read_file(out / (stem + "b" + suffix)))
                << name << suffix;
        }
    }
}

// A sheet that can close in many ways, or whose drawing has to be refined before it closes, makes much of a
// last bit: folded sheets of others, and cartons, with the order in which they are folded.
TEST(Samples, FoldedSheetsDoNotDependOnTheProcessor) {
    const ScratchDirectory out;
    std::vector<fs::path> paths;
    for (const fs::path& path : samples_in("cartons", ".fl")) paths.push_back(kSamples / path);
    for (const fs::path& path : samples_in("folded")) paths.push_back(kSamples / path);
    const fs::path others = fs::path(POPUP_SOURCE_DIR).parent_path() / "shared/data/folded";
    for (const char* name : {"fold/castlePopup.fold", "fold/mapfold.fold", "fold/miura-ori.fold",
                             "svg/castlePopup.svg", "svg/miura-ori.svg", "svg/popupSimple.svg"}) {
        if (fs::exists(others / name)) paths.push_back(others / name);
    }
    EXPECT_GT(paths.size(), 10U);
    for (const fs::path& path : paths) {
        std::vector<std::vector<std::string>> bytes;
        for (const char* const without : {"", "glibc.cpu.hwcaps=-FMA,-AVX2_Usable,-FMA4,-AVX2"}) {
            RunOptions options;
            if (*without != '\0') options.environment["GLIBC_TUNABLES"] = without;
            std::vector<std::string> words{"build", path, "-o", out / "a.glb", "-o", out / "a.fold"};
            if (path.extension() != ".fl") words.insert(words.end(), {"--as", "folded"});
            const RunResult result = popupc(words, options);
            ASSERT_EQ(result.exit, 0) << result.err;
            bytes.push_back({read_file(out / "a.glb"), read_file(out / "a.fold"), result.err});
        }
        EXPECT_TRUE(bytes[0] == bytes[1]) << path;
    }
}

TEST(Samples, OutputsDoNotDependOnDirectoryOrLocale) {
    const ScratchDirectory out;
    fs::create_directory(out / "elsewhere");
    fs::copy_file(kSamples / "castle.xml", out / "elsewhere/castle.xml");
    RunOptions there;
    there.directory = out / "elsewhere";
    there.environment["LC_ALL"] = "de_DE.UTF-8";
    ASSERT_EQ(
        popupc({"build", "castle.xml", "-o", "castle.svg", "-o", "castle.glb", "-o", "castle.pdf"}, there)
            .exit,
        0);
    ASSERT_EQ(popupc({"build", kSamples / "castle.xml", "-o", out / "castle.svg", "-o", out / "castle.glb",
                      "-o", out / "castle.pdf"})
                  .exit,
              0);
    for (const std::string suffix : {"svg", "glb", "pdf"}) {
        EXPECT_TRUE(read_file(out / ("castle." + suffix)) == read_file(out / ("elsewhere/castle." + suffix)))
            << suffix;
    }
}

TEST(Samples, MakefileBuildsAllOfThemAndThenNothing) {
    if (!have_program("make")) GTEST_SKIP() << "make is not installed";
    const ScratchDirectory out;
    fs::copy(kSamples, out / "samples", fs::copy_options::recursive);
    const std::vector<std::string> make{"make", "-C", out / "samples", "-j2",
                                        std::string("POPUPC=") + kPopupc};
    const RunResult first = run(make);
    ASSERT_EQ(first.exit, 0) << first.out << first.err;
    for (const std::string& sample : sample_names()) {
        const std::string name = fs::path(sample).stem();
        EXPECT_TRUE(fs::exists(out / ("samples/out/" + name + ".pdf"))) << name;
        EXPECT_TRUE(fs::exists(out / ("samples/out/" + name + ".glb"))) << name;
    }
    for (const std::string& name : names_with(".dxf"))
        EXPECT_TRUE(fs::exists(out / ("samples/out/" + name + ".glb"))) << name;
    for (const std::string& name : names_with(".svg")) {
        EXPECT_TRUE(fs::exists(out / ("samples/out/" + name + ".pdf"))) << name;
    }
    std::vector<fs::path> others = samples_in("flatlang", ".fl");
    for (const std::string directory : {"drawn", "folded"}) {
        for (const fs::path& path : samples_in(directory)) others.push_back(path);
    }
    for (const fs::path& path : others) {
        for (const std::string suffix : {".pdf", ".glb"}) {
            fs::path output = out / "samples/out" / path;
            EXPECT_TRUE(fs::exists(output.replace_extension(suffix))) << output;
        }
    }
    std::vector<std::string> again = make;
    again.push_back("-q");
    EXPECT_EQ(run(again).exit, 0) << "a second make has nothing to do";
}

}  // namespace
}  // namespace popup::test
