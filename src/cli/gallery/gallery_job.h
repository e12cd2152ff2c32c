// One design of a gallery as a job of a worker process.
#pragma once

#include <string>
#include <vector>

#include "cli/options/options.h"
#include "gallery/entry.h"

namespace popup::cli {

// What all jobs of a run have in common.
struct GalleryRun {
    GalleryPlan plan;
    GalleryRecord record;
    std::string directory;  // of the gallery, absolute
    std::string command;    // digest of the version and of all that changes what is made
    CompileOptions compile;
    DiagnosticPolicy policy;
    bool dry_run = false;
};

// fresh: an earlier run made it, and nothing has changed since. made: now, well or not. due: it would have
// been made, in a dry run.
enum class GalleryNews : char { fresh = 'f', made = 'm', due = 'd' };

struct GalleryReply {
    GalleryNews news = GalleryNews::fresh;
    GalleryEntry entry;  // of what was made: row, files and what was printed
};

// Does the job, in the library's root. Never throws for what is on the disk.
GalleryReply make_one(const GalleryRun& run, std::size_t index);

// The reply on a job whose process died of `signal` (0: it ended itself).
GalleryReply crashed_one(const GalleryRun& run, std::size_t index, int signal);

// A reply as bytes, and back.
std::string packed(const GalleryReply& reply);
GalleryReply unpacked_reply(const std::string& bytes);

}  // namespace popup::cli
