#include "output/book/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/geometry/triangulate.h"
#include "base/nth.h"
#include "output/book/sight.h"
#include "output/orientation.h"
#include "output/poses.h"

namespace popup::book {
namespace {

using still::Light;

constexpr double kLiftShare = 0.3;      // of the size of what lies there
constexpr double kTargetLiftMm = 0.06;  // before the paper
constexpr Light kTargetLight{1.0F, 0.42F, 0.02F};
constexpr Light kGuideInk{0.75F, 0.16F, 0.0F};
// Where hands are: in front of the table, and on its other sides where things are in the way.
constexpr std::array<Vec3, 5> kEyes{Vec3{0.25, -1.0, 0.9}, Vec3{-0.9, -0.55, 0.9}, Vec3{0.9, -0.55, 0.9},
                                    Vec3{0.25, 1.0, 0.9}, Vec3{0.05, -0.35, 1.2}};
// A folded model that is taken into the hand is seen from below, too.
constexpr std::array<Vec3, 12> kEyesAround{
    Vec3{0.45, -1.0, 0.75},  Vec3{-0.8, -0.75, 0.8},  Vec3{1.0, -0.35, 0.8},  Vec3{0.45, 1.0, 0.75},
    Vec3{-0.8, 0.75, 0.8},   Vec3{1.0, 0.45, 0.4},    Vec3{0.15, -0.45, 1.2}, Vec3{-1.0, -0.4, 0.35},
    Vec3{0.45, -1.0, -0.75}, Vec3{-0.8, -0.75, -0.8}, Vec3{0.45, 1.0, -0.75}, Vec3{-0.8, 0.75, -0.8}};
constexpr float kRestFade = 0.62F;   // of what is not marked
constexpr double kDotShare = 0.015;  // the size of dots, of that of the model
constexpr std::array<Light, 4> kMarkedLights{Light{0.95F, 0.36F, 0.05F}, Light{0.12F, 0.42F, 0.86F},
                                             Light{0.18F, 0.60F, 0.22F}, Light{0.55F, 0.24F, 0.72F}};
constexpr Light kPaintedLight{1.0F, 0.58F, 0.24F};
constexpr Light kGoneInk{0.35F, 0.37F, 0.40F};
constexpr Light kDotLight{0.62F, 0.02F, 0.02F};

int piece_of(const Assembly& assembly, int plate) { return nth(assembly.plates, plate).piece; }

// Turned so that a frame lies on the table, its front up, or its back. It may be one of them: by value, for
// it is turned with them.
void lay_down(std::vector<Frame>& frames, const Frame base, bool back_up) {
    const double side = back_up ? -1.0 : 1.0;
    const auto turned = [&](Vec3 v) {
        return Vec3{side * dot(v, base.axes[0]), dot(v, base.axes[1]), side * dot(v, base.axes[2])};
    };
    const Vec3 origin = base.origin;
    for (Frame& frame : frames) {
        for (Vec3& axis : frame.axes) axis = turned(axis);
        frame.origin = turned(frame.origin - origin);
    }
}

// The piece as it is cut, and what hangs on its plates as it stands to them.
void unfold(const Assembly& assembly, int piece, std::vector<Frame>& frames) {
    const std::vector<Frame> folded = frames;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        int base = static_cast<int>(i);
        while (base >= 0 && piece_of(assembly, base) != piece) base = nth(assembly.plates, base).parent;
        if (base < 0) continue;
        const Frame& from = nth(folded, base);
        const auto turned = [&from](Vec3 v) {
            return Vec3{dot(v, from.axes[0]), dot(v, from.axes[1]), dot(v, from.axes[2])};
        };
        for (Vec3& axis : frames[i].axes) axis = turned(axis);
        frames[i].origin = turned(frames[i].origin - from.origin);
    }
}

int largest_plate(const Assembly& assembly, int piece) {
    int largest = -1;
    double most = -1.0;
    for (const int plate : nth(assembly.pieces, piece).plates) {
        const double paper = std::round(area(nth(assembly.plates, plate).outline));
        if (paper <= most) continue;
        most = paper;
        largest = plate;
    }
    return largest;
}

// The shapes of a bond's target, on the page of its mate.
std::vector<Ring> targets_of(const SceneCard& card, const Bond& bond) {
    const Assembly& assembly = *card.assembly;
    if (bond.kind == Bond::Kind::area) {
        std::vector<Ring> rings;
        for (const Polygon& part : nth(assembly.glued_areas, bond.number).on_base)
            rings.push_back(part.outer);
        return rings;
    }
    if (bond.kind == Bond::Kind::rivet) return {};
    const Glue& glue = nth(assembly.glue, bond.number);
    if (!glue.on_back && !bond.theirs && card.pattern != nullptr) {
        std::vector<Ring> rings;
        const PatternPiece& under = nth(card.pattern->pieces, piece_of(assembly, bond.mate));
        for (const GlueTarget& target : under.targets) {
            if (target.label == glue.label && target.plate == bond.mate) rings.push_back(target.outline);
        }
        if (!rings.empty()) return rings;
    }
    // A strip along the seam.
    constexpr double kStripMm = 5.0;
    const Segment& seam = bond.theirs ? glue.on_piece : glue.on_base;
    const Vec2 along = unit(seam.b - seam.a);
    const Vec2 in = kStripMm * (bond.theirs || glue.on_back ? left_of(along) : right_of(along));
    Ring strip{seam.a, seam.b, seam.b + in, seam.a + in};
    if (signed_area(strip) < 0.0) std::reverse(strip.begin(), strip.end());
    return {strip};
}

std::string number_of(const Assembly& assembly, const Bond& bond) {
    switch (bond.kind) {
        case Bond::Kind::tab:
            return nth(assembly.glue, bond.number).label;
        case Bond::Kind::area:
            return nth(assembly.glued_areas, bond.number).label;
        case Bond::Kind::rivet:
            break;
    }
    return "o";
}

// Where a number may stand on a target: in its middle, or nearer to its ends.
std::vector<Vec2> places_on(const Ring& ring) {
    const Vec2 middle = inner_point({ring, {}}, 0.5).at;
    std::vector<Vec2> places{middle};
    Vec2 far = middle;
    for (const Vec2 p : ring) {
        if (distance(p, middle) > distance(far, middle)) far = p;
    }
    const Vec2 away = far - middle;
    for (const double share : {0.35, -0.35, 0.6, -0.6, 0.8, -0.8}) {
        const Vec2 p = middle + share * away;
        if (contains({ring, {}}, p)) places.push_back(p);
    }
    for (const Vec2 p : ring) places.push_back(lerp(middle, p, 0.75));
    return places;
}

// A plate's two sides in a colour, just before its paper.
void add_coat(const Plate& plate, const Frame& frame, const Light& light, still::Model& model) {
    const Triangulation triangles = triangulate(plate.outline);
    for (const double side : {kTargetLiftMm, -kTargetLiftMm}) {
        still::Face& face = model.faces.emplace_back();
        face.plate = model.plates++;
        face.frame = frame;
        face.frame.origin = frame.origin + side * frame.normal();
        face.color = light;
        for (const Vec2 p : triangles.points) face.points.push_back(face.frame.point(p));
        for (const auto& corners : triangles.triangles)
            face.indices.insert(face.indices.end(), corners.begin(), corners.end());
        const Light ink{0.2F * light[0], 0.2F * light[1], 0.2F * light[2]};
        const auto add_edges = [&](const Ring& ring) {
            for (std::size_t i = 0; i < ring.size(); ++i)
                model.edges.push_back({face.plate, face.frame.point(ring[i]),
                                       face.frame.point(ring[(i + 1) % ring.size()]), ink});
        };
        add_edges(plate.outline.outer);
        for (const Ring& hole : plate.outline.holes) add_edges(hole);
    }
}

// A small octahedron.
void add_dot(Vec3 at, double size_mm, still::Model& model) {
    for (const double z : {1.0, -1.0}) {
        for (const double y : {1.0, -1.0}) {
            for (const double x : {1.0, -1.0}) {
                const Vec3 out = unit(Vec3{x, y, z});
                const Vec3 along = unit(Vec3{-y, x, 0.0});
                still::Face& face = model.faces.emplace_back();
                face.plate = model.plates++;
                face.frame.origin = at + (size_mm / std::sqrt(3.0)) * out;
                face.frame.axes = {along, cross(out, along), out};
                face.color = kDotLight;
                face.points = {at + Vec3{x * size_mm, 0, 0}, at + Vec3{0, y * size_mm, 0},
                               at + Vec3{0, 0, z * size_mm}};
                face.indices = {0, 1, 2};
                if (x * y * z < 0.0) std::swap(face.indices[1], face.indices[2]);
            }
        }
    }
}

// Where a marked plate may have its letter: first of all away from the corner that is to be seen.
std::vector<Vec2> letter_places(const Plate& plate, const std::optional<Vec2>& corner) {
    std::vector<Vec2> places = places_on(plate.outline.outer);
    if (!corner) return places;
    const Vec2 away = lerp(*corner, places.front(), 1.3);
    if (contains(plate.outline, away)) places.insert(places.begin(), away);
    return places;
}

// What is to be seen of marked plates.
std::vector<Vec3> points_of(const Scene& scene, const Assembly& assembly, std::span<const Frame> frames) {
    std::vector<Vec3> points;
    for (const Scene::Marked& one : scene.marked) {
        const Frame& frame = nth(frames, one.plate);
        if (one.corner) points.push_back(frame.point(*one.corner));
        points.push_back(frame.point(letter_places(nth(assembly.plates, one.plate), one.corner).front()));
    }
    return points;
}

// Where the corners of marked plates are to meet; of one or none, nowhere.
std::optional<Vec3> meeting_of(const Scene& scene, std::span<const Frame> frames) {
    Vec3 sum;
    double count = 0.0;
    for (const Scene::Marked& one : scene.marked) {
        if (!one.corner) continue;
        sum = sum + nth(frames, one.plate).point(*one.corner);
        count += 1.0;
    }
    if (count < 2.0) return std::nullopt;
    return (1.0 / count) * sum;
}

}  // namespace

struct Illustrator::Stage {
    std::vector<Frame> frames;  // with what is lifted
    std::vector<Frame> placed;  // without
    std::vector<float> fades;
    still::Model model;
    // Numbers, and the places of which the first that is seen has it.
    std::vector<std::pair<std::vector<Vec3>, std::string>> marks;
    std::optional<Vec3> eye;  // of marked plates
};

Illustrator::Illustrator(std::span<const SceneCard> cards, bool printed_backs) : cards_(cards) {
    for (const SceneCard& card : cards) modellers_.emplace_back(std::span(&card, 1), printed_backs);
}

// Washes out what is not marked, looks from where most of the marked is seen, and takes away what hides it.
void Illustrator::look_at_marked(const Scene& scene, const Assembly& assembly, Stage& stage) {
    std::vector<char> is_marked(assembly.plates.size(), 0);
    for (const Scene::Marked& one : scene.marked) nth(is_marked, one.plate) = 1;
    for (std::size_t i = 0; i < is_marked.size(); ++i) {
        if (is_marked[i] == 0 && stage.fades[i] >= 0.0F) stage.fades[i] = kRestFade;
    }
    const std::vector<Vec3> points = points_of(scene, assembly, stage.frames);
    const Placed placed{assembly, stage.frames, stage.fades};
    stage.eye = best_eye(placed, points, kEyesAround);
    for (const int plate : hiding(placed, points, *stage.eye)) {
        if (nth(is_marked, plate) == 0) nth(stage.fades, plate) = -1.0F;
    }
}

void Illustrator::add_marked(const Scene& scene, const Assembly& assembly, Stage& stage) {
    if (scene.marked.empty()) return;
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    Vec3 high = -low;
    for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
        const Polygon& outline = assembly.plates[i].outline;
        for (const Vec2 p : outline.outer) {
            const Vec3 at = stage.frames[i].point(p);
            low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
            high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
        }
        if (stage.fades[i] >= 0.0F) continue;
        // What was taken away is still there as lines.
        const auto lines = [&](const Ring& ring) {
            for (std::size_t k = 0; k < ring.size(); ++k)
                stage.model.edges.push_back({-1, stage.frames[i].point(ring[k]),
                                             stage.frames[i].point(ring[(k + 1) % ring.size()]), kGoneInk});
        };
        lines(outline.outer);
        for (const Ring& hole : outline.holes) lines(hole);
    }
    const double dot_mm = kDotShare * length(high - low);
    const std::optional<Vec3> meeting = meeting_of(scene, stage.frames);
    for (std::size_t i = 0; i < scene.marked.size(); ++i) {
        const Scene::Marked& one = scene.marked[i];
        const Plate& plate = nth(assembly.plates, one.plate);
        const Frame& frame = nth(stage.frames, one.plate);
        add_coat(plate, frame, kMarkedLights.at(i % kMarkedLights.size()), stage.model);
        if (one.corner) {
            add_dot(frame.point(*one.corner), dot_mm, stage.model);
            if (meeting) stage.model.edges.push_back({-1, frame.point(*one.corner), *meeting, kGuideInk});
        }
        std::vector<Vec3> places;
        for (const Vec2 p : letter_places(plate, one.corner)) places.push_back(frame.point(p));
        stage.marks.emplace_back(std::move(places), one.text);
    }
}

std::optional<Illustrator::Stage> Illustrator::stage(const Scene& scene, Diagnostics& diagnostics) {
    const SceneCard& card = cards_[scene.card];
    const Assembly& assembly = *card.assembly;
    Stage stage;
    std::optional<double> opening;
    stage.frames.resize(assembly.plates.size());
    if (moves(assembly)) {
        opening = scene.opening_deg.value_or(modellers_[scene.card].best_deg());
        if (!place_card(assembly, *opening, stage.frames, diagnostics)) return std::nullopt;
    } else {
        for (std::size_t i = 0; i < stage.frames.size(); ++i)
            stage.frames[i] = assembly.plates[i].stands.value_or(Frame{});
    }
    if (scene.on_table && scene.unfolded) {
        unfold(assembly, *scene.on_table, stage.frames);
        lay_down(stage.frames, Frame{}, scene.back_up);
    } else if (scene.on_table) {
        lay_down(stage.frames,
                 nth(stage.frames, scene.lying.value_or(largest_plate(assembly, *scene.on_table))),
                 scene.back_up);
    } else if (scene.back_up) {
        lay_down(stage.frames, Frame{}, true);
    } else if (scene.as_still) {
        stand(modellers_[scene.card].orientations().front(), assembly, stage.frames);
    } else {
        settle(assembly, stage.frames);
    }
    stage.placed = stage.frames;

    std::vector<float>& fades = stage.fades;
    fades = scene.fades;
    if (fades.empty()) fades.assign(assembly.plates.size(), 0.0F);
    Vec3 low{HUGE_VAL, HUGE_VAL, 0};
    Vec3 high{-HUGE_VAL, -HUGE_VAL, 0};
    for (std::size_t i = 0; i < fades.size(); ++i) {
        if (fades[i] < 0.0F) continue;
        for (const Vec2 p : assembly.plates[i].outline.outer) {
            const Vec3 at = stage.frames[i].point(p);
            low = {std::min(low.x, at.x), std::min(low.y, at.y), 0};
            high = {std::max(high.x, at.x), std::max(high.y, at.y), 0};
        }
    }
    const double lift = kLiftShare * std::min(high.x - low.x, high.y - low.y);
    for (const int plate : scene.lifted) {
        Frame& frame = nth(stage.frames, plate);
        frame.origin = frame.origin + Vec3{0, 0, lift};
    }
    if (!scene.marked.empty()) look_at_marked(scene, assembly, stage);
    stage.model = modellers_[scene.card].staged(0, {stage.frames, fades, opening});
    add_marked(scene, assembly, stage);
    for (const int plate : scene.painted)
        add_coat(nth(assembly.plates, plate), nth(stage.frames, plate), kPaintedLight, stage.model);
    for (const Bond& bond : scene.bonds) {
        const Frame& frame = nth(stage.placed, bond.mate);
        const bool behind = bond.on_back || bond.theirs;
        const Vec3 out = (behind ? -kTargetLiftMm : kTargetLiftMm) * frame.normal();
        Box box;
        std::vector<Vec3> places;
        for (const Ring& ring : targets_of(card, bond)) {
            for (const Vec2 p : ring) box.extend(p);
            for (const Vec2 p : places_on(ring)) places.push_back(frame.point(p) + out);
            const Triangulation triangles = triangulate({ring, {}});
            still::Face& face = stage.model.faces.emplace_back();
            face.plate = stage.model.plates++;
            face.frame = frame;
            face.frame.origin = face.frame.origin + out;
            face.color = kTargetLight;
            for (const Vec2 p : triangles.points) face.points.push_back(face.frame.point(p));
            for (const auto& corners : triangles.triangles)
                face.indices.insert(face.indices.end(), corners.begin(), corners.end());
        }
        const auto guide = [&](Vec3 from, Vec3 to) {
            if (!scene.lifted.empty()) stage.model.edges.push_back({-1, from, to, kGuideInk});
        };
        if (bond.kind == Bond::Kind::tab) {
            const Glue& glue = nth(assembly.glue, bond.number);
            const Segment& own = bond.theirs ? glue.on_base : glue.on_piece;
            const Segment& other = bond.theirs ? glue.on_piece : glue.on_base;
            guide(nth(stage.frames, bond.plate).point(own.a), frame.point(other.a));
            guide(nth(stage.frames, bond.plate).point(own.b), frame.point(other.b));
        } else if (bond.kind == Bond::Kind::rivet) {
            const Vec2 rivet = *nth(assembly.plates, bond.number).rivet;
            const Vec3 at = nth(stage.placed, bond.plate).point(rivet);
            guide(nth(stage.frames, bond.plate).point(rivet), at);
            stage.marks.emplace_back(std::vector{at}, number_of(assembly, bond));
        } else if (!box.empty()) {
            guide(frame.point(box.centre()) + Vec3{0, 0, lift}, frame.point(box.centre()));
        }
        if (!places.empty()) stage.marks.emplace_back(std::move(places), number_of(assembly, bond));
    }
    return stage;
}

// The first place from which the most targets are seen, if what is lifted were not there.
Vec3 Illustrator::eye_for(const Scene& scene, const Stage& stage) const {
    constexpr double kEyeAwayMm = 1e4;
    const Assembly& assembly = *cards_[scene.card].assembly;
    std::vector<float> there = stage.fades;
    for (const int plate : scene.lifted) nth(there, plate) = -1.0F;
    Vec3 best = kEyes.front();
    int most = -1;
    for (const Vec3 eye : kEyes) {
        int seen = 0;
        for (const Bond& bond : scene.bonds) {
            const Frame& frame = nth(stage.placed, bond.mate);
            const Vec3 out = (bond.on_back || bond.theirs ? -1.0 : 1.0) * frame.normal();
            if (dot(out, unit(eye)) < 0.15) continue;
            for (const Ring& ring : targets_of(cards_[scene.card], bond)) {
                const Vec3 from = frame.point(places_on(ring).front()) + kTargetLiftMm * out;
                if (!is_hidden({assembly, stage.placed, there}, from, from + kEyeAwayMm * unit(eye))) ++seen;
            }
        }
        if (seen > most) {
            most = seen;
            best = eye;
        }
    }
    return best;
}

// All of it; nearer, where what is lifted would be small.
still::Framing Illustrator::framing_of(std::span<const Scene> scenes, std::span<const Stage> stages,
                                       PictureSize size) const {
    constexpr double kFilledByLifted = 0.5;
    constexpr double kNearest = 2.4;
    const Scene& first = scenes.front();
    const Vec3 eye = first.as_still       ? still::eye_of(View::iso)
                     : stages.front().eye ? *stages.front().eye
                                          : eye_for(first, stages.front());
    still::Framer framer(eye, size.width, size.height);
    for (const Stage& one : stages) framer.measure(one.model);
    for (const Stage& one : stages) framer.aim(one.model);
    still::Framing framing = framer.framing();
    framing.plain = true;
    Box seen;
    still::Camera& camera = framing.camera;
    for (const int plate : first.lifted) {
        for (const Vec2 p : nth(cards_[first.card].assembly->plates, plate).outline.outer) {
            for (const auto* const frames : {&stages.front().frames, &stages.front().placed}) {
                const still::Seen at = camera.see(nth(*frames, plate).point(p));
                seen.extend({at.x, at.y});
            }
        }
    }
    if (seen.empty()) return framing;
    const double fill = kFilledByLifted * std::min(size.width / seen.width(), size.height / seen.height());
    const double nearer = std::clamp(fill, 1.0, kNearest);
    camera.scale *= nearer;
    if (nearer <= 1.0) return framing;
    camera.cx = 0.5 * size.width - nearer * (seen.centre().x - camera.cx);
    camera.cy = 0.5 * size.height - nearer * (seen.centre().y - camera.cy);
    return framing;
}

// Numbers at the first place of each that is seen, and none on another.
std::vector<PictureMark> Illustrator::marks_of(const Scene& scene, const Stage& stage,
                                               const still::Camera& camera, PictureSize size) const {
    constexpr double kMarkHigh = 0.062;    // of the picture's height
    constexpr double kLetterWide = 0.021;  // of its width
    const Assembly& assembly = *cards_[scene.card].assembly;
    std::vector<PictureMark> marks;
    for (const auto& [places, text] : stage.marks) {
        const auto open = std::find_if(places.begin(), places.end(), [&](Vec3 p) {
            return !is_hidden({assembly, stage.frames, stage.fades}, p, camera.eye());
        });
        const still::Seen seen = camera.see(open == places.end() ? places.front() : *open);
        PictureMark mark{text, seen.x / size.width, seen.y / size.height};
        mark.x = std::clamp(mark.x, 0.03, 0.97);
        mark.y = std::clamp(mark.y, 0.04, 0.96);
        const auto is_taken = [&](const PictureMark& other) {
            const double wide =
                kLetterWide * (0.5 * static_cast<double>(mark.text.size() + other.text.size()) + 0.6);
            return std::abs(other.x - mark.x) < wide && std::abs(other.y - mark.y) < kMarkHigh;
        };
        const double down = mark.y > 0.5 ? -kMarkHigh : kMarkHigh;
        for (std::size_t tries = 0; tries <= marks.size(); ++tries) {
            if (std::none_of(marks.begin(), marks.end(), is_taken)) break;
            mark.y += down;
        }
        marks.push_back(std::move(mark));
    }
    return marks;
}

std::optional<std::vector<Picture>> Illustrator::draw(std::span<const Scene> scenes, PictureSize size,
                                                      Diagnostics& diagnostics) {
    std::vector<Stage> stages;
    for (const Scene& scene : scenes) {
        std::optional<Stage> made = stage(scene, diagnostics);
        if (!made) return std::nullopt;
        stages.push_back(std::move(*made));
    }
    const still::Framing framing = framing_of(scenes, stages, size);
    std::vector<Picture> pictures;
    for (std::size_t i = 0; i < stages.size(); ++i)
        pictures.push_back({still::render(stages[i].model, framing, size.width, size.height),
                            marks_of(scenes[i], stages[i], framing.camera, size)});
    return pictures;
}

}  // namespace popup::book
