// What others reach on the nesting instances: published figures, and what libnest2d reached beside us.
#pragma once

#include <optional>
#include <string>

namespace popup::test {

// Densities in %: area of all pieces / (height of the strip × its used length).
struct StripFigures {
    std::string name;                  // as the instance's: strip/albano
    std::optional<double> sparrow;     // mean of 100 runs of 1200 s, sparrow's published logs
    std::optional<double> best;        // best known
    std::optional<double> roma, gcs;   // as published
    std::optional<double> sparrow_60;  // sparrow, one worker, 60 s
    std::optional<double> sparrow_10;  // the same, 10 s
    std::optional<double> svgnest;     // 60 s
    std::optional<double> libnest2d;   // the best of runs of 30 s; see compare_libnest2d
};
// nullptr when nothing is known of it.
const StripFigures* strip_figures(const std::string& name);

// How many sheets libnest2d's best of 30 s, random orders included, takes for an instance of bins; see
// compare_libnest2d.
std::optional<int> libnest2d_sheets(const std::string& name);

}  // namespace popup::test
