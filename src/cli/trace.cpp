#include "popup/trace.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <utility>
#include <variant>

#include "base/diagnostics/picture_hints.h"
#include "cli/files/outputs.h"
#include "cli/files/read_files.h"
#include "cli/options/value_option.h"
#include "cli/report.h"
#include "cli/verbs.h"
#include "popup/files.h"
#include "popup/image.h"

namespace popup::cli {
namespace {

constexpr double kMmPerInch = 25.4;
constexpr double kLargestMm = 10'000.0;

double size_option(std::string_view option, std::string_view text, double least) {
    const std::optional<Length> length = parse_length(text);
    if (length && length->mm >= least && length->mm <= kLargestMm) return length->mm;
    throw UsageError(
        fmt::format("{} takes a length from {} to {} mm, not \"{}\"", option, least, kLargestMm, text),
        {"write 5, 5mm, 0.5cm, 0.2in or 14pt"});
}

void check_usage(const Options& options) {
    const TraceVerbOptions& trace = options.trace;
    const bool to_standard_output = trace.output.empty() || is_standard_output(trace.output);
    if (to_standard_output && options.messages.use_standard_output()) {
        throw UsageError("standard output has two users: the outline and the diagnostics",
                         {"--diagnostics FILE and -o FILE take files"});
    }
    if (!options.messages.file.empty() && !to_standard_output &&
        same_place(options.messages.file, trace.output)) {
        throw UsageError(trace.output + " is named twice as an output");
    }
    const ReadFiles read = files_read(options, {trace.picture});
    read.spare(trace.output, "-o");
    read.spare(options.messages.file, "--diagnostics");
    if (!to_standard_output && !trace.output.ends_with(".svg")) {
        throw UsageError(fmt::format("{}: outlines are written as SVG", trace.output),
                         {"give the file a name that ends in .svg"});
    }
}

std::optional<ImagePixels> read_pixels(const std::string& name, Diagnostics& diagnostics, bool& readable) {
    // One byte more than a picture may have: what is larger is told as such.
    std::optional<Source> source = read_source(name, diagnostics, kMostImageBytes + 1);
    readable = source.has_value();
    if (!source) return std::nullopt;
    std::variant<Image, ImageFault> opened = open_image(std::move(source->text));
    if (const auto* fault = std::get_if<ImageFault>(&opened)) {
        const bool large = *fault == ImageFault::too_many_bytes || *fault == ImageFault::too_many_pixels;
        diagnostics.error("picture-unreadable", {}, std::string(to_string(*fault)))
            .hint(std::string(large ? kPictureSmaller : kPictureAnew));
        return std::nullopt;
    }
    return pixels_of(std::get<Image>(opened));
}

std::optional<Traced> traced(const Options& options, const ImagePixels& pixels, Diagnostics& diagnostics) {
    const TraceVerbOptions& verb = options.trace;
    TraceOptions trace = verb.trace;
    if (verb.dpi > 0.0) trace.pixel_mm = kMmPerInch / verb.dpi;
    if (verb.width_mm > 0.0) trace.pixel_mm = verb.width_mm / pixels.width;
    if (verb.height_mm > 0.0) trace.pixel_mm = verb.height_mm / pixels.height;
    const PixelMask mask = mask_of(pixels, verb.mask);
    if (mask.even && !verb.mask.threshold) {
        diagnostics
            .error(
                "trace-empty", {},
                fmt::format(
                    "the picture has {} pixel{}, all of the same {}: nothing tells a figure from its ground",
                    mask.inside.size(), mask.inside.size() == 1 ? "" : "s",
                    mask.by_alpha ? "opacity" : "brightness"))
            .hint("--threshold says from where on pixels are the figure");
        return std::nullopt;
    }
    say(options.messages, fmt::format("{} × {} pixels; the figure is what is {} than {}{}", pixels.width,
                                      pixels.height, mask.by_alpha ? "more opaque" : "darker", mask.threshold,
                                      verb.mask.invert ? ", inverted" : ""));
    return trace_outlines(mask, trace, diagnostics);
}

void say_result(const Options& options, const Traced& result) {
    std::size_t holes = 0;
    std::size_t curves = 0;
    for (const TracedShape& shape : result.shapes) {
        holes += shape.path.subpaths().size() - 1;
        for (const Subpath& subpath : shape.path.subpaths()) {
            for (const PathStep& step : subpath.steps) curves += step.curve ? 1 : 0;
        }
    }
    say(options.messages,
        fmt::format("{:.2f} × {:.2f} mm, {} shape{}, {} hole{}, {} curves", result.width_mm, result.height_mm,
                    result.shapes.size(), result.shapes.size() == 1 ? "" : "s", holes, holes == 1 ? "" : "s",
                    curves));
}

void add_size_options(CLI::App& verb, TraceVerbOptions& trace) {
    CLI::Option* width =
        value(verb, "--width", "LENGTH", "how wide the whole picture is to be", "Size",
              [&trace](std::string_view text) { trace.width_mm = size_option("--width", text, 0.1); });
    CLI::Option* height =
        value(verb, "--height", "LENGTH", "how high the whole picture is to be", "Size",
              [&trace](std::string_view text) { trace.height_mm = size_option("--height", text, 0.1); });
    CLI::Option* dpi =
        value(verb, "--dpi", "NUMBER", "pixels an inch, where no size is given (default 300)", "Size",
              [&trace](std::string_view text) { trace.dpi = number_option("--dpi", text, 1.0, 10000.0); });
    width->excludes(height)->excludes(dpi);
    height->excludes(dpi);
}

void add_figure_options(CLI::App& verb, TraceVerbOptions& trace) {
    value(verb, "--threshold", "NUMBER",
          "1 to 255: pixels as opaque as this are the figure, or in an opaque picture darker ones (default: "
          "128, "
          "or what separates dark from light best)",
          "Figure", [&trace](std::string_view text) {
              trace.mask.threshold = static_cast<int>(number_option("--threshold", text, 1.0, 255.0));
          });
    verb.add_flag("--invert", trace.mask.invert, "the figure is what is clear, or light")->group("Figure");
    verb.add_flag("--largest", trace.trace.largest,
                  "of several shapes the largest alone: a single silhouette")
        ->group("Figure");
    value(verb, "--min-feature", "LENGTH",
          "drop specks, and fill holes, smaller than a square of this side; tell of thinner necks (default "
          "1mm)",
          "Figure", [&trace](std::string_view text) {
              trace.trace.min_feature_mm = size_option("--min-feature", text, 0.0);
          });
    value(verb, "--simplify", "LENGTH",
          "how far smoothing may move outlines beyond the steps of pixels: 0.01mm or more (default 0.1mm)",
          "Figure", [&trace](std::string_view text) {
              trace.trace.simplify_mm = size_option("--simplify", text, 0.01);
          });
}

}  // namespace

CLI::App* add_trace(CLI::App& app, Options& options) {
    CLI::App* verb = app.add_subcommand("trace", "Make outlines of a picture: PNG or JPEG in, SVG out");
    TraceVerbOptions& trace = options.trace;
    verb->add_option("PICTURE", trace.picture, "a PNG or JPEG file; \"-\" is standard input")
        ->required()
        ->configurable(false)
        ->type_name("");
    verb->add_option("-o,--output", trace.output, "write the outlines here (default: standard output)")
        ->type_name("FILE")
        ->configurable(false)
        ->group("Output");
    add_figure_options(*verb, trace);
    add_size_options(*verb, trace);
    add_message_options(*verb, options);
    add_policy_options(*verb, options);
    add_config_options(*verb, options);
    verb->footer(
        "Examples:\n"
        "  popupc trace bird.png -o bird.svg\n"
        "  popupc trace bird.png --width 80mm --largest -o bird.svg\n"
        "  popupc trace scan.jpg --dpi 600 --threshold 100 --min-feature 2mm -o scan.svg\n"
        "\nThe drawing is as large as the whole picture. Exit status 0 when outlines were written, 1 when "
        "there\n"
        "is nothing to trace, 2 when a file cannot be read or written.");
    return verb;
}

int run_trace(const Options& options) {
    check_usage(options);
    const TraceVerbOptions& verb = options.trace;
    Diagnostics findings(verb.picture, options.policy);
    Diagnostics trouble;
    bool readable = true;
    bool written = true;
    if (const auto pixels = read_pixels(verb.picture, findings, readable)) {
        const std::optional<Traced> result = traced(options, *pixels, findings);
        if (result && !findings.has_errors()) {
            say_result(options, *result);
            const std::string output = verb.output.empty() ? "-" : verb.output;
            clear_litter({output});
            written = write_all({{output, svg_of(*result)}}, false, trouble);
        }
    }
    if (!written && reader_has_gone()) return exit_unusable;
    const bool told = report(options.messages, {{&findings, {}}}, trouble);
    if (!readable || !written || !told) return exit_unusable;
    return findings.has_errors() ? exit_findings : exit_done;
}

}  // namespace popup::cli
