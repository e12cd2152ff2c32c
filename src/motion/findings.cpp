#include "motion/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace popup {
namespace {

class Findings {
 public:
    Findings(const Assembly& assembly, const Linkage& linkage, Diagnostics& diagnostics)
        : assembly_(assembly), linkage_(linkage), diagnostics_(diagnostics) {}

    void collisions(const std::vector<Contact>& contacts) {
        for (const auto& [joints, all] : by_elements(contacts)) {
            const Contact& worst = **std::max_element(
                all.begin(), all.end(),
                [](const Contact* p, const Contact* q) { return p->depth_mm < q->depth_mm; });
            const int other = worst.longer == worst.a ? worst.b : worst.a;
            std::string text = fmt::format("\"{}\" goes through \"{}\" ", name(worst.longer), name(other));
            if (worst.from_deg == worst.to_deg) {
                text += fmt::format("at an opening of {:.2f}°", worst.to_deg);
            } else {
                text += worst.from_deg == 0.0
                            ? fmt::format("from an opening of {:.2f}° until the card is closed", worst.to_deg)
                            : fmt::format("between openings of {:.2f}° and {:.2f}°", worst.from_deg,
                                          worst.to_deg);
                text += fmt::format(", by {:.2f} mm at {:.2f}°", worst.depth_mm, worst.deepest_deg);
            }
            if (all.size() > 1) text += fmt::format(" ({} contacts of the two in all)", all.size());
            const Joint& joint = joint_of(worst.longer);
            const Joint& second = joint_of(other);
            Diagnostic& finding = diagnostics_.warning("collision", joint.place, std::move(text));
            finding.about(joint.name);
            if (&joint != &second) finding.with(second.place, fmt::format("\"{}\"", second.name));
            if (worst.excess_mm > 0.0) {
                finding.hint(
                    fmt::format("make \"{}\" {:.2f} mm shorter where they meet, or move the two apart",
                                name(worst.longer), rounded_up(worst.excess_mm)));
            } else {
                finding.hint("move the two apart");
            }
        }
    }

    void protrusions(const std::vector<Protrusion>& all) {
        std::map<int, const Protrusion*> worst;  // by joint
        for (const Protrusion& one : all) {
            const Protrusion*& most = worst[linkage_.joint_of(one.plate)];
            if (most == nullptr || one.by_mm > most->by_mm) most = &one;
        }
        for (const auto& [joint, one] : worst) {
            const Joint& element = assembly_.joints[static_cast<std::size_t>(joint)];
            diagnostics_
                .warning("protrusion", element.place,
                         fmt::format("\"{}\" sticks out of the closed card by {:.2f} mm {}", name(one->plate),
                                     one->by_mm, where(one->direction)))
                .hint(fmt::format(
                    "make it {:.2f} mm shorter there, or move it as far towards the middle of the card",
                    rounded_up(one->by_mm)))
                .about(element.name);
        }
    }

    void layers(const Examination& found) {
        const std::vector<int>& cycle = found.closed.cycle;
        if (cycle.empty()) return;
        std::string text;
        if (cycle.size() == 2) {
            const bool told =
                std::any_of(found.contacts.begin(), found.contacts.end(), [&](const Contact& one) {
                    return one.from_deg == 0.0 &&
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
        const Joint& first = joint_of(cycle[0]);
        Diagnostic& finding = diagnostics_.warning("layer-order", first.place, std::move(text));
        finding.about(first.name).hint("make one of them smaller, so that it no longer reaches the next");
        std::vector<const Joint*> told{&first};
        for (const int plate : cycle) {
            const Joint& joint = joint_of(plate);
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
            const Joint& joint = joint_of(worst.b);
            const Joint& second = joint_of(worst.a);
            Diagnostic& finding = diagnostics_.warning(
                "clearance-low", joint.place,
                fmt::format("\"{}\" and \"{}\" come as near as {:.2f} mm at an opening of {:.2f}°, {:.2f} mm "
                            "were asked "
                            "for",
                            name(worst.b), name(worst.a), worst.least_mm, worst.least_deg, clearance_mm));
            finding.about(joint.name)
                .hint(fmt::format("move them {:.2f} mm further apart",
                                  rounded_up(clearance_mm - worst.least_mm)));
            if (&joint != &second) finding.with(second.place, fmt::format("\"{}\"", second.name));
        }
    }

    void undecided(const Examination& found) {
        if (found.decided_up_to_deg < 180.0) {
            diagnostics_
                .remark("undecided", {},
                        fmt::format(
                            "so many plates stand on one another that nothing is said about collisions at "
                            "openings above {:.2f}°",
                            found.decided_up_to_deg))
                .hint("let fewer elements stand on one another");
        }
        const std::vector<Undecided>& all = found.undecided;
        for (const auto& [joints, some] : by_elements(all)) {
            const Undecided& first = *some.front();
            const Joint& joint = joint_of(first.b);
            const Joint& second = joint_of(first.a);
            Diagnostic& finding = diagnostics_.remark(
                "undecided", joint.place,
                fmt::format(
                    "whether \"{}\" touches or goes through \"{}\" between openings of {:.3f}° and {:.3f}° "
                    "could not be decided",
                    name(first.b), name(first.a), first.from_deg, some.back()->to_deg));
            finding.about(joint.name).hint("leave a tenth of a millimetre between them");
            if (&joint != &second) finding.with(second.place, fmt::format("\"{}\"", second.name));
        }
    }

 private:
    [[nodiscard]] const std::string& name(int plate) const {
        return assembly_.plates[static_cast<std::size_t>(plate)].name;
    }
    [[nodiscard]] const Joint& joint_of(int plate) const {
        return assembly_.joints[static_cast<std::size_t>(linkage_.joint_of(plate))];
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

    static std::string_view where(Vec3 direction) {
        if (std::abs(direction.y) > std::abs(direction.z))
            return direction.y > 0.0 ? "at the top" : "at the bottom";
        return direction.z > 0.0 ? "at the side opposite the gutter" : "at the gutter";
    }

    const Assembly& assembly_;
    const Linkage& linkage_;
    Diagnostics& diagnostics_;
};

}  // namespace

void report_findings(const Assembly& assembly, const Linkage& linkage, const Examination& found,
                     const MotionOptions& options, Diagnostics& diagnostics) {
    Findings findings(assembly, linkage, diagnostics);
    findings.collisions(found.contacts);
    findings.protrusions(found.closed.protrusions);
    findings.layers(found);
    if (found.approaches) findings.approaches(*found.approaches, found.contacts, *options.clearance_mm);
    findings.undecided(found);
}

}  // namespace popup
