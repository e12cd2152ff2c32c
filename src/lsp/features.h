// What an editor asks of a document, language by language: rows of functions from a text, and what was found
// out about it, to values. A further language is a file and a row.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lsp/analysis.h"
#include "lsp/text.h"

namespace popup::lsp {

// A document as it is asked about.
struct View {
    const Text& text;  // as it is typed now
    std::string path;
    const Analysis* analysis = nullptr;  // of this text; null: it has not been looked at yet
    const Analysis* good = nullptr;      // the last with a design, perhaps of an older text; null: none
    // The text of another file, as it is open or on the disk; empty: it cannot be had.
    std::function<std::optional<std::string>(const std::string& path)> read = {};
    // The files that the document loads and that can be edited, by path.
    std::vector<std::string> loaded = {};
    // Open documents that load it, and what else they load.
    std::vector<std::string> readers = {};
    // An open document that may load this one, or is this one, and whose error hides which files it loads.
    // Empty: there is none.
    std::string doubtful = {};
};

struct Hover {
    Span at;
    std::string markdown;
};

// The numbers are the protocol's.
enum class ItemKind {
    function = 3,
    variable = 6,
    element = 7,
    property = 10,
    unit = 11,
    value = 12,
    word = 14,
    snippet = 15,
    color = 16,
    file = 17,
    reference = 18,
};

struct Completion {
    std::string label;
    ItemKind kind = ItemKind::word;
    std::string detail;    // a few words beside the label
    std::string markdown;  // what it is
    Span replaces;
    std::string text;  // what is written; of a snippet with the protocol's placeholders
    bool snippet = false;
};

enum class SymbolKind { module = 2, property = 7, function = 12, variable = 13, element = 19, event = 24 };

// In the order of the document; `parent` is the number of one before it.
struct Symbol {
    std::string name, detail;
    SymbolKind kind = SymbolKind::element;
    Span all, name_at;
    int parent = -1;
};

struct Target {
    std::string path;
    Span at;
};

struct FileEdits {
    std::string path;
    std::vector<TextEdit> edits;
};

struct Renaming {
    std::vector<FileEdits> files;
    std::string refusal;  // why not, a sentence without its full stop; empty: it can be done
};

struct ColorAt {
    Span at;
    Color color;
};

// A row. Offsets are bytes of the view's text, and may be any up to its size.
struct Service {
    std::string_view language;  // of language_table()
    // False of a text that merely has the suffix, and is of somebody else: nothing is said of it.
    bool (*is_ours)(std::string_view text);
    std::optional<Hover> (*hover)(const View&, std::size_t at);
    std::vector<Completion> (*complete)(const View&, std::size_t at);
    std::vector<Symbol> (*symbols)(const View&);
    std::optional<Target> (*definition)(const View&, std::size_t at);
    // With the definition, first.
    std::vector<Target> (*references)(const View&, std::size_t at);
    // The name that stands there, if it can be changed.
    std::optional<Span> (*renameable)(const View&, std::size_t at);
    Renaming (*rename)(const View&, std::size_t at, std::string_view name);
    // The comment that allows a finding; nullopt: it cannot be allowed.
    std::optional<Fix> (*allow)(const View&, const Finding& finding);
    std::vector<ColorAt> (*colors)(const View&);
};

std::span<const Service> service_table();
// The row of that language, or null.
const Service* find_service(std::string_view language);

// What a code means, as a popup of a few lines: its summary and its explanation.
std::string code_markdown(const CodeInfo& code);
// The finding's sentence, hints and explanation.
std::string finding_markdown(const Diagnostic& diagnostic);

// The rows, in their files.
Service xml_service();
Service flatlang_service();

}  // namespace popup::lsp
