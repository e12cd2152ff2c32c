// What is wanted of a dependency file: the options that compilers call -MD, -MF, -MT and -MP.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace popup::cli {

struct Options;

enum class DependencyFormat { make, json };

struct DependencyOptions {
    bool wanted = false;               // -MD
    std::string file;                  // -MF; empty: beside the first output
    std::vector<std::string> targets;  // -MT, instead of the outputs' names
    bool phony = false;                // -MP
    DependencyFormat format = DependencyFormat::make;
    bool format_given = false;
};

void add_dependency_options(CLI::App& verb, Options& options);

// The parser knows long options with two dashes only, so that "-MD", "-MP", "-MF FILE", "-MFFILE", "-MT NAME"
// and "-MTNAME" become "--MD", "--MF=FILE" and so on; whatever stands after "--" stays as it is. UsageError
// when the last argument lacks its value.
std::vector<std::string> with_long_dependency_options(const std::vector<std::string>& arguments);

// A long option as people know it: all upper case, "MD" is "-MD"; others "--output".
std::string shown_option(const std::string& long_name);

// The name of the dependency file, which is what -MF says or the first output's with another suffix: ".d" in
// the form of make, ".d.json" as JSON. Empty when none is wanted. UsageError when options about it are given
// without -MD, and when an output of the run is standard output, which has no name.
std::string dependency_file_name(const Options& options);

}  // namespace popup::cli
