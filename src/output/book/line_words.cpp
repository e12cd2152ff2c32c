#include "output/book/line_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace popup::book {
namespace {

struct PlainColor {
    std::string_view name;
    Color color;
};
// Words that everybody uses for what pens look like; of the same hue the light and the dark one.
constexpr std::array kPlain{PlainColor{"black", {0, 0, 0}},       PlainColor{"grey", {128, 128, 128}},
                            PlainColor{"white", {255, 255, 255}}, PlainColor{"red", {255, 0, 0}},
                            PlainColor{"red", {180, 0, 0}},       PlainColor{"orange", {255, 128, 0}},
                            PlainColor{"yellow", {255, 255, 0}},  PlainColor{"green", {0, 255, 0}},
                            PlainColor{"green", {0, 128, 0}},     PlainColor{"light blue", {0, 200, 255}},
                            PlainColor{"blue", {0, 0, 255}},      PlainColor{"blue", {0, 0, 140}},
                            PlainColor{"purple", {128, 0, 160}},  PlainColor{"magenta", {255, 0, 255}},
                            PlainColor{"magenta", {200, 0, 200}}, PlainColor{"pink", {255, 150, 190}},
                            PlainColor{"brown", {140, 80, 30}}};

std::string plain_name(const Color& color) {
    const auto apart = [&color](const PlainColor& one) {
        const int r = color.r - one.color.r;
        const int g = color.g - one.color.g;
        const int b = color.b - one.color.b;
        return r * r + g * g + b * b;
    };
    return std::string(std::min_element(kPlain.begin(), kPlain.end(), [&](const auto& a, const auto& b) {
                           return apart(a) < apart(b);
                       })->name);
}

std::string begun(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
}

std::string fold_words(const Profile& profile) {
    const bool perforated = profile.folds == FoldStyle::perforated;
    const auto drawn_as = [perforated](Operation fold) { return perforated ? Operation::perforation : fold; };
    const bool all_there =
        profile.draws(drawn_as(Operation::mountain)) && profile.draws(drawn_as(Operation::valley));
    const std::string away = plain_name(profile.pen(drawn_as(Operation::mountain)).color);
    const std::string towards = plain_name(profile.pen(drawn_as(Operation::valley)).color);
    constexpr std::string_view kTool = "a ruler, and a blunt point that presses a groove without cutting.";
    if (!all_there) return "Not all folds are on the sheets: the drawings of the steps show them.";
    if (profile.dashes(Operation::mountain) && profile.dashes(Operation::valley))
        return fmt::format(
            "Score the dashed lines before you cut: {} {} lines (long and short dashes) are mountains: "
            "they fold away from you. {} lines (even dashes) are valleys: they fold towards you.",
            kTool, begun(away), begun(towards));
    const std::string lines = perforated ? "rows of short lines" : "lines";
    const std::string score =
        perforated ? std::string("They are cut as they are, and not scored.")
                   : fmt::format("Score them before you cut, where no machine does it: {}", kTool);
    if (away == towards)
        return fmt::format("Folds are {} {}: the drawings of the steps show which way they go. {}", away,
                           lines, score);
    return fmt::format(
        "{} {} are mountains: they fold away from you. {} {} are valleys: they fold towards you. {}",
        begun(away), lines, begun(towards), lines, score);
}

std::string cut_words(const Profile& profile, bool inner_cuts) {
    const std::string outer = plain_name(profile.pen(Operation::outer_cut).color);
    std::vector<std::string> inner;
    for (const Operation operation : {Operation::inner_cut, Operation::slit}) {
        const std::string name = plain_name(profile.pen(operation).color);
        if (profile.draws(operation) && std::find(inner.begin(), inner.end(), name) == inner.end())
            inner.push_back(name);
    }
    if (!profile.draws(Operation::outer_cut))
        return "Not all cuts are on the sheets: the drawings of the steps show the outlines of pieces.";
    if (!inner_cuts || inner.empty()) return fmt::format("Cut the solid {} lines.", outer);
    if (inner == std::vector{outer})
        return fmt::format(
            "Cut the solid {} lines: first those inside of a piece, with the knife, then its outline.",
            outer);
    return fmt::format(
        "Cut the solid lines: first those inside of a piece, which are {}, with the knife, then its "
        "outline, which is {}.",
        fmt::join(inner, " or "), outer);
}

// Whether all lines of a sheet look as those that a person is to cut and fold.
bool is_for_hands(const Profile& profile) { return profile.name == profile_table().front().name; }

}  // namespace

std::vector<std::string> line_words(const Profile& profile, const LinesThere& lines) {
    std::vector<std::string> said;
    if (!is_for_hands(profile))
        said.push_back(
            fmt::format("The lines of the sheets are drawn for {}. Where a machine cuts and scores them, "
                        "go on with the tabs.",
                        profile.name));
    said.emplace_back("Print the sheets at 100 %, without fitting them to the page.");
    if (lines.folds) said.push_back(fold_words(profile));
    said.push_back(cut_words(profile, lines.inner_cuts));
    return said;
}

}  // namespace popup::book
