// What is printed beside drawn lines: pictures, texts and areas.
#pragma once

#include "input/picture_files.h"
#include "input/xml/fields.h"
#include "input/xml/values.h"
#include "popup/design.h"

namespace popup::xml {

// Reads an <image>, <text> or <area> of a list of drawn lines. What is wrong with it is an error, and the
// print then not whole.
class PrintReader {
 public:
    PrintReader(Values& values, Reporter& reporter, PictureFiles& pictures)
        : values_(values), reporter_(reporter), pictures_(pictures) {}

    DrawnPrint read(Name name, Node node, Unit unit);

 private:
    DrawnImage image(const Fields& fields);
    DrawnText text(Fields& fields);
    DrawnArea area(const Fields& fields, Unit unit);
    void read_picture(const Fields& fields, DrawnImage& made);
    void read_size(const Fields& fields, DrawnImage& made);
    void read_horizon(const Fields& fields, DrawnImage& made);
    void read_place(const Fields& fields, DrawnPrint& made);
    // A length above zero that fits on a page; 0: there is none, or an error.
    double extent(const Field* field);
    const Field* needed(const Fields& fields, Name name);
    std::optional<std::size_t> word(const Field* field, std::span<const std::string_view> words);

    Values& values_;
    Reporter& reporter_;
    PictureFiles& pictures_;
};

}  // namespace popup::xml
