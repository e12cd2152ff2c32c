// Nesting jobs of others, read from a directory beside the repository, and one job made in code.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "popup/nest.h"

namespace popup::test {

struct NestInstance {
    enum class Form {
        strip,   // one sheet, long enough for everything in any order; its used length is what counts
        bins,    // as many sheets as wanted, all alike; their number is what counts
        cutting  // a job of a workshop: sheets, then the length of the last one
    };
    Form form = Form::strip;
    std::string name;  // folder/stem, as strip/albano
    NestJob job;
    double area = 0.0;  // of all pieces, mm²
    int optimum = 0;    // known least number of sheets; 0: not known
};

// Where the instances are: the directory that POPUP_NEST_DATA names, else shared/data/nesting beside the
// source directory. nullopt when there is none.
std::optional<std::filesystem::path> nest_data();
// The word to skip with.
inline constexpr const char* kNestDataMissing =
    "no nesting instances: POPUP_NEST_DATA names no directory with strip, bins and jobs in it";

// All instances of a directory like nest_data(), strips first, then bins, then jobs, each by name; with
// words, those whose name contains one of them. Units are the files' own, taken as mm. Throws
// std::runtime_error, with the file's name, on a file that cannot be read.
//   strip/*.json  sparrow: items with demand, allowed_orientations and a shape; strip_height
//   bins/T*.txt   Terashima: as many sheets as wanted, no turns; Op*.txt beside it gives the optimum
//   jobs/*.json   packingsolver: bin_types, item_types; rectangles as sheets, polygons with holes as pieces
std::vector<NestInstance> nest_instances(const std::filesystem::path& data,
                                         const std::vector<std::string>& words = {});

// The optimal layout of an instance of bins, as Op*.txt gives it: its own job, whose pieces are in the order
// of that file, and a plan that places each where it is drawn. nullopt when there is no such file.
struct NestSolution {
    NestJob job;
    NestPlan plan;
};
std::optional<NestSolution> nest_optimum(const std::filesystem::path& data, const std::string& name);

// `items` irregular pieces of 20 to 80 mm, five of each kind: stars, crescents, brackets, combs and frames
// with a hole, in quarter turns, 2 mm apart, on A3 sheets without end. Equal seeds give equal jobs on every
// machine.
NestInstance large_nest_instance(int items, std::uint64_t seed);

}  // namespace popup::test
