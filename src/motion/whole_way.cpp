#include "motion/whole_way.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

#include "motion/hinge_gap.h"
#include "motion/passage.h"

namespace popup {
namespace {

bool by_degrees(Angle a, Angle b) { return a.deg < b.deg; }

// Two hinges of one key open alike at every angle: of plates that move alike, along the same lines.
HingeKey key_of(const Hinge& hinge, const Recall& recall) {
    const auto chain = [&](int plate) {
        return static_cast<double>(recall.plates()[static_cast<std::size_t>(plate)].chain);
    };
    return {chain(hinge.a),   chain(hinge.b),   hinge.a_line.a.x, hinge.a_line.a.y, hinge.a_line.b.x,
            hinge.a_line.b.y, hinge.b_line.a.x, hinge.b_line.a.y, hinge.b_line.b.x, hinge.b_line.b.y};
}

class Way {
 public:
    Way(const Assembly& assembly, Linkage& linkage, std::span<const Angle> asked,
        const Tolerances& tolerances)
        : assembly_(assembly),
          linkage_(linkage),
          asked_(asked),
          tolerances_(tolerances),
          gaps_(assembly.hinges.size(), 0.0) {}

    bool walk_all(Diagnostics& diagnostics) {
        hinges_.resize(gaps_.size());
        std::iota(hinges_.begin(), hinges_.end(), std::size_t{0});
        std::fill(gaps_.begin(), gaps_.end(), 0.0);
        return walk(walk_of_all(assembly_, linkage_), diagnostics);
    }

    // What moves otherwise than it did. False: look at all of it.
    bool walk_changed(const Recall& recall) {
        std::vector<int> changed;
        for (std::size_t i = 0; i < assembly_.plates.size(); ++i) {
            if (recall.plates()[i].before < 0) changed.push_back(static_cast<int>(i));
        }
        std::vector<int> held;
        const HingeGaps& kept = recall.kept().gaps;
        for (std::size_t i = 0; i < gaps_.size(); ++i) {
            const Hinge& hinge = assembly_.hinges[i];
            const auto found = kept.find(key_of(hinge, recall));
            if (found != kept.end() && found->second <= tolerances_.closure_mm) {
                gaps_[i] = found->second;
                continue;
            }
            hinges_.push_back(i);
            held.insert(held.end(), {hinge.a, hinge.b});
        }
        Diagnostics unheard;
        return walk(walk_of(changed, held, linkage_), unheard);
    }

    void keep(Recall& recall) const {
        HingeGaps gaps;
        for (std::size_t i = 0; i < gaps_.size(); ++i)
            gaps.emplace(key_of(assembly_.hinges[i], recall), gaps_[i]);
        recall.keep_gaps(std::move(gaps));
    }

    WholeWay take() && {
        for (const double gap : gaps_) result_.most_open_mm = std::max(result_.most_open_mm, gap);
        return std::move(result_);
    }

 private:
    bool walk(const Walked& walked, Diagnostics& diagnostics) {
        result_.closed_at.clear();
        return passes_whole_way(assembly_, linkage_, walked, diagnostics,
                                [this](double deg, std::span<const Frame> frames) { look(deg, frames); });
    }

    void look(double deg, std::span<const Frame> frames) {
        if (!std::binary_search(asked_.begin(), asked_.end(), Angle::degrees(deg), by_degrees)) return;
        here_.clear();
        for (const std::size_t i : hinges_) {
            here_.push_back(gap_of(assembly_.hinges[i], frames));
            if (!(here_.back() <= tolerances_.closure_mm)) return;
        }
        for (std::size_t n = 0; n < hinges_.size(); ++n)
            gaps_[hinges_[n]] = std::max(gaps_[hinges_[n]], here_[n]);
        result_.closed_at.push_back(deg);
    }

    const Assembly& assembly_;
    Linkage& linkage_;
    std::span<const Angle> asked_;
    const Tolerances& tolerances_;
    std::vector<std::size_t> hinges_;  // that are looked at
    std::vector<double> gaps_;         // the most that each opens
    std::vector<double> here_;         // by those that are looked at, at one angle
    WholeWay result_;
};

}  // namespace

std::optional<WholeWay> pass_whole_way(const Assembly& assembly, Linkage& linkage,
                                       std::span<const Angle> asked, const Tolerances& tolerances,
                                       Recall* recall, Diagnostics& diagnostics) {
    Way way(assembly, linkage, asked, tolerances);
    const bool keeps = recall != nullptr && recall->can_keep();
    // What fails is told of the whole.
    const bool passed = keeps && recall->helps() && way.walk_changed(*recall);
    if (!passed && !way.walk_all(diagnostics)) return std::nullopt;
    if (keeps) way.keep(*recall);
    return std::move(way).take();
}

}  // namespace popup
