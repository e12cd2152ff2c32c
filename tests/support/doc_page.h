// Pages of documentation that run: the README, docs/*.md and the pages beside samples.
//
// A page is Markdown. Each fenced block of it is used in one of these ways:
//
//   ```console    Lines "$ COMMAND" run in sh, one after the other, in a directory that belongs to the page.
//   Standard
//                 output and standard error together must be what stands below the command.
//   ```sh         The whole block runs in `sh -e`, and must succeed. What it prints is not looked at.
//   ```text       Is to be looked at only: a picture, a form.
//
// Any other block, and one of these that shall be used in another way, has a comment before it that says how:
//
//   <!-- test: file NAME -->          The block is saved as NAME.
//   <!-- test: is PATH -->            The block is the file PATH of this repository, and is saved under its
//   last name.
//   <!-- test: prints COMMAND -->     The block is what COMMAND prints on standard output.
//   <!-- test: needs PROGRAM... -->   Without these programs the block is skipped.
//   <!-- test: not run: REASON -->    The block does not run.
//
// Two comments stand by themselves, and do something that readers need not see:
//
//   <!-- test: copy PATH [NAME] -->   Copies a file or directory of the repository.
//   <!-- test: run COMMAND -->        Runs COMMAND, which must succeed.
//
// A comment is one line. How long something took is N in what is compared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace popup::test {

// A comment `<!-- test: WORD REST -->`.
struct DocNote {
    std::string word, rest;
    int line = 0;
};

// A fenced block, or (with an empty fence) a note that stands by itself.
struct DocStep {
    std::string language;
    std::vector<std::string> lines;
    std::vector<DocNote> notes;
    int line = 0;  // in the page, from 1: of the fence, or of the note
    // The note of this word; null when there is none.
    [[nodiscard]] const DocNote* note(const std::string& word) const;
};

// The steps of a page, from top to bottom.
std::vector<DocStep> doc_steps(const std::string& text);

// What came of a page.
struct DocRun {
    std::vector<std::string> wrong;    // one text a fault, with file and line
    std::vector<std::string> skipped;  // "12: ninja is not installed"
    std::size_t ran = 0;               // commands
    std::string text;                  // the page with what its commands print now
};

// Runs a page of the repository in a new directory, with popupc in PATH.
DocRun run_doc_page(const std::filesystem::path& page);

// A link of a page: "docs/tour.md#mend-it".
struct DocLink {
    std::string target;
    int line = 0;
};

// Links and pictures of a page, in their order; those in fenced blocks are none.
std::vector<DocLink> doc_links(const std::string& text);

// What links can name after `#`: the headings of a page, in the spelling of GitHub.
std::vector<std::string> doc_anchors(const std::string& text);

}  // namespace popup::test
