// Pictures of a book: some plates of a card at an opening, as those see them whose hands are there.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "output/png.h"
#include "output/still/model.h"
#include "output/still/render.h"
#include "popup/gluing.h"
#include "popup/output.h"

namespace popup::book {

struct Scene {
    std::size_t card = 0;               // of the run
    std::optional<double> opening_deg;  // of cards that move; none: where they are seen best
    // Of each plate how far it is washed out; below 0 it is not there. Empty: all is there as it is.
    std::vector<float> fades;
    std::vector<int> painted = {};  // plates that have a colour here, whatever is on them
    std::vector<int> lifted;        // plates that hover above where they come to be
    std::vector<Bond> bonds;        // whose targets are shown with their numbers
    std::optional<int> on_table;    // the piece that lies on the table; none: the card lies there
    std::optional<int> lying;       // of that piece the plate that lies there; none: its largest
    bool unfolded = false;          // that piece is flat, as it is cut, and what is glued flat on it with it
    bool back_up = false;           // what lies there is turned over
    bool as_still = false;          // it stands as in stills
    std::string alt;                // for those who cannot see it
    // Plates that are to be joined, with letters: all else is pale, and what hides them is drawn as lines.
    // Corners have dots, and lines to the middle of them all.
    struct Marked {
        int plate = 0;
        std::string text;
        std::optional<Vec2> corner = {};  // of the plate, on its page
    };
    std::vector<Marked> marked = {};
};

// A number in a picture, at a share of its width and height.
struct PictureMark {
    std::string text;
    double x = 0.0, y = 0.0;
};
struct Picture {
    Pixels pixels;
    std::vector<PictureMark> marks;
};

class Illustrator {
 public:
    Illustrator(std::span<const SceneCard> cards, bool printed_backs);
    // The scenes of one step, from one place, all in one size; where pieces are lifted, near enough to see
    // them well. nullopt: `locks` was told.
    std::optional<std::vector<Picture>> draw(std::span<const Scene> scenes, PictureSize size,
                                             Diagnostics& diagnostics);

 private:
    struct Stage;
    static void look_at_marked(const Scene& scene, const Assembly& assembly, Stage& stage);
    static void add_marked(const Scene& scene, const Assembly& assembly, Stage& stage);
    std::optional<Stage> stage(const Scene& scene, Diagnostics& diagnostics);
    [[nodiscard]] still::Framing framing_of(std::span<const Scene> scenes, std::span<const Stage> stages,
                                            PictureSize size) const;
    [[nodiscard]] std::vector<PictureMark> marks_of(const Scene& scene, const Stage& stage,
                                                    const still::Camera& camera, PictureSize size) const;
    [[nodiscard]] Vec3 eye_for(const Scene& scene, const Stage& stage) const;

    std::span<const SceneCard> cards_;
    std::vector<still::Modeller> modellers_;  // one a card
};

}  // namespace popup::book
