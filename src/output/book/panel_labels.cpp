#include "output/book/panel_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace popup::book {
namespace {

// The least room that a drawing is given on the pages of either book, and its letters there.
constexpr double kWideMm = 152.0;
constexpr double kHighMm = 110.0;
constexpr double kCapMm = 2.0;
constexpr double kLetterCaps = 0.92;  // how wide a letter is, in heights of capitals; hardly ever more
constexpr double kRimCaps = 0.9;      // of both ends of a label
constexpr double kHighCaps = 1.9;

class Settler {
 public:
    explicit Settler(Figure& figure)
        : figure_(figure), scale_(std::min({1.0, kWideMm / figure.width_mm, kHighMm / figure.height_mm})) {}

    std::string run() {
        named_.assign(figure_.labels.size(), true);
        has_briefs_ = figure_.letters_only;
        for (std::size_t i = 0; i < named_.size(); ++i) {
            Figure::Label& label = figure_.labels[i];
            has_briefs_ = has_briefs_ || !label.brief.empty();
            if (label.room_mm <= 0.0 || box_of(label.text, {}).width() <= scale_ * label.room_mm) continue;
            // It would lie on what is beside, and nobody could tell which of them it names.
            if (label.brief.empty()) named_[i] = false;
            if (!label.brief.empty()) label.text = label.brief;
        }
        while (!are_placed()) {
        }
        return write();
    }

 private:
    // On the page.
    [[nodiscard]] Box box_of(const std::string& text, Vec2 at) const {
        const Vec2 middle = scale_ * at;
        const Vec2 half{0.5 * kCapMm * (kLetterCaps * static_cast<double>(text.size()) + kRimCaps),
                        0.5 * kCapMm * kHighCaps};
        Box box;
        box.extend(middle - half);
        box.extend(middle + half);
        return box;
    }
    static bool overlap(const Box& a, const Box& b) {
        return a.min.x < b.max.x && b.min.x < a.max.x && a.min.y < b.max.y && b.min.y < a.max.y;
    }
    [[nodiscard]] bool is_free(const Box& box) const {
        return std::none_of(taken_.begin(), taken_.end(),
                            [&box](const Box& other) { return overlap(other, box); });
    }
    [[nodiscard]] std::optional<Vec2> free_place(const Figure::Label& label, const std::string& text) const {
        std::vector<Vec2> places{label.at};
        places.insert(places.end(), label.others.begin(), label.others.end());
        const auto found =
            std::find_if(places.begin(), places.end(), [&](Vec2 at) { return is_free(box_of(text, at)); });
        return found == places.end() ? std::nullopt : std::optional(*found);
    }

    // What is shown in place of a name, after so many others: its brief, or the next number of the list.
    [[nodiscard]] std::string short_for(std::size_t label, std::size_t listed) const {
        if (!figure_.labels[label].brief.empty()) return figure_.labels[label].brief;
        if (!has_briefs_) return std::to_string(listed + 1);
        std::string letters;
        for (std::size_t rest = listed + 1; rest > 0; rest = (rest - 1) / 26)
            letters.insert(letters.begin(), static_cast<char>('a' + (rest - 1) % 26));
        return letters;
    }
    [[nodiscard]] bool is_listed(std::size_t label) const { return figure_.labels[label].brief.empty(); }

    [[nodiscard]] const std::string& name(std::size_t label) const { return figure_.labels[label].text; }

    // Names that have room stay, and the others become numbers. False: a number has none, because a name is
    // in its way, which is not to stay then.
    bool are_placed() {
        taken_.clear();
        places_.assign(figure_.labels.size(), std::nullopt);
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < named_.size(); ++i) {
            if (named_[i]) order.push_back(i);
        }
        std::stable_sort(order.begin(), order.end(),
                         [this](std::size_t a, std::size_t b) { return name(a).size() < name(b).size(); });
        for (const std::size_t i : order) {
            const Box box = box_of(name(i), figure_.labels[i].at);
            named_[i] = is_free(box);
            if (!named_[i]) continue;
            taken_.push_back(box);
            places_[i] = figure_.labels[i].at;
        }
        std::size_t numbers = 0;
        for (std::size_t i = 0; i < named_.size(); ++i) {
            if (named_[i]) continue;
            const std::string text = short_for(i, numbers);
            places_[i] = free_place(figure_.labels[i], text);
            if (!places_[i] && take_name_from(box_of(text, figure_.labels[i].at))) return false;
            if (!places_[i]) continue;
            taken_.push_back(box_of(text, *places_[i]));
            if (is_listed(i)) ++numbers;
        }
        return true;
    }

    // Of a label whose name is there; false where none is.
    bool take_name_from(const Box& box) {
        for (std::size_t i = 0; i < named_.size(); ++i) {
            if (!named_[i] || !overlap(box_of(name(i), figure_.labels[i].at), box)) continue;
            named_[i] = false;
            return true;
        }
        return false;
    }

    std::string write() {
        std::vector<std::string> listed;
        std::vector<Figure::Label> labels;
        std::vector<std::string> short_of(named_.size());
        std::size_t numbers = 0;
        for (std::size_t i = 0; i < named_.size(); ++i) {
            if (named_[i] || !places_[i]) continue;
            short_of[i] = short_for(i, numbers);
            if (is_listed(i)) ++numbers;
        }
        for (std::size_t i = 0; i < named_.size(); ++i) {
            if (!places_[i]) continue;
            Figure::Label& label = labels.emplace_back(std::move(figure_.labels[i]));
            label.at = *places_[i];
            const std::string text = named_[i] ? label.text : short_of[i];
            if (!named_[i] && label.brief.empty()) listed.push_back(fmt::format("{} = {}", text, label.text));
            label.text = text;
            label.brief.clear();
        }
        figure_.labels = std::move(labels);
        return listed.empty() ? std::string() : fmt::format("In the drawing: {}.", fmt::join(listed, ", "));
    }

    Figure& figure_;
    double scale_;
    bool has_briefs_ = false;
    std::vector<Box> taken_;
    std::vector<bool> named_;                  // labels that keep their names
    std::vector<std::optional<Vec2>> places_;  // none: left out
};

}  // namespace

std::string settle_labels(Figure& figure) { return Settler(figure).run(); }

}  // namespace popup::book
