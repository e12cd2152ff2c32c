#include "support/viewer_page.h"

#include <gtest/gtest.h>

namespace popup::test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = POPUP_SOURCE_DIR;
const char* const kChromium = "/usr/bin/chromium";

}  // namespace

std::string between(const std::string& page, const std::string& begin, const std::string& end) {
    const std::size_t from = page.find(begin);
    if (from == std::string::npos) return "(no " + begin + ")";
    EXPECT_EQ(page.find(begin, from + 1), std::string::npos) << begin << " is there twice";
    const std::size_t to = page.find(end, from + begin.size());
    return page.substr(from + begin.size(), to - from - begin.size());
}

std::string scene_text(const std::string& page) {
    return between(page, "<script type=\"application/json\" id=\"scene\">", "</script>");
}
nlohmann::json scene_of(const std::string& page) { return nlohmann::json::parse(scene_text(page)); }

std::vector<std::string> words_for_sample(const std::string& sample, const fs::path& output) {
    std::vector<std::string> words{"build", "-q", kRoot / "samples" / sample, "-o", output};
    if (sample.starts_with("folded/") && sample.ends_with(".svg")) {
        words.insert(words.end(), {"--as", "folded"});
    }
    return words;
}

bool have_browser() { return fs::exists(kChromium) && have_program("node"); }

nlohmann::json drive(const ScratchDirectory& scratch, const std::string& page, const std::string& picture,
                     const std::vector<std::string>& expressions, const std::string& scheme, int width,
                     int height) {
    const fs::path profile = scratch / "profile";
    fs::remove_all(profile);
    fs::create_directory(profile);
    std::vector<std::string> words{"node",
                                   kRoot / "tests/tools/drive_page.mjs",
                                   kChromium,
                                   profile,
                                   page,
                                   picture,
                                   std::to_string(width),
                                   std::to_string(height),
                                   scheme};
    words.insert(words.end(), expressions.begin(), expressions.end());
    RunOptions options;
    options.environment["HOME"] = profile;
    const RunResult result = run(words, options);
    EXPECT_EQ(result.exit, 0) << result.err;
    return result.exit == 0 ? nlohmann::json::parse(result.out) : nlohmann::json();
}

std::string when(const std::string& question, const std::string& then) {
    return "new Promise((done) => { const end = performance.now() + 10000; const ask = () => { if ((" +
           question +
           ") || performance.now() > end) done(); else setTimeout(ask, 10); }; ask(); }).then(() => (" +
           then + "))";
}

std::vector<std::string> messages_of(const nlohmann::json& driven) {
    std::vector<std::string> all;
    for (const std::string one : driven.at("messages")) {
        if (one.find("GPU stall due to ReadPixels") == std::string::npos) all.push_back(one);
    }
    return all;
}

}  // namespace popup::test
