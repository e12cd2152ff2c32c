// A document while it is edited.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "edit/quick_look.h"
#include "popup/check.h"
#include "popup/design.h"
#include "popup/diagnostics.h"
#include "popup/edit.h"
#include "popup/mechanism.h"

namespace popup::edit {

// An edit taken apart: "copy bird --times 3 --mirror".
struct Command {
    std::string verb;
    std::vector<std::string> words;                            // that are neither options nor their values
    std::vector<std::pair<std::string, std::string>> options;  // in their order; flags have no value
    [[nodiscard]] const std::string* find(std::string_view name) const;
    [[nodiscard]] bool has(std::string_view name) const { return find(name) != nullptr; }
};

class Session {
 public:
    Session(Design read, std::string folder, const Tolerances& tolerances, Diagnostics& said)
        : design(std::move(read)), folder_(std::move(folder)), tolerances_(tolerances), said_(said) {}

    Design design;
    std::vector<TextRange> gone;  // of structures that were taken out
    Place place;                  // of the edit

    // An error; always false.
    bool fail(std::string_view code, std::string what, std::string hint = {});
    void remark(std::string_view code, std::string what, std::string hint);
    // The structure of that id; an error, with the id that is most like it, when there is none.
    std::optional<std::size_t> find(std::string_view id);
    // What the n-th structure stands on, as the design is now. Precondition: there is one.
    const Standing& standing(std::size_t n);
    const CardFolds& card();
    // Something about a structure has changed: what stands on its folds is looked at anew when it is asked
    // for.
    void touch(std::size_t n) {
        touched_.insert(n);
        is_as_read_ = false;
    }
    // What card() tells has been kept up with the changes.
    void kept_up() { touched_.clear(); }
    // Structures came, went or changed places.
    void forget() {
        card_.reset();
        is_as_read_ = false;
    }
    CardFolds* known() { return card_ ? &*card_ : nullptr; }
    // How the card stood as it was read, if that was asked for before anything was changed.
    [[nodiscard]] std::optional<Owners> take_owners() { return std::move(owners_); }
    // Takes one out of the design, with what is printed on the page of its piece.
    void take_out(std::size_t n);
    // Raises the version of the document, where it needs that.
    void need_version(std::string_view version);
    [[nodiscard]] const std::string& folder() const { return folder_; }
    [[nodiscard]] const Tolerances& tolerances() const { return tolerances_; }

    static const ElementInfo& info_of(const Structure& structure);
    static std::vector<Vec2> points_of(const Structure& structure);
    // The points as measures see them, on the fold that a structure stands on: a point of the fold itself is
    // on the page to the left of it, wherever it is given. on_pages() takes them back to where they are
    // given.
    static std::vector<Vec2> points_of(const Structure& structure, const PageFold& seen);
    static void on_pages(const Structure& structure, const PageFold& seen, std::vector<Vec2>& points);
    // Gives a structure these arguments; a path that would not move stays as it is, to the last digit.
    static void take_arguments(Structure& structure, std::vector<Argument> arguments);
    // Gives a structure other points and drawn values; false after an error.
    bool write(std::size_t n, const Shaped& shaped);

    // A value with a unit of its own, or in the document's; degrees. Errors name what they are for.
    std::optional<double> length(std::string_view name, std::string_view text);
    std::optional<double> angle(std::string_view name, std::string_view text);
    std::optional<Vec2> point(std::string_view name, std::string_view text);
    std::optional<int> count(std::string_view name, std::string_view text, int least, int most);
    // A measure or parameter; false after an error. Measures are set in `measures`.
    bool set_value(std::size_t n, std::string_view name, const std::string& text,
                   std::vector<double>& measures, bool& measured);
    bool set_parameter(Structure& structure, const ElementInfo& info, std::size_t number,
                       const std::string& text);

 private:
    void look();

    std::string folder_;
    Tolerances tolerances_;
    Diagnostics& said_;
    std::optional<CardFolds> card_;
    std::set<std::size_t> touched_;
    bool is_as_read_ = true;
    std::optional<Owners> owners_;
};

// A kind of element in a sentence: "a tent", "an attached-plane".
std::string with_article(std::string_view kind);

// Moves with a structure, that has been changed, everything that stands on it and gives its points on pages.
//
//     const Followers followers(session, n);  // before
//     ...
//     followers.follow(session);              // after
class Followers {
 public:
    Followers(Session& session, std::size_t n);
    void follow(Session& session) const;

 private:
    struct One {
        std::size_t number;
        std::vector<PageFold> before;  // its folds, on pages
    };
    std::vector<One> all_;  // the structure, and what stands on it, in build order
};
// The folds of a structure on their pages, as its points mean them to be.
std::vector<PageFold> folds_on_pages(Session& session, std::size_t n);

// One function an edit; false after an error.
struct Row {
    EditVerb verb;
    std::vector<std::string_view> flags;    // options without a value
    std::vector<std::string_view> options;  // with one; empty: any
    std::size_t least_words = 1, most_words = 1;
    bool (*run)(Session&, const Command&) = nullptr;
};
std::span<const Row> rows();

bool set(Session& session, const Command& command);
bool move(Session& session, const Command& command);
bool move_point(Session& session, const Command& command);
bool add(Session& session, const Command& command);
bool copy(Session& session, const Command& command);
bool take_out(Session& session, const Command& command);
bool rename(Session& session, const Command& command);
bool outline(Session& session, const Command& command);

}  // namespace popup::edit
