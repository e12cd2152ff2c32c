// The input languages, and how one is chosen.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "input/assembly/read.h"
#include "input/cp/read.h"
#include "input/drawing/card/read.h"
#include "input/drawing/folded/read.h"
#include "input/drawing/read.h"
#include "input/dxf/read.h"
#include "input/flatlang/read.h"
#include "input/fold/read.h"
#include "input/oa/read.h"
#include "input/text.h"
#include "input/xml/read.h"
#include "popup/language.h"

namespace popup {
namespace {

template <std::optional<Assembly> (*kRead)(const Source&, const ReadOptions&, Diagnostics&)>
Reading assembly_of(const Source& source, const ReadOptions& options, Diagnostics& diagnostics) {
    Reading reading;
    reading.assembly = kRead(source, options, diagnostics);
    return reading;
}

template <std::optional<CreasePattern> (*kRead)(const Source&, const ReadOptions&, Diagnostics&)>
Reading creases_of(const Source& source, const ReadOptions& options, Diagnostics& diagnostics) {
    Reading reading;
    reading.creases = kRead(source, options, diagnostics);
    return reading;
}

// Of all formats of drawings.
template <std::optional<drawing::Tracing> (*kTrace)(const Source&, const ReadOptions&, Diagnostics&)>
Reading drawing_of(const Source& source, const ReadOptions& options, Diagnostics& diagnostics) {
    Reading reading;
    std::optional<drawing::Tracing> tracing = kTrace(source, options, diagnostics);
    if (!tracing) return reading;
    switch (options.drawing.as.value_or(drawing::shown_by(*tracing))) {
        case DrawnAs::parts:
            reading.assembly = drawing::flat_assembly(std::move(*tracing), diagnostics);
            break;
        case DrawnAs::card: {
            drawing::card::CardReading card = drawing::card::read(*tracing, source, diagnostics);
            reading.design = std::move(card.design);
            reading.assembly = std::move(card.assembly);
            break;
        }
        case DrawnAs::folded:
            reading.creases = drawing::folded::read(*tracing, source, diagnostics);
            if (!options.drawing.as) drawing::card::tell_card(*tracing, source, diagnostics);
            break;
    }
    return reading;
}

}  // namespace

std::vector<Language> const& language_table() {
    static const std::vector<Language> table{
        {.name = "xml",
         .suffix = ".xml",
         .about = "popup document, as Popup Workshop's thesis describes it",
         .read = xml::read_document,
         .patch = xml::patch},
        {.name = "svg",
         .suffix = ".svg",
         .about = "drawing of closed cut contours, each a flat part, or with --as a card or a folded sheet",
         .read = drawing_of<drawing::read_tracing>,
         .drawn = true,
         .only_parts = true,
         .walked = false,
         .recognises = drawing::recognises},
        {.name = "dxf",
         .suffix = ".dxf",
         .about = "drawing of cuts and folds, as AutoCAD, carton designers and laser cutters exchange them",
         .read = drawing_of<dxf::read_tracing>,
         .drawn = true,
         .walked = false,
         .recognises = dxf::recognises},
        {.name = "assembly",
         .suffix = ".assembly.json",
         .about = "assembly of plates and joints, as --emit assembly prints it",
         .read = assembly_of<assembly_text::read>,
         .walked = false,
         .recognises = assembly_text::recognises},
        {.name = "oa",
         .suffix = ".oa",
         .about = "design of webOAcard, a card of one sheet that opens to 90°",
         .read = assembly_of<oa::read>,
         .recognises = oa::recognises},
        {.name = "fold",
         .suffix = ".fold",
         .about = "crease pattern in FOLD, which is folded from its flat sheet",
         .read = creases_of<fold::read>,
         .walked = false,
         .recognises = fold::recognises},
        {.name = "cp",
         .suffix = ".cp",
         .about = "crease pattern of ORIPA, Oriedita and others, which is folded from its flat sheet",
         .read = creases_of<cp::read>,
         .walked = false,
         .recognises = cp::recognises},
        {.name = "flatlang",
         .suffix = ".fl",
         .about = "FlatLang program, whose turtle draws flat parts or a pop-up card",
         .read = flatlang::read,
         .recognises = flatlang::recognises,
         .trail = flatlang::trail},
    };
    return table;
}

const Language* find_language(const Source& source, std::string_view language) {
    const std::vector<Language>& table = language_table();
    const std::string wanted = lower(language.empty() ? std::string_view(source.name) : language);
    const bool standard_input = language.empty() && source.name == "-";
    const auto row = std::find_if(table.begin(), table.end(), [&](const Language& candidate) {
        if (standard_input) return candidate.recognises != nullptr && candidate.recognises(source.text);
        return language.empty() ? wanted.ends_with(candidate.suffix) : wanted == candidate.name;
    });
    if (row != table.end()) return &*row;
    return standard_input ? &table.front() : nullptr;
}

std::string known_languages() {
    std::string known;
    for (const Language& row : language_table()) {
        known += fmt::format("{}{} ({})", known.empty() ? "" : ", ", row.name, row.suffix);
    }
    return known;
}

Reading read_source_text(const Source& source, const ReadOptions& options, Diagnostics& diagnostics) {
    if (const Language* language = find_language(source, options.language)) {
        return language->read(source, options, diagnostics);
    }
    diagnostics
        .error("unknown-language", {},
               options.language.empty()
                   ? std::string("the name of the input does not tell its language")
                   : fmt::format("the language '{}' is not known", shown(options.language)))
        .hint("--from names the language; known are " + known_languages());
    return {};
}

std::optional<Design> read_design(const Source& source, const ReadOptions& options,
                                  Diagnostics& diagnostics) {
    const auto refuse = [&](const char* what) {
        diagnostics.error("no-design", {}, std::string(what) + ", not the design of a pop-up card");
        return std::nullopt;
    };
    const Language* language = find_language(source, options.language);
    if (language != nullptr && language->only_parts &&
        options.drawing.as.value_or(DrawnAs::parts) == DrawnAs::parts)
        return refuse("this describes flat parts");
    Reading reading = read_source_text(source, options, diagnostics);
    if (reading.assembly) {
        return refuse(moves(*reading.assembly) ? "this is an assembly, made of a design or by hand"
                                               : "this describes flat parts");
    }
    if (reading.creases) return refuse("this is a crease pattern");
    if (!reading.design && !diagnostics.has_errors_as_given()) return refuse("this only defines functions");
    return std::move(reading.design);
}

}  // namespace popup
