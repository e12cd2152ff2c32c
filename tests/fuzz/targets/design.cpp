// What all languages of designs promise of what they accept. Apart from target.cpp: what needs no design is
// linked without the library's larger part.
#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/targets/target.h"
#include "input/assembly/guarantees.h"
#include "output/emit.h"
#include "popup/assembly.h"
#include "popup/compile.h"
#include "popup/motion.h"

namespace popup::fuzz {
namespace {

// Openings between those at which a motion is looked at anyway.
constexpr double kShares[] = {0.0, 0.13, 0.5, 0.77, 1.0};
// What docs/guarantees.md promises of seams.
constexpr double kOpenMm = 1e-6;

}  // namespace

void look_at_design(const std::string& name, std::string_view bytes, const ReadOptions& options, Emit emit) {
    CompileOptions how;
    how.read = options;
    how.read.program.limits = {
        .steps = 20'000, .depth = 60, .values = 20'000, .text = 100'000, .trail = 20'000};
    how.read.program.read_file = [](const std::string& /*path*/) -> std::optional<Source> {
        return std::nullopt;
    };
    how.motion.examine = false;
    how.until = Stage::pattern;
    const CompiledDesign one =
        std::move(compile({Source{name, std::string(bytes)}}, how, {}).designs.front());
    expect_told(one.diagnostics, bytes, name.ends_with(".dxf"));
    const bool errors = one.diagnostics.has_errors();
    if (!one.assembly) {
        // A program that only defines something describes nothing.
        expect(errors || name.ends_with(".fl"), "what is not accepted has an error");
        return;
    }
    for (const AssemblyFault& fault : faults_of(*one.assembly)) expect(errors, fault.what);
    if (errors) return;
    expect(one.pattern.has_value(), "what is accepted has a pattern");
    std::vector<Frame> frames(one.assembly->plates.size());
    const Sweep& sweep = one.assembly->sweep;
    for (const double share : kShares) {
        if (!moves(*one.assembly)) break;
        const double deg = sweep.from_deg + share * (sweep.to_deg - sweep.from_deg);
        expect(place(*one.assembly, Angle::degrees(deg), frames),
               [&] { return fmt::format("it opens to {}", deg); });
        const double open = closure_error(*one.assembly, frames);
        expect(open < kOpenMm, [&] { return fmt::format("it is closed at {}: {} mm", deg, open); });
    }
    if (emit == Emit::seldom && !is_one_of(8, bytes)) return;
    const std::string emitted = emit_assembly(*one.assembly);
    Diagnostics told("a.assembly.json");
    const Reading again = read_source_text({"a.assembly.json", emitted}, {}, told);
    expect(again.assembly.has_value(), "an emitted assembly is read");
    expect(emit_assembly(*again.assembly) == emitted, "an assembly that is read again is emitted the same");
}

}  // namespace popup::fuzz
