#include "edit/moved_places.h"

#include <algorithm>

namespace popup::edit {

MovedPlaces::MovedPlaces(std::string_view before, std::span<const xml::PatchEdit> changes,
                         std::string_view after)
    : before_(before), after_(after), changes_(changes) {}

std::optional<Place> MovedPlaces::of(Place place) const {
    if (place.line <= 0) return place;
    const auto at = before_.offset_of(place);
    if (!at) return std::nullopt;
    std::size_t now = *at;
    for (const xml::PatchEdit& change : changes_) {
        if (change.begin > *at) break;
        const bool stays = change.begin == *at && change.end > *at && !change.text.empty();
        if (stays) break;
        if (change.end > *at) return std::nullopt;
        now = now - (change.end - change.begin) + change.text.size();
    }
    return after_.place_of(now);
}

bool MovedPlaces::move(Diagnostic& finding) const {
    const auto moved = [this](Place& place) {
        const auto now = of(place);
        if (now) place = *now;
        return now.has_value();
    };
    return moved(finding.place) && std::all_of(finding.related.begin(), finding.related.end(),
                                               [&](Related& one) { return moved(one.place); });
}

}  // namespace popup::edit
