#include "support/nest_instances.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>

namespace popup::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Counter-clockwise (or clockwise), without the point that closes it.
Ring oriented(Ring ring, bool counter_clockwise) {
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    if (ring.size() < 3 || signed_area(ring) == 0.0) throw std::runtime_error("a ring without an area");
    if ((signed_area(ring) > 0.0) != counter_clockwise) std::reverse(ring.begin(), ring.end());
    return ring;
}

void add_items(NestJob& job, NestKind kind, int copies) {
    const auto number = static_cast<int>(job.kinds.size());
    job.kinds.push_back(std::move(kind));
    for (int i = 0; i < copies; ++i) job.items.push_back({number, -1, std::nullopt});
}

double outline_area(const NestKind& kind) {
    double sum = 0.0;
    for (const Polygon& polygon : kind.outline) sum += area(polygon);
    return sum;
}

double items_area(const NestJob& job) {
    double sum = 0.0;
    for (const NestItem& item : job.items)
        sum += outline_area(job.kinds[static_cast<std::size_t>(item.kind)]);
    return sum;
}

// Whatever the order, rows of boxes fit into this length: no row but the last is less than half full.
double ample_length(const NestJob& job, double height) {
    double boxes = 0.0;
    double longest = 0.0;
    for (const NestItem& item : job.items) {
        Box box;
        for (const Polygon& polygon : job.kinds[static_cast<std::size_t>(item.kind)].outline) {
            for (const Vec2 p : polygon.outer) box.extend(p);
        }
        const double longer = std::max(box.width(), box.height());
        boxes += longer * longer;
        longest = std::max(longest, longer);
    }
    return std::ceil(4.0 * boxes / height + 2.0 * longest);
}

json read_json(const fs::path& path) {
    std::ifstream in(path);
    return json::parse(in);
}

NestJob read_strip(const fs::path& path) {
    const json file = read_json(path);
    NestJob job;
    for (const json& item : file.at("items")) {
        if (item.at("shape").at("type") != "simple_polygon") throw std::runtime_error("not a simple polygon");
        Ring ring;
        for (const json& p : item["shape"].at("data")) ring.push_back({p.at(0), p.at(1)});
        NestKind kind{{{oriented(std::move(ring), true), {}}}, {}};
        for (const json& turn : item.at("allowed_orientations")) kind.turns.push_back(Angle::degrees(turn));
        add_items(job, std::move(kind), item.at("demand"));
    }
    const double height = file.at("strip_height");
    job.stock.push_back({ample_length(job, height), height, 1});
    return job;
}

std::ifstream open_numbers(const fs::path& path) {
    std::ifstream in(path);
    in.imbue(std::locale::classic());
    in.exceptions(std::ios::failbit | std::ios::badbit);
    return in;
}

Ring read_ring(std::istream& in) {
    std::size_t points = 0;
    in >> points;
    Ring ring(points);
    for (Vec2& p : ring) in >> p.x >> p.y;
    return oriented(std::move(ring), true);
}

NestJob read_bins(const fs::path& path) {
    std::ifstream in = open_numbers(path);
    NestJob job;
    std::size_t pieces = 0;
    NestStock stock;
    in >> pieces >> stock.width >> stock.height;
    job.stock.push_back(stock);
    for (std::size_t i = 0; i < pieces; ++i) add_items(job, {{{read_ring(in), {}}}}, 1);
    return job;
}

Ring read_vertices(const json& shape, bool counter_clockwise) {
    if (shape.value("type", "polygon") != "polygon")
        throw std::runtime_error("a shape that is not a polygon");
    Ring ring;
    for (const json& p : shape.at("vertices")) ring.push_back({p.at("x"), p.at("y")});
    return oriented(std::move(ring), counter_clockwise);
}

Polygon read_shape(const json& shape) {
    Polygon polygon{read_vertices(shape, true), {}};
    if (!shape.contains("holes")) return polygon;
    for (const json& hole : shape["holes"]) polygon.holes.push_back(read_vertices(hole, false));
    return polygon;
}

NestJob read_cutting(const fs::path& path) {
    const json file = read_json(path);
    NestJob job;
    if (file.contains("parameters")) job.spacing = file["parameters"].value("item_item_minimum_spacing", 0.0);
    for (const json& bin : file.at("bin_types")) {
        if (bin.value("type", "rectangle") != "rectangle")
            throw std::runtime_error("a sheet with corners cut");
        const double margin = bin.value("item_bin_minimum_spacing", 0.0);
        job.stock.push_back({bin.at("width").get<double>() - 2.0 * margin,
                             bin.at("height").get<double>() - 2.0 * margin, bin.value("copies", -1)});
    }
    for (const json& item : file.at("item_types")) {
        NestKind kind;
        if (item.contains("shapes")) {
            for (const json& shape : item["shapes"]) kind.outline.push_back(read_shape(shape));
        } else {
            kind.outline.push_back(read_shape(item));
        }
        if (item.contains("allowed_rotations")) {
            kind.turns.clear();
            for (const json& range : item["allowed_rotations"]) {
                if (range.at("start") != range.at("end")) throw std::runtime_error("a range of rotations");
                kind.turns.push_back(Angle::degrees(range["start"]));
            }
        }
        add_items(job, std::move(kind), item.value("copies", 1));
    }
    return job;
}

fs::path optimum_path(const fs::path& bins, const std::string& stem) { return bins / ("Op" + stem + ".txt"); }

int read_optimum(const fs::path& path) {
    int sheets = 0;
    if (fs::exists(path)) open_numbers(path) >> sheets;
    return sheets;
}

NestInstance read_instance(NestInstance::Form form, const std::string& name, const fs::path& path) {
    NestInstance instance;
    instance.form = form;
    instance.name = name;
    try {
        switch (form) {
            case NestInstance::Form::strip:
                instance.job = read_strip(path);
                break;
            case NestInstance::Form::bins:
                instance.job = read_bins(path);
                instance.optimum = read_optimum(optimum_path(path.parent_path(), path.stem().string()));
                break;
            case NestInstance::Form::cutting:
                instance.job = read_cutting(path);
                break;
        }
    } catch (const std::exception& what) {
        throw std::runtime_error(path.string() + ": " + what.what());
    }
    instance.area = items_area(instance.job);
    return instance;
}

// Numbers from a seed, equal on every machine: the standard's distributions are not.
class Dice {
 public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    double between(double low, double high) {
        // To hundredths, so that no rounding of the machine's mathematics reaches the job.
        const double share = static_cast<double>(engine_() >> 11) / 9007199254740992.0;
        return std::round(100.0 * (low + share * (high - low))) / 100.0;
    }
    int below(int end) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(end)); }

 private:
    std::mt19937_64 engine_;
};

Vec2 hundredths(Vec2 p) { return {std::round(100.0 * p.x) / 100.0, std::round(100.0 * p.y) / 100.0}; }

Polygon star(Dice& dice) {
    const int points = 4 + dice.below(4);
    const double outer = dice.between(14, 38);
    const double inner = dice.between(0.35, 0.75) * outer;
    Ring ring;
    for (int i = 0; i < 2 * points; ++i) {
        const double radius = (i % 2 == 0 ? outer : inner) * dice.between(0.85, 1.0);
        ring.push_back(hundredths(rotated({radius, 0.0}, i * std::numbers::pi / points)));
    }
    return {ring, {}};
}

Polygon crescent(Dice& dice) {
    const double radius = dice.between(18, 40);
    const double depth = dice.between(0.3, 0.7) * radius;
    constexpr int kChords = 10;
    Ring ring;
    for (int i = 0; i <= kChords; ++i) {
        ring.push_back(hundredths(rotated({radius, 0.0}, i * std::numbers::pi / kChords)));
    }
    for (int i = 1; i < kChords; ++i) {
        const double x = -radius + 2.0 * radius * i / kChords;
        const double share = x / radius;
        ring.push_back(hundredths({x, depth * (1.0 - share * share)}));
    }
    return {ring, {}};
}

Polygon bracket(Dice& dice) {
    const double w = dice.between(25, 80);
    const double h = dice.between(25, 80);
    const double a = dice.between(6, 14);
    const double b = dice.between(6, 14);
    return {{{0, 0}, {w, 0}, {w, a}, {b + 0.2 * w, a}, {b, a + 0.2 * h}, {b, h}, {0, h}}, {}};
}

Polygon comb(Dice& dice) {
    const int teeth = 2 + dice.below(3);
    const double pitch = dice.between(12, 18);
    const double back = dice.between(5, 10);
    const double length = dice.between(12, 40);
    Ring ring{{0, 0}, {teeth * pitch, 0}};
    for (int i = teeth - 1; i >= 0; --i) {
        ring.push_back(hundredths({i * pitch + pitch, back}));
        ring.push_back(hundredths({i * pitch + 0.7 * pitch, back + length}));
        ring.push_back(hundredths({i * pitch + 0.3 * pitch, back + length}));
        ring.push_back(hundredths({i * pitch + 0.1 * pitch, back}));
    }
    ring.push_back({0, back});
    return {ring, {}};
}

Polygon frame(Dice& dice) {
    const double w = dice.between(35, 80);
    const double h = dice.between(35, 80);
    const double rim = dice.between(5, 9);
    const Ring hole{{rim, rim}, {rim, h - rim}, {w - rim, h - rim}, {w - rim, rim}};
    return {{{0, 0}, {w, 0}, {w, h}, {0.5 * w, h + rim}, {0, h}}, {hole}};
}

}  // namespace

std::optional<fs::path> nest_data() {
    const char* named = std::getenv("POPUP_NEST_DATA");
    const fs::path path = named != nullptr && *named != '\0'
                              ? fs::path(named)
                              : fs::path(POPUP_SOURCE_DIR).parent_path() / "shared/data/nesting";
    std::error_code ignored;
    return fs::is_directory(path / "strip", ignored) ? std::optional(path) : std::nullopt;
}

std::vector<NestInstance> nest_instances(const fs::path& data, const std::vector<std::string>& words) {
    struct Folder {
        NestInstance::Form form;
        const char* name;
        const char* extension;
    };
    std::vector<NestInstance> result;
    for (const Folder& folder : {Folder{NestInstance::Form::strip, "strip", ".json"},
                                 Folder{NestInstance::Form::bins, "bins", ".txt"},
                                 Folder{NestInstance::Form::cutting, "jobs", ".json"}}) {
        std::vector<fs::path> paths;
        if (!fs::is_directory(data / folder.name)) continue;
        for (const auto& entry : fs::directory_iterator(data / folder.name)) {
            const bool solution = entry.path().filename().string().starts_with("Op");
            if (entry.path().extension() == folder.extension && !solution) paths.push_back(entry.path());
        }
        std::sort(paths.begin(), paths.end());
        for (const fs::path& path : paths) {
            const std::string name = folder.name + ("/" + path.stem().string());
            const bool wanted =
                words.empty() || std::any_of(words.begin(), words.end(), [&](const std::string& word) {
                    return name.find(word) != std::string::npos;
                });
            if (wanted) result.push_back(read_instance(folder.form, name, path));
        }
    }
    return result;
}

std::optional<NestSolution> nest_optimum(const fs::path& data, const std::string& name) {
    const fs::path path = optimum_path(data / "bins", fs::path(name).filename().string());
    if (!fs::exists(path)) return std::nullopt;
    std::ifstream in = open_numbers(path);
    std::size_t sheets = 0;
    in >> sheets;
    std::vector<int> on_sheet(sheets);
    for (int& pieces : on_sheet) in >> pieces;
    NestSolution result;
    NestStock stock;
    in >> stock.width >> stock.height;
    result.job.stock.push_back(stock);
    for (std::size_t sheet = 0; sheet < sheets; ++sheet) {
        Vec2 used;
        for (int i = 0; i < on_sheet[sheet]; ++i) {
            Ring ring = read_ring(in);
            for (const Vec2 p : ring) used = {std::max(used.x, p.x), std::max(used.y, p.y)};
            add_items(result.job, {{{std::move(ring), {}}}}, 1);
            result.plan.spots.push_back({static_cast<int>(sheet), {}, {}});
        }
        result.plan.sheets.push_back(0);
        result.plan.used.push_back(used);
    }
    return result;
}

NestInstance large_nest_instance(int items, std::uint64_t seed) {
    using Make = Polygon (*)(Dice&);
    constexpr std::array<Make, 5> kForms{star, crescent, bracket, comb, frame};
    constexpr int kOfAKind = 5;
    NestInstance instance;
    instance.form = NestInstance::Form::cutting;
    instance.name = "large/" + std::to_string(items);
    Dice dice(seed);
    for (int made = 0; made < items; made += kOfAKind) {
        const Make make = kForms[static_cast<std::size_t>(made / kOfAKind) % kForms.size()];
        NestKind kind{{make(dice)}, {}};
        for (const double turn : {0.0, 90.0, 180.0, 270.0}) kind.turns.push_back(Angle::degrees(turn));
        add_items(instance.job, std::move(kind), std::min(kOfAKind, items - made));
    }
    instance.job.stock.push_back({420.0, 297.0, -1});
    instance.job.spacing = 2.0;
    instance.area = items_area(instance.job);
    return instance;
}

}  // namespace popup::test
