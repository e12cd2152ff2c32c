#include "input/xml/ground_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/text/nearest.h"
#include "input/text.h"
#include "popup/mechanism.h"

namespace popup::xml {
namespace {

// More names than this are no hint.
constexpr std::size_t kMostNamesTold = 8;

std::vector<std::string> names_of(const Structure& structure, bool plates) {
    std::vector<std::string> names;
    const ElementInfo* info = find_element(structure.type);
    if (info == nullptr) return names;
    if (plates) {
        for (const PlateInfo& plate : info->plates) names.push_back(plate_name(structure.id, plate));
    } else {
        for (const FoldInfo& fold : info->folds) names.push_back(fold_name(structure.id, fold));
    }
    return names;
}

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size() && i < kMostNamesTold; ++i)
        text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return text;
}

}  // namespace

bool read_ground_name(const Fields& fields, std::initializer_list<Name> instead, std::string_view version,
                      Values& values, NamedGround& on) {
    const Field* field = fields.find(Name::on);
    if (field == nullptr) return false;
    Reporter& reporter = values.reporter();
    const auto text = value_of(*field, reporter);
    if (text) {
        on.text = std::string(trimmed(text->decoded));
        on.range = values.tight(*text);
    }
    if (text && version < "3.0") {
        reporter
            .warning("newer-element", text->place,
                     fmt::format("what a structure stands on has no name in version {}", version))
            .hint("write version=\"3.0\"");
    }
    for (const Name name : instead) {
        const Field* other = fields.find(name);
        if (other == nullptr) continue;
        reporter
            .error("duplicate-value", other->place,
                   fmt::format("what is named with 'on' has no '{}' besides", canonical(name)))
            .hint("leave one of them out; points of a structure then lie beside what is named");
    }
    return true;
}

void GroundNames::resolve() {
    const bool any = std::any_of(design_.structures.begin(), design_.structures.end(),
                                 [](const Structure& one) { return one.named().given(); });
    if (!any) return;
    std::unordered_map<std::string_view, std::size_t> numbers;
    for (std::size_t i = 0; i < design_.structures.size(); ++i) numbers.emplace(design_.structures[i].id, i);
    for (std::size_t i = 0; i < design_.structures.size(); ++i) {
        Structure& structure = design_.structures[i];
        if (!structure.named().given()) continue;
        reporter_.set_structure(i);
        const bool plates = structure.plate.has_value();
        NamedGround& on = structure.named();
        const Place place = plates ? structure.plate->place : structure.fold.place;
        for (const DesignPoint& point : structure.points) {
            if (!point.page) continue;
            reporter_
                .error("bad-page", point.place,
                       "this point names a page, and its structure stands beside '" + shown(on.text) + "'")
                .hint("leave the page out: a point right of a seam lies on the page that is there");
        }
        if (!plates && on.text == kGutter) continue;
        if (plates) {
            const auto* const page = std::find(kPagePlates.begin(), kPagePlates.end(), on.text);
            on.which = static_cast<std::size_t>(page - kPagePlates.begin());
            if (page != kPagePlates.end()) continue;
        }
        const std::size_t dot = std::min(on.text.rfind('.'), on.text.size());
        const auto found = numbers.find(std::string_view(on.text).substr(0, dot));
        if (found == numbers.end()) {
            unknown(i, dot);
            continue;
        }
        const Structure& owner = design_.structures[found->second];
        const ElementInfo* info = find_element(owner.type);
        if (info == nullptr) continue;  // that is an error already
        const std::string_view word = dot < on.text.size() ? std::string_view(on.text).substr(dot + 1) : "";
        const auto name =
            plates ? find_plate_name(*info, owner.id, word) : find_fold_name(*info, owner.id, word);
        if (!name) {
            const std::vector<std::string> names = names_of(owner, plates);
            reporter_
                .error("unknown-ground", place,
                       fmt::format("\"{}\" ({}) has no {} '{}'", owner.id, info->name,
                                   plates ? "plate" : "fold", shown(std::string(word))))
                .hint(names.empty()
                          ? fmt::format("a {} makes none to stand on", info->name)
                          : "there " + std::string(names.size() == 1 ? "is " : "are ") + listed(names));
            continue;
        }
        if (found->second >= i) {
            reporter_
                .error("ground-not-yet", place,
                       found->second == i
                           ? fmt::format("\"{}\" stands on itself, on {}", structure.id, name->text)
                           : fmt::format("\"{}\" stands on {}, and \"{}\" comes later, on line {}",
                                         structure.id, name->text, owner.id, owner.place.line))
                .hint("list what carries others before them");
            continue;
        }
        on.owner = found->second;
        on.which = name->which;
        on.text = name->text;
    }
    reporter_.set_structure(Reporter::kNone);
}

void GroundNames::unknown(std::size_t number, std::size_t dot) {
    const Structure& structure = design_.structures[number];
    const bool plates = structure.plate.has_value();
    const std::string& text = structure.named().text;
    // Of what comes before it, the names that are like this one.
    std::vector<std::string> names;
    if (plates) {
        names.assign(kPagePlates.begin(), kPagePlates.end());
    } else {
        names.emplace_back(kGutter);
    }
    constexpr std::size_t kMostLooked = 2'000;
    for (std::size_t i = 0; i < number && i < kMostLooked; ++i) {
        for (std::string& name : names_of(design_.structures[i], plates)) names.push_back(std::move(name));
    }
    const std::vector<std::string_view> candidates(names.begin(), names.end());
    const std::vector<std::string> near = nearest(text, candidates, 1);
    const std::string id = text.substr(0, dot);
    Diagnostic& told =
        reporter_
            .error("unknown-ground", plates ? structure.plate->place : structure.fold.place,
                   fmt::format("there is no {} '{}': no structure has the id '{}'", plates ? "plate" : "fold",
                               shown(text), shown(id)))
            .hint(near.empty()
                      ? fmt::format("names are such as {}, or the id of a structure before it with its {}",
                                    plates ? "page.left" : "gutter", plates ? "plate" : "fold")
                      : fmt::format("perhaps '{}' is meant", near.front()));
    if (dot < text.size()) {
        told.hint(
            fmt::format("if \"{}\" was taken out, the {} \"{}\" stood on is gone: take \"{}\" out too, "
                        "or stand it on another",
                        shown(id), plates ? "plate" : "fold", structure.id, structure.id));
    }
}

}  // namespace popup::xml
