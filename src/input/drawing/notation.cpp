#include "input/drawing/notation.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/nth.h"
#include "base/text/nearest.h"
#include "base/text/shown.h"
#include "input/color.h"
#include "input/drawing/fold_like.h"
#include "input/text.h"

namespace popup::drawing {
namespace {

// In English, German, French, Spanish and Italian, without accents, with a blank before and behind each.
constexpr std::array<std::pair<Named, std::string_view>, 7> kWords{{
    {Named::cut,
     " cut cuts cutting cutline cutlines knife outline outlines border contour contours "
     "trim slit slits profile profiles diecut throughcut thrucut "
     "schnitt schnitte schnittlinie schnittlinien schneiden schneidlinie schneidlinien schneidelinie "
     "schneidelinien stanzen stanzlinie stanzlinien stanzkontur kontur konturen umriss "
     "coupe coupes couper decoupe decoupes decouper corte cortes cortar taglio tagli tagliare "},
    {Named::fold,
     " fold folds folding foldline foldlines crease creases score scores scored scoring "
     "halfcut perf perforation perforations gutter spine hinge hinges creasing "
     "creaseline creaselines creased scoreline scorelines bend bends bending bendline "
     "bendlines perforated perfs cutcrease perfcrease "
     "falz falze falzen falzlinie falzlinien falte falten faltlinie faltlinien rille rillen rillung "
     "rilllinie rilllinien ritzen ritzlinie ritzlinien knick knicklinie biegelinie biegelinien "
     "perforieren perforierung pli plis pliage pliages rainage rainages rainer rainure rainures "
     "pliegue pliegues doblez dobleces hendido hendidos piega pieghe cordonatura cordonature "},
    {Named::mountain,
     " mountain mountains berg berge bergfalz bergfalte bergfalten montagne montagnes montana monte "},
    {Named::valley, " valley valleys tal talfalz talfalte talfalten vallee vallees valle "},
    {Named::hole,
     " hole holes window windows cutout cutouts opening openings "
     "loch locher loecher fenster ausschnitt ausschnitte trou trous fenetre fenetres "
     "agujero agujeros ventana ventanas foro fori finestra finestre "},
    {Named::print,
     " print prints printed artwork draw engrave engraving "
     "druck drucken gravur gravieren impression imprimer gravure impresion stampa "},
    {Named::ignore,
     " guide guides guidelines note notes dimension dimensions label labels glue seam "
     "bleed safety varnish gluearea glueing gluing annotation annotations construction "
     "dim dims tangent registration regmarks mark marks legend "
     "hilfslinie hilfslinien notiz notizen bemassung klebeflache klebeflaeche kleben anschnitt "
     "legende repere reperes cotation colle collage notas cotas colla "},
}};

constexpr std::array<Named, 6> kNamedOfUse{Named::cut,    Named::fold,  Named::mountain,
                                           Named::valley, Named::print, Named::ignore};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// The letters of Latin-1 from 0xC0 on, without what is above or below them; a blank for what is none. The
// sharp s is two.
constexpr unsigned kSharpS = 0xDF;
constexpr std::string_view kBareLetters = "AAAAAAACEEEEIIIIDNOOOOO OUUUUYTsaaaaaaaceeeeiiiidnooooo ouuuuyty";

std::string_view bare(unsigned code) {
    if (code == kSharpS) return "ss";
    return code >= 0xC0 && code <= 0xFF ? kBareLetters.substr(code - 0xC0, 1) : " ";
}

// "Découpe" and "De\u0301coupe" become "Decoupe"; other characters beyond ASCII stay.
std::string without_accents(std::string_view text) {
    std::string made;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
        const bool pair = (next & 0xC0U) == 0x80U;
        if (pair && byte == 0xC3) {
            made += bare(0xC0U + (next & 0x3FU));
            ++i;
        } else if (pair && (byte == 0xCC || (byte == 0xCD && next < 0xB0))) {
            ++i;  // an accent by itself
        } else {
            made += text[i];
        }
    }
    return made;
}

// Illustrator and CorelDRAW write what an id must not have as "_x0020_".
std::string decoded(std::string_view name) {
    std::string made;
    while (!name.empty()) {
        if (name.size() >= 4 && name[0] == '_' && (name[1] == 'x' || name[1] == 'X')) {
            const std::size_t end = name.find('_', 2);
            const std::string_view digits = name.substr(2, end == std::string_view::npos ? end : end - 2);
            unsigned code = 0;
            const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
            if (end != std::string_view::npos && !digits.empty() && digits.size() <= 4 &&
                read.ptr == digits.data() + digits.size()) {
                made += bare(code);
                name.remove_prefix(end + 1);
                continue;
            }
        }
        made += name.front();
        name.remove_prefix(1);
    }
    return without_accents(made);
}

// Calls `use` with each stretch of letters; a capital behind a small letter begins another.
template <typename Use>
void each_word(std::string_view name, Use use) {
    std::string word;
    char before = ' ';
    for (const char c : name) {
        const bool camel = c >= 'A' && c <= 'Z' && before >= 'a' && before <= 'z';
        if ((!is_letter(c) || camel) && !word.empty()) {
            use(word);
            word.clear();
        }
        if (is_letter(c)) word += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        before = c;
    }
    if (!word.empty()) use(word);
}

// Several words together: "mountain folds" are mountains, "half cuts" folds, and "cuts and folds" say
// nothing. A sheet that is bent up, towards who looks at it, has a valley fold there.
Named together(const std::array<bool, 8>& said) {
    const auto has = [&](Named named) { return nth(said, named); };
    const bool fold = has(Named::fold) || has(Named::mountain) || has(Named::valley);
    if (has(Named::ignore)) return Named::ignore;
    if (has(Named::hole)) return Named::hole;
    if (has(Named::cut) && fold) return Named::nothing;
    if (has(Named::mountain) != has(Named::valley))
        return has(Named::mountain) ? Named::mountain : Named::valley;
    if (fold) return Named::fold;
    if (has(Named::cut)) return Named::cut;
    return has(Named::print) ? Named::print : Named::nothing;
}

Use use_of(Named named) {
    switch (named) {
        case Named::nothing:
        case Named::cut:
        case Named::hole:
            return Use::cut;
        case Named::mountain:
            return Use::mountain;
        case Named::fold:
        case Named::valley:
            return Use::valley;
        case Named::print:
        case Named::ignore:
            return Use::print;
    }
    return Use::cut;
}

// The colours of lines, the most frequent first; at most eight.
std::vector<std::string> colors_of(const std::vector<TracedLine>& lines) {
    constexpr std::size_t kMost = 8;
    std::map<std::string, std::size_t> counts;
    for (const TracedLine& line : lines) {
        if (line.use != Use::shape) ++counts[to_string(line.color)];
    }
    std::vector<std::string> colors;
    colors.reserve(counts.size());
    for (const auto& [color, count] : counts) colors.push_back(color);
    std::stable_sort(colors.begin(), colors.end(), [&counts](const std::string& a, const std::string& b) {
        return counts.at(a) > counts.at(b);
    });
    if (colors.size() > kMost) colors.resize(kMost);
    return colors;
}

// The name that was meant, or those that there are.
void tell_names(std::string_view word, const std::vector<std::string>& names, Diagnostic& unused) {
    if (names.empty()) return;
    std::vector<std::string> lowered;
    lowered.reserve(names.size());
    for (const std::string& name : names) lowered.push_back(lower(name));
    const std::vector<std::string> meant =
        nearest(word, std::vector<std::string_view>(lowered.begin(), lowered.end()), 1);
    if (!meant.empty()) {
        const auto at = std::find(lowered.begin(), lowered.end(), meant.front()) - lowered.begin();
        unused.hint(fmt::format("did you mean \"{}\"?", shown(names[static_cast<std::size_t>(at)])));
    }
    constexpr std::size_t kMost = 8;
    std::vector<std::string> told;
    for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
        told.push_back(fmt::format("\"{}\"", shown(names[i])));
    const std::string more = names.size() > kMost ? fmt::format(" and {} more", names.size() - kMost) : "";
    unused.hint(fmt::format("names here are {}{}", fmt::join(told, ", "), more));
}

// A machine's layers are whatever its profile calls them: what they mean is not in the sheet.
void tell_machine(const Tracing& tracing, Diagnostics& diagnostics) {
    const auto first = std::find_if(tracing.lines.begin(), tracing.lines.end(),
                                    [](const TracedLine& line) { return line.of_machine && !line.ruled; });
    if (first == tracing.lines.end()) return;
    diagnostics
        .warning(
            "machine-sheet", nth(tracing.elements, first->element).place,
            "popupc made this sheet for a machine: its folds and marks are read as cuts, and its cuts may "
            "be off by half a kerf")
        .hint("read the design, or the sheet that --profile workshop makes of it")
        .hint("--lines says what its lines are, such as --lines fold=score,ignore=mark");
}

}  // namespace

void LineRules::meet(std::string_view name) {
    constexpr std::size_t kMost = 200;
    if (rules_.empty() || names_.size() == kMost) return;
    std::string text = short_name(name);
    if (text.empty() || std::find(names_.begin(), names_.end(), text) != names_.end()) return;
    names_.push_back(std::move(text));
}

LineRules::LineRules(const std::vector<LineRule>& rules) {
    for (const LineRule& rule : rules) {
        Rule& made = rules_.emplace_back();
        made.word = lower(trimmed(rule.name));
        made.bare = lower(without_accents(made.word));
        made.named = nth(kNamedOfUse, rule.use);
        const Paint paint = parse_paint(rule.name);
        if (paint.kind == Paint::Kind::color) made.color = paint.color;
        made.text = fmt::format("{}={}", kDrawnUseNames.at(static_cast<std::size_t>(rule.use)), rule.name);
    }
}

void LineRules::follow(std::initializer_list<std::string_view> names, Said& said, int met) {
    bool own = false;
    for (const std::string_view name : names) {
        if (met-- > 0) meet(name);
        const Said told = said_by(name);
        if (told.rule) {
            if (!said.rule || *told.rule < *said.rule) said = told;
        } else if (told.named != Named::nothing && !said.rule && !own) {
            said = told;
            own = true;
        }
    }
}

Said LineRules::said_by(std::string_view name) const {
    if (name.empty()) return {};
    const std::string text = decoded(name);
    std::vector<std::string> words;
    each_word(text, [&](const std::string& word) { words.push_back(word); });
    for (std::size_t i = 0; i < rules_.size(); ++i) {
        const Rule& rule = rules_[i];
        if (rule.word == lower(trimmed(name)) || rule.bare == lower(trimmed(text)) ||
            std::find(words.begin(), words.end(), rule.bare) != words.end()) {
            return {rule.named, i, false};
        }
    }
    std::array<bool, 8> said{};
    const auto has = [&words](std::string_view word) {
        return std::find(words.begin(), words.end(), word) != words.end();
    };
    for (const std::string& word : words) {
        for (const auto& [named, all] : kWords) {
            if (all.find(" " + word + " ") != std::string_view::npos) nth(said, named) = true;
        }
    }
    if (has("half") && nth(said, Named::cut)) return {Named::fold, std::nullopt, false};
    const Named named = together(said);
    if (named == Named::fold && has("up") != has("down"))
        return {has("up") ? Named::valley : Named::mountain, std::nullopt, false};
    const bool perforated = std::any_of(words.begin(), words.end(), [](const std::string& word) {
        return word.starts_with("perf") && word != "perfcrease";
    });
    return {named, std::nullopt, named == Named::fold && perforated};
}

void LineRules::say(const Said& names, const Paint& stroke, TracedLine& line) {
    line.named = names.named;
    line.perforated = names.perforated;
    std::optional<std::size_t> rule = names.rule;
    const std::size_t end = std::min(rule.value_or(rules_.size()), rules_.size());
    for (std::size_t i = 0; i < end && stroke.kind == Paint::Kind::color; ++i) {
        if (rules_[i].color != stroke.color) continue;
        rule = i;
        break;
    }
    line.ruled = rule.has_value();
    if (!rule) return;
    line.named = rules_[*rule].named;
    line.perforated = false;
    rules_[*rule].used = true;
}

void LineRules::tell_unused(const std::vector<TracedLine>& lines, Diagnostics& diagnostics) const {
    std::vector<std::string> colors;
    for (const Rule& rule : rules_) {
        if (rule.used) continue;
        if (colors.empty()) colors = colors_of(lines);
        Diagnostic& unused = diagnostics.remark(
            "lines-not-found", {},
            fmt::format("--lines {} fits no line here: none has this colour, or this word in its "
                        "layer, class or id, "
                        "that no earlier rule fits",
                        rule.text));
        if (!rule.color) tell_names(rule.word, names_, unused);
        unused.hint(colors.empty() ? std::string("there are no lines here")
                                   : fmt::format("lines here have the colours {}", fmt::join(colors, ", ")));
    }
}

Hue hue_of(Color color) {
    const int r = color.r;
    const int g = color.g;
    const int b = color.b;
    const int most = std::max({r, g, b});
    const int range = most - std::min({r, g, b});
    // Greys, and what is nearly black.
    if (range < 60 || 3 * range < most) return Hue::dark;
    double sector = 0.0;  // of 6, from red
    if (most == r)
        sector = static_cast<double>(g - b) / range;
    else if (most == g)
        sector = 2.0 + static_cast<double>(b - r) / range;
    else
        sector = 4.0 + static_cast<double>(r - g) / range;
    if (sector < 0.0) sector += 6.0;
    if (sector < 0.35 || sector >= 5.6) return Hue::red;
    if (sector >= 0.8 && sector < 1.25) return Hue::yellow;
    if (sector >= 1.5 && sector < 2.7) return Hue::green;
    if (sector >= 3.4 && sector < 4.4) return Hue::blue;
    if (sector >= 4.7) return Hue::magenta;
    return Hue::other;
}

namespace {

std::string_view name_of(Color color) {
    constexpr std::array<std::string_view, 7> kHues{"",     "red",     "yellow",  "green",
                                                    "blue", "magenta", "coloured"};
    const Hue hue = hue_of(color);
    if (hue != Hue::dark) return nth(kHues, hue);
    const int most = std::max({color.r, color.g, color.b});
    return most < 80 ? "black" : most < 250 ? "grey" : "white";
}

}  // namespace

std::string shown_stroke(const TracedLine& line) {
    constexpr std::array<std::string_view, 3> kDashes{"solid", "dashed", "dash-dotted"};
    return fmt::format("{} {} ({})", nth(kDashes, line.dash), name_of(line.color), to_string(line.color));
}

void settle_uses(Tracing& tracing, Diagnostics& diagnostics) {
    const bool simulator = has_simulator_colors(tracing);
    const auto told = [&tracing](const TracedLine& line) {
        return line.ruled || (tracing.by_layers && line.named != Named::nothing);
    };
    for (TracedLine& line : tracing.lines) {
        if (line.owner > 0 || line.use == Use::shape) continue;
        if (told(line)) {
            line.use = use_of(line.named);
        } else if (simulator && line.dash != Dash::none) {
            const Hue hue = hue_of(line.color);
            if (hue == Hue::blue) line.use = Use::valley;
            if (hue == Hue::red) line.use = Use::mountain;
        }
    }
    // On sheets of this program layers say what they are, too; folds keep theirs.
    std::erase_if(tracing.lines, [&](const TracedLine& line) {
        return line.named == Named::ignore && (told(line) || (tracing.own_sheet && line.use == Use::cut));
    });
    tell_fold_like(tracing, diagnostics);
    tell_machine(tracing, diagnostics);
}

}  // namespace popup::drawing
