#include "output/emit_design.h"

#include "base/text/json_text.h"
#include "output/emit_json.h"
#include "popup/design.h"

namespace popup {
namespace {

using namespace emitted;
using emitted::json;  // joins those below

Json json(const DesignPoint& point) {
    return {{"at", json(point.at)},
            {"page", point.page ? Json(*point.page) : Json()},
            {"place", json(point.place)},
            {"changed", point.changed}};
}

Json json(const std::vector<DesignPoint>& points) {
    return list(points, [](const DesignPoint& p) { return json(p); });
}

Json json(const Structure& one) {
    return {{"id", one.id},
            {"id_given", one.id_given},
            {"type", one.type},
            {"type_changed", one.type_changed},
            {"dropped", one.dropped},
            {"place", json(one.place)},
            {"points", json(one.points)},
            {"fold",
             {{"page", one.fold.page},
              {"begin", json(one.fold.begin)},
              {"end", json(one.fold.end)},
              {"place", json(one.fold.place)}}},
            {"left", json(one.left)},
            {"right", json(one.right)},
            {"left_tab", json(one.left_tab)},
            {"right_tab", json(one.right_tab)}};
}

Json json(const DrawnLine& line) {
    return {{"page", line.page},         {"thickness_pt", mm(line.thickness_pt)},
            {"color", json(line.color)}, {"points", json(line.points)},
            {"dropped", line.dropped},   {"place", json(line.place)}};
}

}  // namespace

std::string emit_design(const Design& design) {
    return json_text({{"file", design.file},
                      {"stem", design.stem},
                      {"version", design.version},
                      {"unit", design.unit.name},
                      {"width_mm", mm(design.width_mm)},
                      {"height_mm", mm(design.height_mm)},
                      {"left", json(design.left)},
                      {"right", json(design.right)},
                      {"place", json(design.page_place)},
                      {"structures", list(design.structures, [](const Structure& s) { return json(s); })},
                      {"lines", list(design.lines, [](const DrawnLine& l) { return json(l); })}});
}

}  // namespace popup
