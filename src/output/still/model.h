// The cards of a run at one opening, as pictures show them: faces of paper and print, and edges. z is up, and
// x leads to the right of someone who sits in front of them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "output/apart.h"
#include "output/mesh.h"
#include "output/still/camera.h"
#include "popup/image.h"
#include "popup/output.h"

namespace popup::still {

using Light = std::array<float, 3>;  // linear, red, green and blue, 0 to 1

inline constexpr float kWashedOut = 0.92F;  // what fades, fades to a grey of this light

// A picture's pixels, and half, a quarter… as many of them, for where it is seen small.
struct Texture {
    struct Level {
        int width = 0, height = 0;
        std::vector<std::uint8_t> rgba;
    };
    std::vector<Level> levels;  // at least one
    bool opaque = true;
};

// Triangles in one plane that look alike.
struct Face {
    int plate = 0;  // of the model: what lies on one plate has one number
    Frame frame;    // of the plate's page
    Light color{};
    std::optional<Light> back;         // of paper that has another colour behind
    const Texture* texture = nullptr;  // in place of the colour
    Affine place;                      // of the texture on the page
    bool paper = true;                 // seen from both sides, and throws a shadow; else only from the front
    float fade = 0.0F;                 // how far it is washed out, 0 to 1
    std::vector<Vec3> points;          // mm
    std::vector<std::uint32_t> indices;
};

struct Edge {
    int plate = -1;  // whose edge it is; -1: a line in space
    Vec3 a, b;
    Light ink{};
};

struct Model {
    std::vector<Face> faces;
    std::vector<Edge> edges;
    int plates = 0;
};

// Makes models of the same cards at several openings: plates are triangulated once, and pictures decoded
// once, when the first model is made.
class Modeller {
 public:
    // Paper is shown `paper_mm` thick; 0: as thin as a line. `printed_backs` as of plate_mesh().
    Modeller(std::span<const SceneCard> cards, bool printed_backs, double paper_mm = 0.0);
    // The opening at which the cards are seen best: where models rest, and further open for cards that lie.
    [[nodiscard]] double best_deg() const { return best_deg_; }
    // How each card stands, and is shown.
    [[nodiscard]] std::vector<Orientation> orientations() const;
    // The plate as triangles; none of one that is not shown.
    [[nodiscard]] const std::vector<MeshPart>& mesh(std::size_t card, std::size_t plate) const {
        return cards_[card].plates[plate].parts;
    }
    // At this opening, or as far as a card opens. nullopt: `locks` was told.
    std::optional<Model> at(double opening_deg, Diagnostics& diagnostics);

    // Some plates of one card, as whoever asks has placed them; z is up.
    struct Staging {
        std::span<const Frame> frames;  // of each plate
        std::span<const float> fades;   // likewise: how far it is washed out; below 0: it is not there
        std::optional<double> opening_deg = {};  // of which these are the places; none: of no opening
    };
    [[nodiscard]] Model staged(std::size_t card, const Staging& staging);

 private:
    struct Plane {
        std::vector<MeshPart> parts;
        std::vector<const Texture*> textures;  // of each part; null: none; before the first model no entries
    };
    struct Card {
        const SceneCard* scene;
        std::vector<Plane> plates;
        std::vector<Frame> frames;
        std::vector<Vec3> lifts;  // of what stands still
        Apart apart;
        Orientation orientation = Orientation::flat;
    };
    void decode_pictures();
    const Texture* texture_of(const Image& image);
    void add(Card& card, const Staging& staging, Vec3 shift, Model& model) const;
    static void add_part(const Plane& plane, std::size_t part, Vec2 pivot, const Frame& frame, Model& model);

    std::vector<Card> cards_;
    std::map<const std::string*, Texture> textures_;
    double paper_mm_;
    double best_deg_ = 90.0;
};

}  // namespace popup::still
