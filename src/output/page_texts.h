// Lines of text that a page has beside what is drawn on it. Contexts have millimetres for their unit, y down,
// and the font of labels.
#pragma once

#include <cairo.h>

#include <string>
#include <string_view>
#include <vector>

#include "popup/geometry.h"

namespace popup {

// From 0, black, to 1, white.
void grey(cairo_t* context, double white);

// Its length in mm, for capitals `cap_mm` high.
double text_length(cairo_t* context, std::string_view text, double cap_mm);

// With the middle of the text at `at`: half its length, half the height of its capitals.
void write(cairo_t* context, std::string_view text, Vec2 at, double cap_mm);
// The same, smaller where it is longer than `room_mm`.
void write_fitting(cairo_t* context, std::string_view text, Vec2 at, double cap_mm, double room_mm);
// The same as write(), turned to be read from the right.
void write_turned(cairo_t* context, std::string_view text, Vec2 at, double cap_mm);
// With its left end at `at`, on the base line.
void write_from(cairo_t* context, std::string_view text, Vec2 at, double cap_mm);

// The words of a text in lines that are no longer than `room_mm`. A word that is longer is broken, behind a
// "-",
// "_", "." or "/" of it where that can be; a single character never is.
std::vector<std::string> wrapped(cairo_t* context, std::string_view text, double cap_mm, double room_mm);

}  // namespace popup
