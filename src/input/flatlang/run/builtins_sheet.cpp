// sheet(), and what draws on a sheet of cuts and folds: a crease pattern.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/design_limits.h"
#include "input/flatlang/run/interpreter.h"
#include "input/text.h"

namespace popup::flatlang {
namespace {

constexpr double kMmPerInch = 25.4;
constexpr double kMostFoldDeg = 180.0;
constexpr double kOffSheet = 1e-4;  // units: as far as a vector may leave the plane of the sheet

struct SheetUse {
    CreaseUse use = CreaseUse::cut;
};
constexpr SheetUse kCutUse{CreaseUse::cut};
constexpr SheetUse kMountainUse{CreaseUse::mountain};
constexpr SheetUse kValleyUse{CreaseUse::valley};
constexpr SheetUse kCreaseUse{CreaseUse::fold};

// Ends the program; does not return. `what` goes on behind the builtin's name.
void refuse_sheet(const Call& call, std::string_view what, std::string hint) {
    call.in.fail(call.place, fmt::format("{}() {}", call.name, what), std::move(hint));
}

// sheet(), sheet("mm")
Value begin_sheet(const Call& call) {
    Interpreter& in = call.in;
    if (in.as_2008()) return in.heap.nil();
    if (in.result.sheet) {
        refuse_sheet(call, fmt::format("was called before, on line {}", in.result.sheet->place.line),
                     "a program makes one sheet, of as many pieces as it is cut into");
    }
    ProgramSheet sheet;
    sheet.place = in.program_place(call.place);
    if (!call.arguments.empty()) {
        const Value& unit = call.arguments[0];
        if (unit->type != Type::text || (unit->text != "mm" && unit->text != "inch")) {
            in.fail_argument(call, 0,
                             fmt::format("argument 1 of sheet() is {}, which is no unit of its points",
                                         unit->type == Type::text ? fmt::format("\"{}\"", shown(unit->text))
                                                                  : std::string(type_name(unit->type))),
                             "write sheet(\"mm\"), or sheet() for inches");
        }
        if (unit->text == "mm") sheet.unit_mm = 1.0;
    }
    sheet.pattern.ruler.unit = sheet.unit_mm == 1.0 ? "mm" : "in";
    sheet.pattern.ruler.per_mm = 1.0 / sheet.unit_mm;
    in.result.sheet = std::move(sheet);
    return in.heap.nil();
}

// The points of the arguments, in their order: vectors, lists of two numbers, and lists of points.
class SheetPoints {
 public:
    SheetPoints(const Call& call, double unit_mm) : call_(call), unit_mm_(unit_mm) {}

    std::vector<Vec2> take(std::size_t count) {
        for (argument_ = 0; argument_ < count; ++argument_) {
            const Value& value = call_.arguments[argument_];
            const bool of_points = value->type == Type::list && value->first &&
                                   (value->first->type == Type::list || value->first->type == Type::vec);
            if (!of_points) {
                add(value);
                continue;
            }
            for (const Value* one = &value->first; *one; one = &(*one)->next) add(*one);
        }
        call_.in.spend(points_.size());
        return std::move(points_);
    }

 private:
    void add(const Value& value) {
        std::array<double, 2> numbers{};
        if (value->type == Type::vec) {
            const auto& of = value->extras->numbers;
            if (!(std::abs(of[2]) <= kOffSheet))
                wrong(fmt::format("a point {:.6g} above the sheet", of[2]), "z is 0 on a sheet");
            numbers = {of[0], of[1]};
        } else if (value->type == Type::list) {
            std::size_t count = 0;
            for (const Value* one = &value->first; *one; one = &(*one)->next, ++count) {
                if ((*one)->type != Type::number)
                    wrong(fmt::format("{} in a point", type_name((*one)->type)), "a point is [x, y]");
                if (count < 2) numbers[count] = (*one)->number;
            }
            if (count != 2) wrong(fmt::format("a point of {} numbers", count), "a point is [x, y]");
        } else {
            wrong(std::string(type_name(value->type)),
                  "points are [x, y], and the angle of a fold comes last");
        }
        const Vec2 at{numbers[0] * unit_mm_, numbers[1] * unit_mm_};
        if (!(std::abs(at.x) <= kCoordinateLimit && std::abs(at.y) <= kCoordinateLimit)) {
            wrong("a point too far off",
                  fmt::format("coordinates are at most {:.6g}", kCoordinateLimit / unit_mm_));
        }
        points_.push_back(at);
    }

    void wrong(const std::string& what, std::string hint) {
        call_.in.fail_argument(call_, argument_,
                               fmt::format("argument {} of {}() has {}", argument_ + 1, call_.name, what),
                               std::move(hint));
    }

    const Call& call_;
    double unit_mm_;
    std::size_t argument_ = 0;
    std::vector<Vec2> points_;
};

// cutline(points…); mountain(points… [, degrees]) and so valley() and crease()
Value draw_on_sheet(const Call& call) {
    Interpreter& in = call.in;
    if (in.as_2008()) return in.heap.nil();
    if (!in.result.sheet) refuse_sheet(call, "has no sheet to draw on", "call sheet() before it");
    ProgramSheet& sheet = *in.result.sheet;
    CreaseLine line;
    line.use = static_cast<const SheetUse*>(call.data)->use;
    line.place = in.program_place(call.place);
    std::size_t count = call.arguments.size();
    if (line.use != CreaseUse::cut && call.arguments[count - 1]->type == Type::number) {
        --count;
        const double deg = call.arguments[count]->number;
        if (!(deg >= 0.0 && deg <= kMostFoldDeg)) {
            in.fail_argument(call, count,
                             fmt::format("argument {} of {}() is {:.6g}, where an angle from 0 to 180 "
                                         "degrees is expected",
                                         count + 1, call.name, deg),
                             "");
        }
        line.fold_deg = deg;
    }
    line.points = SheetPoints(call, sheet.unit_mm).take(count);
    if (line.points.size() < 2) {
        refuse_sheet(call,
                     fmt::format("is given {} point{}, and a line has two at least", line.points.size(),
                                 line.points.size() == 1 ? "" : "s"),
                     "");
    }
    sheet.points += line.points.size();
    if (sheet.points > kPointsLimit)
        refuse_sheet(call, fmt::format("would be the sheet's {}th point", kPointsLimit + 1), "");
    if (line.points.size() > 3 && line.points.front() == line.points.back()) {
        line.points.pop_back();
        line.closed = true;
    }
    line.name = kCreaseUseNames.at(static_cast<std::size_t>(line.use));
    sheet.pattern.lines.push_back(std::move(line));
    return in.heap.nil();
}

constexpr std::array kSheetBuiltins{
    Builtin{"sheet", 0, 1, begin_sheet, nullptr,
            "sheet(), sheet(\"mm\"): begins a sheet of cuts and folds, in inches or in mm"},
    Builtin{
        "cutline", 1, -1, draw_on_sheet, &kCutUse,
        "cutline([x, y], [x, y], ...): cuts the sheet along a line; one that ends where it begins is closed"},
    Builtin{
        "mountain", 1, -1, draw_on_sheet, &kMountainUse,
        "mountain([x, y], [x, y], ..., degrees): folds the sheet away from who looks at it, by 90 degrees "
        "unless others are given"},
    Builtin{"valley", 1, -1, draw_on_sheet, &kValleyUse,
            "valley([x, y], [x, y], ..., degrees): folds the sheet towards who looks at it, by 90 degrees "
            "unless others are given"},
    Builtin{"crease", 1, -1, draw_on_sheet, &kCreaseUse,
            "crease([x, y], [x, y], ..., degrees): folds the sheet as the folds around it ask for"},
};

}  // namespace

std::span<const Builtin> sheet_builtins() { return kSheetBuiltins; }

}  // namespace popup::flatlang
