// The findings that are known and accepted, so that only new ones count.
//
// A baseline is a JSON file, one finding a line, sorted, to be kept beside the designs:
//
//   {"version": 1, "findings": [
//     {"file": "designs/camp.xml", "code": "tent-too-narrow", "element": "tent",
//      "digest": "0123456789abcdef", "count": 1}, …]}
//
// The digest is that of what the finding says, its line numbers left out: moving an element in the file
// changes nothing, and changing its numbers makes the finding a new one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "findings/findings.h"
#include "popup/files.h"

namespace popup {

struct AcceptedFinding {
    // Relative to the directory of the baseline, and percent-encoded where it has a "%" or is no UTF-8;
    // empty: the run as a whole.
    std::string file;
    std::string code;
    std::string element;
    std::string digest;
    friend bool operator<(const AcceptedFinding& a, const AcceptedFinding& b) {
        return std::tie(a.file, a.code, a.element, a.digest) < std::tie(b.file, b.code, b.element, b.digest);
    }
    friend bool operator==(const AcceptedFinding&, const AcceptedFinding&) = default;
};

// How often each is accepted, at least once.
using Baseline = std::map<AcceptedFinding, std::size_t>;

// Where things are, as absolute paths.
struct BaselinePlaces {
    std::filesystem::path baseline;  // the directory of the file
    std::filesystem::path working;   // what names of inputs are relative to
};

// Reads a baseline. A `bad-baseline` error at its place, and nullopt, when it is not what write_baseline()
// makes.
std::optional<Baseline> read_baseline(const Source& source, Diagnostics& diagnostics);

// The file, which read_baseline() reads as the same.
std::string write_baseline(const Baseline& baseline);

// Moves the warnings and errors that the baseline accepts to those that are accepted; of more than it
// accepts, the first ones. What keeps a file from being read is never accepted. Returns how many accepted
// findings did not occur in files that were looked at whole and have no error that is not accepted.
std::size_t accept(Findings& findings, const Baseline& baseline, const BaselinePlaces& places);

// All findings of a run, accepted or not, as a baseline. What `old` has of files that the run did not look at
// stays as far as `exists` says that the file, relative to the baseline, is still there; and so does what it
// has of files that an error kept from being looked at whole, and of sheets where there is such a file.
// `kept`: how many findings these are; null: nobody asks.
Baseline baseline_of(const Findings& findings, const Baseline& old, const BaselinePlaces& places,
                     const std::function<bool(const std::string&)>& exists, std::size_t* kept = nullptr);

}  // namespace popup
