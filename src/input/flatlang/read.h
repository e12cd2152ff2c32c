// FlatLang programs as an input language: a turtle that draws flat parts, possibly in space.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "popup/language.h"

namespace popup::flatlang {

// The row's functions, as language.h promises them; see popupc-flatlang(7). Runs the program; a program that
// makes a card is a design, one that makes a sheet a crease pattern, any other its parts. Deterministic;
// writes nothing.
Reading read(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);
// A text that begins as no document of XML does, but as a program may.
bool recognises(std::string_view text);
std::string trail(const Source& source, const ReadOptions& options, Diagnostics& diagnostics,
                  std::vector<std::string>& files);

}  // namespace popup::flatlang
