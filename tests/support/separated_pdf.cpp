#include "support/separated_pdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "output/qpdf.h"
#include "support/run_program.h"

namespace popup::test {
namespace {

constexpr double kPoint = 25.4 / 72.0;  // mm

std::array<double, 4> box_of(QPDFObjectHandle array) {
    std::array<double, 4> box{};
    EXPECT_EQ(array.getArrayNItems(), 4);
    for (int i = 0; i < 4; ++i) box.at(static_cast<std::size_t>(i)) = array.getArrayItem(i).getNumericValue();
    return box;
}

std::string step_of(QPDFObjectHandle group) {
    QPDFObjectHandle metadata = group.getKey("/GTS_Metadata");
    if (!metadata.isDictionary()) return {};
    EXPECT_EQ(metadata.getKey("/GTS_ProcStepsGroup").getName(), "/Structural");
    return metadata.getKey("/GTS_ProcStepsType").getName();
}

// Knows the operators that such a document may have, and no other: RGB, grey, text and images are failures.
class Interpreter : public QPDFObjectHandle::ParserCallbacks {
 public:
    Interpreter(const QPDFObjectHandle& resources, std::vector<Painted>& painted)
        : resources_(resources), painted_(painted) {}

    void handleObject(QPDFObjectHandle object) override {
        if (!object.isOperator()) {
            operands_.push_back(object);
            return;
        }
        step(object.getOperatorValue());
        operands_.clear();
    }
    void handleEOF() override {
        EXPECT_TRUE(saved_.empty());
        EXPECT_EQ(depth_, 0);
    }

 private:
    struct State {
        std::string fill_spot, stroke_spot;
        Cmyk fill{0, 0, 0, 1000}, stroke{0, 0, 0, 1000};
        bool fill_full = false, stroke_full = false;  // the spot colour's tint is 1
        bool overprint = false;
        double width = 1.0;
        std::size_t dashes = 0;
    };

    [[nodiscard]] double number(std::size_t i) { return operands_.at(i).getNumericValue(); }
    [[nodiscard]] Cmyk tints() {
        Cmyk all{};
        for (std::size_t i = 0; i < 4; ++i) all.at(i) = static_cast<int>(std::lround(number(i) * 1000));
        return all;
    }
    QPDFObjectHandle resource(const std::string& kind, std::size_t operand) {
        QPDFObjectHandle found = resources_.getKey(kind).getKey(operands_.at(operand).getName());
        EXPECT_FALSE(found.isNull()) << kind << operands_.at(operand).getName();
        return found;
    }
    std::string separation() {
        QPDFObjectHandle space = resource("/ColorSpace", 0);
        EXPECT_EQ(space.getArrayItem(0).getName(), "/Separation");
        EXPECT_EQ(space.getArrayItem(2).getName(), "/DeviceCMYK");
        return space.getArrayItem(1).getName().substr(1);
    }
    void line_to(Vec2 p) {
        mm_ += distance(at_, p);
        at_ = p;
        box_.extend(p);
    }
    void paint(bool stroke) {
        EXPECT_EQ(depth_, 1) << "everything is in a layer";
        const std::string& spot = stroke ? state_.stroke_spot : state_.fill_spot;
        if (!spot.empty()) {
            EXPECT_TRUE(stroke ? state_.stroke_full : state_.fill_full);
        }
        painted_.push_back({stroke, spot, stroke ? state_.stroke : state_.fill, state_.overprint,
                            state_.width * kPoint, mm_, layer_, step_, state_.dashes, box_});
        mm_ = 0.0;
        box_ = {};
    }

    void step(const std::string& op) {
        if (op == "m") {
            at_ = start_ = kPoint * Vec2{number(0), number(1)};
            box_.extend(at_);
        } else if (op == "l") {
            line_to(kPoint * Vec2{number(0), number(1)});
        } else if (op == "h") {
            line_to(start_);
        } else if (op == "S" || op == "f" || op == "f*") {
            paint(op == "S");
            painted_.back().even_odd = op == "f*";
        } else if (op == "K") {
            state_.stroke = tints();
            state_.stroke_spot.clear();
        } else if (op == "k") {
            state_.fill = tints();
            state_.fill_spot.clear();
        } else if (op == "CS") {
            state_.stroke_spot = separation();
        } else if (op == "cs") {
            state_.fill_spot = separation();
        } else if (op == "SCN") {
            state_.stroke_full = number(0) == 1.0;
        } else if (op == "scn") {
            state_.fill_full = number(0) == 1.0;
        } else if (op == "gs") {
            QPDFObjectHandle given = resource("/ExtGState", 0);
            state_.overprint = given.getKey("/OP").getBoolValue() && given.getKey("/op").getBoolValue() &&
                               given.getKey("/OPM").getIntValue() == 1;
        } else if (op == "w") {
            state_.width = number(0);
        } else if (op == "d") {
            state_.dashes = static_cast<std::size_t>(operands_.at(0).getArrayNItems());
        } else if (op == "q") {
            saved_.push_back(state_);
        } else if (op == "Q") {
            ASSERT_FALSE(saved_.empty());
            state_ = saved_.back();
            saved_.pop_back();
        } else if (op == "BDC") {
            ++depth_;
            EXPECT_EQ(operands_.at(0).getName(), "/OC");
            QPDFObjectHandle group = resource("/Properties", 1);
            EXPECT_EQ(group.getKey("/Type").getName(), "/OCG");
            layer_ = group.getKey("/Name").getUTF8Value();
            step_ = step_of(group);
        } else if (op == "EMC") {
            --depth_;
        } else {
            EXPECT_TRUE(op == "J" || op == "j") << op;
        }
    }

    QPDFObjectHandle resources_;
    std::vector<Painted>& painted_;
    std::vector<QPDFObjectHandle> operands_;
    std::vector<State> saved_;
    State state_;
    int depth_ = 0;
    std::string layer_, step_;
    double mm_ = 0.0;
    Vec2 at_, start_;
    Box box_;
};

struct Tiff {
    std::string bytes;
    [[nodiscard]] std::uint32_t at(std::size_t i, std::size_t count) const {
        std::uint32_t value = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t byte = bytes.at(0) == 'I' ? i + count - 1 - k : i + k;
            value = value << 8U | static_cast<unsigned char>(bytes.at(byte));
        }
        return value;
    }
    [[nodiscard]] std::vector<std::uint32_t> values(std::uint32_t tag) const {
        const std::size_t table = at(4, 4);
        for (std::size_t i = 0; i < at(table, 2); ++i) {
            const std::size_t entry = table + 2 + 12 * i;
            if (at(entry, 2) != tag) continue;
            const std::size_t size = at(entry + 2, 2) == 3 ? 2 : 4;
            const std::size_t count = at(entry + 4, 4);
            const std::size_t first = size * count > 4 ? at(entry + 8, 4) : entry + 8;
            std::vector<std::uint32_t> all;
            for (std::size_t k = 0; k < count; ++k) all.push_back(at(first + k * size, size));
            return all;
        }
        return {};
    }
    // Of an uncompressed image.
    [[nodiscard]] std::string pixels() const {
        EXPECT_EQ(values(259), std::vector<std::uint32_t>{1});
        std::string all;
        const auto starts = values(273);
        const auto sizes = values(279);
        for (std::size_t i = 0; i < starts.size(); ++i) all += bytes.substr(starts[i], sizes[i]);
        return all;
    }
};

}  // namespace

std::vector<Painted> ReadDocument::painted() const {
    std::vector<Painted> all;
    for (const ReadPage& page : pages) all.insert(all.end(), page.painted.begin(), page.painted.end());
    return all;
}

ReadDocument read_separations(const std::string& bytes) {
    QPDF pdf;
    pdf.processMemoryFile("written", bytes.data(), bytes.size());
    ReadDocument document;
    for (QPDFObjectHandle page : pdf.getAllPages()) {
        ReadPage& one = document.pages.emplace_back();
        one.media = box_of(page.getKey("/MediaBox"));
        one.trim = box_of(page.getKey("/TrimBox"));
        QPDFObjectHandle resources = page.getKey("/Resources");
        Interpreter interpreter(resources, one.painted);
        page.parsePageContents(&interpreter);
        EXPECT_FALSE(resources.hasKey("/Font"));
        QPDFObjectHandle colors = resources.getKey("/ColorSpace");
        if (!colors.isDictionary()) continue;
        for (const std::string& key : colors.getKeys()) {
            QPDFObjectHandle space = colors.getKey(key);
            const std::string name = space.getArrayItem(1).getName().substr(1);
            one.spots.insert(name);
            QPDFObjectHandle function = space.getArrayItem(3);
            EXPECT_EQ(function.getKey("/FunctionType").getIntValue(), 2);
            EXPECT_EQ(box_of(function.getKey("/C0")), (std::array<double, 4>{}));
            document.alternates[name] = box_of(function.getKey("/C1"));
        }
    }
    QPDFObjectHandle content = pdf.getRoot().getKey("/OCProperties");
    if (content.isDictionary()) {
        QPDFObjectHandle view = content.getKey("/D");
        EXPECT_EQ(view.getKey("/ON").unparse(), content.getKey("/OCGs").unparse());
        EXPECT_EQ(view.getKey("/Order").unparse(), content.getKey("/OCGs").unparse());
        for (QPDFObjectHandle group : view.getKey("/Order").getArrayAsVector())
            document.layers.emplace_back(group.getKey("/Name").getUTF8Value(), step_of(group));
    }
    document.title = pdf.getTrailer().getKey("/Info").getKey("/Title").getUTF8Value();
    EXPECT_TRUE(pdf.getWarnings().empty());
    return document;
}

std::map<std::string, std::string> inked_plates(const std::string& pdf) {
    const ScratchDirectory scratch;
    write_file(scratch / "a.pdf", pdf);
    const auto made =
        run({"gs", "-q", "-dBATCH", "-dNOPAUSE", "-dSAFER", "-sDEVICE=tiffsep", "-r36", "-sCompression=none",
             "-o", (scratch / "%d.tif").string(), (scratch / "a.pdf").string()});
    EXPECT_EQ(made.exit, 0) << made.out << made.err;
    EXPECT_EQ(made.err, "");
    std::map<std::string, std::string> inked;
    for (const std::string& name : scratch.names()) {
        if (!name.ends_with(").tif")) continue;
        const std::string pixels = Tiff{read_file(scratch / name)}.pixels();
        EXPECT_GT(pixels.size(), 1000U) << name;
        if (pixels.find_first_not_of(pixels.front()) == std::string::npos) continue;
        inked[name.substr(0, name.size() - 4)] = pixels;
    }
    return inked;
}

}  // namespace popup::test
