// Random sequences of all edits, on generated cards and on the samples. What an edit says and writes is held
// against a whole reading, check, closing and motion of the document before it and after it, which share
// nothing with the quick look of edits.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "output/xml.h"
#include "popup/check.h"
#include "popup/edit.h"
#include "popup/motion.h"
#include "support/designs.h"
#include "support/proposals.h"
#include "support/run_program.h"
#include "support/sanitized.h"

namespace popup::test {
namespace random_edits {
namespace {

constexpr int kSteps = 6;             // edits of a sequence
constexpr double kLastDigits = 1e-5;  // of a document's unit

// Findings, by what tells them apart however lines have moved.
using Found = std::map<std::tuple<Severity, std::string, std::string>, int>;

Found counted(const Diagnostics& diagnostics) {
    Found found;
    for (const Diagnostic& one : diagnostics.sorted()) ++found[{one.severity, one.code, one.element}];
    return found;
}

// Whatever element they are about.
Found by_code(const Found& found) {
    Found made;
    for (const auto& [what, count] : found) made[{std::get<0>(what), std::get<1>(what), ""}] += count;
    return made;
}

// Findings to the last word, with their places.
std::multiset<std::string> told(const Diagnostics& diagnostics) {
    std::multiset<std::string> all;
    for (const Diagnostic& one : diagnostics.sorted()) {
        std::string text = fmt::format("{}:{}: {} [{}] {}", one.place.line, one.place.column, one.message,
                                       one.code, fmt::join(one.hints, "; "));
        for (const Related& related : one.related)
            text += fmt::format(" {}:{}: {}", related.place.line, related.place.column, related.text);
        all.insert(std::move(text));
    }
    return all;
}

std::ptrdiff_t without_id(const Design& design) {
    return std::count_if(design.structures.begin(), design.structures.end(),
                         [](const Structure& one) { return !one.id_given; });
}

// A document as a whole: what it says, and what is found about it without looking for collisions.
struct Looked {
    std::optional<Design> design;
    Found found;
    std::multiset<std::string> told;
};

Looked look_at(const std::string& text) {
    Looked looked;
    Diagnostics said("card.xml");
    looked.design = read_design({"card.xml", text}, {}, said);
    const auto checked = looked.design ? check(*looked.design, {}, said) : std::nullopt;
    const auto assembly = checked ? assemble(*checked, {}, said) : std::nullopt;
    MotionOptions motion;
    motion.examine = false;
    if (assembly) simulate(*assembly, motion, said);
    looked.found = counted(said);
    looked.told = told(said);
    return looked;
}

// What is found after and was not found before.
Found newly(const Found& before, const Found& after) {
    Found made;
    for (const auto& [what, count] : after) {
        const auto was = before.find(what);
        const int more = count - (was == before.end() ? 0 : was->second);
        if (more > 0) made[what] = more;
    }
    return made;
}

bool has_error(const Found& found) {
    return std::any_of(found.begin(), found.end(),
                       [](const auto& one) { return std::get<0>(one.first) == Severity::error; });
}

std::string in_words(const Found& found) {
    std::string text;
    for (const auto& [what, count] : found)
        text += fmt::format("{} × {} of \"{}\"\n", count, std::get<1>(what), std::get<2>(what));
    return text;
}

// An edit, and the one that takes it back; empty where there is none.
struct Proposed {
    std::string edit, back;
};

std::string millimetres(double mm) { return fmt::format("{:.2f}mm", mm); }

// A shape somewhat like what is drawn by hand.
std::string silhouette(Dice& random) {
    const double wide = random.uniform(4, 20);
    const double high = random.uniform(4, 20);
    return fmt::format("'M {:.2f} 0 L {:.2f} {:.2f} L 0 {:.2f} L {:.2f} {:.2f} L {:.2f} 0 Z'", -wide, -wide,
                       high, high * random.uniform(0.6, 1.5), wide, high, wide);
}

// A measure with a value that it may have, as an option.
std::string measured(Dice& random, const ElementInfo& info) {
    const MeasureInfo& measure = info.measures[random.below(info.measures.size())];
    if (measure.kind == MeasureKind::choice)
        return fmt::format(" --{} {}", measure.name, measure.words[random.below(measure.words.size())]);
    return fmt::format(
        " --{} {:.3f}", measure.name,
        measure.kind == MeasureKind::length ? random.uniform(0.1, 30.0) : random.uniform(5.0, 120.0));
}

Proposed move(Dice& random, const Structure& one, const ElementInfo& info) {
    const double by = random.uniform(-8.0, 8.0);
    if (find_measure(info, "turn") && random.chance(0.3))
        return {fmt::format("move {} --turn={:.1f} --follow", one.id, by), ""};
    const std::string_view way = find_measure(info, "x") ? "x" : "along";
    const auto line = [&](double mm) {
        return fmt::format("move {} --{}={} --follow", one.id, way, millimetres(mm));
    };
    return {line(by), line(-by)};
}

Proposed set_color(Dice& random, const Structure& one, const ElementInfo& info) {
    for (std::size_t tries = 0; tries < 8 && !info.parameters.empty(); ++tries) {
        const std::size_t i = random.below(info.parameters.size());
        if (info.parameters[i].kind != ParameterKind::colour) continue;
        const bool given = i < one.arguments.size() && one.arguments[i].given();
        const auto* color = given ? std::get_if<Color>(&one.arguments[i].value) : nullptr;
        return {fmt::format("set {} --{} '#12{:02x}56'", one.id, info.parameters[i].name, random.below(256)),
                color == nullptr ? fmt::format("set {} --{} none", one.id, info.parameters[i].name) : ""};
    }
    return {};
}

Proposed move_point(Dice& random, const Structure& one, const ElementInfo& info) {
    if (info.points.empty()) return {};
    const Vec2 by{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    const std::string_view letter = info.points[random.below(info.points.size())].letter;
    const std::string_view rest = random.chance(0.5) ? " --follow" : " --alone --follow";
    const auto line = [&](Vec2 way) {
        return fmt::format("point {}.{} --by={},{}{}", one.id, letter, millimetres(way.x), millimetres(way.y),
                           rest);
    };
    return {line(by), line(-1.0 * by)};
}

Proposed add(Dice& random, const Design& design, int step) {
    const auto table = element_table();
    const ElementInfo& info = table[random.below(table.size())];
    const CardFolds card = folds_of_card(design);
    std::string on;
    if (info.grounds.plate && !card.plates.empty()) {
        on = card.plates[random.below(card.plates.size())];
    } else if (!info.grounds.page && !card.folds.empty() && random.chance(0.7)) {
        on = card.folds[random.below(card.folds.size())].name;
    }
    std::string line =
        fmt::format("add {} --id new-{} --room {}", info.name, step, millimetres(random.uniform(2.0, 60.0)));
    if (!on.empty()) line += " --on " + on;
    if (find_measure(info, "at")) line += fmt::format(" --at={}", millimetres(random.uniform(-80.0, 80.0)));
    return {line, fmt::format("delete new-{}", step)};
}

Proposed copy(Dice& random, const Structure& one, const Design& design, int step) {
    std::string line = fmt::format("copy {} --ids copy-{} --step={}", one.id, step,
                                   millimetres(random.uniform(-60.0, 60.0)));
    const CardFolds card = folds_of_card(design);
    if (random.chance(0.2) && !card.folds.empty())
        line += " --on " + card.folds[random.below(card.folds.size())].name;
    line += random.chance(0.3) ? " --with-children" : random.chance(0.3) ? " --mirror" : "";
    return {line, fmt::format("delete copy-{} --with-children", step)};
}

Proposed outline(Dice& random, const Structure& one, const ElementInfo& info) {
    const auto number = find_parameter(info, "outline");
    const bool given = number && *number < one.arguments.size() && one.arguments[*number].given();
    return {fmt::format("outline {} --d {} --fit {}", one.id, silhouette(random),
                        random.chance(0.5) ? "both" : "seams"),
            given || !number ? "" : fmt::format("set {} --outline none", one.id)};
}

Proposed propose(Dice& random, const Design& design, int step) {
    if (design.structures.empty()) return add(random, design, step);
    const Structure& one = design.structures[random.below(design.structures.size())];
    const ElementInfo& info = *find_element(one.type);
    switch (random.below(9)) {
        case 0:
        case 1:
            return move(random, one, info);
        case 2:
            return {fmt::format("set {}{} --follow", one.id, measured(random, info)), ""};
        case 3:
            return set_color(random, one, info);
        case 4:
            return {fmt::format("rename {} other-{}", one.id, step),
                    one.id_given ? fmt::format("rename other-{} {}", step, one.id) : ""};
        case 5:
            return add(random, design, step);
        case 6:
            return random.chance(0.5) ? copy(random, one, design, step) : outline(random, one, info);
        case 7:
            return move_point(random, one, info);
        default:
            return {fmt::format("delete {}{}", one.id, random.chance(0.7) ? " --with-children" : ""), ""};
    }
}

struct Result {
    std::optional<Edited> edited;
    std::string of_edits, of_document;
    Found found;
    std::multiset<std::string> told;
    bool refused = false;
};

Result carry_out(const std::string& document, const std::string& line, bool force = false) {
    Diagnostics trouble("edits.txt");
    const std::vector<EditLine> edits = read_edits(line, trouble);
    Diagnostics of_edits("edits.txt");
    Diagnostics of_document("card.xml");
    EditOptions options;
    options.force = force;
    Result result;
    result.edited = edit_document({"card.xml", document}, edits, options, of_edits, of_document);
    result.refused = result.edited && result.edited->refused;
    result.of_edits = findings(trouble) + findings(of_edits);
    result.of_document = findings(of_document);
    result.found = counted(of_document);
    result.told = told(of_document);
    return result;
}

struct Tally {
    std::size_t sequences = 0, carried_out = 0, refused = 0, not_possible = 0, undone = 0;
    std::size_t last_digits = 0;  // undone, but for the last digits of what follows
};

// What an edit has moved to another fold does not come back by its opposite.
std::vector<std::string> grounds(const Design& design) {
    std::vector<std::string> all;
    for (const Standing& one : folds_of_card(design).standing) all.push_back(one.on);
    return all;
}

// How far the numbers of two documents lie apart at the most, that are else the same; infinite where they are
// not.
double apart(const std::string& was, const std::string& is) {
    double most = 0.0;
    const char* a = was.c_str();
    const char* b = is.c_str();
    while (*a != '\0' || *b != '\0') {
        char* a_end = nullptr;
        char* b_end = nullptr;
        const double x = std::strtod(a, &a_end);
        const double y = std::strtod(b, &b_end);
        if (a_end != a && b_end != b) {
            most = std::max(most, std::abs(x - y));
            a = a_end;
            b = b_end;
        } else if (*a++ != *b++) {
            return std::numeric_limits<double>::infinity();
        }
    }
    return most;
}

// Whether copies carry each other and nothing else, and nothing else carries them but what the first stands
// on.
bool copied_alone(const Design& before, const Design& after) {
    const std::size_t count = before.structures.size();
    const CardFolds card = folds_of_card(after);
    const std::vector<std::string> was = grounds(before);
    for (std::size_t i = 0; i < card.standing.size(); ++i) {
        const Standing& one = card.standing[i];
        if (i < count ? one.on != was[i] : i > count && (!one.owner || *one.owner < count)) return false;
    }
    return true;
}

void undo(const Design& before, const std::string& text, const Design& after, const Result& done,
          const Proposed& proposed, Tally& tally) {
    // The version of a document stays where it was raised.
    if (proposed.back.empty() || before.version != after.version) return;
    // So does the id of what others name.
    if (without_id(before) != without_id(after)) return;
    const bool moves = proposed.edit.starts_with("move") || proposed.edit.starts_with("point");
    if (moves && grounds(before) != grounds(after)) return;
    if (proposed.edit.starts_with("copy") && !copied_alone(before, after)) return;
    const Result back = carry_out(done.edited->text, proposed.back);
    if (!back.edited || back.refused) {
        EXPECT_NE(back.of_edits, "");
        return;
    }
    ++tally.undone;
    if (back.edited->text == text) return;
    ++tally.last_digits;
    // What follows is measured by points of six decimals.
    EXPECT_LE(apart(text, back.edited->text), kLastDigits) << text << back.edited->text;
}

// Edits one document so often, and looks at each edit as a whole.
void edit_at_random(std::string text, std::uint64_t seed, Tally& tally) {
    Dice random{seed * 977 + 5};
    ++tally.sequences;
    Looked now = look_at(text);
    ASSERT_TRUE(now.design) << text;
    for (int step = 0; step < kSteps; ++step) {
        const Proposed proposed = propose(random, *now.design, step);
        if (proposed.edit.empty()) continue;
        SCOPED_TRACE(fmt::format("{} {}: {}", seed, step, proposed.edit));
        const Result done = carry_out(text, proposed.edit);
        if (!done.edited) {
            EXPECT_NE(done.of_edits, "");
            ++tally.not_possible;
            continue;
        }
        // A refused edit has made a document all the same, which is not written.
        const Looked after = look_at(done.edited->text);
        EXPECT_TRUE(std::includes(after.told.begin(), after.told.end(), done.told.begin(), done.told.end()))
            << fmt::format("said:\n{}\nfound:\n{}\n", fmt::join(done.told, "\n"), fmt::join(after.told, "\n"))
            << done.edited->text;
        const bool same_names =
            !proposed.edit.starts_with("rename") && without_id(*now.design) == 0 && after.design;
        const Found fresh =
            same_names ? newly(now.found, after.found) : newly(by_code(now.found), by_code(after.found));
        const std::string both =
            "said:\n" + done.of_edits + done.of_document + "found:\n" + in_words(fresh) + text;
        if (same_names) {
            EXPECT_EQ(done.found, fresh) << both;
            EXPECT_EQ(done.refused, has_error(fresh)) << both;
        } else {
            // What has no id has the number of its place as its name, which may become another.
            EXPECT_TRUE(newly(by_code(done.found), fresh).empty()) << both;
            EXPECT_TRUE(done.refused || !has_error(fresh)) << both;
        }
        if (::testing::Test::HasFailure()) return;
        if (done.refused) {
            ++tally.refused;
            continue;
        }
        ++tally.carried_out;
        ASSERT_TRUE(after.design) << done.edited->text;
        undo(*now.design, text, *after.design, done, proposed, tally);
        text = done.edited->text;
        now = after;
    }
}

// As the writer spells it: what is changed and changed back is spelled so.
std::string canonical(const std::string& text) {
    Diagnostics trouble("card.xml");
    return format_document({"card.xml", text}, trouble).value_or(text);
}

std::vector<std::string> samples() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(POPUP_SOURCE_DIR) + "/samples")) {
        if (entry.path().extension() == ".xml") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    std::vector<std::string> texts;
    for (const auto& file : files) {
        // Those that read other files are not what their text says alone.
        std::string text = canonical(read_file(file));
        if (look_at(text).design) texts.push_back(std::move(text));
    }
    return texts;
}

template <typename Text>
void expect_sound(std::uint64_t first, std::uint64_t count, const Text& text) {
    Tally tally;
    for (std::uint64_t seed = first; seed < first + count && !::testing::Test::HasFailure(); ++seed)
        edit_at_random(text(seed), seed, tally);
    EXPECT_GT(tally.carried_out, count);
    EXPECT_GT(tally.undone, count / 3);
    EXPECT_GT(tally.refused + tally.not_possible, 0U);
    EXPECT_LE(tally.last_digits, tally.undone / 20);
    const auto record = [](const char* name, std::size_t value) {
        ::testing::Test::RecordProperty(name, fmt::format("{}", value));
    };
    record("sequences", tally.sequences);
    record("carried_out", tally.carried_out);
    record("refused", tally.refused);
    record("not_possible", tally.not_possible);
    record("undone", tally.undone);
    record("last_digits", tally.last_digits);
}

// Every third has elements without ids.
std::string written(Design design, std::uint64_t seed) {
    for (Structure& one : design.structures) one.id_given = one.id_given || seed % 3 != 0;
    return write_document(design);
}

std::string generated(std::uint64_t seed) { return written(generate(seed, 7), seed); }
std::string generated_any(std::uint64_t seed) { return written(generate_any(seed, 7), seed); }

// Eight elements deep, where there is room; it takes long to find such.
std::string tower(std::uint64_t seed) {
    constexpr std::size_t kTowers = 16;
    static std::array<std::string, kTowers> known;
    std::string& text = known[seed % kTowers];
    if (text.empty()) text = written(generate_tower(seed % kTowers, 8), seed);
    return text;
}

void expect_samples(std::uint64_t first, std::uint64_t count) {
    const std::vector<std::string> texts = samples();
    expect_sound(first, count, [&](std::uint64_t seed) { return texts[seed % texts.size()]; });
}

TEST(RandomEdits, OfGeneratedCards) { expect_sound(1, sanitized_count<std::uint64_t>(60), generated); }
TEST(RandomEdits, OfCardsOfAllElements) {
    expect_sound(1, sanitized_count<std::uint64_t>(60), generated_any);
}
TEST(RandomEdits, OfTowers) { expect_sound(1, sanitized_count<std::uint64_t>(60, 30), tower); }
TEST(RandomEdits, OfSamples) { expect_samples(1, sanitized_count<std::uint64_t>(60)); }

// Together a hundred thousand sequences.
constexpr std::uint64_t kMany = 25'000;

TEST(LongRandomEdits, OfGeneratedCards) {
    expect_sound(1000, sanitized_count<std::uint64_t>(kMany, 250), generated);
}
TEST(LongRandomEdits, OfCardsOfAllElements) {
    expect_sound(1000, sanitized_count<std::uint64_t>(kMany, 250), generated_any);
}
TEST(LongRandomEdits, OfTowers) { expect_sound(1000, sanitized_count<std::uint64_t>(kMany, 250), tower); }
TEST(LongRandomEdits, OfSamples) { expect_samples(1000, sanitized_count<std::uint64_t>(kMany, 250)); }

}  // namespace
}  // namespace random_edits
}  // namespace popup::test
