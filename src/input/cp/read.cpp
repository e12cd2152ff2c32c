#include "input/cp/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "input/text.h"

namespace popup::cp {
namespace {

constexpr double kFoldedDeg = 180.0;
// As large as numbers may be; what is made of them is 200 mm long.
constexpr double kLargest = 1e9;
constexpr std::size_t kLines = 1'000'000;
constexpr int kToldAtMost = 10;
constexpr std::size_t kNumbers = 5;

struct Row {
    std::array<double, kNumbers> numbers{};
    std::size_t count = 0;   // of numbers that were read
    std::string_view wrong;  // a word that is none
    std::size_t at = 0;      // where that is, or what follows the fifth: bytes from the line's begin
    bool more = false;
};

// The numbers of a line, with blanks or commas between them.
Row numbers_of(std::string_view line) {
    Row row;
    const std::string_view between = " \t\r,\v\f";
    std::size_t at = 0;
    while ((at = line.find_first_not_of(between, at)) != std::string_view::npos) {
        const std::size_t end = std::min(line.find_first_of(between, at), line.size());
        std::string_view word = line.substr(at, end - at);
        row.at = at;
        if (row.count == kNumbers) {
            row.more = true;
            return row;
        }
        if (word.starts_with('+')) word.remove_prefix(1);
        double& number = row.numbers.at(row.count);
        const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (error != std::errc{} || stop != word.data() + word.size() || !(std::abs(number) <= kLargest)) {
            row.wrong = line.substr(at, end - at);
            return row;
        }
        ++row.count;
        at = end;
    }
    return row;
}

std::optional<CreaseUse> use_of(double kind) {
    constexpr std::array kUses{CreaseUse::flat, CreaseUse::cut, CreaseUse::mountain, CreaseUse::valley,
                               CreaseUse::flat};
    for (std::size_t i = 0; i < kUses.size(); ++i) {
        if (kind == static_cast<double>(i)) return kUses.at(i);
    }
    return std::nullopt;
}

class Reader {
 public:
    Reader(const Source& source, Diagnostics& diagnostics) : text_(source.text), diagnostics_(diagnostics) {
        out_.file = source.name;
        out_.stem = source.stem();
        out_.fold_deg = kFoldedDeg;
    }

    std::optional<CreasePattern> run() {
        std::string_view rest = text_;
        if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
        for (int number = 1; !rest.empty() && told_ < kToldAtMost; ++number) {
            const std::size_t end = std::min(rest.find('\n'), rest.size());
            read_line(rest.substr(0, end), number);
            if (out_.lines.size() > kLines) {
                wrong({number, 1}, "document-too-large",
                      fmt::format("the pattern has more than {} lines", kLines));
                break;
            }
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
        if (told_ > 0) return std::nullopt;
        if (out_.lines.empty()) {
            diagnostics_.error("cp-no-pattern", {}, "the file has no lines that are cut or folded")
                .hint("each line of it is \"KIND X1 Y1 X2 Y2\"");
            return std::nullopt;
        }
        set_size();
        return std::move(out_);
    }

 private:
    void wrong(Place place, std::string_view code, std::string what) {
        ++told_;
        diagnostics_.error(code, place, std::move(what))
            .hint(
                "a line is \"KIND X1 Y1 X2 Y2\": 1 for edges and cuts, 2 for mountains, 3 for valleys, 4 "
                "for what is not folded");
    }

    void read_line(std::string_view line, int number) {
        const std::string_view words = trimmed(line);
        if (words.empty() || words.starts_with('#')) return;
        const Row row = numbers_of(line);
        const Place place{number, static_cast<int>(row.at) + 1};
        if (!row.wrong.empty())
            return wrong(place, "cp-value",
                         fmt::format("\"{}\" is not a number, or larger than 1e9", shown(row.wrong)));
        if (row.more || row.count < kNumbers) {
            return wrong(place, "cp-value",
                         row.more ? std::string("this line has more than five numbers")
                                  : fmt::format("this line has {} number{}, and not five", row.count,
                                                row.count == 1 ? "" : "s"));
        }
        const Place begin{number, static_cast<int>(line.find_first_not_of(" \t")) + 1};
        const auto use = use_of(row.numbers[0]);
        if (!use) {
            return wrong(begin, "cp-value",
                         fmt::format("there is no line of kind {:g}: kinds go from 0 to 4", row.numbers[0]));
        }
        // Down the page, in those programs.
        const Vec2 a{row.numbers[1], -row.numbers[2]};
        const Vec2 b{row.numbers[3], -row.numbers[4]};
        if (a == b) return;
        out_.lines.push_back({{a, b}, false, *use, {}, begin, std::to_string(number)});
    }

    void set_size() {
        Box box;
        for (const CreaseLine& line : out_.lines) {
            for (const Vec2 p : line.points) box.extend(p);
        }
        const double longer = std::max(box.width(), box.height());
        const double mm = kSheetMm / longer;
        for (CreaseLine& line : out_.lines) {
            for (Vec2& p : line.points) p = mm * p;
        }
        out_.ruler = {{}, 1.0 / mm, true, ""};
        diagnostics_
            .remark("cp-size", {},
                    fmt::format("the pattern has no unit: its longer side of {:g} was made {:g} mm long",
                                longer, kSheetMm))
            .hint("--scale makes it larger or smaller");
    }

    std::string_view text_;
    Diagnostics& diagnostics_;
    int told_ = 0;
    CreasePattern out_;
};

}  // namespace

std::optional<CreasePattern> read(const Source& source, const ReadOptions& /*options*/,
                                  Diagnostics& diagnostics) {
    return Reader(source, diagnostics).run();
}

bool recognises(std::string_view text) {
    text = trimmed(text);
    const Row row = numbers_of(text.substr(0, text.find('\n')));
    return row.count == kNumbers && row.wrong.empty() && !row.more && use_of(row.numbers[0]).has_value();
}

}  // namespace popup::cp
