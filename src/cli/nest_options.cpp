// Options about how pieces are put on sheets.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cli/options.h"

namespace popup::cli {
namespace {

constexpr const char* kGroup = "Nesting";

template <typename Use>
void one(CLI::App& verb, const std::string& names, const std::string& type, const std::string& about,
         Use use) {
    verb.add_option_function<std::string>(
            names, [use](const std::string& text) { use(std::string_view(text)); }, about)
        ->type_name(type)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)
        ->group(kGroup);
}

template <typename Use>
void many(CLI::App& verb, const std::string& names, const std::string& type, const std::string& about,
          Use use) {
    verb.add_option_function<std::vector<std::string>>(
            names,
            [use](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) use(std::string_view(text));
            },
            about)
        ->type_name(type)
        ->allow_extra_args(false)
        ->group(kGroup);
}

[[noreturn]] void refuse(std::string_view option, std::string_view wanted, std::string_view text,
                         std::vector<std::string> hints = {}) {
    throw UsageError(fmt::format("{} takes {}, not \"{}\"", option, wanted, text), std::move(hints));
}

void add_freedom_options(CLI::App& verb, LayoutOptions& layout, bool& given) {
    many(verb, "--rotate", "TURNS", "none, 180, 90 (default), any, or N in a circle; PIECE=TURNS. Repeatable",
         [&layout, &given](std::string_view text) {
             const std::optional<PieceRule> rule = parse_turn_rule(text);
             if (!rule) {
                 refuse("--rotate", "none, 180, 90, any, or a count of turns in a circle", text,
                        {"write PIECE=none, PIECE=180 … for one piece"});
             }
             given = true;
             if (rule->piece.empty()) {
                 layout.rotation = *rule->rotation;
             } else {
                 layout.rules.push_back(*rule);
             }
         });
    one(verb, "--grain", "HOW", "none (default), keep: nothing turns, either: by 180° only, alike",
        [&layout, &given](std::string_view text) {
            if (text != "none" && text != "keep" && text != "either")
                refuse("--grain", "none, keep, either", text);
            layout.grain = text == "keep" ? Grain::keep : text == "either" ? Grain::either : Grain::none;
            given = true;
        });
    one(verb, "--part-in-hole", "WHEN", "always (default) or never use the holes of pieces for others",
        [&layout, &given](std::string_view text) {
            if (text != "always" && text != "never") refuse("--part-in-hole", "always, never", text);
            layout.part_in_hole = text == "always";
            given = true;
        });
    one(verb, "--group", "WHAT", "none (default), or design: pieces of a design share a sheet",
        [&layout, &given](std::string_view text) {
            if (text != "none" && text != "design") refuse("--group", "none, design", text);
            layout.group_designs = text == "design";
            given = true;
        });
    many(verb, "--lock", "PLACE", "PIECE[#COPY]=X,Y[,DEGREES][@SHEET]: keep it there. Repeatable",
         [&layout, &given](std::string_view text) {
             const std::optional<PieceRule> rule = parse_lock_rule(text);
             if (!rule) {
                 refuse("--lock", "PIECE[#COPY]=X,Y[,DEGREES][@SHEET]", text,
                        {"such as page=112,105 or castle:roof#2=40.5,80,90@3; the numbers are those of a "
                         "placement in the report"});
             }
             layout.rules.push_back(*rule);
             given = true;
         });
}

void add_effort_options(CLI::App& verb, LayoutOptions& layout, bool& given) {
    NestEffort& effort = layout.nesting;
    one(verb, "--nest-effort", "EFFORT", "fast (default), normal, best, or a number, fast being 1",
        [&effort, &given](std::string_view text) {
            if (text == "fast") {
                effort.work = kFastNesting;
            } else if (text == "normal") {
                effort.work = kNormalNesting;
            } else if (text == "best") {
                effort.work = kBestNesting;
            } else {
                const std::optional<double> times = parse_number(text);
                if (!times || *times < 0.0 || *times > 1e6)
                    refuse("--nest-effort", "fast, normal, best, or a number from 0 to 1000000", text);
                effort.work = *times * kFastNesting;
            }
            given = true;
        });
    one(verb, "--nest-time", "SECONDS", "look for so long, or until Ctrl-C; depends on the clock",
        [&effort, &given](std::string_view text) {
            effort.seconds = number_option("--nest-time", text, 0.0, 1e6);
            given = true;
        });
    one(verb, "--nest-seed", "N", "begin the search differently (default 0)",
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
    one(verb, "--stock", "LIST", "sheets there are: SIZE[:COUNT],... such as 12x12in:20,a3",
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
