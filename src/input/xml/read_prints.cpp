#include "input/xml/read_prints.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "input/design_limits.h"
#include "input/text.h"
#include "input/xml/number.h"
#include "input/xml/path_text.h"

namespace popup::xml {
namespace {

constexpr double kTextMm = 5.0;  // where no height is given
constexpr double kMostTurn = 360.0;
constexpr std::size_t kMostTextBytes = 2000;

// One line: what blanks and line breaks there are become single blanks.
std::string one_line(std::string_view text) {
    std::string line;
    for (const char c : trimmed(text)) {
        if (!is_blank(c)) {
            line += c;
        } else if (!line.ends_with(' ')) {
            line += ' ';
        }
    }
    return line;
}

}  // namespace

DrawnPrint PrintReader::read(Name name, Node node, Unit unit) {
    Fields fields(node, name, reporter_);
    DrawnPrint made;
    made.place = node.place();
    made.tag_text = node.whole();
    made.page = values_.page(fields.find(Name::page), &made.page_text).value_or(0);
    if (name == Name::area) {
        made.what = area(fields, unit);
        return made;
    }
    read_place(fields, made);
    if (name == Name::image) {
        made.what = image(fields);
    } else {
        made.what = text(fields);
    }
    return made;
}

const Field* PrintReader::needed(const Fields& fields, Name name) {
    const Field* field = fields.find(name);
    if (field == nullptr) {
        reporter_.error("missing-value", fields.node().place(),
                        fmt::format("this {} has no {}", canonical(fields.context()), canonical(name)));
    }
    return field;
}

void PrintReader::read_place(const Fields& fields, DrawnPrint& made) {
    made.at.place = made.place;
    for (const Name name : {Name::x, Name::y}) {
        const Field* field = needed(fields, name);
        const std::optional<Text> text = field != nullptr ? value_of(*field, reporter_) : std::nullopt;
        if (!text) continue;
        (name == Name::x ? made.at.at.x : made.at.at.y) = values_.length(*field).value_or(0.0);
        (name == Name::x ? made.at.x_text : made.at.y_text) = values_.tight(*text);
    }
    const Field* field = fields.find(Name::rotate);
    const std::optional<Text> text = field != nullptr ? value_of(*field, reporter_) : std::nullopt;
    if (!text) return;
    made.rotate_deg = values_.number(*field).value_or(0.0);
    made.rotate_text = values_.tight(*text);
    if (made.rotate_deg >= -kMostTurn && made.rotate_deg <= kMostTurn) return;
    reporter_.error(
        "bad-number", text->place,
        fmt::format("rotate is {}, and must be from -360 to 360 degrees", shown(trimmed(text->decoded))));
}

double PrintReader::extent(const Field* field) {
    const std::optional<double> mm = field != nullptr ? values_.length(*field) : std::nullopt;
    if (!mm) return 0.0;
    if (*mm > 0.0 && *mm <= kLargestPage) return *mm;
    reporter_.error("bad-number", field->place,
                    fmt::format("{} is {} mm, and must be above 0 and at most {} mm", field->word(),
                                format_number(*mm), format_number(kLargestPage)));
    return 0.0;
}

std::optional<std::size_t> PrintReader::word(const Field* field, std::span<const std::string_view> words) {
    const std::optional<Text> text = field != nullptr ? value_of(*field, reporter_) : std::nullopt;
    if (!text) return std::nullopt;
    const auto known = std::find(words.begin(), words.end(), lower(trimmed(text->decoded)));
    if (known != words.end()) return static_cast<std::size_t>(known - words.begin());
    reporter_
        .error("bad-choice", text->place,
               fmt::format("{} is '{}', which is not one of its words", field->word(),
                           shown(trimmed(text->decoded))))
        .hint(fmt::format("known words are {}", fmt::join(words, ", ")));
    return std::nullopt;
}

DrawnImage PrintReader::image(const Fields& fields) {
    DrawnImage made;
    read_picture(fields, made);
    read_size(fields, made);
    if (const auto fit = word(fields.find(Name::fit), kPictureFitNames))
        made.fit = static_cast<PictureFit>(*fit);
    read_horizon(fields, made);
    return made;
}

void PrintReader::read_picture(const Fields& fields, DrawnImage& made) {
    const Field* field = needed(fields, Name::href);
    const std::optional<Text> text = field != nullptr ? value_of(*field, reporter_) : std::nullopt;
    if (!text) return;
    made.href = trimmed(text->decoded);
    made.href_place = text->place;
    PictureRefusal refusal;
    if (const Image* picture = pictures_.open(made.href, refusal)) {
        made.picture = *picture;
        return;
    }
    reporter_.error(refusal.code, text->place, refusal.message).hint(refusal.hint);
}

// One of the two sides may be left out: then the picture's own sides say it.
void PrintReader::read_size(const Fields& fields, DrawnImage& made) {
    const Field* width = fields.find(Name::width);
    const Field* height = fields.find(Name::height);
    made.width_mm = extent(width);
    made.height_mm = extent(height);
    if (width == nullptr && height == nullptr) {
        reporter_.error("missing-value", fields.node().place(), "this image has no width and no height")
            .hint("one of them is enough: the other follows from the picture");
        return;
    }
    if (made.picture.width <= 0 || (width != nullptr && height != nullptr)) return;
    const double ratio = static_cast<double>(made.picture.height) / made.picture.width;
    double& side = width == nullptr ? made.width_mm : made.height_mm;
    side = width == nullptr ? made.height_mm / ratio : made.width_mm * ratio;
    if (side <= kLargestPage) return;
    const Name name = width == nullptr ? Name::width : Name::height;
    reporter_.error("bad-number", fields.node().place(),
                    fmt::format("by the sides of the picture its {} is {} mm, and must be at most {} mm",
                                canonical(name), format_number(side), format_number(kLargestPage)));
}

void PrintReader::read_horizon(const Fields& fields, DrawnImage& made) {
    if (const Field* field = fields.find(Name::horizon)) {
        made.horizon = values_.number(*field);
        if (made.horizon && !(*made.horizon >= 0.0 && *made.horizon <= 1.0)) {
            reporter_
                .error("bad-number", field->place,
                       fmt::format("horizon is {}, and must be from 0 to 1", format_number(*made.horizon)))
                .hint("0 is the lower edge of the picture, 1 the upper one");
        }
    }
    const Field* field = fields.find(Name::horizonheight);
    if (field == nullptr) return;
    made.horizon_mm = values_.length(*field);
    if (made.horizon_mm && std::abs(*made.horizon_mm) > kLargestPage) {
        reporter_.error("bad-number", field->place,
                        fmt::format("horizonheight is {} mm, and must be at most {} mm",
                                    format_number(*made.horizon_mm), format_number(kLargestPage)));
    }
    if (fields.find(Name::horizon) != nullptr) return;
    reporter_.error("missing-value", field->place, "this image has a horizonheight, and no horizon")
        .hint("horizon says where in the picture its horizon is: 0 at the lower edge, 1 at the upper one");
}

DrawnText PrintReader::text(Fields& fields) {
    DrawnText made;
    std::string written;
    if (const Field* value = fields.find(Name::value)) {
        fields.refuse_text();
        if (const std::optional<Text> text = value_of(*value, reporter_)) written = one_line(text->decoded);
    } else {
        written = one_line(fields.node().whole_text());
        if (written.empty()) reporter_.error("missing-value", fields.node().place(), "'text' is empty");
    }
    if (written.size() > kMostTextBytes) {
        reporter_.error("document-too-large", fields.node().place(),
                        fmt::format("this text has more than {} bytes", kMostTextBytes));
    }
    made.text = std::move(written);
    const Field* height = fields.find(Name::height);
    made.height_mm = height != nullptr ? extent(height) : kTextMm;
    if (const auto font = word(fields.find(Name::font), kTextFontNames)) {
        made.font = static_cast<TextFont>(*font);
    }
    made.fill = values_.color(fields.find(Name::fill)).value_or(made.fill);
    return made;
}

DrawnArea PrintReader::area(const Fields& fields, Unit unit) {
    DrawnArea made;
    made.fill = values_.color(fields.find(Name::fill)).value_or(made.fill);
    const Field* field = needed(fields, Name::d);
    const std::optional<Text> text = field != nullptr ? value_of(*field, reporter_) : std::nullopt;
    if (!text) return made;
    made.d_text = values_.tight(*text);
    const auto refusal = read_path(trimmed(text->decoded), unit, made.shape);
    if (refusal) {
        reporter_.error(refusal->too_large ? "document-too-large" : "bad-path", text->place,
                        fmt::format("the path data of this area {}", refusal->what));
    }
    return made;
}

}  // namespace popup::xml
