// Options of inputs that are drawings: what they show, and which lines mean what.
#include <algorithm>

#include "cli/options/value_option.h"

namespace popup::cli {
namespace {

constexpr std::string_view kDrawingGroup = "Drawings";

DrawnUse use_of(std::string_view text) {
    const auto* const found = std::find(kDrawnUseNames.begin(), kDrawnUseNames.end(), text);
    if (found != kDrawnUseNames.end()) return static_cast<DrawnUse>(found - kDrawnUseNames.begin());
    const std::vector<std::string_view> names(kDrawnUseNames.begin(), kDrawnUseNames.end());
    throw UsageError(fmt::format("--lines takes USE=LINES, where USE is one of {}, and not \"{}\"",
                                 fmt::join(names, ", "), text),
                     did_you_mean(text, names), names);
}

// "cut=#005cff,fold=creases": each rule a use and how such lines are drawn.
void read_rules(std::string_view text, std::vector<LineRule>& rules) {
    while (true) {
        const std::size_t end = text.find(',');
        const std::string_view rule = text.substr(0, end);
        const std::size_t equals = rule.find('=');
        const DrawnUse use = use_of(rule.substr(0, equals));
        if (equals == std::string_view::npos || equals + 1 == rule.size()) {
            throw UsageError(
                fmt::format("--lines takes USE=LINES, and \"{}\" names no lines", rule),
                {"name a colour, a layer, a class or an id: --lines valley=#0000ff,cut=Contour"});
        }
        rules.push_back({std::string(rule.substr(equals + 1)), use});
        if (end == std::string_view::npos) return;
        text.remove_prefix(end + 1);
    }
}

// "90", or "valley=90", "#ff0000=45", "12=30": how far folds are folded.
FoldOptions::NamedAngle read_fold_angle(std::string_view text) {
    const std::size_t equals = text.rfind('=');
    const std::string_view angle = equals == std::string_view::npos ? text : text.substr(equals + 1);
    const std::string_view name =
        equals == std::string_view::npos ? std::string_view() : text.substr(0, equals);
    std::string lower(name);  // colours are known in lower case
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return {std::move(lower), Angle::degrees(number_option("--fold-angle", angle, 0.0, 180.0))};
}

}  // namespace

void add_drawing_options(CLI::App& verb, Options& options) {
    DrawingOptions& drawing = options.compile.read.drawing;
    const std::string group(kDrawingGroup);
    value(verb, "--as", "WHAT", "what drawings show: parts, card (a pop-up) or folded (any sheet)", group,
          [&drawing](std::string_view text) {
              drawing.as = choose<DrawnAs>(
                  "--as", text,
                  {{"parts", DrawnAs::parts}, {"card", DrawnAs::card}, {"folded", DrawnAs::folded}});
          });
    values(verb, "--lines", "USE=LINES",
           "what lines of a colour, layer, class or id are, as cut=#f00. Repeatable", group,
           [&drawing](std::string_view text) { read_rules(text, drawing.lines); });
    FoldOptions& fold = options.compile.fold;
    values(verb, "--fold-angle", "ANGLE", "how far sheets fold: 120, or valley=45, #ff0000=30. Repeatable",
           group, [&fold](std::string_view text) { fold.fold_angles.push_back(read_fold_angle(text)); });
    value(verb, "--fold-to", "SHARE", "fold sheets to this share of their angles (default: 1)", group,
          [&fold](std::string_view text) { fold.to = number_option("--fold-to", text, 0.01, 1.0); });
    verb.add_flag("--flat", fold.flat,
                  "fold sheets flat, and look for an order of layers; nothing moves then")
        ->group(group);
    value(verb, "--board", "LENGTH",
          "how thick the board of a carton is: moves creases that lack room for it", group,
          [&fold](std::string_view text) { fold.board_mm = length_option("--board", text, 0.01).mm; })
        ->excludes("--flat");
    value(verb, "--merge", "LENGTH",
          "corners of sheets this near are one (default: 0.002mm, more on large ones)", group,
          [&fold](std::string_view text) { fold.merge_mm = length_option("--merge", text, 1e-6).mm; });
    value(verb, "--snap", "LENGTH", "ends of their lines move so far (default: 0.5mm, 1/400 of large sheets)",
          group, [&fold](std::string_view text) { fold.snap_mm = length_option("--snap", text, 0.02).mm; });
    value(verb, "--frame", "N", "which frame of a FOLD file to read (default: its crease pattern)", group,
          [&options](std::string_view text) {
              options.compile.read.frame = static_cast<int>(number_option("--frame", text, 0.0, 1e6));
          });
}

}  // namespace popup::cli
