#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "edit/session.h"
#include "edit/trial.h"
#include "input/xml/read.h"
#include "popup/edit.h"
#include "popup/mechanism.h"

namespace popup {
namespace {

constexpr std::size_t kMostElements = 300;
constexpr std::size_t kElementsTried = 1000;  // elements times trials
constexpr std::size_t kMostTrials = 20;
constexpr int kTrialsOfSize = 6;
// By less of what the size changes an element does not stick out less.
constexpr double kNoHelp = 0.01;

// What makes an element larger or smaller; the others say where it is and how it stands. The name in edits
// and the words for it.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kSizes{
    {{"height", "height"},
     {"width", "width"},
     {"length", "length"},
     {"radius", "radius"},
     {"pieceheight", "height of its piece"},
     {"piecewidth", "width of its piece"}}};

struct Size {
    std::string_view name, words;
    double is = 0.0, wanted = 0.0;  // in the document's unit
    [[nodiscard]] double share() const { return (is - wanted) / is; }
};

class SizeSearch {
 public:
    SizeSearch(const CompiledDesign& one, const CompileOptions& options) : one_(one), options_(options) {
        const std::size_t elements = one.checked->design().structures.size();
        if (elements <= kMostElements)
            trials_ = std::min(kMostTrials, kElementsTried / std::max<std::size_t>(elements, 1));
    }

    std::optional<std::string> fitting(const std::string& element, double by_mm) {
        std::optional<Size> best;
        for (const Size& size : sizes_of(element)) {
            const auto found = largest(element, size, by_mm);
            if (found && (!best || found->share() < best->share())) best = found;
        }
        if (!best) return std::nullopt;
        return fmt::format("a {} of {}, not {}, keeps it inside the closed card: popupc edit … {}",
                           best->words, in_unit(best->wanted), in_unit(best->is),
                           fmt::join(words_of(element, *best), " "));
    }

 private:
    [[nodiscard]] const Unit& unit() const { return one_.checked->design().unit; }
    // To tenths of a millimetre, or so: who cuts paper measures no finer.
    [[nodiscard]] int decimals() const { return unit().mm < 2.0 ? 1 : 2; }
    [[nodiscard]] std::string in_unit(double value) const {
        return fmt::format("{:.{}f} {}", value, decimals(), unit().name);
    }
    [[nodiscard]] std::vector<std::string> words_of(const std::string& element, const Size& size) const {
        return {"set", element, fmt::format("--{}", size.name),
                fmt::format("{:.{}f}{}", size.wanted, decimals(), unit().name)};
    }

    [[nodiscard]] std::vector<Size> sizes_of(const std::string& element) const {
        const Design& design = one_.checked->design();
        const auto structure = std::find_if(design.structures.begin(), design.structures.end(),
                                            [&](const Structure& s) { return s.id == element; });
        if (structure == design.structures.end()) return {};
        const ElementInfo& info = edit::Session::info_of(*structure);
        const PageFold seen = folds_of_card(design)
                                  .standing[static_cast<std::size_t>(structure - design.structures.begin())]
                                  .seen;
        const auto measures =
            measures_of(info, seen, 1, edit::Session::points_of(*structure, seen), structure->arguments);
        std::vector<Size> sizes;
        for (const auto& [name, words] : kSizes) {
            std::optional<double> mm;
            if (const auto n = find_measure(info, name); n && measures) mm = (*measures)[*n];
            if (const Argument* given = find_argument(info, structure->arguments, name)) {
                if (const double* length = std::get_if<double>(&given->value)) mm = *length;
            }
            if (mm.value_or(0.0) > 0.0) sizes.push_back({name, words, *mm / unit().mm, 0.0});
        }
        return sizes;
    }

    // The largest value of the size that will do, as near as a few trials come to it: by how far the element
    // still sticks out, two of them tell where it will not any more.
    std::optional<Size> largest(const std::string& element, Size size, double by_mm) {
        struct Trial {
            double less;  // than the size is, in the document's unit
            double out_mm;
        };
        const double by = std::pow(10.0, decimals());
        std::optional<Size> best;
        Trial last{0.0, by_mm};
        double less = std::max(by_mm / unit().mm, 1.0 / by);
        for (int i = 0; i < kTrialsOfSize && trials_ > 0; ++i) {
            size.wanted = std::round((size.is - less) * by) / by;
            less = size.is - size.wanted;
            if (size.wanted <= 0.0 || (best && size.wanted <= best->wanted)) break;
            const auto out_mm = sticks_out_by(element, size);
            if (!out_mm) break;
            if (*out_mm > 0.0) {
                const double gain = (last.out_mm - *out_mm) / (less - last.less);
                last = {less, *out_mm};
                if (best || gain * unit().mm < kNoHelp) break;
                less = std::max(less + *out_mm / gain, less + 1.0 / by);
                continue;
            }
            best = size;
            // The first trial may have been more than is needed: where both sides give way, half of it does.
            if (i > 0) break;
            less *= 0.5;
        }
        return best && keeps_inside(element, *best) ? best : std::nullopt;
    }

    // By how far the element still sticks out, once its size is changed in the document. nullopt: that cannot
    // be, reading or checks find something new, or something else sticks out.
    std::optional<double> sticks_out_by(const std::string& element, const Size& size) {
        --trials_;
        Diagnostics found(one_.source.name);
        edit::Session session(*one_.design, one_.source.name, options_.check.tolerances, found);
        const std::vector<std::string> words = words_of(element, size);
        if (!edit::set(session, {words[0], {words[1]}, {{std::string(size.name), words[3]}}})) return {};
        Source source = one_.source;
        source.text = xml::patch(one_.source, session.design, session.gone);
        const auto assembly = edit::assembled(source, options_, found);
        const bool is_worse =
            edit::finds_more(edit::count_findings(one_.diagnostics), edit::count_findings(found));
        return assembly && !is_worse ? sticks_out_by(element, *assembly) : std::nullopt;
    }

    std::optional<double> sticks_out_by(const std::string& element, const Assembly& assembly) {
        double most = 0.0;
        for (const Protrusion& out : find_protrusions(assembly)) {
            const std::string& name = assembly.plates[static_cast<std::size_t>(out.plate)].name;
            if (is_of(name, element)) {
                most = std::max(most, out.by_mm);
            } else if (!sticks_out(name)) {
                return std::nullopt;
            }
        }
        return most;
    }

    // Carries the edit out in the document, and closes the card.
    bool keeps_inside(const std::string& element, const Size& size) {
        const EditLine edit{words_of(element, size), {}};
        Diagnostics of_edit;
        Diagnostics of_document;
        const auto edited = edit_document(one_.source, {&edit, 1}, {false, options_.read, options_.check},
                                          of_edit, of_document);
        if (!edited || edited->refused || of_edit.has_findings() || of_document.has_findings()) return false;
        Source source = one_.source;
        source.text = edited->text;
        Diagnostics unheard;
        const auto assembly = edit::assembled(source, options_, unheard);
        return assembly && sticks_out_by(element, *assembly) == 0.0;
    }

    // Of a plate's name, "bird/left", whether it is the element's.
    static bool is_of(std::string_view plate, std::string_view element) {
        return plate.starts_with(element) && (plate.size() == element.size() || plate[element.size()] == '/');
    }

    [[nodiscard]] bool sticks_out(const std::string& plate) {
        if (!before_) {
            before_.emplace();
            for (const Protrusion& out : find_protrusions(*one_.assembly))
                before_->push_back(one_.assembly->plates[static_cast<std::size_t>(out.plate)].name);
        }
        return std::find(before_->begin(), before_->end(), plate) != before_->end();
    }

    const CompiledDesign& one_;
    const CompileOptions& options_;
    std::size_t trials_ = 0;
    std::optional<std::vector<std::string>> before_;  // plates that stick out as it is
};

}  // namespace

std::optional<std::string> fitting_size(const CompiledDesign& design, const CompileOptions& options,
                                        const std::string& element, double by_mm) {
    if (!edit::can_be_tried(design, options)) return std::nullopt;
    return SizeSearch(design, options).fitting(element, by_mm);
}

}  // namespace popup
