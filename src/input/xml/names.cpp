#include "input/xml/names.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <utility>

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
                                       Name::orientation,
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
                                       Name::t,
                                       Name::on});
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
    std::string_view about;
};

// The mapping table. "colour" is read as "color" everywhere, so it needs no rows of its own.
constexpr std::array kRows = std::to_array<Row>({
    {Name::popup, "popup", "", in({Name::document}), 0,
     "the document: a card with its elements and what is printed on it"},
    {Name::version, "version", "", in({Name::popup}), 0,
     "the version of the document, 2.0 or 3.0; 2.0 where none is given"},
    {Name::units, "units", "unit", in({Name::popup}), 0,
     "the unit of all lengths: in (where none is given), mm, cm, pt or px"},
    {Name::mainpage, "mainpage", "basepage", in({Name::popup}), 0,
     "the base page: the card itself, laid flat"},
    {Name::width, "width", "", in({Name::mainpage, Name::image, Name::argument}), 0,
     "how wide it is, in the document's unit"},
    {Name::height, "height", "", in({Name::mainpage, Name::argument}) | kPlaced, 0,
     "how high it is, in the document's unit"},
    {Name::opens, "opens", "", in({Name::mainpage}), 0,
     "how far the card opens, in degrees; 180 where nothing is given"},
    {Name::orientation, "orientation", "", in({Name::mainpage}), 0,
     "how models of it stand: upright, its spine vertical; flat on a table; or as a stage, its right page on "
     "the ground. Guessed where nothing is given"},
    {Name::leftcolor, "leftcolor", "leftplanecolor", in({Name::mainpage, Name::structure}), 0,
     "colour of the left half"},
    {Name::rightcolor, "rightcolor", "rightplanecolor", in({Name::mainpage, Name::structure}), 0,
     "colour of the right half"},
    {Name::lefttabcolor, "lefttabcolor", "leftgluetabcolor", in({Name::structure}), 0,
     "colour of the left tab"},
    {Name::righttabcolor, "righttabcolor", "rightgluetabcolor", in({Name::structure}), 0,
     "colour of the right tab"},
    {Name::structurelist, "structurelist", "structures", in({Name::popup}), 0,
     "the elements in build order: what an element stands on comes before it"},
    {Name::structure, "structure", "", in({Name::structurelist}), in({Name::structurelist}),
     "an element: a mechanism of the card, or a shape that belongs to one"},
    {Name::type, "type", "", in({Name::structure}), 0,
     "which element it is, by name or by Popup Workshop's number"},
    {Name::id, "id", "", in({Name::structure}), 0,
     "the name of the element, which findings, plates and pieces carry"},
    {Name::outerpoints, "outerpoints", "points", in({Name::structure}), 0,
     "the outer points of the element, in the order of their letters"},
    {Name::point, "point", "outerpoint",
     in({Name::outerpoints, Name::structure, Name::drawnline, Name::argument}),
     in({Name::outerpoints, Name::structure, Name::drawnline, Name::argument}),
     "a point of a page, from its middle: x to the right, y up"},
    {Name::x, "x", "", kPoints | kPlaced | in({Name::argument}), 0,
     "to the right of the middle of the page, in the document's unit"},
    {Name::y, "y", "", kPoints | kPlaced | in({Name::argument}), 0,
     "up from the middle of the page, in the document's unit"},
    {Name::page, "page", "",
     kPoints | kPlaced | in({Name::parentfold, Name::drawnline, Name::argument, Name::area}), 0,
     "the page that it lies on: 0 is the base page, and each glued element adds one for its piece"},
    {Name::parentfold, "parentfold", "", in({Name::structure}), 0,
     "the fold or seam that the element stands on, by two of its points; left is the left-hand side, seen "
     "from begin to end"},
    {Name::parentplate, "parentplate", "", in({Name::structure}), 0,
     "the plate that the element stands on, by any point of it"},
    {Name::d, "d", "", in({Name::argument, Name::area}), 0, "SVG path data in the document's unit, y up"},
    {Name::begin, "begin", "start beginpoint startpoint", in({Name::parentfold}), 0,
     "the point of the fold that one looks from, to tell left from right"},
    {Name::end, "end", "endpoint", in({Name::parentfold}), 0,
     "the point of the fold that one looks to, to tell left from right"},
    {Name::drawnlinelist, "drawnlinelist", "drawnlines", in({Name::popup}), 0,
     "what is printed: lines, pictures, texts and areas"},
    {Name::drawnline, "drawnline", "line", in({Name::drawnlinelist}), in({Name::drawnlinelist}),
     "a line that is printed on a page"},
    {Name::thickness, "thickness", "", in({Name::drawnline}), 0,
     "how thick the line is, in points of 1/72 inch"},
    {Name::color, "color", "linecolor", in({Name::drawnline}), 0, "colour of the line"},
    {Name::image, "image", "picture img", in({Name::drawnlinelist}), in({Name::drawnlinelist}),
     "a picture, a PNG or JPEG file below the folder of the document, with its lower left corner at (x, y)"},
    {Name::text, "text", "caption", in({Name::drawnlinelist}), in({Name::drawnlinelist}),
     "a line of text with its middle at (x, y)"},
    {Name::area, "area", "region", in({Name::drawnlinelist}), in({Name::drawnlinelist}),
     "an area that is printed in one colour"},
    {Name::href, "href", "src file", in({Name::image, Name::argument}), 0,
     "the file, below the folder of the document"},
    {Name::rotate, "rotate", "rotation angle", kPlaced | in({Name::argument}), 0,
     "degrees, counter-clockwise about (x, y)"},
    {Name::mirror, "mirror", "", in({Name::argument}), 0, "whether right is left"},
    {Name::fit, "fit", "", in({Name::image}), 0, "how the picture fills its rectangle"},
    {Name::horizon, "horizon", "", in({Name::image}), 0,
     "where in the picture its horizon is: 0 at the lower edge, 1 at the upper one"},
    {Name::horizonheight, "horizonheight", "", in({Name::image}), 0,
     "how high the horizon is above the base page of the open card"},
    {Name::font, "font", "fontfamily", in({Name::text}), 0, "the kind of letters"},
    {Name::fill, "fill", "fillcolor color", in({Name::text, Name::area}), 0, "colour that it is filled with"},
    {Name::folds, "folds", "", in({Name::structure}), 0, "where the folds are of what is cut from one sheet"},
    {Name::t, "t", "time", in({Name::point}), 0, "when the point was touched"},
    {Name::hole, "hole", "", in({Name::popup}), in({Name::popup}), "a hole through the base page"},
    {Name::on, "on", "", in({Name::parentfold, Name::parentplate}), 0,
     "the fold, seam or plate by its name, such as bird.centre, in place of points"},
    {Name::value, "value", "", kScalars | kPoints | in({Name::argument, Name::text}), 0, "the value itself"},
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
    // By their first letters, shorter ones first.
    std::stable_sort(all.begin(), all.end(), [](const Spelling& a, const Spelling& b) {
        return std::pair(a.text.front(), a.text.size()) < std::pair(b.text.front(), b.text.size());
    });
    return all;
}

// The rows of all names, by their numbers.
std::array<const Row*, 256> all_rows() {
    std::array<const Row*, 256> rows{};
    for (const Row& row : kRows) {
        const Row*& first = rows[static_cast<std::uint8_t>(row.name)];
        if (first == nullptr) first = &row;
    }
    return rows;
}

const Row* row_of(Name name) {
    static const std::array<const Row*, 256> kByName = all_rows();
    return kByName[static_cast<std::uint8_t>(name)];
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
    if (word.empty()) return Name::unknown;
    const auto before = [](const Spelling& a, std::string_view b) {
        return a.text.front() != b.front() ? a.text.front() < b.front() : a.text.size() < b.size();
    };
    auto found = std::lower_bound(kAll.begin(), kAll.end(), word, before);
    for (; found != kAll.end() && !before({word, nullptr}, found->text); ++found) {
        if (found->text == word && (found->row->contexts & in({context})) != 0) return found->row->name;
    }
    return Name::unknown;
}

std::string_view canonical(Name name) {
    if (name == Name::argument) return "value of a structure";
    const Row* row = row_of(name);
    return row ? row->canonical : std::string_view("document");
}

std::string_view about(Name name) {
    const Row* row = row_of(name);
    return row ? row->about : std::string_view();
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
