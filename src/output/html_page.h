// Pages of one file that load nothing: templates, and the policy that lets in what stands in them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace popup {

// A file that a page is made of, as it stands in its folder. The build makes them part of the library.
struct PageFile {
    std::string_view name;  // "page.html"
    std::string_view text;
};
// The text of that name. Precondition: there is one.
std::string_view page_file(std::span<const PageFile> files, std::string_view name);

// Adds the lines of a style or a script, without indentation, empty lines, and lines that are comments.
void append_page_lines(std::string& text, std::string_view source);

// What stands in a content security policy for exactly this style or script: "'sha256-…'".
std::string policy_source(std::string_view text);

// A page up to its body: "<!doctype html>" to "</head>" and a line end. `policy` is its content security
// policy, `title` is markup, and `style` stands as it is.
std::string page_head(std::string_view policy, std::string_view title, std::string_view style);

// The template with "{{name}}" replaced; what is put in is not looked at again. Precondition: every name in
// it has a value.
std::string filled_page(std::string_view page,
                        std::span<const std::pair<std::string_view, std::string>> values);

}  // namespace popup
