#include "edit/moved_places.h"

#include <algorithm>

#include "input/xml/encoding.h"

namespace popup::edit {
namespace {

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }

}  // namespace

MovedPlaces::MovedPlaces(std::string_view before, std::span<const xml::PatchEdit> changes,
                         std::string_view after)
    : before_(before),
      after_(after),
      changes_(changes),
      lines_before_(lines_of(before)),
      lines_after_(lines_of(after)) {}

MovedPlaces::Lines MovedPlaces::lines_of(std::string_view text) {
    Lines lines{text.starts_with(xml::kByteOrderMark) ? xml::kByteOrderMark.size() : 0};
    for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1))
        lines.push_back(at + 1);
    return lines;
}

std::optional<Place> MovedPlaces::of(Place place) const {
    if (place.line <= 0) return place;
    const auto line = static_cast<std::size_t>(place.line) - 1;
    if (line >= lines_before_.size()) return std::nullopt;
    std::size_t at = lines_before_[line];
    for (int column = 1; column < place.column && at < before_.size(); ++column) {
        ++at;
        while (at < before_.size() && !begins_character(before_[at])) ++at;
    }
    std::size_t now = at;
    for (const xml::PatchEdit& change : changes_) {
        if (change.begin > at) break;
        const bool stays = change.begin == at && change.end > at && !change.text.empty();
        if (stays) break;
        if (change.end > at) return std::nullopt;
        now = now - (change.end - change.begin) + change.text.size();
    }
    const auto behind = std::upper_bound(lines_after_.begin(), lines_after_.end(), now);
    const auto number = behind - lines_after_.begin();
    if (number == 0 || now > after_.size()) return std::nullopt;
    const std::string_view passed = after_.substr(*(behind - 1), now - *(behind - 1));
    const auto column = std::count_if(passed.begin(), passed.end(), begins_character);
    return Place{static_cast<int>(number), static_cast<int>(column) + 1};
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
