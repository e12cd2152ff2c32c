// A PDF of separations, read back for tests: its content streams are followed step by step, and its plates
// are made with Ghostscript.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "popup/geometry.h"

namespace popup::test {

using Cmyk = std::array<int, 4>;  // in 1/1000

struct Painted {
    bool stroke = false;
    std::string spot;  // empty: process colour
    Cmyk tints{};      // of process colour
    bool overprint = false;
    double width_mm = 0.0;
    double mm = 0.0;    // length of all its lines
    std::string layer;  // name of the group it stands in
    std::string step;   // its processing step
    std::size_t dashes = 0;
    Box box;                // mm
    bool even_odd = false;  // filled by that rule
};

struct ReadPage {
    std::array<double, 4> media{}, trim{};
    std::vector<Painted> painted;
    std::set<std::string> spots;  // that its resources name
};

struct ReadDocument {
    std::vector<ReadPage> pages;
    std::vector<std::pair<std::string, std::string>> layers;  // name and step, as viewers list them
    std::map<std::string, std::array<double, 4>> alternates;  // of spots
    std::string title;

    [[nodiscard]] std::vector<Painted> painted() const;  // of all pages
};

// Reads the document, with qpdf. A test failure each: whatever qpdf warns of, operators that such a document
// has no use for (RGB, grey, text and images among them), painting outside of layers, tints of spot colours
// other than 1, resources that are not there, fonts, groups that are not on or not listed.
ReadDocument read_separations(const std::string& bytes);

// Pixels, at 36 dpi, of each plate of each page that has ink, by "1(Cyan)": page, and the plate's name. The
// upper left corner of the paper must be bare. Needs Ghostscript.
std::map<std::string, std::string> inked_plates(const std::string& pdf);

}  // namespace popup::test
