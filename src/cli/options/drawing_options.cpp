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

}  // namespace

void add_drawing_options(CLI::App& verb, Options& options) {
    DrawingOptions& drawing = options.compile.read.drawing;
    const std::string group(kDrawingGroup);
    value(verb, "--as", "WHAT", "what drawings show: parts (default), or card, a pop-up cut from one sheet",
          group, [&drawing](std::string_view text) {
              drawing.card = choose<bool>("--as", text, {{"parts", false}, {"card", true}});
          });
    values(verb, "--lines", "USE=LINES",
           "what lines of a colour, layer, class or id are, as cut=#f00. Repeatable", group,
           [&drawing](std::string_view text) { read_rules(text, drawing.lines); });
}

}  // namespace popup::cli
