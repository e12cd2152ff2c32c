#include "output/cut_report.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/numbers.h"
#include "output/sheet_drawing.h"

namespace popup {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kLength = 6;  // decimals of a millimetre
constexpr int kTime = 3;    // of a second

struct Work {
    struct Share {
        std::size_t paths = 0;
        double length_mm = 0.0;
    };
    std::array<Share, kOperations.size()> of;
    double travel_mm = 0.0;
    std::size_t joints = 0;

    [[nodiscard]] std::size_t pierces() const {
        std::size_t sum = 0;
        for (const Share& share : of) sum += share.paths;
        return sum;
    }
    void add(const Work& other) {
        for (std::size_t i = 0; i < of.size(); ++i) {
            of.at(i).paths += other.of.at(i).paths;
            of.at(i).length_mm += other.of.at(i).length_mm;
        }
        travel_mm += other.travel_mm;
        joints += other.joints;
    }
};

Work work_of(const SheetDrawing& drawing) {
    Work work;
    work.joints = drawing.joints;
    Vec2 at;
    for (const SheetShape& shape : drawing.shapes) {
        if (is_printed(shape.operation)) continue;
        Work::Share& share = work.of.at(static_cast<std::size_t>(shape.operation));
        share.length_mm += drawing.length_of(shape);
        for (const Run& run : drawing.runs_of(shape)) {
            ++share.paths;
            const std::span<const Vec2> points = drawing.points_of(run);
            work.travel_mm += distance(at, points.front());
            at = run.closed ? points.front() : points.back();
        }
    }
    return work;
}

// How long each kind of line takes, with the speed that it needs: 0, it is not known.
struct Stretch {
    std::string_view what;  // as --speed names it
    double length_mm = 0.0, speed_mm_s = 0.0;
};
std::vector<Stretch> stretches_of(const Work& work, const Profile& profile) {
    std::vector<Stretch> all{{"travel", work.travel_mm, profile.travel_mm_s}};
    for (const Operation operation : kOperations) {
        const Work::Share& share = work.of.at(static_cast<std::size_t>(operation));
        all.push_back({to_string(operation), share.length_mm, profile.pen(operation).speed_mm_s});
    }
    std::erase_if(all, [](const Stretch& one) { return one.length_mm <= 0.0; });
    return all;
}

std::optional<double> time_of(const Work& work, const Profile& profile) {
    double seconds = static_cast<double>(work.pierces()) * profile.pierce_s;
    for (const Stretch& one : stretches_of(work, profile)) {
        if (one.speed_mm_s <= 0.0) return std::nullopt;
        seconds += one.length_mm / one.speed_mm_s;
    }
    return seconds;
}

// Whoever gives some speeds wants to know a time.
void tell_unknown_speeds(const Work& work, const Profile& profile, Diagnostics& diagnostics) {
    std::vector<std::string> known, unknown;
    for (const Stretch& one : stretches_of(work, profile))
        (one.speed_mm_s > 0.0 ? known : unknown).emplace_back(one.what);
    if (known.empty() || unknown.empty()) return;
    diagnostics
        .remark("time-unknown", {},
                fmt::format("the report has no time: no speed is known for {}", fmt::join(unknown, ", ")))
        .hint(fmt::format("give its speed, too, as in --speed {}=100", unknown.front()));
}

void describe(Json& row, const Work& work, const Profile& profile) {
    Json operations = Json::array();
    for (const Operation operation : kOperations) {
        const Work::Share& share = work.of.at(static_cast<std::size_t>(operation));
        if (share.paths == 0) continue;
        operations.push_back({{"operation", to_string(operation)},
                              {"layer", profile.pen(operation).layer},
                              {"paths", share.paths},
                              {"length_mm", rounded(share.length_mm, kLength)}});
    }
    const std::optional<double> time = time_of(work, profile);
    row["operations"] = std::move(operations);
    row["travel_mm"] = rounded(work.travel_mm, kLength);
    row["pierces"] = work.pierces();
    if (profile.joint_mm > 0.0) row["joints"] = work.joints;
    row["time_s"] = time ? Json(rounded(*time, kTime)) : Json();
}

}  // namespace

std::optional<Json> cut_report(const Layout& layout, const OutputOptions& options, Diagnostics& diagnostics) {
    const auto views = views_of(layout, options, diagnostics);
    if (!views) return std::nullopt;
    Work total;
    Json sheets = Json::array();
    for (const SheetView& view : *views) {
        if (view.part == SheetView::Part::print) continue;
        const Work work = work_of(draw_sheet(layout, options, view));
        if (work.pierces() == 0) continue;
        Json& row =
            sheets.emplace_back(Json{{"sheet", view.sheet + 1}, {"side", view.back ? "back" : "front"}});
        describe(row, work, options.profile);
        total.add(work);
    }
    Json report{{"profile", options.profile.name}};
    describe(report, total, options.profile);
    tell_unknown_speeds(total, options.profile, diagnostics);
    report["sheets"] = std::move(sheets);
    return report;
}

}  // namespace popup
