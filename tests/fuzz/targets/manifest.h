// What manifests of both forms promise.
#pragma once

#include <string>
#include <string_view>

#include "batch/manifest.h"
#include "batch/results.h"
#include "fuzz/targets/target.h"

namespace popup::fuzz {

// Every row of a manifest that is accepted is a job with inputs and outputs, and is one by itself, below the
// heading.
inline void look_at_manifest(std::string_view bytes, ManifestForm form) {
    Diagnostics told("jobs");
    const auto manifest = read_manifest({"jobs", std::string(bytes)}, form, told);
    expect_told(told, bytes);
    expect(manifest.has_value() == !told.has_errors(), "a manifest, or an error");
    if (!manifest) return;
    expect(manifest->size() > 0, "a manifest has jobs");
    for (std::size_t i = 0; i < manifest->size(); ++i) {
        const BatchJob job = manifest->job(i);
        expect(!job.inputs.empty() && !job.outputs.empty(), "a job has inputs and outputs");
        expect(!job.copies || *job.copies >= 1, "copies are at least one");
        const std::string alone = std::string(manifest->heading()) + std::string(manifest->text(i)) + "\n";
        Diagnostics of_one("job");
        const auto one = read_manifest({"job", alone}, form, of_one);
        expect(one && one->size() == 1, "a row alone is a job");
        expect(job_key(one->job(0)) == job_key(job), "a row alone is the same job");
    }
}

}  // namespace popup::fuzz
