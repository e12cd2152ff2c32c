// What lines of drawings mean: by rules that the caller gives, by the names of layers, classes and ids, and
// by colours and dashes.
//
// Origami Simulator's colours are those of many: red mountain, blue valley, green cut, yellow flat, magenta
// hinge. The notation `workshop` of this program's own sheets has dashed blue for mountains and dashed
// magenta for valleys.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/drawing/style.h"
#include "parts/tracing.h"
#include "popup/diagnostics.h"
#include "popup/language.h"

namespace popup::drawing {

// What a name says, and by which rule of the caller, where there is one.
struct Said {
    Named named = Named::nothing;
    std::optional<std::size_t> rule;
    bool perforated = false;  // a fold, because perforations mostly are
};

// The rules of DrawingOptions, and below them the words that people call layers: cut, folds, mountain,
// valley, score, half cut, bend up, windows; also in German, French, Spanish and Italian. Words are stretches
// of letters, so that "Mountain_x0020_folds-2" has two of them, whatever their case and accents.
class LineRules {
 public:
    explicit LineRules(const std::vector<LineRule>& rules);
    [[nodiscard]] Said said_by(std::string_view name) const;
    // Of an element with these names, the weightiest first, in one of which that was said: the first that
    // says something counts, and above all names the first rule that fits one. The first `met` names are met.
    void follow(std::initializer_list<std::string_view> names, Said& said, int met);
    // What the names of a line say, or the first rule that fits its colour or a name of it.
    void say(const Said& names, const Paint& stroke, TracedLine& line);
    // A name that a rule could have: of a layer, a class or a group. Only where there are rules it is kept.
    void meet(std::string_view name);
    // Adds a `lines-not-found` remark for each rule that has said nothing of any line, with the names that
    // were met, or the nearest of them, and the colours that lines have.
    void tell_unused(const std::vector<TracedLine>& lines, Diagnostics& diagnostics) const;

 private:
    struct Rule {
        std::string word;  // in lower case
        std::string bare;  // and without accents
        std::optional<Color> color;
        Named named = Named::nothing;
        std::string text;  // as it was given
        bool used = false;
    };
    std::vector<Rule> rules_;
    std::vector<std::string> names_;  // that were met, each once, as they came
};

// The colours that notations have, each with all that is nearest to it: #ed1c24 is red, too.
enum class Hue { dark, red, yellow, green, blue, magenta, other };
Hue hue_of(Color color);

// "dashed blue (#0000ff)".
std::string shown_stroke(const TracedLine& line);

// Of a drawing of flat parts: gives lines the uses that the rules, or its layers (Tracing::by_layers), say,
// takes out those that are nothing of the sheet, on sheets of this program by their layers too, and reads
// dashed red and blue as Origami Simulator does where the drawing has its colours. Lines that look like folds
// and are cuts are a `folds-as-cuts` warning.
void settle_uses(Tracing& tracing, Diagnostics& diagnostics);

}  // namespace popup::drawing
