// Baselines: what is read is written, and read as the same.
#include "findings/baseline.h"

#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_baseline(std::string_view bytes) {
    Diagnostics told("popup.baseline");
    const auto baseline = read_baseline({"popup.baseline", std::string(bytes)}, told);
    expect_told(told, bytes);
    expect(baseline.has_value() == !told.has_errors(), "a baseline, or an error");
    if (!baseline) return;
    Diagnostics again("popup.baseline");
    expect(read_baseline({"popup.baseline", write_baseline(*baseline)}, again) == baseline,
           "a baseline is read as it is written");
}

}  // namespace popup::fuzz
