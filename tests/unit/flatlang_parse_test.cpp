// The parser of FlatLang: trees, complaints, and what the original parser made of other people's programs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/flatlang/parse.h"
#include "popup/diagnostics.h"

namespace popup::flatlang {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kNoData =
    "no FlatLang programs: POPUP_FLATLANG_DATA names no directory with vectors in it";

// Other people's programs, with what the original interpreter made of them.
fs::path data_directory() {
    const char* named = std::getenv("POPUP_FLATLANG_DATA");
    return named != nullptr ? fs::path(named)
                            : fs::path(POPUP_SOURCE_DIR).parent_path() / "shared/data/flatlang";
}

std::string slurp(const fs::path& path) {
    const std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

struct Read {
    Symbols symbols;
    Diagnostics diagnostics{"test.fl"};
    Parsed parsed;
    std::vector<std::string> said;  // "line:column message"
};

Read read(std::string_view text, bool as_2008 = false) {
    Read result;
    result.parsed = parse("test.fl", text, {as_2008, 250}, result.symbols, result.diagnostics);
    for (const Diagnostic& d : result.diagnostics.sorted()) {
        result.said.push_back(fmt::format("{}:{} {}", d.place.line, d.place.column, d.message));
    }
    return result;
}

// A line and column from 1, as the original counts from 1 and from 0. The end of the file it calls 0:-1.
using At = std::pair<int, int>;

At end_of(std::string_view text) {
    const auto lines = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    const std::size_t last = text.rfind('\n');
    return {lines + 1, static_cast<int>(text.size() - (last == std::string_view::npos ? 0 : last + 1)) + 1};
}

std::set<At> places_2008(const nlohmann::json& parse, std::string_view text) {
    std::set<At> places;
    const std::regex where("line ([0-9]+):(-?[0-9]+) .*", std::regex::extended);
    for (const std::string error : parse.value("errors", nlohmann::json::array())) {
        // Messages may have line breaks in them.
        std::string line = error.substr(0, error.find('\n'));
        std::smatch match;
        if (!std::regex_match(line, match, where)) {
            ADD_FAILURE() << error;
            continue;
        }
        const int at = std::stoi(match[1]);
        places.insert(at == 0 ? end_of(text) : At{at, std::stoi(match[2]) + 1});
    }
    if (parse.value("stopped_before_eof", false)) {
        places.insert({parse["stop_line"], parse["stop_col"].get<int>() + 1});
    }
    return places;
}

TEST(FlatLangParse, ComplaintsIn2008ModeStandWhereTheOriginalHadThem) {
    if (!fs::is_directory(data_directory() / "vectors")) GTEST_SKIP() << kNoData;
    int programs = 0;
    int failing = 0;
    for (const auto& [vectors, sources] :
         {std::pair{"vectors", "programs"}, std::pair{"probe-vectors", "probes"}}) {
        for (const auto& entry : fs::directory_iterator(data_directory() / vectors)) {
            if (entry.path().stem() == "INDEX") continue;
            const nlohmann::json vector = nlohmann::json::parse(slurp(entry.path()));
            const std::string program = vector["program"];
            const std::string text = slurp(data_directory() / sources / program);
            SCOPED_TRACE(program);
            const Read got = read(text, true);
            std::set<At> places;
            for (const Diagnostic& d : got.diagnostics.sorted()) {
                EXPECT_EQ(d.severity, Severity::warning);
                places.insert({d.place.line, d.place.column});
            }
            const std::set<At> expected = places_2008(vector["parse"], text);
            EXPECT_EQ(places, expected) << fmt::format("{}", fmt::join(got.said, "\n"));
            EXPECT_EQ(got.parsed.complete, expected.empty());
            // And where the original found nothing, the default mode does not either.
            EXPECT_EQ(read(text).parsed.complete, expected.empty());
            ++programs;
            failing += expected.empty() ? 0 : 1;
        }
    }
    EXPECT_GT(programs, 200);
    EXPECT_GT(failing, 30);
    fmt::print("{} programs, {} of them with mistakes\n", programs, failing);
}

}  // namespace
}  // namespace popup::flatlang
