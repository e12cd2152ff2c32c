// A drawn silhouette for a piece.
#include <fmt/format.h>

#include <algorithm>

#include "edit/session.h"
#include "input/text.h"
#include "input/xml/outline_file.h"
#include "popup/files.h"

namespace popup::edit {
namespace {

// The box of what the outline takes the place of: the old outline, or the piece's points.
Box place_of(const Structure& structure, const ElementInfo& info, std::size_t outline) {
    Box box;
    if (outline < structure.arguments.size()) {
        if (const auto* path = std::get_if<DrawnPath>(&structure.arguments[outline].value)) {
            for (const Polygon& area : path->inside.areas) {
                for (const Vec2 p : area.outer) box.extend(p);
            }
        }
    }
    if (!box.empty()) return box;
    for (std::size_t i = 0; i < structure.points.size(); ++i) {
        if (info.points[i].page == info.parameters[outline].page) box.extend(structure.points[i].at);
    }
    return box;
}

// Its lower left corner stays where that of the box is; in the middle of it where it is wider or narrower.
std::optional<Path> fitted(Session& session, const Path& drawn, const Box& place, std::string_view fit) {
    Box box;
    for (const Subpath& line : drawn.subpaths()) {
        box.extend(line.start);
        for (const PathStep& step : line.steps) box.extend(step.to);
    }
    double scale = 1.0;
    if (fit == "width" && box.width() > 0.0) {
        scale = place.width() / box.width();
    } else if (fit == "height" && box.height() > 0.0) {
        scale = place.height() / box.height();
    } else if (fit != "none") {
        session.fail("bad-edit", fmt::format("--fit is one of width, height and none, not '{}'", fit));
        return std::nullopt;
    }
    const Vec2 from{box.centre().x, box.min.y};
    const Vec2 to = place.empty() ? Vec2{} : Vec2{place.centre().x, place.min.y};
    return drawn.mapped([&](Vec2 p) { return to + scale * (p - from); });
}

}  // namespace

bool outline(Session& session, const Command& command) {
    const auto n = session.find(command.words.front());
    if (!n) return false;
    Structure& structure = session.design.structures[*n];
    const ElementInfo& info = Session::info_of(structure);
    const auto parameter = find_parameter(info, "outline");
    if (!parameter) return session.fail("bad-edit", fmt::format("a {} has no outline", info.name));
    const std::string* data = command.find("d");
    const std::string* from = command.find("from");
    if ((data == nullptr) == (from == nullptr))
        return session.fail("bad-edit", "an outline comes from a file or from path data",
                            "write --from bird.svg or --d 'M 0 0 L …'");
    if (data != nullptr) return session.set_parameter(structure, info, *parameter, *data);
    Diagnostics trouble(*from);
    const auto file = read_source(*from, trouble);
    if (!file) return session.fail("bad-edit", trouble.sorted().front().message);
    xml::OutlineDrawing drawing;
    if (const std::string refusal = xml::read_outline_drawing(*from, file->text, drawing); !refusal.empty())
        return session.fail("bad-edit", fmt::format("{} has no outline: {}", *from, refusal));
    const std::string* fit = command.find("fit");
    const auto path = fitted(session, drawing.path, place_of(structure, info, *parameter),
                             fit != nullptr ? std::string_view(*fit) : "width");
    if (!path) return false;
    DrawnPath made;
    made.path = *path;
    made.moved = true;
    if (enclose(made.path, made.inside) != FlatteningFault::none || made.inside.areas.empty())
        return session.fail("bad-edit", fmt::format("the outline in {} encloses nothing", *from));
    Argument& argument = structure.argument(*parameter);
    if (argument.given() && !argument.text.present() && argument.tag_text.present()) {
        return session.fail(
            "bad-edit", fmt::format("the outline of \"{}\" is named by the document as a file", structure.id),
            "write the name of the other file there: href");
    }
    argument.value = std::move(made);
    argument.changed = true;
    session.need_version(version_needed(info, structure.arguments));
    session.touch(*n);
    return true;
}

}  // namespace popup::edit
