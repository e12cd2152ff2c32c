#include "input/xml/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "assembly/orientation_names.h"
#include "base/text/nearest.h"
#include "input/design_limits.h"
#include "input/text.h"
#include "input/xml/allowances.h"
#include "input/xml/encoding.h"
#include "input/xml/fields.h"
#include "input/xml/ground_names.h"
#include "input/xml/locate.h"
#include "input/xml/number.h"
#include "input/xml/read_prints.h"
#include "input/xml/tree.h"
#include "input/xml/units.h"
#include "input/xml/values.h"
#include "popup/mechanism.h"

namespace popup::xml {
namespace {

constexpr std::array<std::string_view, 2> kVersions{"2.0", "3.0"};

class DocumentReader {
 public:
    DocumentReader(const Source& source, const Located& located, const ReadOptions& options,
                   Diagnostics& diagnostics)
        : located_(located),
          reporter_(diagnostics, options.strict),
          values_(source.text, {}, reporter_),
          pictures_(source, options) {
        values_.set_files(pictures_);
        design_.file = source.name;
        design_.stem = source.stem();
    }

    [[nodiscard]] const PictureFiles& pictures() const { return pictures_; }

    // The design as far as it could be read; it is whole when no error was added.
    Design run() {
        if (!read_root()) return std::move(design_);
        reporter_.set_structure(Reporter::kNone);
        name_structures(design_);
        reporter_.name_structures(design_.structures);
        GroundNames(design_, reporter_).resolve();
        return std::move(design_);
    }

 private:
    using Item = void (DocumentReader::*)(Name, Node);

    bool read_root() {
        const Place place = located_.elements[0].place;
        const std::string_view name = located_.name(0);
        if (find_name(Name::document, name) != Name::popup) {
            Diagnostic& made = reporter_.error(
                "wrong-root", place, fmt::format("the root element is <{}>, not <popup>", shown(name)));
            if (name == "svg" || name.ends_with(":svg"))
                made.hint("--from svg reads a drawing whatever its name");
            return false;
        }
        const auto shell = Tree::parse(located_, 0, Tree::Extent::shell, reporter_.diagnostics());
        if (!shell) return false;
        design_.page_place = place;
        design_.root_tag = shell->root().start_tag();
        design_.root_text = shell->root().whole();

        // Lists are not parsed whole: their items are, one at a time.
        Fields fields(shell->root(), Name::popup, reporter_);
        std::deque<Tree> trees;
        std::deque<Tree> holes;
        Offset structures = 0;
        Offset lines = 0;
        for (Offset child = 1; child < located_.elements[0].after; child = located_.elements[child].after) {
            const Name found = fields.wants(located_.name(child), located_.elements[child].place);
            if (found == Name::unknown) continue;
            const bool list = found == Name::structurelist || found == Name::drawnlinelist;
            auto tree = Tree::parse(located_, child, list ? Tree::Extent::shell : Tree::Extent::whole,
                                    reporter_.diagnostics());
            if (!tree) return false;
            if (found == Name::hole) {
                holes.push_back(std::move(*tree));
                continue;
            }
            trees.push_back(std::move(*tree));
            fields.add(found, trees.back().root());
            if (found == Name::structurelist) structures = child;
            if (found == Name::drawnlinelist) lines = child;
        }

        read_version(fields.find(Name::version));
        values_.set_pages(pages_, design_.version >= "3.0");
        read_units(fields.find(Name::units));
        if (const Field* field = element_field(fields, Name::mainpage)) read_mainpage(field->node);
        if (const Field* field = element_field(fields, Name::structurelist)) {
            design_.list_text = field->node.whole();
            if (!read_list(structures, field->node, Name::structurelist, &DocumentReader::read_structure))
                return false;
        }
        if (design_.structures.size() + holes.size() > kItemsLimit) {
            reporter_.error(
                "document-too-large", holes.back().root().place(),
                fmt::format("'structurelist' has more than {} entries, holes included", kItemsLimit));
            return false;
        }
        for (const Tree& hole : holes) read_hole(hole.root());
        if (const Field* field = element_field(fields, Name::drawnlinelist)) {
            if (!read_list(lines, field->node, Name::drawnlinelist, &DocumentReader::read_printed))
                return false;
        }
        return true;
    }

    // A field that has fields of its own and so cannot be an attribute.
    const Field* element_field(const Fields& fields, Name name) {
        const Field* field = fields.find(name);
        if (!field || field->node) return field;
        reporter_.unknown_name(fields.context(), canonical(name), field->place, true);
        return nullptr;
    }

    bool read_list(Offset list, Node shell, Name name, Item read_item) {
        Fields fields(shell, name, reporter_);
        const Offset end = located_.elements[list].after;
        std::size_t items = 0;
        for (Offset child = list + 1; child < end; child = located_.elements[child].after) {
            const Name found = fields.wants(located_.name(child), located_.elements[child].place);
            if (found == Name::unknown) continue;
            if (++items > kItemsLimit) {
                reporter_.error("document-too-large", located_.elements[child].place,
                                fmt::format("'{}' has more than {} entries", canonical(name), kItemsLimit));
                return false;
            }
            const auto tree = Tree::parse(located_, child, Tree::Extent::whole, reporter_.diagnostics());
            if (!tree) return false;
            (this->*read_item)(found, tree->root());
        }
        return true;
    }

    void read_version(const Field* field) {
        if (!field) return;
        const auto text = value_of(*field, reporter_);
        if (!text) return;
        std::string version(trimmed(text->decoded));
        design_.version_text = values_.tight(*text);
        if (version == "2" || version == "3") version += ".0";
        if (std::find(kVersions.begin(), kVersions.end(), version) != kVersions.end()) {
            design_.version = version;
            return;
        }
        reporter_.warning("unknown-version", text->place,
                          fmt::format("version '{}' is not known; the document is read as {}", shown(version),
                                      design_.version));
    }

    void read_units(const Field* field) {
        if (!field) return;
        const auto text = value_of(*field, reporter_);
        if (!text) return;
        if (const Unit* unit = find_unit(trimmed(text->decoded))) {
            design_.unit = *unit;
            values_.set_unit(*unit);
            return;
        }
        std::string known;
        for (const UnitRow& row : unit_table())
            known += (known.empty() ? "" : ", ") + std::string(row.unit.name);
        reporter_
            .error("bad-unit", text->place,
                   fmt::format("the unit '{}' is not known", shown(trimmed(text->decoded))))
            .hint("known units are " + known);
        unit_is_known_ = false;
    }

    void read_mainpage(Node node) {
        const Fields fields(node, Name::mainpage, reporter_);
        design_.page_place = node.place();
        design_.left = values_.color(fields.find(Name::leftcolor));
        design_.right = values_.color(fields.find(Name::rightcolor));
        const bool has_width = read_page_size(fields.find(Name::width), design_.width_mm);
        const bool has_height = read_page_size(fields.find(Name::height), design_.height_mm);
        if (has_width && has_height && unit_is_known_)
            doubt_page_size(design_.width_mm, design_.height_mm, design_.unit, design_.page_place, reporter_);
        if (const Field* field = fields.find(Name::opens)) read_opening(*field);
        if (const Field* field = fields.find(Name::orientation)) read_orientation(*field);
    }

    void read_orientation(const Field& field) {
        const auto text = value_of(field, reporter_);
        if (!text) return;
        const std::string word = lower(trimmed(text->decoded));
        const auto known = std::find(kOrientationNames.begin() + 1, kOrientationNames.end(), word);
        if (known == kOrientationNames.end()) {
            reporter_
                .error("bad-choice", text->place,
                       fmt::format("'{}' is no orientation of a card", shown(trimmed(text->decoded))))
                .hint(
                    "write upright, for a model that stands on its edge, flat, for one that lies open, or "
                    "stage, for one with a page on the ground and the other for a back wall");
            return;
        }
        design_.orientation = static_cast<Orientation>(known - kOrientationNames.begin());
        warn_of_version(field, "orientation");
    }

    void read_opening(const Field& field) {
        const auto degrees = values_.number(field);
        if (!degrees) return;
        if (!(*degrees >= kLeastOpening && *degrees <= kWholeOpening)) {
            reporter_.error("bad-number", field.place,
                            fmt::format("the card opens to {} degrees, and must open to between {} and {}",
                                        format_number(*degrees), format_number(kLeastOpening),
                                        format_number(kWholeOpening)));
            return;
        }
        design_.opens_deg = *degrees;
        warn_of_version(field, "opens");
    }

    void warn_of_version(const Field& field, std::string_view name) {
        if (design_.version >= "3.0") return;
        reporter_
            .warning("newer-element", field.place,
                     fmt::format("a mainpage has no {} in version {}", name, design_.version))
            .hint("write version=\"3.0\"");
    }

    // False after an error.
    bool read_page_size(const Field* field, double& size) {
        if (!field) return true;
        const auto mm = values_.length(*field);
        if (!mm) return false;
        if (*mm >= kSmallestPage && *mm <= kLargestPage) {
            size = *mm;
            return true;
        }
        reporter_.error(
            "page-size", field->place,
            fmt::format("the page's {} is {} mm, and must be from {} to {} mm", canonical(field->name),
                        format_number(*mm), format_number(kSmallestPage), format_number(kLargestPage)));
        return false;
    }

    void read_structure(Name /*name*/, Node node) {
        const std::size_t n = design_.structures.size();
        reporter_.set_structure(n);
        const Fields fields(node, Name::structure, reporter_);
        Structure& made = design_.structures.emplace_back();
        made.place = node.place();
        made.tag_text = node.whole();
        made.start_tag = node.start_tag();
        read_id(fields.find(Name::id), made);
        const ElementInfo* info = read_type(fields.find(Name::type), made);
        const bool glued = info != nullptr && info->glued;
        pages_made_ += glued ? 1 : 0;
        if (made.id_given) pages_.emplace(made.id, glued ? pages_made_ : -1);
        read_outer_points(fields, made, info);
        if (info) read_arguments(fields, made, *info);
        read_ground(fields, made, info);
        reporter_.set_structure(Reporter::kNone);
    }

    // A hole that stands beside the list of structures comes after all of them.
    void read_hole(Node node) {
        const ElementInfo* info = find_element("hole");
        if (info == nullptr) return reporter_.unknown_name(Name::popup, node.name(), node.place(), false);
        reporter_.set_structure(design_.structures.size());
        Structure& made = design_.structures.emplace_back();
        made.type = info->name;
        made.place = made.type_place = node.place();
        made.tag_text = node.whole();
        made.start_tag = node.start_tag();
        if (info->since > design_.version) {
            reporter_
                .warning("newer-element", node.place(),
                         fmt::format("'{}' is not an element of version {}", info->name, design_.version))
                .hint(fmt::format("write version=\"{}\"", info->since));
        }
        const Field field{Name::argument, node.place(), {}, node, info->parameters.front().name};
        if (auto value = values_.argument(field, info->parameters.front()))
            made.argument(0) = std::move(*value);
        find_ground(made, *info);
        reporter_.set_structure(Reporter::kNone);
    }

    // The values that the element's row names; other elements' are unknown here.
    void read_arguments(const Fields& fields, Structure& made, const ElementInfo& info) {
        std::optional<Fields> folds;
        if (const Field* field = element_field(fields, Name::folds))
            folds.emplace(field->node, Name::folds, reporter_);
        for (std::size_t i = 0; i < info.parameters.size(); ++i) {
            const ParameterInfo& parameter = info.parameters[i];
            const Field* field = fields.find(parameter.name);
            if (field == nullptr && folds && !parameter.group.empty()) field = folds->find(parameter.name);
            if (field != nullptr) {
                if (auto value = values_.argument(*field, parameter)) made.argument(i) = std::move(*value);
                if (parameter.since > design_.version && parameter.since > info.since) {
                    reporter_
                        .warning("newer-element", field->place,
                                 fmt::format("a {} has no {} in version {}", info.name, parameter.name,
                                             design_.version))
                        .hint(fmt::format("write version=\"{}\"", parameter.since));
                }
            } else if (parameter.required) {
                reporter_
                    .error("missing-value", made.place,
                           fmt::format("this {} has no {}", info.name, parameter.name))
                    .hint(fmt::format("{} is the {}", parameter.name, parameter.about));
            }
        }
        for (const Field& field : fields.all()) {
            if (!is_value(field.name) || find_parameter(info, field.word())) continue;
            reporter_.value_of_others(info, field.word(), field.place, !field.node);
        }
        if (!folds) return;
        for (const Field& field : folds->all()) {
            const auto known = find_parameter(info, field.word());
            if (known && !info.parameters[*known].group.empty()) continue;
            reporter_.unknown_name(Name::folds, field.word(), field.place, !field.node);
        }
    }

    // What finds its ground lies on the page of its outline, or of its first point that names one.
    static void find_ground(Structure& made, const ElementInfo& info) {
        made.finds_ground = true;
        made.fold.place = made.place;
        std::optional<int> page;
        for (const DesignPoint& point : made.points) {
            if (!page) page = point.page;
        }
        for (std::size_t i = 0; i < made.arguments.size(); ++i) {
            if (!page && info.parameters[i].page == PointPage::fold) page = made.arguments[i].page;
        }
        made.fold.page = page.value_or(0);
    }

    // Names that mean something in a structure only where its element has such a parameter.
    static bool is_value(Name name) {
        return name == Name::argument || name == Name::leftcolor || name == Name::rightcolor ||
               name == Name::lefttabcolor || name == Name::righttabcolor;
    }

    void read_ground(const Fields& fields, Structure& made, const ElementInfo* info) {
        const Field* plate = fields.find(Name::parentplate);
        const Field* fold = element_field(fields, Name::parentfold);
        if (plate && fold) {
            reporter_.error(
                "duplicate-value", plate->place,
                fmt::format("a structure stands on a plate or on a fold; its parentfold is on line {}",
                            fold->place.line));
        } else if (plate) {
            read_plate(*plate, made.plate.emplace());
        } else if (fold) {
            read_fold(fold->node, made.fold);
        } else if (info && (info->grounds.found || info->grounds.page)) {
            find_ground(made, *info);
        } else if (info && !info->grounds.fold && !info->grounds.seam) {
            reporter_.error("missing-value", made.place, "this structure has no parentplate")
                .hint("name the plate by any point of it: <parentplate page=\"0\" x=\"1\" y=\"1\"/>");
        } else {
            reporter_.error("missing-value", made.place, "this structure has no parentfold")
                .hint("for the gutter write <parentfold page=\"0\"> with its begin and end");
        }
    }

    void read_plate(const Field& field, ParentPlate& plate) {
        plate.place = field.place;
        if (field.node) {
            const Fields fields(field.node, Name::parentplate, reporter_);
            plate.at.place = field.place;
            if (read_ground_name(fields, {Name::x, Name::y, Name::page}, design_.version, values_, plate.on))
                return;
        }
        if (const auto point = values_.point(field)) plate.at = *point;
        plate.page = plate.at.page.value_or(0);
        plate.page_text = plate.at.page_text;
        plate.tag_text = plate.at.tag_text;
    }

    void read_id(const Field* field, Structure& made) {
        if (!field) return;
        const auto text = value_of(*field, reporter_);
        if (!text) return;
        const std::string id(trimmed(text->decoded));
        if (!is_id(id)) {
            reporter_.error("bad-id", text->place, fmt::format("'{}' cannot be an id", shown(id)))
                .hint(std::string(kIdHint));
            return;
        }
        if (id == kBasePage) {
            reporter_.error("bad-id", text->place, "the id 'page' is kept for the base page");
            return;
        }
        const auto [known, fresh] = ids_.emplace(id, text->place);
        if (!fresh) {
            reporter_.error("duplicate-id", text->place,
                            fmt::format("the id '{}' is given twice; the first is on line {}", shown(id),
                                        known->second.line));
        }
        made.id = id;
        made.id_given = true;
        made.id_text = values_.tight(*text);
    }

    const ElementInfo* read_type(const Field* field, Structure& made) {
        made.type_place = made.place;
        if (!field) {
            reporter_.error("missing-value", made.place, "this structure has no type")
                .hint("`popupc list elements` shows all types");
        }
        const auto text = field ? value_of(*field, reporter_) : std::nullopt;
        if (!text) return nullptr;
        made.type_place = text->place;
        made.type_text = values_.tight(*text);
        const std::string_view name = trimmed(text->decoded);
        const ElementInfo* info = find_element(name);
        if (!info) {
            Diagnostic& error = reporter_.error("unknown-type", text->place,
                                                fmt::format("the type '{}' is not known", shown(name)));
            std::vector<std::string_view> names;
            for (const ElementInfo& row : element_table()) names.push_back(row.name);
            const std::vector<std::string> near = nearest(lower(name), names, 1);
            error.hint(near.empty() ? "`popupc list elements` shows all types"
                                    : fmt::format("perhaps '{}' is meant", near.front()));
            return nullptr;
        }
        made.type = info->name;
        if (info->since > design_.version) {
            reporter_
                .warning("newer-element", text->place,
                         fmt::format("'{}' is not an element of version {}", info->name, design_.version))
                .hint(fmt::format("write version=\"{}\"", info->since));
        }
        return info;
    }

    void read_outer_points(const Fields& fields, Structure& made, const ElementInfo* info) {
        Place place = made.place;
        if (const Field* field = fields.find(Name::outerpoints)) {
            place = field->place;
            if (field->node) {
                values_.points(Fields(field->node, Name::outerpoints, reporter_), made.points);
            } else {
                values_.points(field->text, made.points);
            }
            if (!fields.repeated().empty())
                reporter_.twice("outerpoints", fields.repeated()[0].place(), place);
        } else {
            values_.points(fields, made.points);
        }
        if (!info || info->points.size() == made.points.size()) return;
        std::string letters;
        for (const PointInfo& point : info->points)
            letters += (letters.empty() ? "" : " ") + std::string(point.letter);
        const std::size_t given = made.points.size();
        reporter_.error("point-count", place,
                        fmt::format("'{}' has {} outer points ({}), and {} {} given", info->name,
                                    info->points.size(), letters, given, given == 1 ? "is" : "are"));
    }

    void read_fold(Node node, ParentFold& fold) {
        const Fields fields(node, Name::parentfold, reporter_);
        fold.place = node.place();
        fold.tag_text = node.start_tag();
        if (read_ground_name(fields, {Name::begin, Name::end, Name::page}, design_.version, values_, fold.on))
            return;
        read_end(fields, Name::begin, fold.begin);
        read_end(fields, Name::end, fold.end);
        // The fold lies on one page, wherever that is written.
        std::optional<int> page = values_.page(fields.find(Name::page), &fold.page_text);
        for (const DesignPoint* end : {&fold.begin, &fold.end}) {
            if (!end->page) continue;
            if (page && *page != *end->page) {
                reporter_.error(
                    "bad-page", end->place,
                    fmt::format("the parent fold is on page {} and on page {}", *page, *end->page));
            }
            page = page.value_or(*end->page);
        }
        fold.page = page.value_or(0);
    }

    void read_end(const Fields& fields, Name name, DesignPoint& end) {
        if (const Field* field = fields.find(name)) {
            if (const auto point = values_.point(*field)) end = *point;
            return;
        }
        reporter_.error("missing-value", fields.node().place(),
                        fmt::format("this parentfold has no {}", canonical(name)));
    }

    void read_printed(Name name, Node node) {
        if (name == Name::drawnline) return read_line(node);
        constexpr std::string_view kSince = "3.0";
        if (design_.version < kSince && design_.prints.empty()) {
            reporter_
                .warning(
                    "newer-element", node.place(),
                    fmt::format("'{}' is not an element of version {}", canonical(name), design_.version))
                .hint(fmt::format("write version=\"{}\"", kSince));
        }
        design_.prints.push_back(PrintReader(values_, reporter_, pictures_).read(name, node, design_.unit));
    }

    void read_line(Node node) {
        const Fields fields(node, Name::drawnline, reporter_);
        DrawnLine& made = design_.lines.emplace_back();
        made.place = node.place();
        made.tag_text = node.whole();
        made.page = values_.page(fields.find(Name::page), &made.page_text).value_or(0);
        made.color = values_.color(fields.find(Name::color)).value_or(made.color);
        if (const Field* field = fields.find(Name::thickness)) {
            const auto thickness = values_.number(*field);
            if (thickness && (*thickness < 0 || *thickness > kThickestLine)) {
                reporter_.error("bad-number", field->place,
                                fmt::format("thickness is {} pt, and must be from 0 to {} pt",
                                            format_number(*thickness), format_number(kThickestLine)));
            }
            made.thickness_pt = thickness.value_or(made.thickness_pt);
        }
        values_.points(fields, made.points);
        if (made.points.size() < 2) {
            reporter_.error("point-count", made.place,
                            fmt::format("a drawn line has at least 2 points, and {} {} given",
                                        made.points.size(), made.points.size() == 1 ? "is" : "are"));
        }
        for (const DesignPoint& point : made.points) {
            if (!point.page || *point.page == made.page) continue;
            reporter_.error(
                "bad-page", point.place,
                fmt::format("this point is on page {}, its line on page {}", *point.page, made.page));
        }
    }

    const Located& located_;
    Reporter reporter_;
    Values values_;
    PictureFiles pictures_;
    Design design_;
    bool unit_is_known_ = true;  // or lengths say nothing of how large the card is meant to be
    Values::Pages pages_;        // of the elements read so far; only looked up, never walked
    int pages_made_ = 0;
    std::unordered_map<std::string, Place> ids_;  // given ids; only looked up, never walked
};

}  // namespace

void name_structures(Design& design) {
    std::unordered_set<std::string_view> given;  // only looked up, never walked
    for (const Structure& structure : design.structures) {
        if (structure.id_given) given.insert(structure.id);
    }
    std::size_t spare = design.structures.size();
    for (std::size_t n = 0; n < design.structures.size(); ++n) {
        Structure& structure = design.structures[n];
        if (structure.id_given) continue;
        structure.id = fmt::format("e{}", n + 1);
        while (given.contains(structure.id)) structure.id = fmt::format("e{}", ++spare);
    }
}

Reading read_document(const Source& source, const ReadOptions& options, Diagnostics& diagnostics) {
    Reading reading;
    if (!check_encoding(source.text, diagnostics)) return reading;
    const auto located = locate(source.text, diagnostics);
    if (!located) return reading;
    // What is allowed is known before anything is found, or --werror would end the reading for it.
    std::vector<Allowance> for_elements = read_allowances(*located, AllowanceScope::elements, diagnostics);
    DocumentReader reader(source, *located, options, diagnostics);
    Design design = reader.run();
    reading.files = reader.pictures().files();
    reading.missing.assign(reader.pictures().missing().begin(), reader.pictures().missing().end());
    allow_for_elements(std::move(for_elements), design.structures, diagnostics);
    diagnostics.apply_allowances();
    if (!diagnostics.has_errors_as_given()) reading.design = std::move(design);
    return reading;
}

std::optional<Design> read(const Source& source, const ReadOptions& options, Diagnostics& diagnostics) {
    return read_document(source, options, diagnostics).design;
}

}  // namespace popup::xml
