// One design of a gallery, from its source to its files.
#pragma once

#include <string>
#include <vector>

#include "gallery/names.h"
#include "gallery/record.h"
#include "popup/compile.h"

namespace popup {

struct GalleryEntry {
    GalleryRow row;  // its result has neither command nor inputs yet
    // The row's outputs, named from the directory of the gallery: the page, and of designs without errors the
    // picture. None where there is nothing to show.
    std::vector<PendingFile> files;
    std::string printed;                     // as in CompiledDesign
    std::vector<std::string> further_files;  // likewise
    std::vector<std::string> missing_files;  // likewise
};

// Compiles a design and makes its page and its picture: of what has a model the page of the `.html` output
// and the still in it, of flat parts a page with their sheets and the first of them as a picture, of designs
// with errors a page with these. A program that only defines functions is no design, and is not shown.
//
// `source` is named from the library's root, which is the working directory. Never throws for bad input: what
// is wrong is in the row. Its status is `done`, `failed` where there are errors, or `unusable` where a page
// or picture could not be made that could be another time.
GalleryEntry make_entry(const GalleryDesign& design, Source source, const CompileOptions& options,
                        const DiagnosticPolicy& policy);

// The entry of a design that cannot be compiled: it cannot be read, or its process died of it.
GalleryEntry failed_entry(const GalleryDesign& design, JobStatus status, const Diagnostics& diagnostics);

}  // namespace popup
