#include "input/flatlang/trail_json.h"

#include <nlohmann/json.hpp>

#include "base/text/json_text.h"
#include "base/text/numbers.h"
#include "input/flatlang/turtle/original_files.h"

namespace popup::flatlang {
namespace {

using Json = nlohmann::ordered_json;

double inches(double value) { return rounded(value, 9); }

Json point(Vec3 p) { return Json::array({inches(p.x), inches(p.y), inches(p.z)}); }

}  // namespace

std::string trail_json(const ProgramRun& run) {
    const Trail& trail = run.trail;
    Json segments = Json::array();
    for (const TrailSegment& one : trail.segments) {
        Json segment = Json::array({inches(one.from.x), inches(one.from.y), inches(one.from.z),
                                    inches(one.to.x), inches(one.to.y), inches(one.to.z)});
        if (one.part > 0) segment.push_back(trail.parts[static_cast<std::size_t>(one.part)].name);
        segments.push_back(std::move(segment));
    }
    Json polygons = Json::array();
    for (const TrailPolygon& one : trail.polygons) {
        Json points = Json::array();
        for (const Vec3 p : one.points) points.push_back(point(p));
        polygons.push_back(std::move(points));
    }
    // Of several calls the original wrote what the last asked for.
    Json files = Json::object();
    if (!run.hpgl.empty() && run.status != RunStatus::runtime_fail && run.status != RunStatus::timeout) {
        files[run.hpgl.back().name] = original_hpgl(trail, run.part_mode);
    }
    return json_text({{"status", to_string(run.status)},
                      {"stdout", run.printed},
                      {"segments", std::move(segments)},
                      {"polygons", std::move(polygons)},
                      {"final_pose",
                       {{"pos", point(trail.last.at)},
                        {"right_x", point(trail.last.right)},
                        {"heading_y", point(trail.last.heading)},
                        {"up_z", point(trail.last.up)}}},
                      {"part_mode", run.part_mode},
                      {"hpgl", std::move(files)}});
}

}  // namespace popup::flatlang
