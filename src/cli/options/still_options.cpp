#include "cli/options/still_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options/options.h"
#include "cli/options/value_option.h"

namespace popup::cli {
namespace {

constexpr std::size_t kMostPictures = 1000;
constexpr int kLeastSide = 16;
constexpr int kMostSide = 32767;

View view_named(std::string_view name) {
    const auto known = std::find(kViewNames.begin(), kViewNames.end(), name);
    if (known == kViewNames.end()) {
        const std::vector<std::string_view> names(kViewNames.begin(), kViewNames.end());
        throw UsageError(fmt::format("--view takes {}, not \"{}\"", fmt::join(kViewNames, ", "), name),
                         did_you_mean(name, names), names);
    }
    return static_cast<View>(known - kViewNames.begin());
}

std::vector<View> views_named(std::string_view names) {
    std::vector<View> views;
    for (std::size_t from = 0; from <= names.size();) {
        const std::size_t to = std::min(names.find(',', from), names.size());
        const View view = view_named(names.substr(from, to - from));
        if (std::find(views.begin(), views.end(), view) == views.end()) views.push_back(view);
        from = to + 1;
    }
    return views;
}

}  // namespace

void add_still_options(CLI::App& verb, StillOptions& still) {
    const std::string group = "Pictures";
    value(verb, "--view", "VIEWS",
          fmt::format("from where: {}; or a list (default iso)", fmt::join(kViewNames, ", ")), group,
          [&still](std::string_view text) { still.views = views_named(text); });
    value(verb, "--at", "ANGLES", "openings that .view.png shows, in degrees, as --angles takes them", group,
          [&still](std::string_view text) {
              const std::optional<std::vector<Angle>> angles = parse_angles(text);
              if (!angles || angles->size() > kMostPictures) {
                  throw UsageError(
                      fmt::format("--at takes at most {} openings, from 0 to 180 degrees, not \"{}\"",
                                  kMostPictures, text),
                      {"such as --at 90, --at 30,90,150 or --at 0:180:30"});
              }
              still.openings_deg.clear();
              for (const Angle angle : *angles) still.openings_deg.push_back(angle.deg);
          });
    value(verb, "--size", "PIXELS",
          "their width and height, such as 1200x900 (default 800x600, moving 480x360)", group,
          [&still](std::string_view text) {
              const std::size_t middle = text.find('x');
              const auto wrong = [&] {
                  return UsageError(
                      fmt::format("--size takes a width and a height of {} to {} pixels, not \"{}\"",
                                  kLeastSide, kMostSide, text),
                      {"such as --size 1200x900"});
              };
              if (middle == std::string_view::npos) throw wrong();
              const auto side = [&](std::string_view digits) {
                  const std::optional<double> pixels = parse_number(digits);
                  if (!pixels || *pixels < kLeastSide || *pixels > kMostSide ||
                      *pixels != static_cast<int>(*pixels))
                      throw wrong();
                  return static_cast<int>(*pixels);
              };
              still.size = PictureSize{side(text.substr(0, middle)), side(text.substr(middle + 1))};
          });
}

}  // namespace popup::cli
