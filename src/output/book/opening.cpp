#include "output/book/opening.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/nth.h"
#include "base/text/numbers.h"
#include "gluing/glue_flaps.h"
#include "output/book/words.h"
#include "popup/motion.h"

namespace popup::book {
namespace {

constexpr std::size_t kMostNames = 6;
constexpr double kAlike = 0.9998;  // cosine: of planes within a degree
constexpr double kRisenMm = 0.5;   // what is nearer to a cover lies on it

// Findings that somebody who holds the card can see, or do something about.
constexpr std::array<std::string_view, 12> kForHands{
    "clearance-low",       "collision",   "folds-in-order",  "glue-overlaps",
    "glue-marks-left-out", "layer-order", "lies-on-another", "not-forced",
    "not-rigid",           "protrusion",  "tab-too-small",   "target-covered"};

// What of a card stands when it is open, rises on the way only, and is not held by the opening.
class Risers {
 public:
    explicit Risers(const SceneCard& card) : in_(*card.assembly) {
        name_plates();
        const std::vector<Frame> half = frames_at(0.5);
        const std::vector<Frame> open = frames_at(1.0);
        if (half.empty() || open.empty()) return;
        std::vector<bool> is_free(in_.plates.size(), false);
        if (card.motion != nullptr) {
            for (const FreePlates& one : card.motion->not_forced) {
                for (const int plate : one.plates) is_free[static_cast<std::size_t>(plate)] = true;
            }
        }
        // By element, in the order of their plates.
        std::vector<std::pair<std::string, Way>> all;
        for (std::size_t i = 0; i < in_.plates.size(); ++i) {
            const auto plate = static_cast<int>(i);
            if (names_[i].empty()) continue;
            const Way way{rises(plate, open), rises(plate, half), is_free[i]};
            const auto known =
                std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == names_[i]; });
            if (known == all.end()) {
                all.emplace_back(names_[i], way);
            } else {
                known->second.stands = known->second.stands || way.stands;
                known->second.rises = known->second.rises || way.rises;
                known->second.is_free = known->second.is_free || way.is_free;
            }
        }
        for (const auto& [name, way] : all) {
            if (!way.stands && !way.rises) continue;
            (way.is_free ? free_ : way.stands ? stand_ : rise_).push_back(name);
        }
    }

    void tell(bool is_glued, std::vector<std::string>& said) const {
        const std::string start =
            fmt::format("{}pen it slowly, to {}°",
                        is_glued ? "Let the glue dry with the card closed, under a book. Then o" : "O",
                        number_text(in_.sweep.to_deg, 0));
        std::string what;
        if (!stand_.empty())
            what = fmt::format("{} {} up by {}, and {} flat again when it closes",
                               rise_.empty() && free_.empty() ? "everything" : listed(stand_, kMostNames),
                               is_one(stand_) || (rise_.empty() && free_.empty()) ? "stands" : "stand",
                               is_one(stand_) || (rise_.empty() && free_.empty()) ? "itself" : "themselves",
                               is_one(stand_) || (rise_.empty() && free_.empty()) ? "lies" : "lie");
        if (!rise_.empty())
            what += fmt::format("{}{} {} on the way, and {} flat when it is wide open and when it is closed",
                                what.empty() ? "" : "; ", listed(rise_, kMostNames),
                                is_one(rise_) ? "rises" : "rise", is_one(rise_) ? "lies" : "lie");
        said.push_back(start + (what.empty() ? "." : ": " + what + "."));
        if (free_.empty()) return;
        said.push_back(fmt::format(
            "Nothing forces {0} to stand: {1} can lean to one side while the card stands still. Set {2} "
            "upright with a finger when the card is open, and see before it closes that {1} {3} the way that "
            "{4} folds go.",
            listed(free_, kMostNames), is_one(free_) ? "it" : "they", is_one(free_) ? "it" : "them",
            is_one(free_) ? "leans" : "lean", is_one(free_) ? "its" : "their"));
    }

 private:
    struct Way {
        bool stands = false, rises = false, is_free = false;
    };
    static bool is_one(const std::vector<std::string>& names) { return names.size() == 1; }

    // Of plates other than the card's own: the element that is pushed out of it, else the piece.
    void name_plates() {
        names_.resize(in_.plates.size());
        std::vector<bool> is_card(in_.pieces.size(), false);
        for (const int cover : in_.covers)
            is_card[static_cast<std::size_t>(nth(in_.plates, cover).piece)] = true;
        for (std::size_t i = 0; i < in_.plates.size(); ++i) {
            const int piece = in_.plates[i].piece;
            const std::string& name = nth(in_.pieces, piece).name;  // "roof", "roof/pillar": of one element
            if (!is_card[static_cast<std::size_t>(piece)]) names_[i] = name.substr(0, name.find('/'));
        }
        for (const PushedOut& one : pushed_out(in_)) {
            if (!is_card[static_cast<std::size_t>(one.piece)]) continue;
            for (const int plate : one.plates) nth(names_, plate) = one.name;
        }
    }

    [[nodiscard]] std::vector<Frame> frames_at(double share) const {
        std::vector<Frame> frames(in_.plates.size());
        const Sweep& sweep = in_.sweep;
        const double opening = sweep.from_deg + share * (sweep.to_deg - sweep.from_deg);
        if (!place(in_, Angle::degrees(opening), frames)) frames.clear();
        return frames;
    }

    // Whether the plate is off all covers.
    [[nodiscard]] bool rises(int plate, const std::vector<Frame>& frames) const {
        const Frame& own = nth(frames, plate);
        const Vec3 at = own.point(nth(in_.plates, plate).outline.outer.front());
        return std::none_of(in_.covers.begin(), in_.covers.end(), [&](int cover) {
            const Frame& on = nth(frames, cover);
            return std::abs(dot(on.normal(), own.normal())) > kAlike &&
                   std::abs(dot(at - on.origin, on.normal())) < kRisenMm;
        });
    }

    const Assembly& in_;
    std::vector<std::string> names_;  // of each plate; empty: of the card's own
    std::vector<std::string> stand_, rise_, free_;
};

// Whether a panel of a folded sheet hangs by one fold alone, and is neither glued nor what is glued to.
bool has_loose_flaps(const Assembly& in, std::span<const GlueFlap> glued) {
    std::vector<int> folds(in.plates.size(), 0);
    for (const Hinge& hinge : in.hinges) {
        ++nth(folds, hinge.a);
        ++nth(folds, hinge.b);
    }
    for (std::size_t i = 0; i < folds.size(); ++i) {
        const auto plate = static_cast<int>(i);
        const bool is_held = std::any_of(glued.begin(), glued.end(), [plate](const GlueFlap& one) {
            return one.flap == plate || one.panel == plate;
        });
        if (folds[i] == 1 && !is_held) return true;
    }
    return false;
}

// What keeps a folded sheet as it is.
std::string how_it_holds(const Assembly& in) {
    const std::string looks = "Folded, it looks like the last picture. ";
    std::vector<std::string> flaps;
    const std::vector<GlueFlap> glued = glue_flaps(in);
    for (const GlueFlap& one : glued) {
        const std::string& name = nth(in.plates, one.flap).name;
        flaps.push_back(name.substr(name.rfind('/') + 1));
    }
    if (flaps.empty()) return looks + "Whether glue or tucked flaps keep it so, its drawing does not say.";
    return looks + fmt::format("{} {} it together, glued{}.", listed(flaps, kMostNames),
                               flaps.size() == 1 ? "holds" : "hold",
                               has_loose_flaps(in, glued)
                                   ? "; whether its other flaps are glued or tucked, its drawing does not say"
                                   : "");
}

}  // namespace

void add_opening(const SceneCard& card, std::size_t number, std::span<const Diagnostic> findings,
                 CardPart& part) {
    const Assembly& in = *card.assembly;
    const bool is_card = moves(in) && !in.covers.empty();
    const Sweep& sweep = in.sweep;
    const auto add = [&](double share, std::string caption) {
        Scene one;
        one.card = number;
        one.as_still = true;
        one.opening_deg = sweep.from_deg + share * (sweep.to_deg - sweep.from_deg);
        one.alt = fmt::format("{}, {}", in.stem, caption);
        part.opening.push_back(std::move(one));
        part.opening_captions.push_back(std::move(caption));
    };
    const auto degrees = [&](double share) {
        return fmt::format(
            "open {}°", number_text(std::round(sweep.from_deg + share * (sweep.to_deg - sweep.from_deg)), 0));
    };
    if (is_card) {
        for (const double share : {0.2, 0.5, 1.0}) add(share, degrees(share));
        const bool is_glued = !in.glue.empty() || !in.glued_areas.empty();
        Risers(card).tell(is_glued, part.opens);
        part.trouble.emplace_back(
            "It does not close flat: a fold goes the wrong way. Find the place that is thick, open the "
            "card, and crease that fold as its line is drawn.");
        part.trouble.emplace_back(
            "It does not open wide: glue went beyond a tab, or a tab sits beside its target. Look along "
            "the seams of what is tight.");
        part.trouble.emplace_back(
            "Something stands crooked: its two tabs do not sit alike. Loosen one while the glue is "
            "wet, and close the card on it again.");
        if (!is_glued) {
            part.trouble.erase(part.trouble.begin() + 1, part.trouble.end());
            part.trouble.emplace_back(
                "It does not open wide, or tears: a cut does not go to its end. Cut it a little further, "
                "exactly to where the folds begin.");
        }
    } else if (moves(in)) {
        part.closing_title = "How it must look";
        add(1.0, "flat");
        add(0.5, "half folded");
        add(0.0, "folded");
        part.opens.push_back(how_it_holds(in));
        part.trouble.emplace_back(
            "Panels do not meet: a fold goes the wrong way, or not far enough. Compare each with the "
            "steps.");
    }
    // An assembly that is read bears the name of the file that it was made from.
    const std::string& input = card.input.empty() ? in.file : card.input;
    for (const Diagnostic& one : findings) {
        const bool own = one.file == input || one.file.empty();
        const bool is_for_hands = std::find(kForHands.begin(), kForHands.end(), one.code) != kForHands.end();
        if (!own || !is_for_hands || one.severity == Severity::error) continue;
        part.found.push_back(one.message);
    }
}

}  // namespace popup::book
