#include "input/xml/names.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>

namespace popup::xml {
namespace {

constexpr std::uint32_t in(std::initializer_list<Name> contexts) {
    std::uint32_t mask = 0;
    for (const Name context : contexts) mask |= 1U << static_cast<unsigned>(context);
    return mask;
}
static_assert(static_cast<unsigned>(Name::value) < 32);

// Everything that is a single value.
constexpr std::uint32_t kScalars = in({Name::version, Name::units, Name::width, Name::height, Name::leftcolor,
                                       Name::rightcolor, Name::lefttabcolor, Name::righttabcolor, Name::type,
                                       Name::id, Name::x, Name::y, Name::page, Name::thickness, Name::color});
// Everything that is one point.
constexpr std::uint32_t kPoints = in({Name::point, Name::begin, Name::end});

struct Row {
    Name name;
    std::string_view canonical;
    std::string_view others;   // separated by blanks; in lower case, without "_" and "-"
    std::uint32_t contexts;    // where it stands
    std::uint32_t repeats_in;  // where it may stand several times
};

// The mapping table. "colour" is read as "color" everywhere, so it needs no rows of its own.
constexpr std::array kRows = std::to_array<Row>({
    {Name::popup, "popup", "", in({Name::document}), 0},
    {Name::version, "version", "", in({Name::popup}), 0},
    {Name::units, "units", "unit", in({Name::popup}), 0},
    {Name::mainpage, "mainpage", "basepage", in({Name::popup}), 0},
    {Name::width, "width", "", in({Name::mainpage}), 0},
    {Name::height, "height", "", in({Name::mainpage}), 0},
    {Name::leftcolor, "leftcolor", "leftplanecolor", in({Name::mainpage, Name::structure}), 0},
    {Name::rightcolor, "rightcolor", "rightplanecolor", in({Name::mainpage, Name::structure}), 0},
    {Name::lefttabcolor, "lefttabcolor", "leftgluetabcolor", in({Name::structure}), 0},
    {Name::righttabcolor, "righttabcolor", "rightgluetabcolor", in({Name::structure}), 0},
    {Name::structurelist, "structurelist", "structures", in({Name::popup}), 0},
    {Name::structure, "structure", "", in({Name::structurelist}), in({Name::structurelist})},
    {Name::type, "type", "", in({Name::structure}), 0},
    {Name::id, "id", "", in({Name::structure}), 0},
    {Name::outerpoints, "outerpoints", "points", in({Name::structure}), 0},
    {Name::point, "point", "outerpoint", in({Name::outerpoints, Name::structure, Name::drawnline}),
     in({Name::outerpoints, Name::structure, Name::drawnline})},
    {Name::x, "x", "", kPoints, 0},
    {Name::y, "y", "", kPoints, 0},
    {Name::page, "page", "", kPoints | in({Name::parentfold, Name::drawnline}), 0},
    {Name::parentfold, "parentfold", "", in({Name::structure}), 0},
    {Name::begin, "begin", "start beginpoint startpoint", in({Name::parentfold}), 0},
    {Name::end, "end", "endpoint", in({Name::parentfold}), 0},
    {Name::drawnlinelist, "drawnlinelist", "drawnlines", in({Name::popup}), 0},
    {Name::drawnline, "drawnline", "line", in({Name::drawnlinelist}), in({Name::drawnlinelist})},
    {Name::thickness, "thickness", "", in({Name::drawnline}), 0},
    {Name::color, "color", "linecolor", in({Name::drawnline}), 0},
    {Name::value, "value", "", kScalars | kPoints, 0},
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

}  // namespace

Name find_name(Name context, std::string_view spelling) {
    static const std::vector<Spelling> kAll = all_spellings();
    std::array<char, kLongest> buffer{};
    std::size_t size = 0;
    for (char c : spelling) {
        if (c == '_' || c == '-') continue;
        if (size == buffer.size()) return Name::unknown;
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        // British spelling: drop the "u" of "colour".
        if (c == 'r' && std::string_view(buffer.data(), size).ends_with("colou")) --size;
        buffer[size++] = c;
    }
    const std::string_view word(buffer.data(), size);
    auto found = std::lower_bound(kAll.begin(), kAll.end(), word,
                                  [](const Spelling& a, std::string_view b) { return a.text < b; });
    for (; found != kAll.end() && found->text == word; ++found) {
        if (found->row->contexts & in({context})) return found->row->name;
    }
    return Name::unknown;
}

std::string_view canonical(Name name) {
    const Row* row = row_of(name);
    return row ? row->canonical : std::string_view("document");
}

bool repeats(Name context, Name name) {
    const Row* row = row_of(name);
    return row && (row->repeats_in & in({context}));
}

bool is_scalar(Name name) { return (kScalars & in({name})) != 0; }

std::vector<std::string_view> names_in(Name context) {
    std::vector<std::string_view> names;
    for (const Row& row : kRows) {
        if (row.contexts & in({context})) names.push_back(row.canonical);
    }
    return names;
}

}  // namespace popup::xml
