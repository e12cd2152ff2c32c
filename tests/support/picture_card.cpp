#include "support/picture_card.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace popup::test {
namespace {

constexpr int kGroups = 5;
constexpr double kPitchMm = 26.0;  // of what stands on the gutter, six things a group
constexpr double kWidthMm = 300.0;
constexpr double kHeightMm = kPitchMm * 6 * kGroups + 20.0;

struct On {
    Vec2 at;
    std::string page = {};  // none: that of the structure
};

class Card {
 public:
    void structure(const std::string& type, const std::string& id, std::span<const On> points,
                   const std::string& more, const std::string& attributes = "") {
        structures_ += fmt::format("<structure type='{}' id='{}'{}>\n<outerpoints>", type, id, attributes);
        for (const On& point : points) {
            const std::string page = point.page.empty() ? "" : fmt::format(" page='{}'", point.page);
            structures_ += fmt::format("<point{} x='{:.4f}' y='{:.4f}'/>", page, point.at.x, point.at.y);
        }
        structures_ += "</outerpoints>\n" + more;
        if (type != "attached-plane" && type != "disc") {
            structures_ +=
                fmt::format("<parentfold page='0'><begin x='0' y='{}'/><end x='0' y='{}'/></parentfold>\n",
                            -0.5 * kHeightMm, 0.5 * kHeightMm);
        }
        structures_ += "</structure>\n";
    }

    void print(const std::string& line) { prints_ += line + "\n"; }

    [[nodiscard]] std::string text() const {
        return fmt::format(
            "<popup version='3.0' units='mm'>\n<mainpage width='{}' height='{}'/>\n<structurelist>\n{}"
            "</structurelist>\n<drawnlinelist>\n{}</drawnlinelist>\n</popup>\n",
            kWidthMm, kHeightMm, structures_, prints_);
    }

 private:
    std::string structures_;
    std::string prints_;
};

// Two seams of 20 mm beside the gutter.
std::vector<On> seams(double y, double out) {
    return {{{-out, y - 10}}, {{-out, y + 10}}, {{out, y - 10}}, {{out, y + 10}}};
}

void add_layer(Card& card, int n, double y) {
    std::vector<On> points = seams(y, 10.0);
    for (const On& seam : seams(0.0, 10.0)) points.push_back(seam);
    card.structure("layer", fmt::format("layer{}", n), points,
                   "<outline d='M -10 -10 C -5 -12 5 -12 10 -10 V 10 C 5 12 -5 12 -10 10 Z'/>"
                   "<hole d='M -7 -6 H -3 V 6 H -7 Z'/>\n");
    const std::string page = fmt::format("layer{}", n);
    card.structure(
        "attached-plane", fmt::format("flag{}", n),
        std::array<On, 4>{{{{5, -4}, page}, {{5, 4}, page}, {{0, -4}}, {{0, 4}}}},
        fmt::format("<outline d='M 2 -6 H -3 C -14 -9 -16 9 -3 6 H 2 Z M -6 -2 C -9 -4 -9 4 -6 2 Z'/>"
                    "<parentplate page='{}' x='5' y='0'/>\n",
                    page),
        " side='front'");
}

void add_v_fold(Card& card, int n, double y) {
    // The seams are as long on the piece as on the page, and meet it in the apex at another angle.
    const double seam = std::hypot(9.0, 9.0);
    const Vec2 right{seam * std::sin(1.05), seam * std::cos(1.05) - 12.0};
    card.structure("v-fold", fmt::format("vfold{}", n),
                   std::array<On, 8>{{{{-9, y + 1}},
                                      {{0, y - 8}},
                                      {{9, y + 1}},
                                      {{-right.x, right.y}},
                                      {{0, -12}},
                                      {right},
                                      {{8, 18}},
                                      {{-8, 18}}}},
                   fmt::format("<outline d='M 0 -12 L {0:.4f} {1:.4f} C 16 2 14 12 9 18 C 4 14 -4 14 -9 18 "
                               "C -14 12 -16 2 {2:.4f} {1:.4f} Z'/><hole d='M 3 4 C 6 4 6 9 3 9 Z'/>\n",
                               right.x, right.y, -right.x));
}

void add_tent(Card& card, int n, double y) {
    std::vector<On> points = seams(y, 10.0);
    for (const On& seam : seams(0.0, 12.0)) points.push_back(seam);
    card.structure("tent", fmt::format("tent{}", n), points,
                   "<outline d='M -12 -10 C -6 -13 6 -13 12 -10 V 10 C 6 12 -6 12 -12 10 Z'/>"
                   "<hole d='M -8 -4 H -3 V 4 H -8 Z M 4 -4 h 4 v 8 h -4 Z'/>\n");
}

void add_turning(Card& card, int n, double y) {
    card.structure("pivot", fmt::format("pivot{}", n),
                   std::array<On, 5>{{{{0, y - 8}}, {{-16, y}}, {{16, y}}, {{0, 0}}, {{-16, 8}}}},
                   "<outline d='M -0.4 1.5 L -0.4 13 C -6 17 -10 12 -14 14 C -18 19 -24 22 -26 20 "
                   "C -24 16 -20 12 -17 10 Z M -17 14 C -19 12 -22 15 -20 17 Z'/>\n");
    card.structure("disc", fmt::format("disc{}", n), std::array<On, 2>{{{{70, y}}, {{70, y}}}},
                   fmt::format("<window d='M 73 {} h 8 v 6 h -8 Z' page='page'/>"
                               "<parentplate page='page' x='55' y='{}'/>\n",
                               y + 1.0, y - 10.0),
                   " radius='14'");
}

void add_prints(Card& card, int n) {
    const bool more = n <= 3;
    card.print(
        fmt::format("<image page='vfold{0}' x='-16' y='-14' width='32' height='34'{1} href='{0}.png'/>", n,
                    more ? " horizon='0.4' horizonheight='10'" : ""));
    if (more) {
        card.print(fmt::format(
            "<image page='layer{}' x='-10' y='-12' width='20' height='24' fit='cover' href='{}.png'/>", n,
            n + kGroups));
    }
    card.print(fmt::format(
        "<text page='layer{0}' x='6' y='-4' height='3' font='sans-bold' fill='#fdf6e6'>No {0}</text>", n));
    card.print(fmt::format("<area page='tent{}' fill='#d1493a' d='M -10 6 C -8 10 -4 10 -2 6 Z'/>", n));
    card.print(fmt::format("<area page='pivot{}' fill='#d1493a' d='M -3 2 h 2 v 2 h -2 Z'/>", n));
}

struct Rgb {
    std::uint8_t red, green, blue;
};

// Of a shore: a sky that grows paler, a sun, hills, and a sea with waves.
Rgb shore(int number, int x, int y) {
    const auto channel = [](double value) {
        return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
    };
    if (std::hypot(x - 37.0 * number, y - 60.0) < 24.0) return {255, 236, 170};
    const double hill = 150.0 + 18.0 * std::sin(0.021 * x + number) + 9.0 * std::sin(0.057 * x - number);
    if (y < 180 && y > hill) return {channel(70.0 + 8.0 * number), channel(0.4 * y + 30.0), 74};
    if (y < 180) return {channel(90.0 + 0.7 * y), channel(140.0 + 0.45 * y), channel(225.0 - 0.1 * y)};
    const double wave = 14.0 * std::sin(0.35 * (y - 180) + std::sin(0.06 * x + number));
    return {channel(24.0 + wave), channel(92.0 + 0.2 * (y - 180) + wave), channel(140.0 + wave)};
}

}  // namespace

std::string picture_card() {
    Card card;
    for (int n = 1; n <= kGroups; ++n) {
        const double first = 0.5 * (kPitchMm - kHeightMm) + 10.0 + 6.0 * kPitchMm * (n - 1);
        const auto at = [first](int place) { return first + kPitchMm * place; };
        add_layer(card, n, at(0));
        add_v_fold(card, n, at(1));
        card.structure("box", fmt::format("box{}", n), seams(at(2), 10.0), "", " height='12'");
        card.structure("floating-layer", fmt::format("top{}", n), seams(at(3), 16.0), "", " height='12'");
        add_tent(card, n, at(4));
        add_turning(card, n, at(5));
        add_prints(card, n);
    }
    constexpr double kCovered = 0.5 * kWidthMm - 10.0;
    for (const auto& [number, x] : {std::pair{9, -0.5 * kWidthMm}, std::pair{10, 10.0}}) {
        card.print(
            fmt::format("<image page='page' x='{}' y='{}' width='{}' height='{}' fit='cover' href='{}.png'/>",
                        x, -0.5 * kHeightMm, kCovered, kHeightMm, number));
    }
    card.print(fmt::format(
        "<text page='page' x='-75' y='{}' height='10' font='serif-bold' fill='#0f3a5c'>All kinds</text>",
        0.5 * kHeightMm - 30.0));
    return card.text();
}

std::string card_picture(int number) {
    constexpr int kWidth = 400;
    constexpr int kHeight = 300;
    std::vector<std::uint8_t> rgb;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const Rgb pixel = shore(number, x, y);
            rgb.insert(rgb.end(), {pixel.red, pixel.green, pixel.blue});
        }
    }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = kWidth;
    image.height = kHeight;
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string bytes(size, '\0');
    POPUP_INVARIANT(png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), 0, nullptr) != 0);
    bytes.resize(size);
    return bytes;
}

CompileOptions picture_card_options() {
    static const std::map<std::string, std::string> pictures = [] {
        std::map<std::string, std::string> made;
        for (int n = 1; n <= kCardPictures; ++n) made[fmt::format("{}.png", n)] = card_picture(n);
        return made;
    }();
    CompileOptions options;
    options.layout.sheet = {"", 1000.0, 700.0};
    options.read.program.read_file = [](const std::string& path) -> std::optional<Source> {
        const auto found = pictures.find(path);
        if (found == pictures.end()) return std::nullopt;
        return Source{path, found->second};
    };
    return options;
}

}  // namespace popup::test
