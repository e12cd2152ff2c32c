#include "output/production_pdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/diagnostics/render_diagnostics.h"
#include "base/text/numbers.h"
#include "output/pdf_pages.h"
#include "output/qpdf.h"
#include "output/sheet_drawing.h"
#include "output/sheet_sides.h"
#include "popup/image.h"

namespace popup {
namespace {

constexpr int kDecimals = 4;  // of points, and of tints

// The processing step that an operation is, as ISO 19593-1 names it within its group Structural; empty: art.
std::string_view step_of(Operation operation) {
    switch (operation) {
        case Operation::fill:
        case Operation::draw:
        case Operation::label:
        case Operation::legend:
        case Operation::registration:
            return {};
        case Operation::glue:
        case Operation::mark:
            return "/Gluing";
        case Operation::valley:
        case Operation::seam:
            return "/Creasing";
        case Operation::mountain:
            return "/ReverseCreasing";
        case Operation::perforation:
            return "/Perforating";
        case Operation::slit:
        case Operation::inner_cut:
        case Operation::outer_cut:
            return "/Cutting";
    }
    broken_invariant("an operation is one of its enumerators", __FILE__, __LINE__);
}

// Tints of cyan, magenta, yellow and black, 0 to 1.
std::array<double, 4> cmyk(Color color) {
    const double most = std::max({color.r, color.g, color.b});
    if (most == 0.0) return {0.0, 0.0, 0.0, 1.0};
    return {(most - color.r) / most, (most - color.g) / most, (most - color.b) / most, 1.0 - most / 255.0};
}

// The layers and spot colours of a document: which there are, and which of them the operations use. What
// stands in `layers` and `spots` keeps its number in all pages, drawn there or not.
struct Plan {
    struct Layer {
        std::string name;
        std::string_view step;  // empty: art
        bool used = false;
    };
    struct Spot {
        std::string name;
        Color color;
        bool used = false;
    };
    static constexpr int kProcess = -1;
    struct Place {
        int layer = 0;
        int spot = kProcess;
        friend bool operator==(const Place&, const Place&) = default;
    };
    std::vector<Layer> layers;  // in the order of operations
    std::vector<Spot> spots;
    std::array<Place, kOperations.size()> places;

    [[nodiscard]] Place place(Operation operation) const {
        return places.at(static_cast<std::size_t>(operation));
    }
};

// The number of the first thing that `is` so; `more` is added when there is none.
template <typename Things, typename Is>
int find_or_add(Things& things, const Is& is, typename Things::value_type more) {
    const auto at = std::find_if(things.begin(), things.end(), is);
    const auto number = static_cast<int>(at - things.begin());
    if (at == things.end()) things.push_back(std::move(more));
    return number;
}

Plan plan_of(const Profile& profile) {
    Plan plan;
    for (const Operation operation : kOperations) {
        if (!profile.draws(operation)) continue;
        const Pen& pen = profile.pen(operation);
        Plan::Place& place = plan.places.at(static_cast<std::size_t>(operation));
        const std::string name = visible(pen.layer);
        const std::string_view step = step_of(operation);
        place.layer = find_or_add(
            plan.layers, [&](const Plan::Layer& one) { return one.name == name && one.step == step; },
            {name, step});
        if (pen.spot.empty()) continue;
        const std::string spot = visible(pen.spot);
        place.spot = find_or_add(plan.spots, [&](const Plan::Spot& one) { return one.name == spot; },
                                 {spot, pen.color});
    }
    return plan;
}

// Names of resources, the same in content streams and in dictionaries.
std::string layer_key(std::size_t number) { return fmt::format("/Layer{}", number); }
std::string spot_key(std::size_t number) { return fmt::format("/Spot{}", number); }
constexpr const char* kOverprintKey = "/Overprint";

// The pictures of a document, each once for every ink it is printed in.
struct PictureUse {
    const Image* image = nullptr;
    int spot = Plan::kProcess;
    friend bool operator<(const PictureUse& a, const PictureUse& b) {
        return std::tie(a.image->bytes, a.spot) < std::tie(b.image->bytes, b.spot);
    }
};
std::string picture_key(std::size_t number) { return fmt::format("/Picture{}", number); }

// One page's content stream; marks what it uses.
class Content {
 public:
    Content(const SheetDrawing& drawing, Plan& plan, std::map<PictureUse, std::size_t>& pictures)
        : drawing_(drawing), plan_(plan), pictures_(pictures) {}

    std::string draw() {
        const std::vector<SheetShape>& all = drawing_.shapes;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (i == 0 || place(i) != place(i - 1)) begin(place(i));
            shape(all[i]);
            if (i + 1 == all.size() || place(i) != place(i + 1)) end();
        }
        return fmt::to_string(out_);
    }

 private:
    void raw(std::string_view text) { out_.append(text.data(), text.data() + text.size()); }
    void number(double value) {
        append_number(out_, value, kDecimals);
        out_.push_back(' ');
    }
    void point(Vec2 p) {
        number(p.x * kPointsPerMm);
        number(p.y * kPointsPerMm);
    }
    [[nodiscard]] Plan::Place place(std::size_t i) const { return plan_.place(drawing_.shapes[i].operation); }

    // Everything between begin() and end() is in one layer and in one spot colour, or in process colours. It
    // leaves no trace in the graphics state.
    void begin(Plan::Place place) {
        const auto layer = static_cast<std::size_t>(place.layer);
        plan_.layers.at(layer).used = true;
        fmt::format_to(fmt::appender(out_), "/OC {} BDC\nq\n", layer_key(layer));
        stroke_look_.clear();
        fill_look_.clear();
        spot_ = place.spot;
        if (spot_ == Plan::kProcess) return;
        const auto spot = static_cast<std::size_t>(spot_);
        plan_.spots.at(spot).used = true;
        fmt::format_to(fmt::appender(out_), "{0} gs\n{1} CS 1 SCN\n{1} cs 1 scn\n", kOverprintKey,
                       spot_key(spot));
    }
    void end() { raw("Q\nEMC\n"); }

    [[nodiscard]] std::string color(Color color, char op) const {
        if (spot_ != Plan::kProcess) return {};  // chosen already
        fmt::memory_buffer text;
        for (const double tint : cmyk(color)) {
            append_number(text, tint, kDecimals);
            text.push_back(' ');
        }
        text.push_back(op);
        text.push_back('\n');
        return fmt::to_string(text);
    }

    [[nodiscard]] std::string stroke_look(const SheetShape& shape) const {
        const bool whole = !drawing_.profile.dashes(shape.operation);
        std::string text = color(shape.color, 'K');
        text += number_text(shape.width_mm * kPointsPerMm, kDecimals);
        text += whole ? " w\n1 J 1 j\n" : " w\n0 J 0 j\n[";
        if (whole) return text;
        const Dashes dashes = fitted_dashes(shape.operation, drawing_.length_of(shape));
        for (const double mm : dashes.pattern()) {
            if (text.back() != '[') text += ' ';
            text += number_text(mm * kPointsPerMm, kDecimals);
        }
        text += "] 0 d\n";
        return text;
    }

    // Says how what follows looks, where that is not said already.
    void look(std::string text, std::string& last) {
        if (text == last) return;
        raw(text);
        last = std::move(text);
    }

    void curves(const Subpath& path) {
        point(path.start);
        raw("m\n");
        for (const PathStep& step : path.steps) {
            if (step.curve) {
                point(step.control_1);
                point(step.control_2);
            }
            point(step.to);
            raw(step.curve ? "c\n" : "l\n");
        }
        if (path.closed) raw("h\n");
    }

    void outline(const SheetShape& shape) {
        for (const Run& run : drawing_.runs_of(shape)) {
            if (run.steps > 0) {
                curves(drawing_.path_of(run));
                continue;
            }
            const char* command = "m\n";
            for (const Vec2 p : drawing_.points_of(run)) {
                point(p);
                raw(command);
                command = "l\n";
            }
            if (run.closed && run.count > 0) raw("h\n");
        }
    }

    // A picture is a unit square whose upper edge is the first row.
    void image(const SheetShape& shape) {
        const SheetImage& shown = drawing_.images[static_cast<std::size_t>(shape.image)];
        const std::size_t number =
            pictures_.try_emplace({shown.image, spot_}, pictures_.size()).first->second;
        raw("q\n");
        outline(shape);
        raw("W* n\n");
        const Vec2 along = shown.image->width * shown.place.x;
        const Vec2 down = shown.image->height * shown.place.y;
        point(along);
        point(-down);
        point(shown.place.origin + down);
        fmt::format_to(fmt::appender(out_), "cm\n{} Do\nQ\n", picture_key(number));
    }

    void shape(const SheetShape& shape) {
        if (shape.image >= 0) return image(shape);
        if (shape.filled) {
            look(color(shape.color, 'k'), fill_look_);
        } else {
            look(stroke_look(shape), stroke_look_);
        }
        outline(shape);
        if (!shape.filled) {
            raw("S\n");
        } else {
            // Letters are filled by the other rule than areas with holes.
            raw(shape.operation == Operation::fill ? "f*\n" : "f\n");
        }
    }

    const SheetDrawing& drawing_;
    Plan& plan_;
    std::map<PictureUse, std::size_t>& pictures_;  // their numbers
    fmt::memory_buffer out_;
    std::string stroke_look_, fill_look_;
    int spot_ = Plan::kProcess;
};

using Object = QPDFObjectHandle;

Object real(double value) { return Object::newReal(number_text(value, kDecimals)); }
Object dictionary(std::initializer_list<std::pair<const std::string, Object>> items) {
    return Object::newDictionary(std::map<std::string, Object>(items));
}

// A name as a name object. qpdf 11.3 writes a # as it is, where it would begin an escape; others escape it.
Object name_object(std::string_view name) {
    static const bool bare = Object::newName("/#").unparse() == "/#";
    std::string text = "/";
    for (const char c : name) text += bare && c == '#' ? std::string("#23") : std::string(1, c);
    return Object::newName(text);
}

// A document that grows page by page. What pages share, layers and spot colours, are objects of it.
class Document {
 public:
    explicit Document(const Profile& profile) : plan_(plan_of(profile)) {
        pdf_.emptyPDF();
        pdf_.setSuppressWarnings(true);
        for (const Plan::Layer& layer : plan_.layers)
            layers_.push_back(pdf_.makeIndirectObject(group(layer)));
        for (const Plan::Spot& spot : plan_.spots)
            spots_.push_back(pdf_.makeIndirectObject(separation(spot)));
        overprint_ = pdf_.makeIndirectObject(dictionary({{"/Type", Object::newName("/ExtGState")},
                                                         {"/OP", Object::newBool(true)},
                                                         {"/op", Object::newBool(true)},
                                                         {"/OPM", Object::newInteger(1)}}));
    }

    void add_page(const SheetDrawing& drawing) {
        Plan page = plan_;
        std::map<PictureUse, std::size_t> shown;
        const std::string content = Content(drawing, page, shown).draw();
        // Resources are what the page uses: a colour that is only named would make an empty plate.
        Object properties = Object::newDictionary();
        for (std::size_t i = 0; i < layers_.size(); ++i) {
            if (!page.layers[i].used) continue;
            properties.replaceKey(layer_key(i), layers_[i]);
            used_.layers[i].used = true;
        }
        Object colors = Object::newDictionary();
        for (std::size_t i = 0; i < spots_.size(); ++i) {
            if (page.spots[i].used) colors.replaceKey(spot_key(i), spots_[i]);
        }
        Object resources = dictionary({{"/Properties", properties}});
        if (!colors.getKeys().empty()) {
            resources.replaceKey("/ColorSpace", colors);
            resources.replaceKey("/ExtGState", dictionary({{kOverprintKey, overprint_}}));
        }
        Object pictures = Object::newDictionary();
        std::vector<const PictureUse*> in_order(shown.size());  // of their use: not of their addresses
        for (const auto& [use, number] : shown) in_order[number] = &use;
        for (std::size_t i = 0; i < in_order.size(); ++i) {
            pictures.replaceKey(picture_key(i), picture(*in_order[i]));
        }
        if (!shown.empty()) resources.replaceKey("/XObject", pictures);
        const Object box =
            Object::newArray({Object::newInteger(0), Object::newInteger(0),
                              real(drawing.width_mm * kPointsPerMm), real(drawing.height_mm * kPointsPerMm)});
        const Object leaf = dictionary({{"/Type", Object::newName("/Page")},
                                        {"/MediaBox", box},
                                        {"/TrimBox", box},
                                        {"/Resources", resources},
                                        {"/Contents", Object::newStream(&pdf_, content)}});
        QPDFPageDocumentHelper(pdf_).addPage(QPDFPageObjectHelper(pdf_.makeIndirectObject(leaf)), false);
    }

    std::string bytes(const std::string& title) {
        set_layers();
        set_information(title);
        QPDFWriter writer(pdf_);
        writer.setOutputMemory();
        writer.setMinimumPDFVersion("1.6");
        writer.setDeterministicID(true);
        // Print shops have old programs, too.
        writer.setObjectStreamMode(qpdf_o_disable);
        writer.setCompressStreams(true);
        writer.write();
        const std::shared_ptr<Buffer> buffer = writer.getBufferSharedPointer();
        return {reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()};
    }

 private:
    // In process colours, or in tints of the spot colour that fills are printed in; the same object on all
    // pages.
    Object picture(const PictureUse& use) {
        const auto [known, fresh] = pictures_.try_emplace({use.image->bytes.get(), use.spot});
        if (!fresh) return known->second;
        const std::optional<ImagePixels> pixels = pixels_of(*use.image);
        if (!pixels) throw std::runtime_error("a picture is broken");
        const bool process = use.spot == Plan::kProcess;
        const std::size_t count = pixels->rgba.size() / 4;
        std::string tints;
        std::string alpha;
        tints.reserve(count * (process ? 4 : 1));
        const auto add = [&tints](double tint) {
            tints += static_cast<char>(static_cast<unsigned char>(std::lround(255.0 * tint)));
        };
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint8_t* p = &pixels->rgba[4 * i];
            if (process) {
                for (const double tint : cmyk({p[0], p[1], p[2]})) add(tint);
            } else {
                add(1.0 - (0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2]) / 255.0);
            }
            if (!pixels->opaque) alpha += static_cast<char>(p[3]);
        }
        Object object = bitmap(
            *pixels, process ? Object::newName("/DeviceCMYK") : spots_.at(static_cast<std::size_t>(use.spot)),
            tints);
        if (!pixels->opaque) {
            object.getDict().replaceKey("/SMask", bitmap(*pixels, Object::newName("/DeviceGray"), alpha));
        }
        known->second = object;
        return object;
    }

    Object bitmap(const ImagePixels& pixels, const Object& colors, const std::string& bytes) {
        Object stream = Object::newStream(&pdf_, bytes);
        stream.replaceDict(dictionary({{"/Type", Object::newName("/XObject")},
                                       {"/Subtype", Object::newName("/Image")},
                                       {"/Width", Object::newInteger(pixels.width)},
                                       {"/Height", Object::newInteger(pixels.height)},
                                       {"/ColorSpace", colors},
                                       {"/BitsPerComponent", Object::newInteger(8)}}));
        return stream;
    }

    static Object group(const Plan::Layer& layer) {
        Object object =
            dictionary({{"/Type", Object::newName("/OCG")}, {"/Name", Object::newUnicodeString(layer.name)}});
        if (layer.step.empty()) return object;
        object.replaceKey("/GTS_Metadata",
                          dictionary({{"/GTS_ProcStepsGroup", Object::newName("/Structural")},
                                      {"/GTS_ProcStepsType", Object::newName(std::string(layer.step))}}));
        return object;
    }

    static Object separation(const Plan::Spot& spot) {
        Object none = Object::newArray();
        Object full = Object::newArray();
        Object range = Object::newArray();
        for (const double tint : cmyk(spot.color)) {
            none.appendItem(Object::newInteger(0));
            full.appendItem(real(tint));
            range.appendItem(Object::newInteger(0));
            range.appendItem(Object::newInteger(1));
        }
        const Object domain = Object::newArray({Object::newInteger(0), Object::newInteger(1)});
        const Object tint = dictionary({{"/FunctionType", Object::newInteger(2)},
                                        {"/Domain", domain},
                                        {"/Range", range},
                                        {"/C0", none},
                                        {"/C1", full},
                                        {"/N", Object::newInteger(1)}});
        return Object::newArray(
            {Object::newName("/Separation"), name_object(spot.name), Object::newName("/DeviceCMYK"), tint});
    }

    void set_layers() {
        Object groups = Object::newArray();
        for (std::size_t i = 0; i < layers_.size(); ++i) {
            if (used_.layers[i].used) groups.appendItem(layers_[i]);
        }
        if (groups.getArrayNItems() == 0) return;
        const Object configuration = dictionary({{"/Name", Object::newUnicodeString("Layers")},
                                                 {"/BaseState", Object::newName("/ON")},
                                                 {"/Order", groups.shallowCopy()},
                                                 {"/ON", groups.shallowCopy()}});
        pdf_.getRoot().replaceKey("/OCProperties", dictionary({{"/OCGs", groups}, {"/D", configuration}}));
    }

    void set_information(const std::string& title) {
        Object information = dictionary({{"/Title", Object::newUnicodeString(title)},
                                         {"/Creator", Object::newUnicodeString(std::string(generator()))}});
        if (const std::optional<std::tm> utc = source_date()) {
            information.replaceKey(
                "/CreationDate", Object::newString(fmt::format(
                                     "D:{:04}{:02}{:02}{:02}{:02}{:02}Z", utc->tm_year + 1900,
                                     utc->tm_mon + 1, utc->tm_mday, utc->tm_hour, utc->tm_min, utc->tm_sec)));
        }
        pdf_.getTrailer().replaceKey("/Info", pdf_.makeIndirectObject(information));
    }

    const Plan plan_;
    Plan used_ = plan_;  // on any page
    QPDF pdf_;
    std::vector<Object> layers_, spots_;
    Object overprint_;
    std::map<std::pair<const std::string*, int>, Object> pictures_;
};

}  // namespace

bool has_spot_colors(const Profile& profile) {
    return std::any_of(kOperations.begin(), kOperations.end(), [&profile](Operation operation) {
        return profile.draws(operation) && !profile.pen(operation).spot.empty();
    });
}

std::optional<std::vector<SheetFile>> write_production_pdf(const Layout& layout, const OutputOptions& options,
                                                           Diagnostics& diagnostics) {
    if (!fits_pages(layout, diagnostics)) return std::nullopt;
    OutputOptions outlined = options;
    outlined.profile.outlined_text = true;
    const std::optional<std::vector<SheetView>> views = views_of(layout, outlined, diagnostics);
    if (!views) return std::nullopt;
    std::vector<SheetFile> files;
    for (const std::span<const SheetView> part : parts_of(*views)) {
        try {
            Document document(profile_of(outlined, part.front()));
            for (const SheetView& view : part) document.add_page(draw_sheet(layout, outlined, view));
            files.push_back({part.front().part_suffix, document.bytes(layout_title(layout))});
        } catch (const std::runtime_error& error) {
            diagnostics.error("pdf-failed", {},
                              fmt::format("the PDF could not be made: {}", visible(error.what())));
            return std::nullopt;
        }
    }
    return files;
}

}  // namespace popup
