#include "output/still/model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "output/gltf_values.h"
#include "output/orientation.h"
#include "output/poses.h"
#include "output/space_mesh.h"

namespace popup::still {
namespace {

constexpr double kBetweenMm = 0.02;  // two papers that lie on one another
constexpr double kAjarDeg = 1.5;
constexpr Color kTraceInk{70, 70, 76};

std::size_t index(int number) { return static_cast<std::size_t>(number); }

Light light_of(Color color) {
    return {static_cast<float>(linear(color.r)), static_cast<float>(linear(color.g)),
            static_cast<float>(linear(color.b))};
}
Light ink_on(const Light& paper) {
    Light ink{};
    for (std::size_t i = 0; i < ink.size(); ++i) ink.at(i) = 0.22F * paper.at(i) + 0.02F;
    return ink;
}

Light washed_out(const Light& light, float fade) {
    Light result{};
    for (std::size_t i = 0; i < result.size(); ++i)
        result.at(i) = light.at(i) + fade * (kWashedOut - light.at(i));
    return result;
}

// Each pixel the mean of up to four; what shows through counts for nothing.
Texture::Level halved(const Texture::Level& from) {
    Texture::Level to{std::max(1, from.width / 2), std::max(1, from.height / 2), {}};
    to.rgba.resize(4 * index(to.width) * index(to.height));
    for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
            std::array<unsigned, 4> sum{};
            for (int k = 0; k < 4; ++k) {
                const int fx = std::min(2 * x + k % 2, from.width - 1);
                const int fy = std::min(2 * y + k / 2, from.height - 1);
                const std::uint8_t* p = from.rgba.data() + 4 * (index(fy) * index(from.width) + index(fx));
                for (std::size_t c = 0; c < 3; ++c) sum.at(c) += unsigned{p[c]} * p[3];
                sum[3] += p[3];
            }
            std::uint8_t* out = to.rgba.data() + 4 * (index(y) * index(to.width) + index(x));
            for (std::size_t c = 0; c < 3; ++c)
                out[c] = static_cast<std::uint8_t>(sum[3] == 0 ? 0 : (sum.at(c) + sum[3] / 2) / sum[3]);
            out[3] = static_cast<std::uint8_t>((sum[3] + 2) / 4);
        }
    }
    return to;
}

// Where all lies in one plane nothing can be told apart: it is shown a hair before.
double shown_at(const Sweep& sweep, double opening_deg) {
    const double least = sweep.closed_flat ? sweep.from_deg + kAjarDeg : sweep.from_deg;
    return std::clamp(opening_deg, std::min(least, sweep.to_deg), sweep.to_deg);
}

template <typename Visit>
void each_side(const Polygon& outline, const Visit& visit) {
    const auto sides = [&visit](const Ring& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[(i + 1) % ring.size()]);
    };
    sides(outline.outer);
    for (const Ring& hole : outline.holes) sides(hole);
}

Frame moved(Frame frame, Vec3 by) {
    frame.origin = frame.origin + by;
    return frame;
}

// The side of a plate that is `thick` mm, along one of its edges. Outlines have the paper on their left.
void add_wall(const Frame& frame, Vec2 a, Vec2 b, double thick, const Light& color, Model& model) {
    const Vec3 along = frame.point(b) - frame.point(a);
    const double long_mm = std::sqrt(dot(along, along));
    if (long_mm < 1e-9) return;
    const Vec3 x = (1.0 / long_mm) * along;
    Face& wall = model.faces.emplace_back();
    wall.plate = model.plates;
    wall.frame.origin = frame.point(a);
    wall.frame.axes = {x, frame.normal(), cross(x, frame.normal())};
    wall.color = color;
    const Vec3 up = 0.5 * thick * frame.normal();
    for (const Vec3 p : {frame.point(a) - up, frame.point(b) - up, frame.point(b) + up, frame.point(a) + up})
        wall.points.push_back(p);
    wall.indices = {0, 1, 2, 0, 2, 3};
}

}  // namespace

Modeller::Modeller(std::span<const SceneCard> cards, bool printed_backs, double paper_mm)
    : paper_mm_(paper_mm) {
    for (const SceneCard& scene : cards) {
        const Assembly& assembly = *scene.assembly;
        Card card{&scene, {}, std::vector<Frame>(assembly.plates.size()), {}, Apart(scene)};
        for (const Plate& plate : assembly.plates) {
            Plane& plane = card.plates.emplace_back();
            if (!moves(assembly) && !plate.stands) continue;
            plane.parts = plate_mesh(plate, printed_backs, assembly.pieces[index(plate.piece)].prints);
        }
        if (!moves(assembly)) card.lifts = layer_lifts(assembly);
        cards_.push_back(std::move(card));
    }
    const std::vector<Stance> stances = stances_of(cards);
    for (std::size_t i = 0; i < stances.size(); ++i) cards_[i].orientation = stances[i].orientation;
    best_deg_ = best_opening(cards, stances);
}

std::vector<Orientation> Modeller::orientations() const {
    std::vector<Orientation> each;
    for (const Card& card : cards_) each.push_back(card.orientation);
    return each;
}

void Modeller::decode_pictures() {
    for (Card& card : cards_) {
        for (Plane& plane : card.plates) {
            for (std::size_t i = plane.textures.size(); i < plane.parts.size(); ++i) {
                const Image* image = plane.parts[i].image;
                plane.textures.push_back(image != nullptr ? texture_of(*image) : nullptr);
            }
        }
    }
}

const Texture* Modeller::texture_of(const Image& image) {
    const auto [known, fresh] = textures_.try_emplace(image.bytes.get());
    if (!fresh) return &known->second;
    std::optional<ImagePixels> pixels = pixels_of(image);
    POPUP_INVARIANT(pixels.has_value());
    std::vector<Texture::Level>& levels = known->second.levels;
    known->second.opaque = pixels->opaque;
    levels.push_back({pixels->width, pixels->height, std::move(pixels->rgba)});
    while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(halved(levels.back()));
    return &known->second;
}

std::optional<Model> Modeller::at(double opening_deg, Diagnostics& diagnostics) {
    decode_pictures();
    Model model;
    double left = 0.0;
    for (Card& card : cards_) {
        const Assembly& assembly = *card.scene->assembly;
        std::optional<double> shown_deg;
        if (moves(assembly)) {
            shown_deg = shown_at(assembly.sweep, opening_deg);
            if (!place_card(assembly, *shown_deg, card.frames, diagnostics)) return std::nullopt;
        } else {
            std::transform(assembly.plates.begin(), assembly.plates.end(), card.frames.begin(),
                           [](const Plate& plate) { return plate.stands.value_or(Frame{}); });
        }
        stand(card.orientation, assembly, card.frames);
        double low = HUGE_VAL;
        double high = -HUGE_VAL;
        for (std::size_t i = 0; i < card.plates.size(); ++i) {
            if (card.plates[i].parts.empty()) continue;
            for (const Vec2 p : assembly.plates[i].outline.outer) {
                const double x = card.frames[i].point(p).x;
                low = std::min(low, x);
                high = std::max(high, x);
            }
        }
        const bool several = cards_.size() > 1 && low <= high;
        add(card, {card.frames, {}, shown_deg}, several ? Vec3{left - low, 0.0, 0.0} : Vec3{}, model);
        if (several) left += high - low + kCardGapMm;
    }
    return model;
}

Model Modeller::staged(std::size_t card, const Staging& staging) {
    decode_pictures();
    Model model;
    add(cards_.at(card), staging, {}, model);
    return model;
}

void Modeller::add_part(const Plane& plane, std::size_t part, Vec2 pivot, const Frame& frame, Model& model) {
    const MeshPart& from = plane.parts[part];
    Face& face = model.faces.emplace_back();
    face.plate = model.plates;
    face.frame = moved(frame, from.lift_mm * frame.normal());
    face.color = light_of(from.color);
    if (from.back) face.back = light_of(*from.back);
    face.texture = plane.textures[part];
    if (from.image != nullptr) face.place = from.image->place;
    face.paper = !from.drawn;
    face.points.reserve(from.points.size());
    for (const Vec2 p : from.points) face.points.push_back(face.frame.point(p + pivot));
    face.indices = from.indices;
}

void Modeller::add(Card& card, const Staging& staging, Vec3 shift, Model& model) const {
    const Assembly& assembly = *card.scene->assembly;
    const double layer_mm = std::max(kLayerMm, paper_mm_ + kBetweenMm);
    const bool moving = moves(assembly);
    const std::vector<Vec3> lifts =
        moving ? card.apart.lifts({staging.frames, staging.opening_deg, paper_mm_}) : card.lifts;
    for (std::size_t i = 0; i < card.plates.size(); ++i) {
        const Plate& plate = assembly.plates[i];
        const Plane& plane = card.plates[i];
        const float fade = staging.fades.empty() ? 0.0F : staging.fades[i];
        if (plane.parts.empty() || fade < 0.0F) continue;
        const std::size_t first = model.faces.size();
        const Frame frame = moved(staging.frames[i], shift + (moving ? 1.0 : layer_mm / kLayerMm) * lifts[i]);
        const Vec3 out = 0.5 * paper_mm_ * frame.normal();
        const Light paint = washed_out(light_of(plate.fill.value_or(Color{})), fade);
        const Light core =
            washed_out(light_of(plane.parts.front().back.value_or(plane.parts.front().color)), fade);
        const auto add_edges = [&](const Frame& on) {
            each_side(plate.outline, [&](Vec2 a, Vec2 b) {
                model.edges.push_back({model.plates, on.point(a), on.point(b), ink_on(paint)});
            });
            ++model.plates;
        };
        // Front and back are plates of their own, so that the edges of each are hidden by the other.
        for (std::size_t k = 0; k < plane.parts.size(); ++k)
            add_part(plane, k, plate.pivot, moved(frame, out), model);
        add_edges(moved(frame, out));
        for (std::size_t k = first; k < model.faces.size(); ++k) model.faces[k].fade = fade;
        if (paper_mm_ <= 0.0) continue;
        for (std::size_t k = 0; k < plane.parts.size(); ++k) {
            if (!plane.parts[k].drawn) add_part(plane, k, plate.pivot, moved(frame, -out), model);
        }
        add_edges(moved(frame, -out));
        each_side(plate.outline, [&](Vec2 a, Vec2 b) { add_wall(frame, a, b, paper_mm_, core, model); });
        ++model.plates;
    }
    if (!staging.fades.empty()) return;
    for (const Trace& trace : assembly.traces) {
        for (const std::vector<Vec3>& line : trace.lines) {
            for (std::size_t i = 0; i + 1 < line.size(); ++i)
                model.edges.push_back({-1, line[i] + shift, line[i + 1] + shift, light_of(kTraceInk)});
        }
    }
}

}  // namespace popup::still
