#include "fabrication/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kFabricationCodes = std::to_array<CodeInfo>({
    {"bad-profile", Severity::error, "a profile's file is not what it should be",
     "A profile of your own is a TOML file. \"man popupc\" says which keys there are and what each takes, "
     "and schemas/profile.schema.json tells editors. A key that is not known is refused, so that a slip of "
     "the pen does not end in a wrong colour on a machine."},
    {"kerf-shares-color", Severity::remark, "cuts that are moved for the kerf share their colour with others",
     "With --kerf closed cuts are moved out of the paper by half of what the tool burns away; slits, and "
     "cuts that no kerf was given for, are not. Programs that move cuts themselves do so by colour or "
     "layer, and would do it twice to some of them. Let the program move nothing, or give the pens "
     "different colours in a profile of your own."},
    {"kerf-too-wide", Severity::error, "a cut is narrower than what the tool burns away",
     "With --kerf cuts are moved out of the paper by half the width that a laser burns away, or a knife "
     "tears, so that pieces have the size they were drawn with. A hole, a notch, or a gap between two "
     "contours that is no wider than the kerf then closes, and no path of the tool could make it; nor may "
     "pieces be laid nearer to each other than the kerf is wide, for their cuts would cross, or nearer to "
     "the edge of the sheet than half of it. At sharp corners cuts run further out, up to a whole kerf, so "
     "that a --spacing of two kerfs and a --margin of one are enough for all pieces. Cut without --kerf, or "
     "with a narrower one, make the design "
     "larger with --scale, draw a narrow slot as an open line, which is cut as it is, or raise --spacing."},
    {"lines-left-out", Severity::warning, "a profile leaves out cuts or folds",
     "The pens of these lines have no layer, or folds are to be perforated and the pen of perforations has "
     "none, so that the files lack them. A file without its cuts is seldom what is wanted; without folds "
     "it may be, where they are made by hand: then --allow lines-left-out says so."},
    {"one-sided-folds", Severity::remark, "mountain and valley folds are scored from the same side",
     "A laser, and most plotters, score the front of the paper only, and paper folds best away from its "
     "score: mountain folds come out crisp, valley folds less so. Take --score-side both, which puts the "
     "valley folds on a mirrored sheet for the back, or --fold-style perforated, which folds either way, "
     "or crease them by hand with a ruler."},
    {"unusual-format", Severity::remark, "the machine's program is not known to take this format",
     "A machine profile names the formats that the machine or its program takes. A file of another format "
     "was asked for. It is written all the same, with the profile's layers and colours."},
});

}  // namespace

std::span<const CodeInfo> fabrication_codes() { return kFabricationCodes; }

}  // namespace popup
