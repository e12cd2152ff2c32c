// Other people's programs against what the original interpreter computed for them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "input/flatlang/run/interpreter.h"
#include "input/flatlang/turtle/original_files.h"
#include "popup/files.h"
#include "support/run_program.h"

namespace popup::flatlang {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double kGeometry = 1e-4;  // inches
constexpr double kPrinted = 1e-6;

// What a vector is about: a program, and what it gave.
struct Vector {
    std::string name;
    std::string program;  // path
    std::vector<std::string> folders;
    Json expected;
    [[nodiscard]] bool flagged(const std::string& quirk) const {
        return expected.contains("quirks_hit") && expected["quirks_hit"].contains(quirk);
    }
};

Json read_json(const fs::path& path) { return Json::parse(std::ifstream(path)); }

std::vector<Vector> all_vectors(const fs::path& data) {
    std::vector<Vector> all;
    const auto add = [&](const fs::path& vectors, const fs::path& programs,
                         const std::vector<std::string>& folders) {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(vectors)) {
            if (entry.path().filename() != "INDEX.json") files.push_back(entry.path());
        }
        std::sort(files.begin(), files.end());
        for (const fs::path& file : files) {
            Json expected = read_json(file);
            const std::string program = programs / expected["program"].get<std::string>();
            all.push_back({file.stem(), program, folders, std::move(expected)});
        }
    };
    const fs::path programs = data / "programs";
    add(data / "vectors", programs,
        {programs, programs / "distro/flatcad-examples", programs / "fl", programs / "distro"});
    add(data / "probe-vectors", data / "probes", {data / "probes", data / "probes/lib"});
    return all;
}

ProgramRun run(const Vector& vector, bool as_2008) {
    Diagnostics diagnostics(vector.program);
    const auto source = read_source(vector.program, diagnostics);
    EXPECT_TRUE(source) << vector.program;
    ReadOptions options;
    options.program.as_2008 = as_2008;
    options.program.folders = vector.folders;
    return run_program(source.value_or(Source{vector.program, ""}), options, diagnostics);
}

// The words of a text, and between them the numbers, so that these can be compared as such.
std::vector<std::string> words(const std::string& text) {
    std::vector<std::string> found;
    std::string word;
    for (const char c : text + "\n") {
        if (std::string_view(" \t\n[]{}(),").find(c) == std::string_view::npos) {
            word += c;
            continue;
        }
        if (!word.empty()) found.push_back(std::exchange(word, {}));
        found.emplace_back(1, c);
    }
    return found;
}

std::optional<double> as_number(const std::string& word) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (word.empty() || end != word.c_str() + word.size()) return std::nullopt;
    return value;
}

bool near(double a, double b, double tolerance) {
    if (std::isnan(a) || std::isnan(b)) return std::isnan(a) == std::isnan(b);
    return a == b || std::fabs(a - b) <= tolerance * std::max(1.0, std::fabs(a));
}

// Texts are the same but for numbers that differ by `tolerance`, relative above 1.
std::string text_difference(const std::string& expected, const std::string& got, double tolerance) {
    const auto a = words(expected);
    const auto b = words(got);
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
        const std::string x = i < a.size() ? a[i] : "(end)";
        const std::string y = i < b.size() ? b[i] : "(end)";
        if (x == y) continue;
        const auto m = as_number(x);
        const auto n = as_number(y);
        if (m && n && near(*m, *n, tolerance)) continue;
        return fmt::format("word {}: {} is wanted, {} there", i, x, y);
    }
    return {};
}

bool same_point(const Json& expected, Vec3 got) {
    const auto number = [](const Json& value) { return value.is_number() ? value.get<double>() : NAN; };
    return near(number(expected[0]), got.x, kGeometry) && near(number(expected[1]), got.y, kGeometry) &&
           near(number(expected[2]), got.z, kGeometry);
}

std::string segment_difference(const Json& expected, const Trail& trail) {
    std::vector<Json> wanted;
    for (const Json& one : expected) {
        double length = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            length += std::fabs(one[i].get<double>() - one[i + 3].get<double>());
        }
        if (length > 1e-9) wanted.push_back(one);
    }
    std::vector<TrailSegment> drawn;
    for (const TrailSegment& one : trail.segments) {
        if (length(one.to - one.from) > 1e-9) drawn.push_back(one);
    }
    if (wanted.size() != drawn.size()) {
        return fmt::format("{} segments are wanted, {} there", wanted.size(), drawn.size());
    }
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const Json& one = wanted[i];
        const TrailSegment& got = drawn[i];
        const std::string part = one.size() > 6 ? one[6].get<std::string>() : std::string();
        if (!same_point(Json::array({one[0], one[1], one[2]}), got.from) ||
            !same_point(Json::array({one[3], one[4], one[5]}), got.to)) {
            return fmt::format("segment {}: {} is wanted", i, one.dump());
        }
        if (trail.parts[static_cast<std::size_t>(got.part)].name != part) {
            return fmt::format("segment {}: the part is {}", i,
                               trail.parts[static_cast<std::size_t>(got.part)].name);
        }
    }
    return {};
}

std::string polygon_difference(const Json& expected, const Trail& trail) {
    if (expected.size() != trail.polygons.size()) {
        return fmt::format("{} polygons are wanted, {} there", expected.size(), trail.polygons.size());
    }
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto& got = trail.polygons[i].points;
        if (expected[i].size() != got.size()) {
            return fmt::format("polygon {}: {} points are wanted, {} there", i, expected[i].size(),
                               got.size());
        }
        for (std::size_t j = 0; j < got.size(); ++j) {
            if (!same_point(expected[i][j], got[j])) return fmt::format("polygon {}, point {}", i, j);
        }
    }
    return {};
}

std::string pose_difference(const Json& expected, const Pose& pose) {
    if (!same_point(expected["pos"], pose.at)) return "the last position";
    if (!same_point(expected["right_x"], pose.right)) return "the last direction of right";
    if (!same_point(expected["heading_y"], pose.heading)) return "the last heading";
    if (!same_point(expected["up_z"], pose.up)) return "the last direction of up";
    return {};
}

// HP-GL within one unit.
std::string hpgl_difference(const std::string& expected, const std::string& got) {
    const auto a = words(expected);
    const auto b = words(got);
    if (a.size() != b.size())
        return fmt::format("{} words of HP-GL are wanted, {} there", a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        const auto m = as_number(a[i]);
        const auto n = as_number(b[i]);
        const bool same = m && n ? std::fabs(*m - *n) <= 1.0 : a[i] == b[i];
        if (!same) return fmt::format("HP-GL word {}: {} is wanted, {} there", i, a[i], b[i]);
    }
    return {};
}

std::string laser_difference(const Json& expected, const OriginalLaser& got) {
    if (expected["lines"].size() != got.lines.size()) {
        return fmt::format("{} laser lines are wanted, {} there", expected["lines"].size(), got.lines.size());
    }
    for (std::size_t i = 0; i < got.lines.size(); ++i) {
        const Json& line = expected["lines"][i];
        const Segment& drawn = got.lines[i];
        const double values[] = {drawn.a.x, drawn.a.y, drawn.b.x, drawn.b.y};
        for (std::size_t j = 0; j < 4; ++j) {
            // In points, of which there are 72 an inch.
            if (!near(line[j].get<double>(), values[j], 72 * kGeometry)) {
                return fmt::format("laser line {}: {} is wanted", i, line.dump());
            }
        }
    }
    if (expected["page"] != Json::array({got.width, got.height})) {
        return fmt::format("a page of {} is wanted, {} × {} there", expected["page"].dump(), got.width,
                           got.height);
    }
    return {};
}

// The first difference; `excused` gets what was not looked at, and why.
std::string difference(const Vector& vector, const ProgramRun& got, bool as_2008,
                       std::vector<std::string>& excused) {
    const Json& wanted = vector.expected;
    if (wanted["status"].get<std::string>() != to_string(got.status)) {
        return fmt::format("it ends with {}, not {}", to_string(got.status),
                           wanted["status"].get<std::string>());
    }
    if (vector.flagged("quote_returns_nil")) {
        excused.push_back("stdout, where quote() returned nil");
    } else if (auto text = text_difference(wanted["stdout"], got.printed, kPrinted); !text.empty()) {
        return "stdout, " + text;
    }
    if (auto text = segment_difference(wanted["segments"], got.trail); !text.empty()) return text;
    const bool once = !as_2008 && wanted.contains("polygons_if_computed_once");
    if (auto text = polygon_difference(wanted[once ? "polygons_if_computed_once" : "polygons"], got.trail);
        !text.empty()) {
        return text;
    }
    const bool ended = got.status == RunStatus::ok || wanted["completed"].get<bool>();
    if (ended) {
        if (auto text = pose_difference(wanted["final_pose"], got.trail.last); !text.empty()) return text;
    }
    if (!as_2008) return {};
    for (const auto& [file, text] : wanted["hpgl"].items()) {
        if (got.hpgl.empty() || got.hpgl.back().name != file) return "hpgl() did not ask for " + file;
        const std::string hpgl = original_hpgl(got.trail, got.part_mode);
        if (auto words = hpgl_difference(text, hpgl); !words.empty()) return words;
    }
    if (vector.flagged("polygons_differ_if_computed_once")) {
        if (wanted.contains("hpgl_probe") || wanted.contains("laser")) {
            excused.push_back("hpgl_probe and laser, where poses were computed twice");
        }
        return {};
    }
    if (wanted.contains("hpgl_probe")) {
        const std::string hpgl = original_hpgl(got.trail, got.part_mode);
        if (auto words = hpgl_difference(wanted["hpgl_probe"], hpgl); !words.empty())
            return "probe: " + words;
    }
    if (wanted.contains("laser")) {
        if (got.laser.empty() || got.laser.back().name != wanted["laser"]["file"])
            return "laser() asked for less";
        const OriginalLaser laser = original_laser(got.trail, got.part_mode);
        if (auto text = laser_difference(wanted["laser"], laser); !text.empty()) return text;
    }
    return {};
}

fs::path shared_data() { return fs::path(POPUP_SOURCE_DIR) / "../shared/data/flatlang"; }

class FlatLangVectors : public ::testing::Test {
 protected:
    void SetUp() override {
        if (!fs::exists(shared_data() / "vectors")) GTEST_SKIP() << "the shared programs are not here";
    }
};

TEST_F(FlatLangVectors, In2008ModeEveryProgramDoesWhatTheOriginalDid) {
    std::size_t agree = 0, excused_programs = 0;
    std::map<std::string, std::size_t> excuses;
    std::string table;
    for (const Vector& vector : all_vectors(shared_data())) {
        std::vector<std::string> excused;
        const std::string what = difference(vector, run(vector, true), true, excused);
        for (const std::string& one : excused) ++excuses[one];
        if (!what.empty()) {
            table += fmt::format("  {}: {}\n", vector.name, what);
        } else {
            ++(excused.empty() ? agree : excused_programs);
        }
    }
    const auto differ = static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n'));
    std::cout << fmt::format("2008 mode: {} agree, {} differ, {} agree but for what is excused\n{}", agree,
                             differ, excused_programs, table);
    for (const auto& [excuse, count] : excuses)
        std::cout << fmt::format("  excused: {} ({})\n", excuse, count);
    EXPECT_EQ(differ, 0U) << table;
    EXPECT_GT(agree, 150U);
}

// A mended oddity shows in the outcome of these only.
TEST_F(FlatLangVectors, InDefaultModeTheDifferencesAreThoseOfTheMendedOddities) {
    std::size_t same = 0, mended = 0;
    std::string unexplained, explained;
    for (const Vector& vector : all_vectors(shared_data())) {
        std::vector<std::string> excused;
        const ProgramRun got = run(vector, false);
        const std::string wanted = vector.expected["status"];
        std::string reason;
        if (wanted == "parse-fail") {
            reason = "does not parse";
            if (got.status != RunStatus::parse_fail || !got.trail.segments.empty() || !got.printed.empty()) {
                unexplained += fmt::format("  {}: it was run though it does not parse\n", vector.name);
                continue;
            }
        }
        const std::string what = difference(vector, got, false, excused);
        // Probes that ask for one oddity alone; the files do not flag these.
        static const std::map<std::string, std::string> kAsked{
            {"lists", "an index is used twice"},
            {"quote_eval", "what eval() cannot read is an error"},
            {"replace_after_pos", "poses were computed twice"},
            {"shape_drawto", "draw() left drawto() out"},
        };
        if (const auto asked = kAsked.find(vector.name); asked != kAsked.end()) reason = asked->second;
        for (const char* quirk : {"safe_mode_lost_after_call", "minus_of_negative_is_zero",
                                  "draw_ignores_name", "index_used_twice"}) {
            if (vector.flagged(quirk)) reason = quirk;
        }
        if (what.empty()) {
            ++same;
        } else if (!reason.empty()) {
            ++mended;
            explained += fmt::format("  {} ({}): {}\n", vector.name, reason, what);
        } else {
            unexplained += fmt::format("  {}: {}\n", vector.name, what);
        }
    }
    std::cout << fmt::format("default mode: {} the same, {} differ by a mended oddity\n{}", same, mended,
                             explained);
    EXPECT_EQ(unexplained, "");
}

}  // namespace
}  // namespace popup::flatlang
