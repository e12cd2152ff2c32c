#include "input/dxf/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "input/dxf/entities.h"
#include "input/dxf/groups.h"
#include "input/dxf/names.h"
#include "input/dxf/record.h"
#include "input/text.h"

namespace popup::dxf {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
// Flags of group 70.
constexpr int kFrozenLayer = 1;
constexpr int kElsewhereBlock = 4 | 8;
// Normals that lean less than this from straight up or down.
constexpr double kUpright = 1e-6;
// So many spoilt entities, and it is not worth to read on.
constexpr int kMostFaults = 100;

// Kinds that draw nothing, and need no word.
constexpr std::array<std::string_view, 5> kSilentKinds{"SEQEND", "ATTDEF", "VIEWPORT", "ENDBLK", "VERTEX"};

class DocumentReader {
 public:
    DocumentReader(std::string_view text, Diagnostics& diagnostics)
        : diagnostics_(diagnostics), groups_(text), record_(diagnostics), inner_(diagnostics) {
        out_.linetypes.push_back({"continuous", drawing::Dash::none});
        linetypes_["continuous"] = 0;
        linetypes_["bylayer"] = kLinetypeByLayer;
        linetypes_["byblock"] = kLinetypeByBlock;
        layer_named("0");
    }

    std::optional<Document> run() {
        advance();
        while (there_ && !is_end()) {
            if (!is(0, "SECTION")) return misplaced("a section begins here with 0 and SECTION");
            advance();
            if (!there_ || ahead_.code != 2)
                return misplaced("the name of a section stands here, with group code 2");
            const std::string_view name = ahead_.value;
            advance();
            section(name);
            if (faults_ > kMostFaults) return std::nullopt;
            if (!there_) return misplaced(fmt::format("the file ends in the section {}", shown(name)));
            advance();
        }
        if (!groups_.trouble().empty()) return misplaced({});
        if (!there_) {
            diagnostics_
                .warning("dxf-no-end", {last_line(), 1},
                         "the file ends without 0 and EOF, so something may be missing")
                .hint("export it anew, or copy it again");
        }
        if (diagnostics_.has_errors_as_given()) return std::nullopt;
        return std::move(out_);
    }

 private:
    void advance() { there_ = groups_.next(ahead_); }
    [[nodiscard]] bool is(int code, std::string_view value) const {
        return there_ && ahead_.code == code && ahead_.value == value;
    }
    [[nodiscard]] bool is_end() const { return is(0, "EOF"); }
    // Where nothing is left: what holds a byte order mark and nothing else has a line, too.
    [[nodiscard]] int last_line() const { return std::max(1, groups_.line() - 1); }

    std::nullopt_t misplaced(const std::string& what) {
        const bool broken = !groups_.trouble().empty();
        diagnostics_
            .error("dxf-syntax",
                   {broken   ? groups_.line()
                    : there_ ? ahead_.line
                             : last_line(),
                    1},
                   broken   ? groups_.trouble()
                   : there_ ? fmt::format("{}, and not {} and \"{}\"", what, ahead_.code, shown(ahead_.value))
                            : what)
            .hint("DXF is pairs of lines, a whole number and a value: export the file anew");
        return std::nullopt;
    }

    // Its groups up to the next 0; those of extended data are left out.
    void take(Record& record) {
        record.begin(ahead_);
        advance();
        while (there_ && ahead_.code != 0) {
            constexpr int kExtended = 1000;
            if (ahead_.code < kExtended) record.add(ahead_);
            advance();
        }
    }

    void section(std::string_view name) {
        if (name == "HEADER") return header();
        while (there_ && !is(0, "ENDSEC") && faults_ <= kMostFaults) {
            const bool begins = ahead_.code == 0;
            if (begins && name == "TABLES") {
                table_row();
            } else if (begins && name == "BLOCKS") {
                block();
            } else if (begins && name == "ENTITIES") {
                entity(out_.entities);
            } else {
                advance();
            }
        }
    }

    void header() {
        record_.begin(ahead_);
        std::string_view variable;
        while (there_ && !is(0, "ENDSEC")) {
            if (ahead_.code == 9) variable = ahead_.value;
            if (ahead_.code == 70 && variable == "$INSUNITS") {
                out_.units = record_.whole_value(ahead_);
                out_.units_line = ahead_.line;
            }
            if (ahead_.code == 70 && variable == "$MEASUREMENT")
                out_.metric = record_.whole_value(ahead_) != 0;
            if (ahead_.code == 1 && variable == "$ACADVER") names_.take_version(ahead_.value);
            if (ahead_.code == 3 && variable == "$DWGCODEPAGE") names_.take_code_page(ahead_.value);
            advance();
        }
    }

    // --- tables

    void table_row() {
        take(record_);
        if (record_.kind() == "LAYER") layer_row();
        if (record_.kind() == "LTYPE") linetype_row();
    }

    // AutoCAD never plots what is on this one.
    static constexpr std::string_view kDefpoints = "defpoints";

    int layer_named(std::string_view name) {
        const auto [row, fresh] = layers_.try_emplace(key_of(name), static_cast<int>(out_.layers.size()));
        if (fresh) {
            Layer& layer = out_.layers.emplace_back();
            layer.name = names_.decoded(name);
            layer.off = row->first == kDefpoints;
        }
        return row->second;
    }

    int linetype_named(std::string_view name) {
        const auto [row, fresh] =
            linetypes_.try_emplace(key_of(name), static_cast<int>(out_.linetypes.size()));
        if (fresh) out_.linetypes.push_back({row->first, dash_named(row->first)});
        return row->second;
    }

    void layer_row() {
        const std::string_view name = record_.text(2);
        Layer& layer = out_.layers[static_cast<std::size_t>(layer_named(name))];
        const int color = record_.whole(62, kForeground);
        layer.color = std::abs(color);
        layer.rgb = true_color(record_);
        layer.off = color < 0 || record_.whole(290, 1) == 0 || key_of(name) == kDefpoints;
        layer.frozen = (record_.whole(70) & kFrozenLayer) != 0;
        layer.linetype = std::max(0, linetype_named(record_.text(6, "continuous")));
    }

    // Where the table of line types says nothing of one: by the names that AutoCAD and ISO have.
    static drawing::Dash dash_named(std::string_view name) {
        const auto has = [name](std::string_view word) { return name.find(word) != std::string_view::npos; };
        for (const std::string_view word :
             {"dashdot", "center", "centre", "phantom", "divide", "border", "iso04", "iso05", "iso06",
              "iso08", "iso09", "iso10", "iso11", "iso12", "iso13", "iso14", "iso15"}) {
            if (has(word)) return drawing::Dash::mixed;
        }
        for (const std::string_view word : {"dash", "hidden", "dot", "iso02", "iso03", "iso07"}) {
            if (has(word)) return drawing::Dash::even;
        }
        return drawing::Dash::none;
    }

    void linetype_row() {
        const std::size_t number = static_cast<std::size_t>(std::max(0, linetype_named(record_.text(2))));
        if (number == 0) return;
        // Above zero a dash, below a gap, zero a dot.
        std::vector<double> drawn;
        bool gaps = false;
        for (const Group& group : record_.groups()) {
            if (group.code != 49) continue;
            const double length = record_.value(group);
            gaps = gaps || length < 0.0;
            if (length >= 0.0) drawn.push_back(length);
        }
        drawing::Dash& dash = out_.linetypes[number].dash;
        if (record_.whole(73, -1) == 0) dash = drawing::Dash::none;
        if (drawn.empty()) return;
        const bool even =
            std::all_of(drawn.begin(), drawn.end(), [&](double one) { return one == drawn[0]; });
        dash = !gaps ? drawing::Dash::none : even ? drawing::Dash::even : drawing::Dash::mixed;
    }

    static std::optional<Color> true_color(Record& record) {
        const int packed = record.whole(420, -1);
        if (packed < 0) return std::nullopt;
        const auto part = [packed](int shift) { return static_cast<std::uint8_t>((packed >> shift) & 0xff); };
        return Color{part(16), part(8), part(0)};
    }

    // --- blocks and entities

    void block() {
        take(record_);
        if (record_.kind() != "BLOCK") return;
        Block made;
        made.name = key_of(record_.text(2));
        made.title = names_.decoded(record_.text(2));
        made.base = record_.point(10);
        made.elsewhere = (record_.whole(70) & kElsewhereBlock) != 0;
        while (there_ && !is(0, "ENDBLK") && !is(0, "ENDSEC") && !is_end() && faults_ <= kMostFaults) {
            entity(made.entities);
        }
        out_.blocks.push_back(std::move(made));
    }

    void entity(std::vector<Entity>& into) {
        take(record_);
        const std::string_view kind = record_.kind();
        if (std::find(kSilentKinds.begin(), kSilentKinds.end(), kind) != kSilentKinds.end()) return;
        Entity made;
        made.line = record_.line();
        made.layer = layer_named(record_.text(8, "0"));
        made.linetype = linetype_named(record_.text(6, "bylayer"));
        made.color = record_.whole(62, kByLayer);
        made.rgb = true_color(record_);
        constexpr int kPaperSpace = 67;
        made.hidden = record_.whole(60) != 0 || record_.whole(kPaperSpace) != 0 || made.color < 0;
        const bool upright = stand(made);
        std::string trouble;
        if (kind == "POLYLINE") {
            if (!polyline(made)) made.skipped = kind_number("mesh");
            if (!upright) made.skipped = kind_number("tilted POLYLINE");
        } else if (!upright) {
            made.skipped = kind_number("tilted " + names_.decoded(kind));
        } else if (kind == "INSERT") {
            insert(made);
        } else if (is_line(kind)) {
            trouble = make_line(record_, made.path);
        } else {
            made.skipped = kind_number(kind.empty() ? "unnamed" : names_.decoded(kind));
        }
        if (!trouble.empty()) diagnostics_.error("dxf-curve", {made.line, 1}, trouble);
        if (!trouble.empty() || !record_.sound()) {
            ++faults_;
            return;
        }
        into.push_back(std::move(made));
    }

    // Which side it is seen from: its normal is (0, 0, 1), or (0, 0, -1) where it was mirrored. Lines and
    // splines are in the drawing's own coordinates, whatever it is. False where it leans.
    bool stand(Entity& made) {
        const std::string_view kind = record_.kind();
        if (kind == "LINE" || kind == "SPLINE") return true;
        const double x = record_.number(210);
        const double y = record_.number(220);
        const double z = record_.number(230, 1.0);
        if (std::hypot(x, y) > kUpright * std::abs(z)) return false;
        made.mirrored = z < 0.0 && kind != "ELLIPSE";
        return true;
    }

    int kind_number(std::string_view kind) {
        const auto [row, fresh] = kinds_.try_emplace(std::string(kind), static_cast<int>(out_.kinds.size()));
        if (fresh) out_.kinds.emplace_back(kind);
        return row->second;
    }

    // With its corners, which follow it. False where it is none that could be cut.
    bool polyline(Entity& made) {
        OldPolyline line;
        const bool usable = line.begin(record_);
        while (is(0, "VERTEX")) {
            take(inner_);
            if (usable) line.corner(inner_);
            if (!inner_.sound()) ++faults_;
        }
        if (is(0, "SEQEND")) take(inner_);
        if (usable) line.end(made.path);
        return usable;
    }

    void insert(Entity& made) {
        Insert one;
        one.block = key_of(record_.text(2));
        one.title = names_.decoded(record_.text(2));
        one.at = record_.point(10);
        one.scale = {record_.number(41, 1.0), record_.number(42, 1.0)};
        one.turn = kDegree * std::remainder(record_.number(50), 360.0);
        one.columns = std::max(1, record_.whole(70, 1));
        one.rows = std::max(1, record_.whole(71, 1));
        one.spacing = {record_.number(44), record_.number(45)};
        made.insert = static_cast<int>(out_.inserts.size());
        out_.inserts.push_back(std::move(one));
    }

    Diagnostics& diagnostics_;
    Groups groups_;
    Group ahead_;
    bool there_ = false;  // ahead_ is the group that comes next
    Record record_, inner_;
    Names names_;
    std::map<std::string, int, std::less<>> layers_, linetypes_, kinds_;
    int faults_ = 0;
    Document out_;
};

bool check_bytes(std::string_view text, Diagnostics& diagnostics) {
    const auto refuse = [&](std::string_view what) {
        diagnostics.error("dxf-binary", {}, fmt::format("this is {}, and not an ASCII DXF file", what))
            .hint(
                "save it as DXF from the program that made it, of any version from R12 to 2018, as text and "
                "not "
                "as binary")
            .hint("dwg2dxf of LibreDWG and the ODA File Converter make DXF of DWG");
        return false;
    };
    if (is_binary(text)) return refuse(text.starts_with("AC") ? "a DWG file" : "a binary DXF file");
    if (is_wide_text(text)) return refuse("UTF-16");
    if (trimmed(text).empty()) {
        diagnostics.error("empty-input", {},
                          text.empty() ? "the file is empty" : "the file holds only blanks");
        return false;
    }
    return true;
}

}  // namespace

std::string key_of(std::string_view name) { return lower(name); }

bool is_binary(std::string_view text) {
    return text.starts_with("AutoCAD Binary DXF") ||
           (text.starts_with("AC10") && text.substr(0, 16).find('\0') != std::string_view::npos);
}

std::optional<Document> read_document(std::string_view text, Diagnostics& diagnostics) {
    if (!check_bytes(text, diagnostics)) return std::nullopt;
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    return DocumentReader(text, diagnostics).run();
}

}  // namespace popup::dxf
