#include "popup/edit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/text/nearest.h"
#include "base/text/quoted_words.h"
#include "base/text/utf8.h"
#include "edit/first_edit.h"
#include "edit/moved_places.h"
#include "edit/quick_look.h"
#include "edit/session.h"
#include "edit/trial.h"
#include "input/text.h"
#include "input/xml/read.h"
#include "mechanism/arguments.h"
#include "popup/motion.h"

namespace popup {
namespace edit {

std::span<const Row> rows() {
    static const std::array<Row, 8> kRows{
        {{{"set", "ID --NAME VALUE...",
           "change measures, sizes and colours; the others stay; none takes a value out"},
          {"follow"},
          {},
          1,
          1000,
          set},
         {{"move", "ID --along LENGTH | --to PLACE | --across LENGTH | --x LENGTH --y LENGTH | --turn ANGLE",
           "move an element along its fold, or on its plate"},
          {"follow"},
          {"along", "to", "across", "x", "y", "turn"},
          1,
          1,
          move},
         {{"point", "ID.LETTER --to X,Y | --by X,Y", "move a point, and its partner on the other side"},
          {"alone", "follow"},
          {"to", "by"},
          1,
          1,
          move_point},
         {{"add", "TYPE [--on FOLD] [--id ID] [--room LENGTH] [--NAME VALUE]...", "add an element"},
          {},
          {},
          1,
          1000,
          add},
         {{"copy", "ID [--times N] [--step LENGTH] [--on FOLD] [--mirror | --with-children] [--ids PATTERN]",
           "copy an element along its fold, or to another"},
          {"mirror", "with-children"},
          {"times", "step", "on", "ids"},
          1,
          1,
          copy},
         {{"delete", "ID [--with-children]", "take an element out"}, {"with-children"}, {}, 1, 1, take_out},
         {{"rename", "ID NEW", "give an element another id, also where it is named"}, {}, {}, 2, 2, rename},
         {{"outline", "ID --from FILE.svg [--fit seams|width|height|both|none] | --d PATH",
           "give a piece a drawn silhouette, stood on its seams"},
          {},
          {"from", "fit", "d"},
          1,
          1,
          outline}}};
    return kRows;
}

namespace {

// Whether an option is a number that is negative, and no option.
bool is_value(const std::string& word) { return !word.starts_with("--"); }

std::optional<Command> parse(Session& session, const EditLine& line) {
    Command made;
    if (line.words.empty()) {
        session.fail("bad-edit", "there is no edit");
        return std::nullopt;
    }
    made.verb = line.words.front();
    const auto all = rows();
    const auto row =
        std::find_if(all.begin(), all.end(), [&](const Row& r) { return r.verb.name == made.verb; });
    if (row == all.end()) {
        std::vector<std::string_view> names;
        for (const Row& one : all) names.push_back(one.verb.name);
        const std::vector<std::string> near = nearest(made.verb, names, 1);
        session.fail("bad-edit", fmt::format("there is no edit '{}'", shown(made.verb)),
                     near.empty() ? fmt::format("edits are {}", fmt::join(names, ", "))
                                  : fmt::format("perhaps '{}' is meant", near.front()));
        return std::nullopt;
    }
    const std::string usage = fmt::format("{} {}", row->verb.name, row->verb.usage);
    const bool any = row->options.empty() && row->most_words > 2;
    for (std::size_t i = 1; i < line.words.size(); ++i) {
        const std::string& word = line.words[i];
        if (is_value(word)) {
            made.words.push_back(word);
            continue;
        }
        const std::size_t equals = std::min(word.find('='), word.size());
        const std::string name = word.substr(2, equals - 2);
        if (made.has(name)) {
            session.fail("bad-edit", fmt::format("--{} is given twice", shown(name)), "write " + usage);
            return std::nullopt;
        }
        const bool flag = std::find(row->flags.begin(), row->flags.end(), name) != row->flags.end();
        const bool known =
            any || std::find(row->options.begin(), row->options.end(), name) != row->options.end();
        if (flag && equals == word.size()) {
            made.options.emplace_back(name, std::string());
        } else if (!known) {
            session.fail("bad-edit", fmt::format("{} has no option --{}", made.verb, shown(name)),
                         "write " + usage);
            return std::nullopt;
        } else if (equals < word.size()) {
            made.options.emplace_back(name, word.substr(equals + 1));
        } else if (i + 1 < line.words.size() && is_value(line.words[i + 1])) {
            made.options.emplace_back(name, line.words[++i]);
        } else {
            session.fail("bad-edit", fmt::format("--{} has no value", shown(name)), "write " + usage);
            return std::nullopt;
        }
    }
    if (made.words.size() < row->least_words || made.words.size() > row->most_words) {
        session.fail("bad-edit",
                     fmt::format("{} takes {} word{}, and {} {} given", made.verb, row->least_words,
                                 row->least_words == 1 ? "" : "s", made.words.size(),
                                 made.words.size() == 1 ? "is" : "are"),
                     "write " + usage);
        return std::nullopt;
    }
    return made;
}

bool run(Session& session, const EditLine& line) {
    session.place = line.place;
    const auto command = parse(session, line);
    if (!command) return false;
    const auto all = rows();
    return std::find_if(all.begin(), all.end(), [&](const Row& r) { return r.verb.name == command->verb; })
        ->run(session, *command);
}

// How far a document is looked at.
enum class Until { reading, check, motion };

std::optional<Design> read_document(const Source& source, const EditOptions& options, Diagnostics& found) {
    ReadOptions read = options.read;
    read.language = "xml";
    return read_source_text(source, read, found).design;
}

// Checks and closes a design: with what its reading says, everything that can be an error of it. How far it
// was when the last finding came: looking no further finds the same codes. `edits`: those
// that made the text of which this one was read; what moves as before is not moved again.
Until look_at(const Design& design, Until until, const EditOptions& options, Diagnostics& found,
              Edits* edits = nullptr) {
    Until last = Until::reading;
    std::size_t count = found.sorted().size();
    const auto now = [&](Until stage) {
        if (const std::size_t more = found.sorted().size(); more > count) {
            count = more;
            last = stage;
        }
    };
    if (until == Until::reading) return last;
    const auto checked = check(design, options.check, found);
    now(Until::check);
    if (!checked || until == Until::check) return last;
    const auto assembly = assemble(*checked, {}, found);
    const bool moves = assembly && edits != nullptr &&
                       moves_without_findings(*edits, *checked, found.repairs(), *assembly, options.check);
    if (assembly && !moves) {
        MotionOptions motion;
        motion.examine = false;
        simulate(*assembly, motion, found);
    }
    now(Until::motion);
    return last;
}

// By severity too: a repair that has become impossible is an error of the same code.
using Counts = std::map<std::tuple<Severity, std::string, std::string>, int>;

Counts counted(const Diagnostics& found) {
    Counts counts;
    for (const Diagnostic& one : found.sorted()) ++counts[{one.severity, one.code, one.element}];
    return counts;
}

// Whether all that a reading and the checks have found was found by the reading before, or is known not to
// have been found by the checks: a card that was made as it is written has no errors and no repairs.
bool is_surely_new(std::span<const Diagnostic> found, Counts read, const Edits& edits) {
    if (!edits.owners || !edits.owners->as_written) return false;
    return std::all_of(found.begin(), found.end(), [&read](const Diagnostic& one) {
        if (int& known = read[{one.severity, one.code, one.element}]; known > 0) {
            --known;
            return true;
        }
        return one.severity == Severity::error || one.change.has_value();
    });
}

// What elements were called before the edits, of those that have another name now: what has no id is called
// by its number, and that changes with every element that goes before it.
using NamesBefore = std::unordered_map<std::string, std::string>;

NamesBefore names_before(const Edits& edits, const Design& read) {
    NamesBefore made;
    if (read.structures.size() != edits.after.structures.size()) return made;
    const auto numbers = numbers_before(edits.before, edits.after);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (!numbers[i]) continue;
        const std::string& was = edits.before.structures[*numbers[i]].id;
        if (read.structures[i].id != was) made.emplace(read.structures[i].id, was);
    }
    return made;
}

// What is found in an edited document, with its places.
struct Looked {
    std::optional<Design> design;  // as it was read, or would be
    std::vector<Diagnostic> found;
    Until last = Until::reading;
};

Looked look_at_text(const std::string& text, const std::string& name, const EditOptions& options,
                    Edits& edits) {
    Looked looked;
    Diagnostics found(name);
    looked.design = read_document({name, text}, options, found);
    if (looked.design) looked.last = look_at(*looked.design, Until::motion, options, found, &edits);
    looked.found = found.sorted();
    return looked;
}

// The same, with all that compile() finds up to the pattern.
Looked look_at_all(const std::string& text, const std::string& name, const CompileOptions& options,
                   const DiagnosticPolicy& policy) {
    CompileOptions first = options;
    first.read.language = "xml";
    first.until = Stage::check;
    first.progress = {};
    Compilation run = compile({{name, text}}, first, policy);
    CompiledDesign& one = run.designs.front();
    find_further(one, first);
    Looked looked;
    looked.design = std::move(one.design);
    looked.found = one.diagnostics.sorted();
    looked.last = Until::motion;
    return looked;
}

// As the findings of a document as it was: no move is looked for that would mend them.
Counts counted_all(const Source& source, const CompileOptions& options, const DiagnosticPolicy& policy) {
    Counts counts;
    for (const Diagnostic& one : look_at_all(source.text, source.name, without_hints(options), policy).found)
        ++counts[{one.severity, one.code, one.element}];
    return counts;
}

// Whether something stands on the page of a piece that was taken out: no number is written for it.
bool has_lost_page(const Design& design) {
    const auto is_lost = [](const std::optional<int>& page) { return page && *page < 0; };
    return std::any_of(design.structures.begin(), design.structures.end(),
                       [&](const Structure& one) {
                           return is_lost(one.ground_page()) ||
                                  std::any_of(one.points.begin(), one.points.end(),
                                              [&](const DesignPoint& p) { return is_lost(p.page); }) ||
                                  std::any_of(one.arguments.begin(), one.arguments.end(),
                                              [&](const Argument& a) { return is_lost(a.page); });
                       }) ||
           std::any_of(design.lines.begin(), design.lines.end(),
                       [](const DrawnLine& one) { return one.page < 0; }) ||
           std::any_of(design.prints.begin(), design.prints.end(),
                       [](const DrawnPrint& one) { return one.page < 0; });
}

// Whether the edited design tells all that reading its document would: nothing is allowed, reading finds
// nothing but before the first structure, nothing was added, whose places are not known yet, and what was
// drawn anew is not read from its text.
bool tells_all(const Edits& edits, const Diagnostics& of_reading) {
    if (edits.after.version_changed || !of_reading.allowances().empty() || edits.before.structures.empty() ||
        has_lost_page(edits.after))
        return false;
    const Place first = edits.before.structures.front().place;
    for (const Diagnostic& one : of_reading.sorted()) {
        const bool before = std::tie(one.place.line, one.place.column) < std::tie(first.line, first.column);
        if (!before || !one.related.empty()) return false;
    }
    return std::none_of(
        edits.after.structures.begin(), edits.after.structures.end(), [](const Structure& one) {
            return one.added ||
                   std::any_of(one.arguments.begin(), one.arguments.end(), [](const Argument& argument) {
                       return argument.changed &&
                              (!argument.text.present() || !argument.given() || is_drawn(argument));
                   });
        });
}

// The same as look_at_text(), without reading it; nullopt where that is not certain. `changes` made `text`.
std::optional<Looked> look_at_design(const Source& before, std::span<const xml::PatchEdit> changes,
                                     const std::string& text, const Diagnostics& of_reading,
                                     const EditOptions& options, Edits& edits) {
    Looked looked;
    looked.design = as_read(edits.after);
    Diagnostics found(before.name);
    looked.last = look_at(*looked.design, Until::motion, options, found, &edits);
    looked.found = found.sorted();
    if (looked.found.empty()) return looked;
    // Reading finds again what it has found.
    for (Diagnostic& one : of_reading.sorted()) looked.found.push_back(std::move(one));
    const MovedPlaces moved(before.text, changes, text);
    for (Diagnostic& one : looked.found) {
        if (!moved.move(one)) return std::nullopt;
    }
    return looked;
}

bool is_among(const Diagnostics& found, const Diagnostic& error) {
    const auto all = found.sorted();
    return std::any_of(all.begin(), all.end(), [&](const Diagnostic& one) {
        return one.severity == Severity::error && one.code == error.code && one.element == error.element;
    });
}

// The place of an edit that brings an error of the document that all of them make.
Place place_of_error(const Source& source, std::span<const EditLine> edits, const EditOptions& options,
                     const Diagnostic& error, const DiagnosticPolicy& policy) {
    EditOptions forced = options;
    forced.force = true;
    return place_of_first(edits, [&](std::size_t count) {
        Diagnostics unheard;
        Diagnostics found(source.name, policy);
        edit_document(source, edits.first(count), forced, unheard, found);
        return is_among(found, error);
    });
}

}  // namespace
}  // namespace edit

std::vector<EditLine> read_edits(std::string_view text, Diagnostics& diagnostics) {
    std::vector<EditLine> made;
    text = without_mark(text);
    int number = 0;
    while (!text.empty()) {
        ++number;
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.empty() || line.starts_with('#')) continue;
        EditLine& edit = made.emplace_back();
        edit.place = {number, 1};
        Diagnostics trouble(diagnostics.file());
        const std::vector<QuotedWord> words = quoted_words(line, "bad-edit", trouble);
        const auto comment = std::find_if(words.begin(), words.end(), [](const QuotedWord& word) {
            return word.plain && word.text == "#";
        });
        for (auto word = words.begin(); word != comment; ++word) edit.words.push_back(word->text);
        // A quote that does not end takes all behind it, so one behind a comment's begin is in the comment.
        if (comment != words.end()) continue;
        for (const Diagnostic& one : trouble.sorted()) diagnostics.error("bad-edit", edit.place, one.message);
    }
    return made;
}

std::span<const EditVerb> edit_verbs() {
    static const std::vector<EditVerb> verbs = [] {
        std::vector<EditVerb> made;
        for (const edit::Row& row : edit::rows()) made.push_back(row.verb);
        return made;
    }();
    return verbs;
}

std::optional<Edited> edit_document(const Source& source, std::span<const EditLine> edits,
                                    const EditOptions& options, Diagnostics& of_edits,
                                    Diagnostics& of_document) {
    ReadOptions read = options.read;
    read.language = "xml";
    Diagnostics reading_errors(source.name);
    Reading reading = read_source_text(source, read, reading_errors);
    if (!reading.design) {
        for (const Diagnostic& one : reading_errors.sorted()) {
            Diagnostic& told = of_document.add(one.severity, one.code, one.place, one.message);
            told = one;
        }
        return std::nullopt;
    }
    const Design before_edits = *reading.design;
    edit::Session session(std::move(*reading.design), source.name, options.check.tolerances, of_edits);
    for (const EditLine& line : edits) {
        if (!edit::run(session, line)) return std::nullopt;
    }
    const std::vector<xml::PatchEdit> changes = xml::patch_edits(source, session.design, session.gone);
    Edited made;
    made.text = xml::patched(source.text, changes);
    made.files = std::move(reading.files);
    made.examined = options.all != nullptr || made.text == source.text;
    if (made.text == source.text) return made;
    edit::Edits done{before_edits, session.design, session.take_owners()};
    if (edit::is_as_it_was(done)) {
        made.examined = true;
        return made;
    }
    const DiagnosticPolicy& policy = of_document.policy();
    std::optional<edit::Looked> looked;
    if (options.all != nullptr) {
        looked = edit::look_at_all(made.text, source.name, *options.all, policy);
    } else if (edit::tells_all(done, reading_errors)) {
        looked = edit::look_at_design(source, changes, made.text, reading_errors, options, done);
    } else if (edit::finds_nothing(done, options.check)) {
        return made;
    }
    if (!looked) looked = edit::look_at_text(made.text, source.name, options, done);
    const std::vector<Diagnostic>& found = looked->found;
    // What was found before is asked only as far as there is something to compare it with.
    edit::Counts before = edit::counted(reading_errors);
    if (options.all != nullptr) {
        before = edit::counted_all(source, *options.all, policy);
    } else if (!found.empty() &&
               !(looked->last == edit::Until::check && edit::is_surely_new(found, before, done))) {
        edit::look_at(before_edits, looked->last, options, reading_errors);
        before = edit::counted(reading_errors);
    }
    const edit::NamesBefore names =
        looked->design ? edit::names_before(done, *looked->design) : edit::NamesBefore();
    const Diagnostic* broken = nullptr;
    for (const Diagnostic& one : found) {
        const auto name = names.find(one.element);
        int& known = before[{one.severity, one.code, name == names.end() ? one.element : name->second}];
        if (known > 0) {
            --known;
            continue;
        }
        Diagnostic& told = of_document.add(one.severity, one.code, one.place, one.message);
        const Severity severity = told.severity;  // the policy may have raised it
        told = one;
        told.severity = severity;
        if (broken == nullptr && severity == Severity::error) broken = &one;
    }
    if (broken == nullptr || options.force) return made;
    Diagnostic& refused =
        of_edits
            .error("edit-refused", edit::place_of_error(source, edits, options, *broken, policy),
                   "the document would have an error that it does not have now; nothing is written")
            .hint("--force writes it all the same");
    const bool leaves_others = std::any_of(edits.begin(), edits.end(), [](const EditLine& one) {
        if (one.words.empty()) return false;
        const std::string& verb = one.words.front();
        return (verb == "move" || verb == "set" || verb == "point") &&
               std::find(one.words.begin(), one.words.end(), "--follow") == one.words.end();
    });
    if (leaves_others) refused.hint("what stands on a moved element goes along with --follow");
    made.refused = true;
    return made;
}

}  // namespace popup
