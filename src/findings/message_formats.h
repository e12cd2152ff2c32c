// The ways to tell findings, as text. Nothing here prints, reads the environment or looks at a clock.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "findings/findings.h"

namespace popup {

// What a format needs to know beside the findings.
struct MessageStyle {
    bool color = false;                // of the formats for people
    std::string summary;               // what closes those, with its line break; may be empty
    std::filesystem::path working;     // what names of files are relative to; absolute
    std::filesystem::path repository;  // what SARIF names files relative to; absolute
    std::filesystem::path workspace;   // what GitHub names files relative to; absolute
};

struct MessageFormat {
    std::string_view name;   // of --message-format
    std::string_view about;  // half a sentence
    bool for_machines;       // goes to standard output where nothing else is said
    // Every format has something valid to say of no findings at all. Names and messages may hold any bytes.
    std::string (*render)(const Findings& findings, const MessageStyle& style);
};

// All formats; the first is the default.
std::span<const MessageFormat> message_format_table();
// The row of `name`, or null.
const MessageFormat* find_message_format(std::string_view name);

// The rows that have a file of their own.

// A SARIF 2.1.0 log with one run.
std::string render_sarif(const Findings& findings, const MessageStyle& style);
// A JUnit report with a case a file.
std::string render_junit(const Findings& findings, const MessageStyle& style);
// Workflow commands of GitHub Actions, which it shows beside the lines of the files.
std::string render_github(const Findings& findings, const MessageStyle& style);

}  // namespace popup
