#include "cli/options/profile_options.h"

#include <algorithm>
#include <utility>

#include "base/nth.h"
#include "cli/files/read_settings.h"
#include "cli/options/value_option.h"
#include "popup/files.h"
#include "popup/write.h"

namespace popup::cli {
namespace {

constexpr double kLongestMm = 10000.0;
constexpr double kLeastJointMm = 0.05;

Perforation perforation_option(std::string_view text) {
    std::vector<Length> lengths;
    bool good = true;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t comma = std::min(text.find(',', at), text.size());
        const std::optional<Length> length = parse_length(text.substr(at, comma - at));
        good = good && length && length->mm >= (lengths.size() < 2 ? Perforation::kLeastMm : 0.0) &&
               length->mm <= 1000.0;
        lengths.push_back(length.value_or(Length{}));
        at = comma + 1;
    }
    if (!good || lengths.size() < 2 || lengths.size() > 3) {
        throw UsageError(fmt::format("--perforation takes CUT,GAP or CUT,GAP,CLEAR, not \"{}\"", text),
                         {"such as 2,1 or 1.5mm,0.8mm,2mm; cut and gap are at least 0.01 mm"});
    }
    Perforation perforation{lengths[0].mm, lengths[1].mm};
    if (lengths.size() == 3) perforation.clear_mm = lengths[2].mm;
    return perforation;
}

Length length_of(std::string_view option, std::string_view text, double least, double most) {
    const std::optional<Length> length = parse_length(text);
    if (length && length->mm >= least && length->mm <= most) return *length;
    throw UsageError(
        fmt::format("{} takes a length from {} mm to {} mm, not \"{}\"", option, least, most, text));
}

// Does `use` with the pens that `name` means: an operation, "fold" or "cut". False: it means none.
template <typename Use>
bool with_pens(Profile& profile, std::string_view name, Use use) {
    bool any = false;
    for (const Operation operation : kOperations) {
        const bool group = (name == "fold" && is_fold(operation)) ||
                           (name == "cut" && (is_cut(operation) || operation == Operation::perforation));
        if (!group && (is_printed(operation) || name != to_string(operation))) continue;
        use(nth(profile.pens, operation));
        any = true;
    }
    return any;
}

// "NAME=VALUE" apart; without "=" the name is empty.
std::pair<std::string_view, std::string_view> named_value(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) return {{}, text};
    return {text.substr(0, equals), text.substr(equals + 1)};
}

void apply_kerf(Profile& profile, std::string_view text) {
    const auto [name, value] = named_value(text);
    const double kerf = length_of("--kerf", value, 0.0, 10.0).mm;
    bool known = false;
    for (const Operation cut : {Operation::inner_cut, Operation::outer_cut}) {
        if (!name.empty() && name != to_string(cut)) continue;
        nth(profile.pens, cut).kerf_mm = kerf;
        known = true;
    }
    if (known) return;
    throw UsageError(fmt::format("--kerf takes WIDTH, inner-cut=WIDTH or outer-cut=WIDTH, not \"{}\"", text),
                     {"only closed cuts have an inside and an outside to move away from"});
}

void apply_speed(Profile& profile, std::string_view text) {
    const auto [name, value] = named_value(text);
    const std::optional<double> speed = parse_number(value);
    const bool good = speed && *speed > 0.0 && *speed <= 1e5;
    if (good && name == "travel") {
        profile.travel_mm_s = *speed;
        return;
    }
    if (good && with_pens(profile, name, [&](Pen& pen) { pen.speed_mm_s = *speed; })) return;
    throw UsageError(
        fmt::format("--speed takes NAME=MM_PER_SECOND, not \"{}\"", text),
        {"names: cut, fold, travel, or an operation such as outer-cut; speeds are above 0, up to 100000"});
}

}  // namespace

void add_profile_options(CLI::App& verb, Options& options) {
    BuildOptions& build = options.build;
    OutputOptions& output = options.compile.output;
    output.legend = Legend::automatic;
    value(verb, "--profile", "NAME", "for which machine: see \"popupc list profiles\"; or FILE.toml", "Lines",
          [&options](std::string_view text) {
              options.build.profile_file.clear();
              if (text.ends_with(".toml")) {
                  options.build.profile_file = text;
                  return;
              }
              const Profile* profile = find_profile(text);
              if (profile == nullptr) {
                  std::vector<std::string> hints = did_you_mean(text, profile_names());
                  hints.push_back(fmt::format("profiles: {}; or a file of your own, with the suffix .toml",
                                              fmt::join(profile_names(), ", ")));
                  throw UsageError(fmt::format("there is no profile \"{}\"", text), hints, profile_names());
              }
              options.compile.output.profile = *profile;
          });
    value(verb, "--fold-style", "STYLE", "dashed, score, perforated or both, instead of the profile's",
          "Lines", [&build](std::string_view text) {
              build.folds = choose<FoldStyle>("--fold-style", text,
                                              {{"dashed", FoldStyle::dashed},
                                               {"score", FoldStyle::score},
                                               {"perforated", FoldStyle::perforated},
                                               {"both", FoldStyle::both}});
          });
    value(verb, "--away-folds", "LOOK",
          "whole or broken: scores of folds away from you, instead of the profile's", "Lines",
          [&build](std::string_view text) {
              build.away_folds = choose<AwayFolds>(
                  "--away-folds", text, {{"whole", AwayFolds::whole}, {"broken", AwayFolds::broken}});
          });
    value(verb, "--perforation", "CUT,GAP",
          "of perforated folds (default 2,1); CUT,GAP,CLEAR: and their ends", "Lines",
          [&build](std::string_view text) { build.perforation = perforation_option(text); });
    value(verb, "--score-side", "SIDE", "front, back or both: from which side folds are scored", "Lines",
          [&output](std::string_view text) {
              output.score_side = choose<ScoreSide>(
                  "--score-side", text,
                  {{"front", ScoreSide::front}, {"back", ScoreSide::back}, {"both", ScoreSide::both}});
          });
    values(verb, "--kerf", "WIDTH",
           "what the tool burns away (default 0); inner-cut=WIDTH: there. Repeatable", "Lines",
           [&build](std::string_view text) {
               Profile probe;
               apply_kerf(probe, text);
               build.kerfs.emplace_back(text);
           });
    value(verb, "--joints", "WIDTH", "bridges that hold pieces in the sheet (default 0: none), such as 0.4mm",
          "Lines", [&build](std::string_view text) {
              const double width = length_of("--joints", text, 0.0, 10.0).mm;
              if (width > 0.0 && width < kLeastJointMm) {
                  throw UsageError(fmt::format("--joints takes 0 or a width from {} mm to 10 mm, not \"{}\"",
                                               kLeastJointMm, text));
              }
              build.joint_mm = width;
          });
    value(verb, "--marks-on", "SIDE",
          "where a machine marks how to glue: front, back, hidden (default) or none", "Lines",
          [&build](std::string_view text) {
              build.marks_on = choose<MarksOn>("--marks-on", text,
                                               {{"front", MarksOn::front},
                                                {"back", MarksOn::back},
                                                {"hidden", MarksOn::hidden},
                                                {"none", MarksOn::none}});
          });
    values(verb, "--speed", "SPEED", "NAME=MM_S, of cut, fold, travel or an operation, for times. Repeatable",
           "Lines", [&build](std::string_view text) {
               Profile probe;
               apply_speed(probe, text);
               build.speeds.emplace_back(text);
           });
    value(verb, "--marks", "MARKS", "registration marks: none, corners or silhouette", "Print",
          [&build](std::string_view text) {
              build.marks = choose<Marks>(
                  "--marks", text,
                  {{"none", Marks::none}, {"corners", Marks::corners}, {"silhouette", Marks::silhouette}});
          });
    value(verb, "--legend", "WHEN", "what lines mean, on free paper: auto (default), always or never",
          "Print", [&output](std::string_view text) {
              output.legend = choose<Legend>(
                  "--legend", text,
                  {{"auto", Legend::automatic}, {"always", Legend::always}, {"never", Legend::never}});
          });
    verb.add_flag("--print-and-cut", output.print_and_cut,
                  "what is printed and what is cut as files of their own, -print and -cut")
        ->group("Print");
    value(verb, "--sides", "SIDES", "front or both: both prints glue targets and labels on the back", "Print",
          [&output](std::string_view text) {
              output.backs = choose<bool>("--sides", text, {{"front", false}, {"both", true}});
          });
    value(verb, "--reference", "LENGTH", "a bar of this length on each sheet, to measure", "Print",
          [&output](std::string_view text) {
              output.reference_mm = length_of("--reference", text, 1.0, kLongestMm).mm;
          });
    value(verb, "--dpi", "N", "pixels an inch of .png (default 300)", "Print",
          [&output](std::string_view text) { output.dpi = number_option("--dpi", text, 10.0, 4800.0); });
}

std::optional<ProfileFile> load_profile(Options& options) {
    const std::string& name = options.build.profile_file;
    if (name.empty()) return std::nullopt;
    ProfileFile file{Diagnostics(name, options.policy), Source{name, {}}};
    std::optional<Source> source = read_settings(name, file.diagnostics);
    file.readable = source.has_value();
    if (source) file.source = std::move(*source);
    std::vector<std::string_view> formats;
    for (const Format& row : format_table()) formats.push_back(row.suffix.substr(1));
    const std::optional<Profile> profile =
        file.readable ? read_profile(file.source, file.diagnostics, formats) : std::nullopt;
    if (profile) options.compile.output.profile = *profile;
    return file;
}

void finish_profile(Options& options) {
    Profile& profile = options.compile.output.profile;
    profile.folds = options.build.folds.value_or(profile.folds);
    profile.away_folds = options.build.away_folds.value_or(profile.away_folds);
    profile.perforation = options.build.perforation.value_or(profile.perforation);
    profile.marks = options.build.marks.value_or(profile.marks);
    profile.marks_on = options.build.marks_on.value_or(profile.marks_on);
    profile.joint_mm = options.build.joint_mm.value_or(profile.joint_mm);
    for (const std::string& text : options.build.kerfs) apply_kerf(profile, text);
    for (const std::string& text : options.build.speeds) apply_speed(profile, text);

    const double need = margin_needed(options.compile.output);
    const Length margin = options.compile.layout.margin;
    if (options.margin_given && margin.mm < need) {
        throw UsageError(
            fmt::format("a margin of {} mm has no room for {}, which {} {} mm", margin.mm,
                        clear_of(profile.marks) == need ? "the registration marks" : "the bar of --reference",
                        clear_of(profile.marks) == need ? "need" : "needs", need),
            {fmt::format("leave --margin away, or make it {} mm", need)});
    }
    fit_layout(options.compile);
}

}  // namespace popup::cli
