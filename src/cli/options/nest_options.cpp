// Options about how pieces are put on sheets.
#include "cli/options/value_option.h"

namespace popup::cli {
namespace {

constexpr const char* kGroup = "Nesting";

[[noreturn]] void refuse(std::string_view option, std::string_view wanted, std::string_view text,
                         std::vector<std::string> hints = {}, std::vector<std::string_view> choices = {}) {
    throw UsageError(fmt::format("{} takes {}, not \"{}\"", option, wanted, text), std::move(hints),
                     std::move(choices));
}

void add_freedom_options(CLI::App& verb, LayoutOptions& layout, bool& given) {
    values(verb, "--rotate", "TURNS",
           "none, 180, 90 (default), any, or N in a circle; PIECE=TURNS. Repeatable", kGroup,
           [&layout, &given](std::string_view text) {
               const std::optional<PieceRule> rule = parse_turn_rule(text);
               if (!rule) {
                   refuse("--rotate", "none, 180, 90, any, or a count of turns in a circle", text,
                          {"write PIECE=none, PIECE=180 … for one piece"}, {"none", "180", "90", "any"});
               }
               given = true;
               if (rule->piece.empty()) {
                   layout.rotation = *rule->rotation;
               } else {
                   layout.rules.push_back(*rule);
               }
           });
    value(verb, "--grain", "HOW", "none (default), keep: nothing turns, either: by 180° only, alike", kGroup,
          [&layout, &given](std::string_view text) {
              layout.grain = choose<Grain>(
                  "--grain", text, {{"none", Grain::none}, {"keep", Grain::keep}, {"either", Grain::either}});
              given = true;
          });
    value(
        verb, "--part-in-hole", "WHEN", "always (default) or never use the holes of pieces for others",
        kGroup, [&layout, &given](std::string_view text) {
            layout.part_in_hole = choose<bool>("--part-in-hole", text, {{"always", true}, {"never", false}});
            given = true;
        });
    value(verb, "--group", "WHAT", "none (default), or design: pieces of a design share a sheet", kGroup,
          [&layout, &given](std::string_view text) {
              layout.group_designs = choose<bool>("--group", text, {{"none", false}, {"design", true}});
              given = true;
          });
    values(verb, "--lock", "PLACE", "PIECE[#COPY]=X,Y[,DEGREES][@SHEET]: keep it there. Repeatable", kGroup,
           [&layout, &given](std::string_view text) {
               const std::optional<PieceRule> rule = parse_lock_rule(text);
               if (!rule) {
                   refuse("--lock", "PIECE[#COPY]=X,Y[,DEGREES][@SHEET]", text,
                          {"such as page=112,105 or castle:roof#2=40.5,80,90@3; the numbers are those of a "
                           "placement in the report"});
               }
               layout.rules.push_back(*rule);
               given = true;
           })
        ->configurable(false);
}

void add_effort_options(CLI::App& verb, LayoutOptions& layout, bool& given) {
    NestEffort& effort = layout.nesting;
    value(verb, "--nest-effort", "EFFORT", "quick (default), fast, normal, best, or a number, fast being 1",
          kGroup, [&effort, &given](std::string_view text) {
              effort.shortening = text == "quick" ? kQuickShortening : HUGE_VAL;
              if (text == "quick" || text == "fast") {
                  effort.work = kFastNesting;
              } else if (text == "normal") {
                  effort.work = kNormalNesting;
              } else if (text == "best") {
                  effort.work = kBestNesting;
              } else {
                  const std::optional<double> times = parse_number(text);
                  if (!times || *times < 0.0 || *times > 1e6)
                      refuse("--nest-effort", "quick, fast, normal, best, or a number from 0 to 1000000",
                             text, {}, {"quick", "fast", "normal", "best"});
                  effort.work = *times * kFastNesting;
              }
              given = true;
          });
    value(verb, "--nest-time", "SECONDS", "look for so long, or until Ctrl-C; depends on the clock", kGroup,
          [&effort, &given](std::string_view text) {
              effort.seconds = number_option("--nest-time", text, 0.0, 1e6);
              given = true;
          });
    value(verb, "--nest-seed", "N", "begin the search differently (default 0)", kGroup,
          [&effort, &given](std::string_view text) {
              const double seed = number_option("--nest-seed", text, 0.0, 9e15);
              effort.seed = static_cast<std::uint64_t>(seed);
              if (static_cast<double>(effort.seed) != seed) refuse("--nest-seed", "a whole number", text);
              given = true;
          });
}

}  // namespace

void add_nest_options(CLI::App& verb, Options& options) {
    LayoutOptions& layout = options.compile.layout;
    bool& given = options.sheet_given;
    value(
        verb, "--stock", "LIST", "sheets there are: SIZE[:COUNT],... such as 12x12in:20,a3", kGroup,
        [&layout, &given](std::string_view text) {
            std::optional<std::vector<StockRow>> stock = parse_stock(text);
            if (!stock) {
                refuse(
                    "--stock", "a list SIZE[:COUNT],SIZE[:COUNT]…", text,
                    {"sizes are names of \"popupc list sheets\" or WxH with mm or in; without a count there "
                     "are as many as wanted"});
            }
            layout.stock = std::move(*stock);
            given = true;
        });
    add_freedom_options(verb, layout, given);
    add_effort_options(verb, layout, given);
}

}  // namespace popup::cli
