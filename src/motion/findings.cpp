#include "motion/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "motion/across_folds.h"
#include "motion/lying.h"
#include "motion/mend.h"

namespace popup {
namespace {

// A move that frees two elements is looked for only so often, and in cards of so many plates: it takes a few
// dozen looks at the whole motion.
constexpr int kMostTries = 10;
constexpr int kMostSizes = 3;  // elements of which sizes are tried
constexpr std::size_t kMostPlates = 400;
// What collides from here on is told of as a collision, and not once more as layers without an order.
constexpr double kClosedDeg = 1.0;

// Other elements that are named in one finding, so that a tall one says no more than can be read.
constexpr std::size_t kMostOthers = 8;

std::string what_would_force(const Assembly& assembly, const FreePlates& one) {
    int rivets = 0;
    for (const int plate : one.plates)
        rivets += assembly.plates[static_cast<std::size_t>(plate)].rivet.has_value() ? 1 : 0;
    if (rivets == one.ways) {
        return rivets == 1 ? "it is turned by hand about its rivet: glue it where it is not to be"
                           : "they are turned by hand about their rivets: glue what is not to be";
    }
    // Of one sheet nothing is glued.
    if (assembly.pieces.size() == 1 && assembly.glue.empty())
        return one.lines < 2 ? "let another of its edges reach what moves with the card, and fold it there"
                             : "fold another of its edges to what the opening forces";
    if (one.lines == 0) return "fold it or glue it to something that moves with the card";
    if (one.lines == 1) {
        return "it turns about one line only: glue a second edge of it, or glue it flat on what it stands on";
    }
    const std::string more = one.ways == 1 ? "one linkage more" : fmt::format("{} linkages more", one.ways);
    if (one.parallel) {
        return fmt::format(
            "the folds and seams that hold it all run in one direction, and a further wall of that direction "
            "and height forces nothing, nor does what stands on one of its folds: make a box, a tent or a "
            "step "
            "of it, all of which the opening forces, or keep it from leaning by what stands close to it; an "
            "assembly may have {}, such as a wall of another height between the ground and it",
            more);
    }
    return fmt::format(
        "take an element that the opening forces, such as a v-fold, a tent or a box; an assembly may have "
        "{}, "
        "glued to it and to what moves with the card",
        more);
}

class Findings {
 public:
    Findings(const Assembly& assembly, const Linkage& linkage, std::span<const PlateShape> shapes,
             const MotionOptions& options, Diagnostics& diagnostics)
        : assembly_(assembly),
          linkage_(linkage),
          shapes_(shapes),
          options_(options),
          diagnostics_(diagnostics) {}

    std::vector<FreeingMove> collisions(const std::vector<Contact>& contacts) {
        std::vector<FreeingMove> moves;
        int tried = 0;
        for (const auto& [joints, all] : by_elements(contacts)) {
            const Contact& worst = **std::max_element(
                all.begin(), all.end(),
                [](const Contact* p, const Contact* q) { return p->depth_mm < q->depth_mm; });
            const int other = worst.longer == worst.a ? worst.b : worst.a;
            std::string text = fmt::format("\"{}\" goes through \"{}\" {}{}", name(worst.longer), name(other),
                                           worst.at_fold ? "at its fold " : "", when(worst));
            if (worst.depth_mm > 0.0) {
                text += fmt::format(", by {:.2f} mm at {:.2f}°", worst.depth_mm, worst.deepest_deg);
            }
            if (const std::string more = others(all, worst); !more.empty()) text += more;
            const Joint& joint = linkage_.element(worst.longer);
            Diagnostic& finding = diagnostics_.warning("collision", joint.place, std::move(text));
            finding.about(joint.name);
            also(finding, worst.longer, other);
            if (worst.excess_mm > 0.0) {
                finding.hint(
                    fmt::format("\"{}\" reaches {:.2f} mm too far, with its corner at ({:.2f}, {:.2f}) mm",
                                name(worst.longer), worst.excess_mm, in_hundredths(worst.corner.x),
                                in_hundredths(worst.corner.y)));
            }
            // What parts two plates does not part one from a fold.
            if (worst.at_fold) {
                finding.hint("move one of the two aside, or end it before the fold");
                continue;
            }
            if (joints.first == joints.second || !may_try(tried)) continue;
            if (const auto move = freeing_move(assembly_, linkage_, shapes_,
                                               pairs_between(assembly_, joints.first, joints.second),
                                               contacts, budget_, options_.move_holds)) {
                finding.hint(in_words(*move, "frees the two"));
                moves.push_back(as_told(*move, joints, joint.place, linkage_.element(other).place));
            }
        }
        return moves;
    }

    // Of elements that collide, too, nothing more is said: they are told of, with a move that parts them.
    std::vector<FreeingMove> lying(const std::vector<LyingPair>& all, const std::vector<Contact>& contacts) {
        std::vector<FreeingMove> moves;
        const auto colliding = by_elements(contacts);
        int tried = 0;
        for (const auto& [joints, some] : by_elements(all)) {
            if (colliding.contains(joints)) continue;
            const LyingPair& most = **std::max_element(
                some.begin(), some.end(),
                [](const LyingPair* p, const LyingPair* q) { return p->area_mm2 < q->area_mm2; });
            const bool first = linkage_.joint_of(most.b) == joints.second;
            const Joint& joint = linkage_.element(first ? most.b : most.a);
            Diagnostic& finding = diagnostics_.warning(
                "lies-on-another", joint.place,
                fmt::format("\"{}\" and \"{}\" lie on one another while the card stands open, over {:.2f} × "
                            "{:.2f} mm round ({:.2f}, {:.2f}) mm of the page of \"{}\"",
                            name(first ? most.b : most.a), name(first ? most.a : most.b), most.size.x,
                            most.size.y, in_hundredths(most.point.x), in_hundredths(most.point.y),
                            name(most.b)));
            finding.about(joint.name);
            const int other = first ? most.a : most.b;
            also(finding, first ? most.b : most.a, other);
            if (!may_try(tried)) continue;
            const auto move = freeing_move(assembly_, linkage_, shapes_,
                                           pairs_between(assembly_, joints.first, joints.second), contacts,
                                           budget_, options_.move_holds, true);
            if (move) {
                finding.hint(in_words(*move, "parts the two"));
                moves.push_back(as_told(*move, joints, joint.place, linkage_.element(other).place));
            } else {
                finding.hint(
                    "make one of the two smaller, or take it out: no move of one along what it stands on was "
                    "found that leaves it on nothing");
            }
        }
        return moves;
    }

    void across_folds(const std::vector<AcrossFold>& all) {
        for (const AcrossFold& one : all) {
            const Joint& joint = linkage_.element(one.plate);
            const Vec2 middle = lerp(one.at.a, one.at.b, 0.5);
            const std::string where = fmt::format(
                "over {:.2f} mm round ({:.2f}, {:.2f}) mm of the page of \"{}\"",
                distance(one.at.a, one.at.b), in_hundredths(middle.x), in_hundredths(middle.y), name(one.on));
            const bool by_hand = assembly_.plates[static_cast<std::size_t>(one.plate)].rivet.has_value();
            std::string text;
            if (one.seam) {
                text = fmt::format("\"{}\" cannot be turned all round: \"{}\" is glued down on its way, {}",
                                   name(one.plate), name(one.through), where);
            } else {
                text = fmt::format("\"{}\" {} through the fold of \"{}\" and \"{}\", by {:.2f} mm, {}",
                                   name(one.plate), by_hand ? "would be turned" : "goes", name(one.on),
                                   name(one.through), one.by_mm, where);
            }
            Diagnostic& finding = diagnostics_.warning("across-fold", joint.place, std::move(text));
            finding.about(joint.name);
            also(finding, one.plate, one.through);
            if (by_hand) {
                finding.hint("make it smaller, or move its rivet away");
            } else {
                finding.hint(
                    "end it at the fold, or glue it on the other side of the paper: the fold turns away from "
                    "there");
            }
        }
    }

    void protrusions(const std::vector<Protrusion>& all, const std::vector<Contact>& contacts) {
        std::map<int, const Protrusion*> worst;  // by joint
        for (const Protrusion& one : all) {
            const Protrusion*& most = worst[linkage_.joint_of(one.plate)];
            if (most == nullptr || one.by_mm > most->by_mm) most = &one;
        }
        int tried = 0;
        for (const auto& [joint, one] : worst) {
            const Joint& element = assembly_.joints[static_cast<std::size_t>(joint)];
            Diagnostic& finding = diagnostics_.warning(
                "protrusion", element.place,
                fmt::format("\"{}\" sticks out of the closed card by {}", name(one->plate), how_far(*one)));
            finding.about(element.name);
            std::optional<ElementMove> move;
            std::optional<std::string> size;
            if (may_try(tried)) {
                move = tucking_move(assembly_, linkage_, shapes_, joint, all, contacts, budget_,
                                    options_.move_holds);
                if (options_.fitting_size && tried <= kMostSizes)
                    size = options_.fitting_size(element.name, one->by_mm);
            }
            if (move) finding.hint(in_words(*move, "keeps it inside the closed card"));
            if (size) finding.hint(*size);
            finding.hint(fmt::format(
                "its corner at ({:.2f}, {:.2f}) mm reaches furthest; make the piece smaller there{}",
                in_hundredths(one->corner.x), in_hundredths(one->corner.y),
                move || size ? "" : ", or move the element"));
        }
    }

    void layers(const Examination& found) {
        const std::vector<int>& cycle = found.closed.cycle;
        if (cycle.empty()) return;
        std::string text;
        if (cycle.size() == 2) {
            const bool told =
                std::any_of(found.contacts.begin(), found.contacts.end(), [&](const Contact& one) {
                    return one.from_deg < kClosedDeg &&
                           std::minmax(one.a, one.b) == std::minmax(cycle[0], cycle[1]);
                });
            if (told) return;
            text = fmt::format("\"{}\" lies partly under and partly over \"{}\" in the closed card",
                               name(cycle[0]), name(cycle[1]));
        } else {
            text = fmt::format("the closed card has no order of layers: \"{}\"", name(cycle[0]));
            for (std::size_t i = 1; i < cycle.size(); ++i) {
                text += fmt::format("{} lies under \"{}\"", i == 1 ? "" : ", which", name(cycle[i]));
            }
            text += ", and that under the first again";
        }
        const Joint& first = linkage_.element(cycle[0]);
        Diagnostic& finding = diagnostics_.warning("layer-order", first.place, std::move(text));
        finding.about(first.name).hint("make one of them smaller, so that it no longer reaches over another");
        std::vector<const Joint*> told{&first};
        for (const int plate : cycle) {
            const Joint& joint = linkage_.element(plate);
            if (std::find(told.begin(), told.end(), &joint) != told.end()) continue;
            told.push_back(&joint);
            finding.with(joint.place, fmt::format("\"{}\"", joint.name));
        }
    }

    // Of elements that collide anyway nothing more is said.
    void approaches(const std::vector<Approach>& all, const std::vector<Contact>& contacts,
                    double clearance_mm) {
        const auto colliding = by_elements(contacts);
        for (const auto& [joints, some] : by_elements(all)) {
            if (colliding.contains(joints)) continue;
            const Approach& worst = **std::min_element(
                some.begin(), some.end(),
                [](const Approach* p, const Approach* q) { return p->least_mm < q->least_mm; });
            const Joint& joint = linkage_.element(worst.b);
            Diagnostic& finding = diagnostics_.warning(
                "clearance-low", joint.place,
                fmt::format("\"{}\" and \"{}\" come as near as {:.2f} mm at an opening of {:.2f}°, although "
                            "{:.2f} mm were "
                            "asked for",
                            name(worst.b), name(worst.a), worst.least_mm, worst.least_deg, clearance_mm));
            finding.about(joint.name)
                .hint(fmt::format("move them {:.2f} mm further apart",
                                  rounded_up(clearance_mm - worst.least_mm)));
            also(finding, worst.b, worst.a);
        }
    }

    void undecided(const Examination& found) {
        if (found.decided_up_to_deg < assembly_.sweep.to_deg) {
            diagnostics_
                .remark(
                    "undecided", {},
                    fmt::format(
                        "so many plates stand on or touch one another that nothing is said of collisions at "
                        "openings above {:.2f}°",
                        found.decided_up_to_deg))
                .hint("let fewer elements stand on one another, or in one place");
        }
        const std::vector<Undecided>& all = found.undecided;
        for (const auto& [joints, some] : by_elements(all)) {
            const Undecided& first = *some.front();
            const Joint& joint = linkage_.element(first.b);
            Diagnostic& finding = diagnostics_.remark(
                "undecided", joint.place,
                fmt::format(
                    "whether \"{}\" touches or goes through \"{}\" between openings of {:.3f}° and {:.3f}° "
                    "could not be decided",
                    name(first.b), name(first.a), first.from_deg, some.back()->to_deg));
            finding.about(joint.name).hint("leave a tenth of a millimetre between them");
            also(finding, first.b, first.a);
        }
    }

 private:
    // Whether to look for one more move, after so many.
    bool may_try(int& tried) const {
        return options_.find_moves && assembly_.plates.size() <= kMostPlates && tried++ < kMostTries;
    }
    [[nodiscard]] const std::string& name(int plate) const {
        return assembly_.plates[static_cast<std::size_t>(plate)].name;
    }
    // What is printed with two decimals: never "-0.00".
    static double in_hundredths(double mm) { return std::round(mm * 100.0) / 100.0 + 0.0; }

    [[nodiscard]] std::string in_words(const ElementMove& move, std::string_view does) const {
        const std::string& element = assembly_.joints[static_cast<std::size_t>(move.joint)].name;
        const auto command =
            options_.move_command ? options_.move_command(element, move.by) : std::optional<std::string>();
        return fmt::format("moving \"{}\" {:.2f} mm along its {}, by ({:.2f}, {:.2f}) mm on the page, {}{}{}",
                           element, in_hundredths(length(move.by)), move.along, in_hundredths(move.by.x),
                           in_hundredths(move.by.y), does, command ? ": " : "", command.value_or(""));
    }
    [[nodiscard]] FreeingMove as_told(const ElementMove& move, std::pair<int, int> joints, Place place,
                                      Place other_place) const {
        const int still = move.joint == joints.first ? joints.second : joints.first;
        return {assembly_.joints[static_cast<std::size_t>(move.joint)].name,
                assembly_.joints[static_cast<std::size_t>(still)].name,
                place,
                other_place,
                move.by,
                move.along};
    }
    // Names the element of a second plate, where it is another one.
    void also(Diagnostic& finding, int plate, int second) const {
        const Joint& other = linkage_.element(second);
        if (&linkage_.element(plate) != &other) finding.with(other.place, fmt::format("\"{}\"", other.name));
    }

    template <typename Row>
    [[nodiscard]] std::map<std::pair<int, int>, std::vector<const Row*>> by_elements(
        const std::vector<Row>& rows) const {
        std::map<std::pair<int, int>, std::vector<const Row*>> result;
        for (const Row& row : rows)
            result[std::minmax(linkage_.joint_of(row.a), linkage_.joint_of(row.b))].push_back(&row);
        return result;
    }

    // So that a piece shortened by what is printed is short enough.
    static double rounded_up(double mm) { return std::ceil(mm * 100.0) / 100.0; }

    [[nodiscard]] std::string when(const Contact& contact) const {
        if (contact.from_deg == contact.to_deg)
            return fmt::format("at an opening of {:.2f}°", contact.to_deg);
        if (contact.from_deg > assembly_.sweep.from_deg) {
            return fmt::format("between openings of {:.2f}° and {:.2f}°", contact.from_deg, contact.to_deg);
        }
        if (contact.to_deg >= assembly_.sweep.to_deg) return "at every angle";
        return fmt::format("from an opening of {:.2f}° until the card is closed", contact.to_deg);
    }

    // Up to two further pairs of plates of the two elements, in words.
    [[nodiscard]] std::string others(const std::vector<const Contact*>& all, const Contact& worst) const {
        std::vector<std::pair<int, int>> more;
        for (const Contact* one : all) {
            const std::pair<int, int> pair{one->a, one->b};
            if (pair == std::pair{worst.a, worst.b} ||
                std::find(more.begin(), more.end(), pair) != more.end())
                continue;
            more.push_back(pair);
        }
        std::string text;
        for (std::size_t i = 0; i < std::min<std::size_t>(more.size(), 2); ++i) {
            text += fmt::format("{} \"{}\" through \"{}\"", i == 0 ? "; so do" : " and", name(more[i].first),
                                name(more[i].second));
        }
        if (more.size() > 2) text += fmt::format(" and {} more", more.size() - 2);
        return text;
    }

    // "12.30 mm at the top and 4.00 mm at the side opposite the gutter".
    static std::string how_far(const Protrusion& one) {
        const double along = one.direction.y * one.by_mm;
        const double out = one.direction.z * one.by_mm;
        std::string text;
        if (std::abs(along) > kTouchMm) {
            text = fmt::format("{:.2f} mm at the {}", std::abs(along), along > 0.0 ? "top" : "bottom");
        }
        if (std::abs(out) > kTouchMm) {
            text += fmt::format("{}{:.2f} mm at the {}", text.empty() ? "" : " and ", std::abs(out),
                                out > 0.0 ? "side opposite the gutter" : "gutter");
        }
        return text;
    }

    MoveBudget budget_;
    const Assembly& assembly_;
    const Linkage& linkage_;
    std::span<const PlateShape> shapes_;
    const MotionOptions& options_;
    Diagnostics& diagnostics_;
};

}  // namespace

std::vector<FreeingMove> report_findings(const Assembly& assembly, const Linkage& linkage,
                                         std::span<const PlateShape> shapes, const Examination& found,
                                         const MotionOptions& options, Diagnostics& diagnostics) {
    Findings findings(assembly, linkage, shapes, options, diagnostics);
    std::vector<FreeingMove> moves = findings.collisions(found.contacts);
    std::vector<FreeingMove> parting = findings.lying(find_lying(assembly, linkage, shapes), found.contacts);
    moves.insert(moves.end(), std::make_move_iterator(parting.begin()),
                 std::make_move_iterator(parting.end()));
    findings.across_folds(find_across_folds(assembly));
    findings.protrusions(found.closed.protrusions, found.contacts);
    findings.layers(found);
    if (found.approaches) findings.approaches(*found.approaches, found.contacts, *options.clearance_mm);
    findings.undecided(found);
    return moves;
}

void report_not_forced(const Assembly& assembly, const Linkage& linkage, std::span<const FreePlates> all,
                       Diagnostics& diagnostics) {
    for (const FreePlates& one : all) {
        const auto name = [&](std::size_t i) -> const std::string& {
            return assembly.plates[static_cast<std::size_t>(one.plates[i])].name;
        };
        const std::size_t count = one.plates.size();
        std::string who = fmt::format("\"{}\"", name(0));
        if (count == 2) who += fmt::format(" and \"{}\"", name(1));
        if (count > 2) who += fmt::format(" and {} plates that hang together with it", count - 1);
        const Joint& first = linkage.element(one.plates[0]);
        Diagnostic& finding =
            diagnostics.remark("not-forced", first.place,
                               fmt::format("the opening of the card does not force {}: free in {} {}", who,
                                           one.ways, one.ways == 1 ? "way" : "ways"));
        finding.about(first.name).hint(what_would_force(assembly, one));
        std::vector<int> told{linkage.joint_of(one.plates[0])};
        for (const int plate : one.plates) {
            const int joint = linkage.joint_of(plate);
            if (std::find(told.begin(), told.end(), joint) != told.end()) continue;
            if (told.size() > kMostOthers) break;
            told.push_back(joint);
            const Joint& other = linkage.element(plate);
            finding.with(other.place, fmt::format("\"{}\"", other.name));
        }
    }
}

}  // namespace popup
