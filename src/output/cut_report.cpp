#include "output/cut_report.h"

#include <array>
#include <optional>

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

std::optional<double> time_of(const Work& work, const Profile& profile) {
    if (work.travel_mm > 0.0 && profile.travel_mm_s <= 0.0) return std::nullopt;
    double seconds = static_cast<double>(work.pierces()) * profile.pierce_s;
    if (work.travel_mm > 0.0) seconds += work.travel_mm / profile.travel_mm_s;
    for (const Operation operation : kOperations) {
        const Work::Share& share = work.of.at(static_cast<std::size_t>(operation));
        if (share.length_mm <= 0.0) continue;
        const double speed = profile.pen(operation).speed_mm_s;
        if (speed <= 0.0) return std::nullopt;
        seconds += share.length_mm / speed;
    }
    return seconds;
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
    report["sheets"] = std::move(sheets);
    return report;
}

}  // namespace popup
