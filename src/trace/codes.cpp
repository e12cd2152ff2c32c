#include "trace/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kTraceCodes = std::to_array<CodeInfo>({
    {"trace-empty", Severity::error, "a picture in which there is nothing to trace",
     "An outline runs between what is the figure and what is the ground of a picture: between opaque and "
     "clear pixels where a hundredth or more is clear, else between dark and light ones. Here there is no "
     "figure: all pixels are "
     "alike, or what there is is smaller than the least feature. Give another --threshold, or --invert where "
     "the figure is the lighter one, or a smaller --min-feature, or a size at which the picture is larger."},
    {"trace-few-clear", Severity::remark, "a picture with a few clear pixels was traced by brightness",
     "Where a picture has a clear ground, its figure is what is opaque. Here less than a hundredth of the "
     "pixels are clear, such as the corners of a window in a screenshot, and what is opaque is dark in some "
     "places and light in others. Then the figure is what is dark. Where all that is opaque is the figure, "
     "paint it in one colour."},
    {"trace-holes-filled", Severity::remark, "small holes of a traced picture were filled",
     "Holes with less area than a square of the side --min-feature are noise of the picture, or too small to "
     "cut. They belong to the figure in the outline that is written. The remark says how many there were, "
     "and "
     "how large the largest was; give a smaller --min-feature to keep them."},
    {"trace-others", Severity::remark, "shapes beside the largest one were left out",
     "With --largest the outline is one silhouette: of the shapes in the picture the one with the most paper "
     "is kept, and what is not joined to it is left out, also what lies in its holes. The remark says how "
     "many "
     "there were, and how large the largest of them was. Join them in the picture, or trace without "
     "--largest."},
    {"trace-specks", Severity::remark, "small specks of a traced picture were left out",
     "Shapes with less area than a square of the side --min-feature are noise of the picture, or too small "
     "to "
     "cut. They are not in the outline that is written. The remark says how many there were, and how large "
     "the "
     "largest was; give a smaller --min-feature to keep them, or a larger one where noise is left."},
    {"trace-thin", Severity::warning, "traced paper that is thinner than the least feature",
     "Two parts of a shape hang together by paper that is narrower than --min-feature, or a shape is nowhere "
     "as "
     "wide as that. It can be cut, but it tears easily, and burns away under a laser. The places are counted "
     "from the lower left corner of the picture. Paint them wider in the picture, or trace it at a larger "
     "size; where thin paper is meant, give a smaller --min-feature."},
    {"trace-too-complex", Severity::error, "a picture whose outlines are too many",
     "Photographs, dithered pictures and noise have borders between dark and light everywhere, and no "
     "machine "
     "would cut them in a day. What is traced should be a silhouette: few areas with clear borders. Blur the "
     "picture or give it fewer pixels, trace it at a smaller size, or give a larger --min-feature and "
     "--simplify."},
});

}  // namespace

std::span<const CodeInfo> trace_codes() { return kTraceCodes; }

}  // namespace popup
