// What may be written next in a document.
#pragma once

#include <cstddef>
#include <vector>

#include "lsp/features.h"

namespace popup::lsp {

// As Service::complete, of documents: elements (with a skeleton for each row of the element table),
// attributes, types, colours, units, pages, words of choices, folds to stand on, and codes in comments.
std::vector<Completion> complete_xml(const View& view, std::size_t at);

}  // namespace popup::lsp
