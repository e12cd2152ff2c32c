#include "output/lightburn.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "base/diagnostics/render_diagnostics.h"
#include "base/text/numbers.h"
#include "output/pictures_left_out.h"
#include "output/sheet_drawing.h"

namespace popup {
namespace {

constexpr int kDecimals = 6;
constexpr int kToolIndex = 30;

// The colours of LightBurn's layers 00 to 29, as its manual lists them.
constexpr std::array kPalette{
    Color{0x00, 0x00, 0x00}, Color{0x00, 0x00, 0xff}, Color{0xff, 0x00, 0x00}, Color{0x00, 0xe0, 0x00},
    Color{0xd0, 0xd0, 0x00}, Color{0xff, 0x80, 0x00}, Color{0x00, 0xe0, 0xe0}, Color{0xff, 0x00, 0xff},
    Color{0xb4, 0xb4, 0xb4}, Color{0x00, 0x00, 0xa0}, Color{0xa0, 0x00, 0x00}, Color{0x00, 0xa0, 0x00},
    Color{0xa0, 0xa0, 0x00}, Color{0xc0, 0x80, 0x00}, Color{0x00, 0xa0, 0xff}, Color{0xa0, 0x00, 0xa0},
    Color{0x80, 0x80, 0x80}, Color{0x7d, 0x87, 0xb9}, Color{0xbb, 0x77, 0x84}, Color{0x4a, 0x6f, 0xe3},
    Color{0xd3, 0x3f, 0x6a}, Color{0x8c, 0xd7, 0x8c}, Color{0xf0, 0xb9, 0x8d}, Color{0xf6, 0xc4, 0xe1},
    Color{0xfa, 0x9e, 0xd4}, Color{0x50, 0x0a, 0x78}, Color{0xb4, 0x5a, 0x00}, Color{0x00, 0x47, 0x54},
    Color{0x86, 0xfa, 0x88}, Color{0xff, 0xdb, 0x66}};

int apart(Color a, Color b) {
    const int red = a.r - b.r;
    const int green = a.g - b.g;
    const int blue = a.b - b.b;
    return red * red + green * green + blue * blue;
}

// What LightBurn calls a layer.
struct Setting {
    std::string name;
    const Pen* pen = nullptr;
    int index = -1;  // into kPalette
};

struct Settings {
    std::vector<Setting> all;                  // in the order in which they are done
    std::array<int, kOperations.size()> of{};  // index into `all` of each operation, -1: it has none
};

bool same_setting(const Pen& a, const Pen& b) {
    return a.layer == b.layer && a.color == b.color && a.speed_mm_s == b.speed_mm_s &&
           a.power_percent == b.power_percent;
}

// Colours that are LightBurn's own are given out first, so that no other colour takes their number.
void give_indices(std::vector<Setting>& settings) {
    std::array<bool, kPalette.size()> taken{};
    const auto give = [&taken](Setting& setting, std::size_t index) {
        setting.index = static_cast<int>(index);
        taken.at(index) = true;
    };
    for (Setting& setting : settings) {
        const auto at = std::find(kPalette.begin(), kPalette.end(), setting.pen->color);
        const auto index = static_cast<std::size_t>(at - kPalette.begin());
        if (at != kPalette.end() && !taken.at(index)) give(setting, index);
    }
    for (Setting& setting : settings) {
        if (setting.index >= 0) continue;
        std::size_t nearest = kPalette.size();
        for (std::size_t i = 0; i < kPalette.size(); ++i) {
            if (taken.at(i)) continue;
            if (nearest == kPalette.size() ||
                apart(kPalette.at(i), setting.pen->color) < apart(kPalette.at(nearest), setting.pen->color))
                nearest = i;
        }
        // There are more colours than operations.
        give(setting, nearest);
    }
}

Settings settings_of(const Profile& profile) {
    Settings settings;
    settings.of.fill(-1);
    for (const Operation operation : kOperations) {
        if (is_printed(operation) || !profile.draws(operation)) continue;
        const Pen& pen = profile.pen(operation);
        std::vector<Setting>& all = settings.all;
        if (all.empty() || !same_setting(*all.back().pen, pen)) {
            std::string name = visible(pen.layer);
            const auto is_named = [&name](const Setting& setting) { return setting.name == name; };
            if (std::any_of(all.begin(), all.end(), is_named))
                name += fmt::format(" ({})", to_string(operation));
            all.push_back({std::move(name), &pen});
        }
        settings.of.at(static_cast<std::size_t>(operation)) = static_cast<int>(all.size()) - 1;
    }
    give_indices(settings.all);
    return settings;
}

class Project {
 public:
    explicit Project(const SheetDrawing& drawing)
        : drawing_(drawing), settings_(settings_of(drawing.profile)) {}

    std::string sheet() {
        xml_.PushDeclaration("xml version=\"1.0\" encoding=\"UTF-8\"");
        xml_.OpenElement("LightBurnProject");
        xml_.PushAttribute("AppVersion", "1.7.08");
        xml_.PushAttribute("FormatVersion", "1");
        xml_.PushAttribute("MaterialHeight", "0");
        xml_.PushAttribute("MirrorX", "False");
        xml_.PushAttribute("MirrorY", "False");
        settings();
        for (const SheetLayer& layer : drawing_.layers) shapes(layer);
        xml_.OpenElement("Notes");
        xml_.PushAttribute("ShowOnLoad", "0");
        xml_.PushAttribute("Notes", fmt::format("{} ({})", drawing_.title, generator()).c_str());
        xml_.CloseElement();
        xml_.CloseElement();
        return xml_.CStr();
    }

 private:
    // Of the layers that something is in.
    void settings() {
        std::array<bool, kOperations.size()> used{};
        for (const SheetShape& one : drawing_.shapes) used.at(static_cast<std::size_t>(one.operation)) = true;
        int priority = 0;
        int last = -1;
        for (const Operation operation : kOperations) {
            const int index = index_of(operation);
            if (!used.at(static_cast<std::size_t>(operation)) || index < 0 || index == last) continue;
            last = index;
            if (index == kToolIndex) {
                begin_setting("Tool", index, "T1");
            } else {
                const Setting& setting = *setting_of(operation);
                begin_setting("Cut", index, setting.name);
                machine(*setting.pen);
            }
            value("priority", std::to_string(priority++));
            xml_.CloseElement();
        }
    }

    [[nodiscard]] const Setting* setting_of(Operation operation) const {
        const int at = settings_.of.at(static_cast<std::size_t>(operation));
        return at < 0 ? nullptr : &settings_.all.at(static_cast<std::size_t>(at));
    }
    // Negative: it is left out.
    [[nodiscard]] int index_of(Operation operation) const {
        if (operation == Operation::fill) return -1;
        if (is_printed(operation)) return kToolIndex;
        const Setting* setting = setting_of(operation);
        return setting == nullptr ? -1 : setting->index;
    }

    void begin_setting(const char* type, int index, const std::string& name) {
        xml_.OpenElement("CutSetting");
        xml_.PushAttribute("type", type);
        value("index", std::to_string(index));
        value("name", name);
    }
    void machine(const Pen& pen) {
        if (pen.power_percent > 0.0) {
            const std::string percent = number_text(pen.power_percent, kDecimals);
            value("minPower", percent);
            value("maxPower", percent);
        }
        if (pen.speed_mm_s > 0.0) value("speed", number_text(pen.speed_mm_s, kDecimals));
    }
    void value(const char* name, const std::string& text) {
        xml_.OpenElement(name);
        xml_.PushAttribute("Value", text.c_str());
        xml_.CloseElement();
    }

    void shapes(const SheetLayer& layer) {
        for (const SheetShape& one : drawing_.shapes_of(layer)) {
            const int index = index_of(one.operation);
            if (index < 0) continue;
            for (const Run& run : drawing_.runs_of(one)) {
                if (run.steps > 0) {
                    curves(index, drawing_.path_of(run));
                } else {
                    path(index, drawing_.points_of(run), run.closed);
                }
            }
        }
    }

    void path(int index, std::span<const Vec2> points, bool closed) {
        if (points.size() < 2) return;
        fmt::memory_buffer vertices;
        fmt::memory_buffer lines;
        for (std::size_t i = 0; i < points.size(); ++i) {
            vertices.push_back('V');
            append_number(vertices, points[i].x, kDecimals);
            vertices.push_back(' ');
            append_number(vertices, points[i].y, kDecimals);
            vertices.append(std::string_view("c0x1c1x1"));  // no control points
            if (i > 0 && !closed) fmt::format_to(fmt::appender(lines), "L{} {}", i - 1, i);
        }
        if (closed) lines.append(std::string_view("LineClosed"));
        shape(index, fmt::to_string(vertices), fmt::to_string(lines));
    }

    // A curve that ends where it begins needs a second vertex.
    static void halve(Subpath& path) {
        const PathStep& step = path.steps[0];
        const Cubic whole{path.start, step.control_1, step.control_2, step.to};
        const Cubic first = whole.part(0.0, 0.5);
        const Cubic second = whole.part(0.5, 1.0);
        path.steps = {{first.to, true, first.control_1, first.control_2},
                      {step.to, true, second.control_1, second.control_2}};
    }

    // A vertex holds the control point of the curve that leaves it as c0, and of the one that ends there as
    // c1; "c0x1" and "c1x1" say that there is none.
    void curves(int index, Subpath path) {
        if (path.steps.size() == 1 && path.steps[0].to == path.start) halve(path);
        std::vector<Vec2> ends{path.start};
        for (const PathStep& step : path.steps) ends.push_back(step.to);
        // A curve that ends where the path begins ends at its first vertex.
        const bool round = path.closed && ends.back() == ends.front();
        if (round) ends.pop_back();
        const std::size_t count = ends.size();
        std::vector<const PathStep*> into(count, nullptr);
        std::vector<const PathStep*> out_of(count, nullptr);
        std::string primitives;
        for (std::size_t i = 0; i < path.steps.size(); ++i) {
            const PathStep& step = path.steps[i];
            const std::size_t to = (i + 1) % count;
            if (step.curve) out_of[i] = into[to] = &step;
            primitives += fmt::format("{}{} {}", step.curve ? 'B' : 'L', i, to);
        }
        if (path.closed && !round) primitives += fmt::format("L{} 0", count - 1);
        fmt::memory_buffer vertices;
        const auto control = [&vertices](char number, bool is, Vec2 p) {
            vertices.append(std::string_view{number == '0' ? "c0x" : "c1x"});
            if (!is) return vertices.push_back('1');
            append_number(vertices, p.x, kDecimals);
            vertices.append(std::string_view{number == '0' ? "c0y" : "c1y"});
            append_number(vertices, p.y, kDecimals);
        };
        for (std::size_t i = 0; i < count; ++i) {
            vertices.push_back('V');
            append_number(vertices, ends[i].x, kDecimals);
            vertices.push_back(' ');
            append_number(vertices, ends[i].y, kDecimals);
            control('0', out_of[i] != nullptr, out_of[i] == nullptr ? Vec2{} : out_of[i]->control_1);
            control('1', into[i] != nullptr, into[i] == nullptr ? Vec2{} : into[i]->control_2);
        }
        shape(index, fmt::to_string(vertices), primitives);
    }

    void shape(int index, const std::string& vertices, const std::string& primitives) {
        xml_.OpenElement("Shape");
        xml_.PushAttribute("Type", "Path");
        xml_.PushAttribute("CutIndex", index);
        xml_.PushAttribute("VertID", number_);
        xml_.PushAttribute("PrimID", number_);
        ++number_;
        text("XForm", "1 0 0 1 0 0");
        text("VertList", vertices);
        text("PrimList", primitives);
        xml_.CloseElement();
    }
    void text(const char* name, const std::string& text) {
        xml_.OpenElement(name);
        xml_.PushText(text.c_str());
        xml_.CloseElement();
    }

    const SheetDrawing& drawing_;
    Settings settings_;
    tinyxml2::XMLPrinter xml_;
    int number_ = 0;
};

}  // namespace

std::optional<std::vector<SheetFile>> write_lightburn(const Layout& layout, const OutputOptions& options,
                                                      Diagnostics& diagnostics) {
    OutputOptions outlined = options;
    outlined.profile.outlined_text = true;
    outlined.legend = Legend::never;
    tell_pictures_left_out(layout, options, ".lbrn2", diagnostics);
    return file_per_view(layout, outlined, diagnostics, [](const SheetDrawing& drawing, const SheetView&) {
        return Project(drawing).sheet();
    });
}

}  // namespace popup
