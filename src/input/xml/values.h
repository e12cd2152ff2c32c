// Typed values out of fields: numbers, lengths, colours, pages, points.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "input/design_limits.h"
#include "input/picture_files.h"
#include "input/xml/fields.h"
#include "input/xml/outline_file.h"
#include "popup/design.h"
#include "popup/mechanism.h"

namespace popup::xml {

// Reads values of one document. Whatever is wrong is an error, and the value nullopt.
class Values {
 public:
    Values(std::string_view source, Unit unit, Reporter& reporter)
        : source_(source), unit_(unit), reporter_(reporter) {}

    [[nodiscard]] Reporter& reporter() { return reporter_; }
    void set_unit(Unit unit) { unit_ = unit; }
    // Where outlines that are files are read from; must outlive this.
    void set_files(PictureFiles& files) { files_ = &files; }
    // The bytes of a value, without blanks around.
    [[nodiscard]] TextRange tight(const Text& text) const;
    // A length in document units, as mm; at most kCoordinateLimit away from 0.
    std::optional<double> length(const Field& field);
    // A plain number.
    std::optional<double> number(const Field& field);
    std::optional<Color> color(const Field* field);
    std::optional<Color> color(const Text& text, std::string_view what);
    // Pages by the ids of the elements whose pieces they are; of those without a piece -1. Must outlive this.
    using Pages = std::unordered_map<std::string, int>;
    void set_pages(const Pages& pages, bool newer) {
        pages_ = &pages;
        newer_ = newer;
    }
    // A whole number from 0 to kPageLimit, or the id of an element that has a piece, from version 3.0 on
    // ("page": the base page); `range` (if given) is where it stands.
    std::optional<int> page(const Field* field, TextRange* range = nullptr);
    // The value of a parameter, of the kind and in the limits that its row gives.
    std::optional<Argument> argument(const Field& field, const ParameterInfo& parameter);
    // One point, of <point>, <begin> or <end>, or of an attribute.
    std::optional<DesignPoint> point(const Field& field);
    // Appends the points of a list: <point> elements, text, or both forms of `fields`. A point that cannot be
    // read is an error and still takes its place in the list, so that a count of points stays right.
    void points(const Fields& fields, std::vector<DesignPoint>& out);
    void points(const Text& text, std::vector<DesignPoint>& out);

 private:
    // A word of a text that lists numbers.
    struct Token {
        std::string_view decoded;
        TextRange raw;
        Place place;
    };
    std::optional<double> number(std::string_view text, std::string_view what, Place place);
    std::optional<double> length(std::string_view text, std::string_view what, Place place);
    // At most `most` of them, and one more where there are more.
    [[nodiscard]] std::vector<Token> tokens(const Text& text, std::size_t most) const;
    bool count_point(Place place);
    bool read_number(const Text& text, const ParameterInfo& parameter, Argument& made);
    bool read_choice(const Text& text, const ParameterInfo& parameter, Argument& made);
    bool read_path(const Field& field, const ParameterInfo& parameter, Argument& made);
    bool read_outline(const Fields& fields, const Field& href, const ParameterInfo& parameter,
                      Argument& made);
    void tell_slits(const DrawnPath& path, const ParameterInfo& parameter, Place place);
    bool read_outline_place(const Fields& fields, OutlinePlace& place);
    void read_points(const Field& field, Argument& made);
    DesignPoint point_of(const Token& x, const Token& y);
    DesignPoint point(Node node, Name context);
    std::optional<DesignPoint> plain_point(Node node, Name context);
    void read_coordinate(const Field& field, double& value, TextRange& range);
    std::optional<DesignPoint> point_of(const Text& text, std::string_view what);

    [[nodiscard]] bool is_page(std::string_view name) const;
    std::optional<int> named_page(const Text& text, std::string_view name);
    std::string page_like(std::string_view name);

    std::string_view source_;
    const Pages* pages_ = nullptr;
    int pages_missed_ = 0;
    bool newer_ = false;  // the document's version has pages with names
    Unit unit_;
    Reporter& reporter_;
    PictureFiles* files_ = nullptr;
    std::size_t points_ = 0;  // read so far
};

}  // namespace popup::xml
