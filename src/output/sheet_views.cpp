// Which pictures of a layout there are.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/nth.h"
#include "base/text/font_file.h"
#include "base/text/numbers.h"
#include "fabrication/count_operations.h"
#include "fabrication/glue_marks.h"
#include "fabrication/marks.h"
#include "output/cairo_sheet.h"
#include "output/pictures_left_out.h"
#include "output/sheet_legend.h"
#include "output/sheet_sides.h"
#include "output/text_outlines.h"

namespace popup {
namespace {

bool has_room(const Layout& layout, const OutputOptions& options, Diagnostics& diagnostics) {
    for (const LayoutSheet& sheet : layout.sheets) {
        const double longest = longest_reference(sheet.width_mm);
        if (options.reference_mm <= longest || options.reference_mm <= 0.0) continue;
        diagnostics
            .error(
                "reference-too-long", {},
                fmt::format("a bar of {} mm does not fit below the pieces of a sheet {:.1f} mm wide, which "
                            "has room for {:.0f} mm",
                            number_text(options.reference_mm, 3), sheet.width_mm,
                            std::max(std::floor(longest), 0.0)))
            .hint("ask for a shorter bar with --reference");
        return false;
    }
    return true;
}

// A font that a printed text of the layout is in, and that cannot be read. That of labels is looked at where
// they are outlined or painted.
std::optional<TextFont> missing_font(const Layout& layout) {
    std::array<bool, kTextFontNames.size()> used{};
    for (const DesignPattern& design : layout.designs) {
        for (const PatternPiece& piece : design.pattern.pieces) {
            for (const PatternPrint& one : piece.prints) {
                if (const Text* text = std::get_if<Text>(&one.print))
                    used.at(static_cast<std::size_t>(text->font)) = true;
            }
        }
    }
    for (std::size_t i = 1; i < used.size(); ++i) {
        if (used.at(i) && !can_outline_text(static_cast<TextFont>(i))) return static_cast<TextFont>(i);
    }
    return std::nullopt;
}

// What lies on several plates is one.
struct Printed {
    std::set<const std::string*> pictures;
    std::set<std::string_view> texts;
    std::set<Operation> operations;  // that draw these
};

// What of the prints these operations draw, or would draw.
template <class Asked>
Printed printed_on(const Layout& layout, const Asked& asked) {
    Printed all;
    for (const Placement& placement : layout.placements) {
        const Pattern& pattern = nth(layout.designs, placement.design).pattern;
        const PatternPiece& piece = nth(pattern.pieces, placement.piece);
        for (const PatternPrint& one : piece.prints) {
            const Operation operation = operation_of(one.print);
            if (!asked(operation)) continue;
            const Image* image = std::get_if<Image>(&one.print);
            const Text* text = std::get_if<Text>(&one.print);
            if (image != nullptr) all.pictures.insert(image->bytes.get());
            if (text != nullptr && text->color) all.texts.insert(text->text);
            if (image != nullptr || (text != nullptr && text->color)) all.operations.insert(operation);
        }
    }
    return all;
}

// Not the colours of plates and drawn lines: hardly a card has none, and whoever cuts it knows.
void name_pictures(const Layout& layout, const Profile& profile, std::vector<std::string>& missing,
                   std::set<Operation>& pens) {
    auto [pictures, texts, operations] =
        printed_on(layout, [&](Operation operation) { return !profile.draws(operation); });
    pens.merge(operations);
    const auto name = [&missing](std::size_t count, std::string_view what) {
        if (count > 0) missing.push_back(fmt::format("{} {}{}", count, what, count == 1 ? "" : "s"));
    };
    name(pictures.size(), "picture");
    name(texts.size(), "printed text");
}

std::string counted(std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

bool prints_glue(const OutputOptions& options) {
    return options.print_and_cut ||
           (options.profile.draws(Operation::glue) && options.profile.draws(Operation::label));
}

void examine_glue_marks(const Layout& layout, const OutputOptions& options, Diagnostics& diagnostics) {
    const Profile& profile = options.profile;
    const bool printed = prints_glue(options);
    const bool marked = !printed && profile.marks_glue();
    const bool named =
        marked && (profile.marks_on != MarksOn::hidden || options.score_side != ScoreSide::front);
    const bool has_backs = are_backs_marked(options);
    std::size_t targets = 0;
    std::size_t behind = 0;  // targets on backs, which only views of backs have
    std::size_t numbers = 0;
    std::size_t flat = 0;  // pieces that are glued flat and have no room for a number where they are
    for (const Placement& placement : layout.placements) {
        const Pattern& pattern = nth(layout.designs, placement.design).pattern;
        const PatternPiece& piece = nth(pattern.pieces, placement.piece);
        const auto is_tab = [](const Label& label) { return label.kind == LabelKind::tab; };
        const auto tabs =
            static_cast<std::size_t>(std::count_if(piece.labels.begin(), piece.labels.end(), is_tab));
        const auto backs = static_cast<std::size_t>(std::count_if(
            piece.targets.begin(), piece.targets.end(), [](const GlueTarget& one) { return one.on_back; }));
        if (!has_backs) behind += backs;
        if (printed) continue;
        if (!marked) {
            targets += piece.targets.size() - backs;
            numbers += tabs;
        }
        const bool hidden = marked && profile.marks_on == MarksOn::hidden && piece.hidden_number;
        if (!named && !hidden && tabs == 0 && !piece.number.empty()) ++flat;
    }
    std::vector<std::string> missing;
    if (targets > 0) missing.push_back(counted(targets, "glue target"));
    if (behind > 0) missing.push_back(counted(behind, "glue target") + " on backs");
    if (numbers > 0) missing.push_back(counted(numbers, "number") + " of tabs");
    if (flat > 0) missing.push_back("the numbers of " + counted(flat, "piece") + " glued flat");
    if (missing.empty()) return;
    diagnostics
        .remark(
            "glue-marks-left-out", {},
            fmt::format("the sheets by the profile {} lack {}", profile.name, fmt::join(missing, " and ")))
        .hint(printed                         ? "take --sides both, which prints them on the backs"
              : targets + numbers + flat == 0 ? "take --marks-on back, which marks all of it on the back"
              : marked ? "take --marks-on front, which marks them where they are seen, or --marks-on back"
              : profile.marks_on == MarksOn::none
                  ? "leave out --marks-on none, or build printed sheets beside these to glue by"
                  : "give the pen \"mark\" a layer, or build printed sheets beside these to glue by");
}

// Whether the marks of backs are more than those of what is covered there.
bool marks_all_of_backs(const OutputOptions& options) {
    const MarksOn where = options.profile.marks_on;
    return marks_joints(where, options.score_side, true) || marks_names(where, options.score_side, true);
}

// By sheet: whether any of its paper is marked on its back where something is glued on it.
std::vector<char> covered_backs(const Layout& layout) {
    std::vector<char> covered(layout.sheets.size(), 0);
    for (const Placement& placement : layout.placements) {
        const Pattern& pattern = nth(layout.designs, placement.design).pattern;
        const PatternPiece& piece = nth(pattern.pieces, placement.piece);
        if ((piece.hidden_number && piece.hidden_number->on_back) ||
            std::any_of(piece.targets.begin(), piece.targets.end(),
                        [](const GlueTarget& one) { return one.on_back; }))
            nth(covered, placement.sheet) = 1;
    }
    return covered;
}

// A sheet of backs that nobody asked for says in its name alone what it is.
void examine_backs(const Layout& layout, const OutputOptions& options, Diagnostics& diagnostics) {
    if (options.backs || options.score_side != ScoreSide::front || options.print_and_cut ||
        !options.profile.marks_glue() || marks_all_of_backs(options) ||
        !marks_covered_backs(options.profile.marks_on, options.score_side, true))
        return;
    const std::vector<char> covered = covered_backs(layout);
    const auto backs = static_cast<std::size_t>(std::count(covered.begin(), covered.end(), 1));
    if (backs == 0) return;
    diagnostics
        .remark("backs-to-mark", {},
                fmt::format("{} mirrored back{}, with marks of what is glued there",
                            backs == 1 ? "1 sheet has a" : fmt::format("{} sheets have", backs),
                            backs == 1 ? "" : "s"))
        .hint(
            "mark the back first (the file whose name ends in -back; in PDF the page after the front), turn "
            "the sheet over from left to right, and cut the front; --marks-on none leaves all marks out");
}

// Joints are known where sheets are drawn.
void examine_joints(const Layout& layout, const OutputOptions& options, Diagnostics& diagnostics) {
    if (options.profile.joint_mm <= 0.0 || !options.profile.draws(Operation::outer_cut)) return;
    SheetView view;
    view.back = options.score_side == ScoreSide::back;
    view.part = options.print_and_cut ? SheetView::Part::cut : SheetView::Part::whole;
    std::size_t loose = 0;
    std::string first;
    for (std::size_t i = 0; i < layout.sheets.size(); ++i) {
        view.sheet = static_cast<int>(i);
        const SheetDrawing drawing = draw_sheet(layout, options, view);
        if (loose == 0 && !drawing.loose_pieces.empty())
            first = nth(drawing.pieces, drawing.loose_pieces.front()).name;
        loose += drawing.loose_pieces.size();
    }
    if (loose == 0) return;
    diagnostics
        .warning(
            "too-few-joints", {},
            fmt::format("the outer cut{} of \"{}\"{} no room for two joints of {} mm clear of corners, folds "
                        "and holes",
                        loose > 1 ? "s" : "", first,
                        loose > 1 ? fmt::format(" and {} have", counted(loose - 1, "more piece")) : " has",
                        number_text(options.profile.joint_mm, 3)))
        .hint("ask for narrower joints with --joints, or hold the sheet down");
}

void examine_legend(const Layout& layout, const OutputOptions& options, Diagnostics& diagnostics) {
    if (options.legend != Legend::always) return;
    SheetView view;
    view.part = options.print_and_cut ? SheetView::Part::print : SheetView::Part::whole;
    if (!profile_of(options, view).draws(Operation::legend)) return;
    std::vector<std::string> without;
    for (std::size_t i = 0; i < layout.sheets.size(); ++i) {
        view.sheet = static_cast<int>(i);
        const SheetDrawing drawing = draw_sheet(layout, options, view);
        const auto is_legend = [](const auto& thing) { return thing.operation == Operation::legend; };
        if (std::none_of(drawing.shapes.begin(), drawing.shapes.end(), is_legend))
            without.push_back(std::to_string(i + 1));
    }
    if (without.empty()) return;
    diagnostics
        .warning("legend-left-out", {},
                 fmt::format("sheet{} {} {} no room for the legend beside the pieces",
                             without.size() == 1 ? "" : "s", fmt::join(without, ", "),
                             without.size() == 1 ? "has" : "have"))
        .hint("choose a larger sheet with --sheet, or leave out --legend always");
}

}  // namespace

bool are_backs_marked(const OutputOptions& options) {
    if (prints_glue(options)) return options.backs;
    const MarksOn where = options.profile.marks_on;
    return options.profile.marks_glue() && (marks_joints(where, options.score_side, true) ||
                                            marks_covered_backs(where, options.score_side, true));
}

double margin_needed(const OutputOptions& options) {
    return std::max(clear_of(options.profile.marks), options.reference_mm > 0.0 ? kReferenceMarginMm : 0.0);
}

void examine_prints(const Layout& layout, const OutputOptions& options, Diagnostics& diagnostics) {
    examine_glue_marks(layout, options, diagnostics);
    examine_backs(layout, options, diagnostics);
    examine_joints(layout, options, diagnostics);
    examine_legend(layout, options, diagnostics);
    const Profile& profile = options.profile;
    std::vector<std::string> missing;
    std::set<Operation> pens;  // that would draw it
    if (options.legend == Legend::always && !options.print_and_cut && !profile.draws(Operation::legend)) {
        missing.emplace_back("the legend");
        pens.insert(Operation::legend);
    }
    if (!options.print_and_cut) name_pictures(layout, profile, missing, pens);
    if (!profile.draws(Operation::registration)) {
        if (profile.marks != Marks::none) missing.emplace_back("registration marks");
        if (options.reference_mm > 0.0) missing.emplace_back("the bar to measure");
        if (profile.marks != Marks::none || options.reference_mm > 0.0) pens.insert(Operation::registration);
    }
    const bool prints = std::any_of(kOperations.begin(), kOperations.end(), [&profile](Operation operation) {
        return is_printed(operation) && operation != Operation::registration && profile.draws(operation);
    });
    if (options.backs && !prints && !options.print_and_cut) missing.emplace_back("printed backs");
    if (missing.empty()) return;
    std::vector<std::string> keys;
    keys.reserve(pens.size());
    for (const Operation pen : pens) keys.push_back(fmt::format("[pens.{}]", to_string(pen)));
    diagnostics
        .remark("prints-left-out", {},
                fmt::format("the profile {} leaves out {}{}", profile.name, fmt::join(missing, " and "),
                            options.print_and_cut ? ", which only the files of prints have" : ""))
        .hint(options.print_and_cut
                  ? "a profile of your own can give the pen of registration a layer"
                  : fmt::format("take --print-and-cut, which prints them to files of their own, or give {} a "
                                "layer in a profile of your own",
                                keys.empty() ? "their pens" : fmt::format("{}", fmt::join(keys, " and "))));
}

void tell_pictures_left_out(const Layout& layout, const OutputOptions& options, std::string_view suffix,
                            Diagnostics& diagnostics) {
    const auto is_meant = [&](Operation operation) {
        return options.print_and_cut || options.profile.draws(operation);
    };
    const std::size_t pictures = printed_on(layout, is_meant).pictures.size();
    if (pictures == 0) return;
    diagnostics
        .remark("prints-left-out", {},
                fmt::format("{} files hold lines, and leave out {}", suffix, counted(pictures, "picture")))
        .hint("sheets as .svg, .pdf or .png have what is printed");
}

Profile profile_of(const OutputOptions& options, const SheetView& view) {
    Profile profile = options.profile;
    if (view.part != SheetView::Part::print) return profile;
    const Profile& workshop = profile_table().front();
    for (const Operation operation : kOperations) {
        Pen& pen = profile.pens[static_cast<std::size_t>(operation)];
        if (is_printed(operation) && pen.layer.empty()) pen = workshop.pen(operation);
    }
    return profile;
}

bool is_shown(Operation operation, const OutputOptions& options, const SheetView& view) {
    const bool print = view.part == SheetView::Part::print;
    if (is_printed(operation)) {
        if (!print && !options.profile.draws(operation)) return false;
        if (operation == Operation::legend)
            return options.legend != Legend::never && !view.back && view.part != SheetView::Part::cut;
        if (operation == Operation::registration)
            return options.profile.marks != Marks::none || options.reference_mm > 0.0;
        if (view.part == SheetView::Part::cut) return false;
        const bool note = operation == Operation::glue || operation == Operation::label;
        return view.back ? options.backs : !(note && options.backs);
    }
    if (print || !options.profile.draws(operation)) return false;
    if (operation == Operation::mark) {
        // The files of prints have it.
        if (options.print_and_cut || !options.profile.marks_glue()) return false;
        const MarksOn where = options.profile.marks_on;
        return marks_joints(where, options.score_side, view.back) ||
               marks_names(where, options.score_side, view.back) ||
               marks_covered_backs(where, options.score_side, view.back);
    }
    switch (options.score_side) {
        case ScoreSide::front:
            return !view.back;
        case ScoreSide::back:
            return view.back;
        case ScoreSide::both:
            return view.back == (operation == Operation::valley);
    }
    broken_invariant("a score side is one of its enumerators", __FILE__, __LINE__);
}

std::optional<std::vector<SheetView>> views_of(const Layout& layout, const OutputOptions& options,
                                               Diagnostics& diagnostics) {
    if (!has_room(layout, options, diagnostics)) return std::nullopt;
    if (options.profile.outlined_text && !can_outline_text()) {
        report_missing_font(POPUP_FONT_FILE, diagnostics);
        return std::nullopt;
    }
    if (const auto font = missing_font(layout)) {
        report_missing_font(font_path(*font), diagnostics);
        return std::nullopt;
    }
    using Part = SheetView::Part;
    const std::vector<Part> parts =
        options.print_and_cut ? std::vector{Part::print, Part::cut} : std::vector{Part::whole};
    const OperationCounts counts = count_operations(layout, options.profile);
    const bool folded_or_glued = is_folded_or_glued(counts);
    const std::vector<char> covered = covered_backs(layout);
    const bool all_of_backs = marks_all_of_backs(options);
    const auto shows_anything = [&](const SheetView& view) {
        return std::any_of(kOperations.begin(), kOperations.end(), [&](Operation operation) {
            if (operation == Operation::mark && view.back && !all_of_backs && nth(covered, view.sheet) == 0)
                return false;
            return counts.at(static_cast<std::size_t>(operation)) > 0 && is_shown(operation, options, view);
        });
    };
    // A machine that works on a back looks for the marks that are printed there.
    const auto has_marks_to_find = [&](SheetView view) {
        if (view.part != Part::print || options.profile.marks == Marks::none) return false;
        view.part = Part::cut;
        return shows_anything(view);
    };
    std::vector<SheetView> views;
    for (const Part part : parts) {
        SheetView view;
        view.folded_or_glued = folded_or_glued;
        view.part = part;
        view.part_suffix = part == Part::print ? "-print" : part == Part::cut ? "-cut" : "";
        const bool front = shows_anything(view);
        for (std::size_t i = 0; i < layout.sheets.size(); ++i) {
            view.sheet = static_cast<int>(i);
            view.back = true;
            const bool back = shows_anything(view) || has_marks_to_find(view);
            const std::string number = i == 0 ? std::string() : fmt::format("-{}", i + 1);
            // A layout with nothing on it is a sheet with nothing on it.
            if (front || !back) {
                view.back = false;
                view.suffix = number + view.part_suffix;
                views.push_back(view);
            }
            if (back) {
                view.back = true;
                view.suffix = number + (front ? "-back" : "") + view.part_suffix;
                views.push_back(view);
            }
        }
    }
    return views;
}

std::vector<std::span<const SheetView>> parts_of(std::span<const SheetView> views) {
    std::vector<std::span<const SheetView>> parts;
    for (std::size_t first = 0; first < views.size();) {
        std::size_t last = first;
        while (last < views.size() && views[last].part == views[first].part) ++last;
        parts.push_back(views.subspan(first, last - first));
        first = last;
    }
    return parts;
}

std::optional<std::vector<SheetFile>> file_per_view(const Layout& layout, const OutputOptions& options,
                                                    Diagnostics& diagnostics, const ViewWriter& write) {
    const std::optional<std::vector<SheetView>> views = views_of(layout, options, diagnostics);
    if (!views) return std::nullopt;
    std::vector<SheetFile> files;
    files.reserve(views->size());
    for (const SheetView& view : *views) {
        std::optional<std::string> bytes = write(draw_sheet(layout, options, view), view);
        if (!bytes) return std::nullopt;
        files.push_back({view.suffix, std::move(*bytes)});
    }
    return files;
}

}  // namespace popup
