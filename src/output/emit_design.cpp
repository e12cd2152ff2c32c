#include "output/emit_design.h"

#include "assembly/orientation_names.h"
#include "base/nth.h"
#include "base/text/json_text.h"
#include "output/emit_json.h"
#include "popup/design.h"
#include "popup/mechanism.h"

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

// The values of its element's parameters, but for the colours of its halves and tabs.
Json arguments(const Structure& one) {
    Json made = Json::object();
    const ElementInfo* info = find_element(one.type);
    for (std::size_t i = 0; info != nullptr && i < one.arguments.size(); ++i) {
        const Argument& argument = one.arguments[i];
        Json value;
        if (const auto* word = std::get_if<std::string>(&argument.value)) value = *word;
        if (const auto* number = std::get_if<double>(&argument.value)) value = mm(*number);
        if (const auto* points = std::get_if<std::vector<DesignPoint>>(&argument.value))
            value = json(*points);
        if (const auto* path = std::get_if<DrawnPath>(&argument.value)) value = path->text;
        if (!value.is_null()) made[std::string(info->parameters[i].name)] = std::move(value);
    }
    return made;
}

Json json(const Structure& one) {
    Json made{{"id", one.id},
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
              {"left", json(color_of(one, "leftcolor"))},
              {"right", json(color_of(one, "rightcolor"))},
              {"left_tab", json(color_of(one, "lefttabcolor"))},
              {"right_tab", json(color_of(one, "righttabcolor"))}};
    if (one.finds_ground) {
        made.erase("fold");
        made["page"] = one.fold.page;
    }
    if (one.plate) {
        made.erase("fold");
        made["plate"] = {{"page", one.plate->page}, {"at", json(one.plate->at)}};
    }
    if (one.named().given()) made[one.plate ? "plate" : "fold"] = {{"on", one.named().text}};
    if (Json values = arguments(one); !values.empty()) made["arguments"] = std::move(values);
    return made;
}

Json json(const DrawnLine& line) {
    return {{"page", line.page},         {"thickness_pt", mm(line.thickness_pt)},
            {"color", json(line.color)}, {"points", json(line.points)},
            {"dropped", line.dropped},   {"place", json(line.place)}};
}

Json json(const DrawnPrint& print) {
    Json made{{"page", print.page}, {"dropped", print.dropped}, {"place", json(print.place)}};
    if (const auto* area = std::get_if<DrawnArea>(&print.what)) {
        made["kind"] = "area";
        made["d"] = area->shape.text;
        made["fill"] = json(area->fill);
        return made;
    }
    made["at"] = json(print.at);
    made["rotate_deg"] = mm(print.rotate_deg);
    if (const auto* text = std::get_if<DrawnText>(&print.what)) {
        made["kind"] = "text";
        made["text"] = text->text;
        made["height_mm"] = mm(text->height_mm);
        made["font"] = to_string(text->font);
        made["fill"] = json(text->fill);
        return made;
    }
    const auto& image = std::get<DrawnImage>(print.what);
    made["kind"] = "image";
    made["href"] = image.href;
    made["width_mm"] = mm(image.width_mm);
    made["height_mm"] = mm(image.height_mm);
    made["fit"] = kPictureFitNames.at(static_cast<std::size_t>(image.fit));
    made["pixels"] = Json::array({image.picture.width, image.picture.height});
    if (image.horizon) made["horizon"] = mm(*image.horizon);
    if (image.horizon_mm) made["horizon_mm"] = mm(*image.horizon_mm);
    return made;
}

}  // namespace

std::string emit_design(const Design& design) {
    Json made{{"file", design.file},
              {"stem", design.stem},
              {"version", design.version},
              {"unit", design.unit.name},
              {"width_mm", mm(design.width_mm)},
              {"height_mm", mm(design.height_mm)},
              {"left", json(design.left)},
              {"right", json(design.right)},
              {"place", json(design.page_place)},
              {"structures", list(design.structures, [](const Structure& s) { return json(s); })},
              {"lines", list(design.lines, [](const DrawnLine& l) { return json(l); })}};
    if (design.opens_deg < 180.0) made["opens_deg"] = design.opens_deg;
    if (design.orientation != Orientation::guessed)
        made["orientation"] = nth(kOrientationNames, design.orientation);
    if (!design.prints.empty())
        made["prints"] = list(design.prints, [](const DrawnPrint& print) { return json(print); });
    return json_text(made);
}

}  // namespace popup
