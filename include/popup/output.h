// Writers: pure functions from a stage's value to bytes. One file and one table row a format.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "popup/check.h"
#include "popup/layout.h"
#include "popup/motion.h"
#include "popup/profile.h"

namespace popup {

struct CompiledDesign;
struct Compilation;

struct OutputOptions {
    double fps = 0.0;         // scene: > 0 adds keys so that there are at least this many a second
    double duration_s = 4.0;  // scene: length of the animation, > 0
    Profile profile = profile_table().front();  // how lines of sheets are drawn
    std::vector<std::string> files;  // report: the files of this run, every sheet's; empty: not known
};

// One design as a scene: how it is built and how it moves. `prefix` ("castle:") goes before every name, may
// be empty.
struct SceneCard {
    const Assembly* assembly = nullptr;
    const Motion* motion = nullptr;
    std::string prefix;
};

// Bytes a sheet (a format that holds all sheets in one file gives one).
using SheetWriter = std::optional<std::vector<std::string>> (*)(const Layout&, const OutputOptions&,
                                                                Diagnostics&);
using SceneWriter = std::optional<std::string> (*)(std::span<const SceneCard>, const OutputOptions&,
                                                   Diagnostics&);
using DocumentWriter = std::optional<std::string> (*)(const CheckedDesign&, const OutputOptions&,
                                                      Diagnostics&);
using ReportWriter = std::optional<std::string> (*)(const Compilation&, const OutputOptions&, Diagnostics&);

struct Format {
    std::string_view suffix;  // ".svg"
    std::string_view about;
    std::variant<SheetWriter, SceneWriter, DocumentWriter, ReportWriter> write;
};
std::span<const Format> format_table();
// The row whose suffix ends `path` (case disregarded), or whose suffix without its dot is `path`; null: none.
const Format* find_format(std::string_view path);

}  // namespace popup
