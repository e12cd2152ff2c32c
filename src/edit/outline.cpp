// A drawn silhouette for a piece.
#include <fmt/format.h>

#include <array>
#include <utility>

#include "edit/drawn_feet.h"
#include "edit/drawn_once.h"
#include "edit/session.h"
#include "edit/stand_drawing.h"
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

constexpr std::array<std::pair<std::string_view, DrawingFit>, 5> kFits{{{"seams", DrawingFit::seams},
                                                                        {"width", DrawingFit::width},
                                                                        {"height", DrawingFit::height},
                                                                        {"both", DrawingFit::both},
                                                                        {"none", DrawingFit::none}}};

std::optional<DrawingFit> fit_of(Session& session, const Command& command) {
    const std::string* given = command.find("fit");
    if (given == nullptr) return DrawingFit::seams;
    for (const auto& [name, fit] : kFits) {
        if (name == *given) return fit;
    }
    session.fail("bad-edit",
                 fmt::format("--fit is one of seams, width, height, both and none, not '{}'", shown(*given)));
    return std::nullopt;
}

std::string mm_text(double mm) { return fmt::format("{:.1f} mm", mm); }
std::string text_of(Vec2 p) { return fmt::format("({:.1f}, {:.1f})", p.x, p.y); }

// On a piece without seams: the middle of its lower end stays where that of the box is.
Path fitted(const Path& drawn, const Box& place, DrawingFit fit) {
    Box box;
    for (const Subpath& line : drawn.subpaths()) {
        const Box one = box_of(outline_of(line));
        box.extend(one.min);
        box.extend(one.max);
    }
    Vec2 scale{1.0, 1.0};
    const bool has_size = box.width() > 0.0 && box.height() > 0.0 && !place.empty();
    if (has_size && place.width() > 0.0 && fit != DrawingFit::none && fit != DrawingFit::height)
        scale.x = scale.y = place.width() / box.width();
    if (has_size && place.height() > 0.0 && (fit == DrawingFit::height || fit == DrawingFit::both)) {
        scale.y = place.height() / box.height();
        if (fit == DrawingFit::height) scale.x = scale.y;
    }
    const Vec2 from{box.centre().x, box.min.y};
    const Vec2 to = place.empty() ? Vec2{} : Vec2{place.centre().x, place.min.y};
    return drawn.mapped([&](Vec2 p) {
        const Vec2 d = p - from;
        return to + Vec2{scale.x * d.x, scale.y * d.y};
    });
}

// The drawing on the piece, on its seams where it has any.
std::optional<Path> placed(Session& session, std::size_t n, const xml::OutlineDrawing& drawing,
                           const std::string& from, const Box& place, DrawingFit fit) {
    const Structure& structure = session.design.structures[n];
    const ElementInfo& info = Session::info_of(structure);
    const std::vector<GlueChain> chains = glue_chains(structure.id, info, folds_on_pages(session, n));
    if (chains.empty() || chains.size() > 2) return fitted(drawing.path, place, fit);
    StoodDrawing stood = stand_drawing(drawing.path, chains, fit, place);
    if (!stood.refusal.what.empty()) {
        session.fail("bad-edit", fmt::format("the drawing in {} {}", from, stood.refusal.what),
                     stood.refusal.hint);
        return std::nullopt;
    }
    for (const StoodDrawing::Cut& cut : stood.cuts) {
        const std::string where =
            fmt::format("between {} and {} mm on its page", text_of(cut.from), text_of(cut.to));
        if (cut.round && cut.mm > 0.05) {
            session.remark("drawing-cut",
                           fmt::format("the drawing in {} has no straight edge to stand on that is a fifth "
                                       "as wide as it is; its lowest {:.1f} "
                                       "mm were cut off, {}, where it is wide enough for {}",
                                       from, cut.mm, where, cut.on),
                           "draw a straight edge along its lower end to keep all of it");
        } else if (!cut.round && cut.mm > kMeantMm) {
            session.remark("drawing-cut",
                           fmt::format("the drawing in {} reaches {:.1f} mm beyond {}, {}; that was cut off",
                                       from, cut.mm, cut.on, where),
                           "draw that edge as the seams lie to keep all of it");
        }
    }
    return std::move(stood.path);
}

}  // namespace

bool outline(Session& session, const Command& command) {
    const auto n = session.find(command.words.front());
    if (!n) return false;
    Structure& structure = session.design.structures[*n];
    const ElementInfo& info = Session::info_of(structure);
    const auto parameter = find_parameter(info, "outline");
    if (!parameter)
        return session.fail("bad-edit", fmt::format("{} has no outline", with_article(info.name)));
    const std::string* data = command.find("d");
    const std::string* from = command.find("from");
    if ((data == nullptr) == (from == nullptr))
        return session.fail("bad-edit", "an outline comes from a file or from path data",
                            "write --from bird.svg or --d 'M 0 0 L …'");
    if (data != nullptr) return session.set_parameter(structure, info, *parameter, *data);
    Diagnostics trouble(*from);
    const auto file = read_source(*from, trouble);
    if (!file) {
        return session.fail("bad-edit",
                            fmt::format("the drawing {} {}", shown(*from), trouble.sorted().front().message));
    }
    xml::OutlineDrawing drawing;
    if (const std::string refusal = xml::read_outline_drawing(*from, file->text, drawing); !refusal.empty())
        return session.fail("bad-edit", fmt::format("{} has no outline: {}", *from, refusal));
    const auto fit = fit_of(session, command);
    if (!fit) return false;
    std::vector<Vec2> repeated;
    drawing.path = drawn_once(drawing.path, repeated);
    if (!repeated.empty()) {
        session.remark(
            "drawing-twice",
            fmt::format("the drawing in {} has {} twice, {} from its left and {} above its lower "
                        "end; {} taken once",
                        *from, repeated.size() == 1 ? "a line" : fmt::format("{} lines", repeated.size()),
                        mm_text(repeated.front().x), mm_text(repeated.front().y),
                        repeated.size() == 1 ? "it is" : "each is"),
            "take one of the two out of the drawing");
    }
    const auto path = placed(session, *n, drawing, *from, place_of(structure, info, *parameter), *fit);
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
