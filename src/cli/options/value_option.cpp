#include "cli/options/value_option.h"

namespace popup::cli {
namespace {

// What the parser cannot be told.
struct Note {
    std::string_view key;
    std::string_view suffix;
    std::string_view instead_of;
};
constexpr Note kNotes[] = {{"profile", ".toml", ""},
                           {"sheet", "", "stock"},
                           {"stock", "", "sheet"},
                           {"nest-effort", "", "nest-time"},
                           {"nest-time", "", "nest-effort"}};

}  // namespace

OptionTraits traits_of(const CLI::Option& option) {
    OptionTraits traits;
    traits.key = option.get_lnames().empty() ? option.get_name(true, false) : option.get_lnames().front();
    traits.flag = option.get_items_expected_max() == 0;
    traits.repeatable = !traits.flag && option.get_expected_max() > 1;
    const std::string type = option.get_type_name();
    traits.files = !traits.flag && (type == "FILE" || type == "DIR");
    for (const Note& note : kNotes) {
        if (note.key != traits.key) continue;
        traits.suffix = note.suffix;
        traits.instead_of = note.instead_of;
    }
    return traits;
}

}  // namespace popup::cli
