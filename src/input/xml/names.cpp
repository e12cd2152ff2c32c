#include "input/xml/names.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>

#include "popup/mechanism.h"

namespace popup::xml {
namespace {

constexpr std::uint64_t in(std::initializer_list<Name> contexts) {
    std::uint64_t mask = 0;
    for (const Name context : contexts) mask |= std::uint64_t{1} << static_cast<unsigned>(context);
    return mask;
}
static_assert(static_cast<unsigned>(Name::value) < 64);

// Everything that is a single value.
constexpr std::uint64_t kScalars = in({Name::version,
                                       Name::units,
                                       Name::width,
                                       Name::height,
                                       Name::opens,
                                       Name::leftcolor,
                                       Name::rightcolor,
                                       Name::lefttabcolor,
                                       Name::righttabcolor,
                                       Name::type,
                                       Name::id,
                                       Name::x,
                                       Name::y,
                                       Name::page,
                                       Name::thickness,
                                       Name::color,
                                       Name::d,
                                       Name::href,
                                       Name::rotate,
                                       Name::mirror,
                                       Name::fit,
                                       Name::horizon,
                                       Name::horizonheight,
                                       Name::font,
                                       Name::fill,
                                       Name::t});
// Everything that is one point.
constexpr std::uint64_t kPoints = in({Name::point, Name::begin, Name::end, Name::parentplate});

// What is printed at a place.
constexpr std::uint64_t kPlaced = in({Name::image, Name::text});

struct Row {
    Name name;
    std::string_view canonical;
    std::string_view others;   // separated by blanks; in lower case, without "_" and "-"
    std::uint64_t contexts;    // where it stands
    std::uint64_t repeats_in;  // where it may stand several times
};

// The mapping table. "colour" is read as "color" everywhere, so it needs no rows of its own.
constexpr std::array kRows = std::to_array<Row>({
    {Name::popup, "popup", "", in({Name::document}), 0},
    {Name::version, "version", "", in({Name::popup}), 0},
    {Name::units, "units", "unit", in({Name::popup}), 0},
    {Name::mainpage, "mainpage", "basepage", in({Name::popup}), 0},
    {Name::width, "width", "", in({Name::mainpage, Name::image, Name::argument}), 0},
    {Name::height, "height", "", in({Name::mainpage, Name::argument}) | kPlaced, 0},
    {Name::opens, "opens", "", in({Name::mainpage}), 0},
    {Name::leftcolor, "leftcolor", "leftplanecolor", in({Name::mainpage, Name::structure}), 0},
    {Name::rightcolor, "rightcolor", "rightplanecolor", in({Name::mainpage, Name::structure}), 0},
    {Name::lefttabcolor, "lefttabcolor", "leftgluetabcolor", in({Name::structure}), 0},
    {Name::righttabcolor, "righttabcolor", "rightgluetabcolor", in({Name::structure}), 0},
    {Name::structurelist, "structurelist", "structures", in({Name::popup}), 0},
    {Name::structure, "structure", "", in({Name::structurelist}), in({Name::structurelist})},
    {Name::type, "type", "", in({Name::structure}), 0},
    {Name::id, "id", "", in({Name::structure}), 0},
    {Name::outerpoints, "outerpoints", "points", in({Name::structure}), 0},
    {Name::point, "point", "outerpoint",
     in({Name::outerpoints, Name::structure, Name::drawnline, Name::argument}),
     in({Name::outerpoints, Name::structure, Name::drawnline, Name::argument})},
    {Name::x, "x", "", kPoints | kPlaced | in({Name::argument}), 0},
    {Name::y, "y", "", kPoints | kPlaced | in({Name::argument}), 0},
    {Name::page, "page", "",
     kPoints | kPlaced | in({Name::parentfold, Name::drawnline, Name::argument, Name::area}), 0},
    {Name::parentfold, "parentfold", "", in({Name::structure}), 0},
    {Name::parentplate, "parentplate", "", in({Name::structure}), 0},
    {Name::d, "d", "", in({Name::argument, Name::area}), 0},
    {Name::begin, "begin", "start beginpoint startpoint", in({Name::parentfold}), 0},
    {Name::end, "end", "endpoint", in({Name::parentfold}), 0},
    {Name::drawnlinelist, "drawnlinelist", "drawnlines", in({Name::popup}), 0},
    {Name::drawnline, "drawnline", "line", in({Name::drawnlinelist}), in({Name::drawnlinelist})},
    {Name::thickness, "thickness", "", in({Name::drawnline}), 0},
    {Name::color, "color", "linecolor", in({Name::drawnline}), 0},
    {Name::image, "image", "picture img", in({Name::drawnlinelist}), in({Name::drawnlinelist})},
    {Name::text, "text", "caption", in({Name::drawnlinelist}), in({Name::drawnlinelist})},
    {Name::area, "area", "region", in({Name::drawnlinelist}), in({Name::drawnlinelist})},
    {Name::href, "href", "src file", in({Name::image, Name::argument}), 0},
    {Name::rotate, "rotate", "rotation angle", kPlaced | in({Name::argument}), 0},
    {Name::mirror, "mirror", "", in({Name::argument}), 0},
    {Name::fit, "fit", "", in({Name::image}), 0},
    {Name::horizon, "horizon", "", in({Name::image}), 0},
    {Name::horizonheight, "horizonheight", "", in({Name::image}), 0},
    {Name::font, "font", "fontfamily", in({Name::text}), 0},
    {Name::fill, "fill", "fillcolor color", in({Name::text, Name::area}), 0},
    {Name::folds, "folds", "", in({Name::structure}), 0},
    {Name::t, "t", "time", in({Name::point}), 0},
    {Name::hole, "hole", "", in({Name::popup}), in({Name::popup})},
    {Name::value, "value", "", kScalars | kPoints | in({Name::argument, Name::text}), 0},
});

// Longer than any spelling of the table; longer names are unknown without a look.
constexpr std::size_t kLongest = 24;

struct Spelling {
    std::string_view text;
    const Row* row;
};

// All spellings, sorted.
std::vector<Spelling> all_spellings() {
    std::vector<Spelling> all;
    for (const Row& row : kRows) {
        all.push_back({row.canonical, &row});
        for (std::string_view rest = row.others; !rest.empty();) {
            const std::size_t blank = std::min(rest.find(' '), rest.size());
            all.push_back({rest.substr(0, blank), &row});
            rest.remove_prefix(std::min(blank + 1, rest.size()));
        }
    }
    std::sort(all.begin(), all.end(), [](const Spelling& a, const Spelling& b) { return a.text < b.text; });
    return all;
}

const Row* row_of(Name name) {
    const auto* row = std::find_if(kRows.begin(), kRows.end(),
                                   [&](const Row& candidate) { return candidate.name == name; });
    return row == kRows.end() ? nullptr : &*row;
}

// A name as the table has it; empty when it is longer than all of them.
class Word {
 public:
    explicit Word(std::string_view spelling) {
        for (char c : spelling) {
            if (c == '_' || c == '-') continue;
            if (size_ == buffer_.size()) {
                size_ = 0;
                return;
            }
            c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
            // British spelling: drop the "u" of "colour".
            if (c == 'r' && text().ends_with("colou")) --size_;
            buffer_[size_++] = c;
        }
    }
    [[nodiscard]] std::string_view text() const { return {buffer_.data(), size_}; }

 private:
    std::array<char, kLongest> buffer_{};
    std::size_t size_ = 0;
};

}  // namespace

Name find_name(Name context, std::string_view spelling) {
    static const std::vector<Spelling> kAll = all_spellings();
    const Word plain(spelling);
    const std::string_view word = plain.text();
    auto found = std::lower_bound(kAll.begin(), kAll.end(), word,
                                  [](const Spelling& a, std::string_view b) { return a.text < b; });
    for (; found != kAll.end() && found->text == word; ++found) {
        if (found->row->contexts & in({context})) return found->row->name;
    }
    return Name::unknown;
}

std::string_view canonical(Name name) {
    if (name == Name::argument) return "value of a structure";
    const Row* row = row_of(name);
    return row ? row->canonical : std::string_view("document");
}

std::string_view find_parameter_name(std::string_view spelling) {
    const Word plain(spelling);
    if (plain.text().empty()) return {};
    for (const ElementInfo& info : element_table()) {
        for (const ParameterInfo& parameter : info.parameters) {
            if (parameter.name == plain.text()) return parameter.name;
        }
    }
    return {};
}

bool repeats(Name context, Name name) {
    const Row* row = row_of(name);
    return row && (row->repeats_in & in({context}));
}

bool is_scalar(Name name) { return (kScalars & in({name})) != 0; }

Name home_of(Name context, std::string_view spelling) {
    for (const Name home :
         {Name::popup, Name::mainpage, Name::structurelist, Name::drawnlinelist, Name::structure}) {
        if (home != context && find_name(home, spelling) != Name::unknown) return home;
    }
    return Name::unknown;
}

std::vector<std::string_view> names_in(Name context) {
    std::vector<std::string_view> names;
    for (const Row& row : kRows) {
        if (row.contexts & in({context})) names.push_back(row.canonical);
    }
    if (context != Name::structure && context != Name::folds) return names;
    for (const ElementInfo& info : element_table()) {
        for (const ParameterInfo& parameter : info.parameters) {
            if (std::find(names.begin(), names.end(), parameter.name) == names.end())
                names.push_back(parameter.name);
        }
    }
    return names;
}

}  // namespace popup::xml
