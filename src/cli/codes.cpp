#include "cli/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kCliCodes = std::to_array<CodeInfo>({
    {"bad-config", Severity::error, "a configuration is not what it should be",
     "A popupc.toml has the long names of options as keys: at its top for every verb that has the option, "
     "in a table such as [build] for that verb alone. Flags are true or false, repeatable options lists, "
     "and all else is written as on the command line. A key that no verb has is refused, so that a slip of "
     "the pen is not a setting that is silently not made; so are options that belong to one run, such as "
     "output. \"popupc check --print-config\" shows what is set, and where."},
    {"bad-job", Severity::error, "a job of a batch that cannot be run as it is written",
     "The words that a row of the manifest makes of its inputs, outputs, options and copies are no build: "
     "an option is not known, an output has a suffix that names no format, or the job asks for standard "
     "input or output, which batches do not have. The job is not done; the others are. Mend the row, then "
     "run the batch again: only what is missing is done."},
    {"bad-response-file", Severity::error, "a file of arguments cannot be read",
     "An argument @FILE stands for the words of FILE, with blanks or line breaks between them. Quotes keep "
     "the blanks of a word together and must be closed; a backslash takes away the meaning of the "
     "character after it. Files may name other files, but not one that names them. To name an input that "
     "begins with @, write ./ before it."},
    {"baseline-outdated", Severity::remark, "accepted findings that are no longer there",
     "The baseline accepts findings that did not occur in the designs that were checked: they have been "
     "mended, or changed so that they count as new. Nothing is wrong, but an entry that is left would "
     "accept the same mistake if it were made again. Run the check with --write-baseline to take them out; "
     "entries of designs that were not checked stay."},
    {"config-ignored", Severity::remark, "a popupc.toml that this run does not look at",
     "A run has one configuration, and of a directory that is walked it is found from that directory "
     "upward. This one lies below it, so its settings do not hold for the designs beside it, as they would "
     "if these were checked alone. Check its directory in a run of its own, or name one configuration for "
     "all with --config, or take the file away."},
    {"dependency-name", Severity::warning, "a name that ninja does not read in a dependency file",
     "A dependency file names the inputs and outputs of a build as makefiles write names. GNU make reads "
     "this one, but ninja knows fewer characters and ways to protect them, and takes it for another name "
     "or for several: it would build again every time, or miss a change. Rename the file; letters, digits, "
     "blanks and most marks are no trouble. Where only make reads the dependency file, allow this warning."},
    {"edit-not-examined", Severity::remark, "an edited document that was not looked at as a whole",
     "`popupc edit` tells what an edit brings that `popupc check` would find. Of a document with more than "
     "40 "
     "elements it looks only at what the checks find, and whether the card closes, so that it answers at "
     "once: collisions, plates that lie on one another or stick out, and tabs are not looked at. With --deny "
     "or --werror they are, whatever the size."},
    {"fix-unsettled", Severity::error, "repairs that undo one another",
     "Each repair is the least change that mends one thing, and what it moves is looked at again. Here the "
     "repaired document was read again several times and still had something to repair, or had become one "
     "that cannot be made: two constraints pull the same points in different directions, most often "
     "because an element is too large for the fold it stands on. Nothing has been written. Make the "
     "elements that the warnings name smaller, or move them, and run fix again."},
    {"job-crashed", Severity::error, "a job whose process died",
     "The process that did a job of a batch ended without an answer, and so did a second one that tried "
     "the job again. Often the system had no memory left: run fewer processes at a time with -j. Otherwise "
     "it is a mistake in this program; please report it with the input. All other jobs went on, and a "
     "rerun tries this one anew."},
    {"job-failed", Severity::error, "a job of a batch that ended with errors",
     "The input of the job has errors, or a file could not be read or written, so nothing of it was "
     "written. The report has the findings of the job itself, with their places. When the input is mended, "
     "or the file can be used again, run the batch once more: only what is missing or has changed is done."},
    {"job-missing", Severity::error, "a job of a batch whose files are not there",
     "No result says that the job was done, or a file that it wrote has been removed or changed since. A "
     "shard may not have run, or its machine went down. Run the batch again, or the shard: what was "
     "finished stays as it is, and only what is missing is done."},
    {"no-designs", Severity::warning, "a directory in which there is nothing to look at",
     "A directory was named as an input, and in it and below it there is no design: no file whose suffix "
     "is that of a popup document, or none that --include asks for, or all of them are left out by "
     "--exclude, by a .popupcignore file, or because their names begin with a full stop. Nothing has been "
     "checked, which is seldom what was meant. Correct the path or the patterns."},
    {"no-document", Severity::error, "a drawn card of which no document can be written",
     "A document tells a card by its elements, and no element has what is drawn here: a flap or a figure "
     "that "
     "stands up at a fold, or stairs that share a cut (card-of-no-elements). popupc build makes sheets and "
     "models of the drawing, and popupc check examines it. To have a document, leave out of the drawing what "
     "no "
     "element has."},
    {"option-unused", Severity::remark, "an option that no output or input of the run uses",
     "An option on the command line works for some formats only (--dpi for .png, --at for .view.png), or for "
     "some inputs (--snap for folded sheets, --lines for drawings). This run has none of them, so the option "
     "changes nothing. Add the output that you meant, or remove the option. Settings in a popupc.toml or in "
     "the environment are "
     "for many runs, and are not reported."},
});

}  // namespace

std::span<const CodeInfo> cli_codes() { return kCliCodes; }

}  // namespace popup
