// check() at work.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "check/fold_index.h"
#include "check/paper.h"
#include "check/placing.h"
#include "check/plate_index.h"
#include "mechanism/element.h"
#include "popup/check.h"

namespace popup {

// Equal where all points are.
std::size_t hash_of_points(const Structure& structure);

struct Checker {
    const Design& authored;
    const CheckOptions& options;
    Diagnostics& diagnostics;
    Design design;
    std::shared_ptr<Skeleton> skeleton = std::make_shared<Skeleton>();
    Builder builder{*skeleton};
    FoldIndex index;
    PlateIndex plates;
    PaperMap paper;
    std::vector<Fold>
        ghosts;     // folds of elements that could not be made, so that what stands on them is left in peace
    int pages = 1;  // pages that exist so far
    std::size_t current = 0;  // number of the structure that is looked at
    std::vector<bool> redrawn{
        false};  // of each page: its piece was drawn mirrored, and the document is mended
    // Of each structure, what it made: numbers of its first fold, of the first of its folds that would have
    // been, and of its first plate; -1: none.
    struct Made {
        int fold = -1, ghost = -1, plate = -1;
    };
    std::vector<Made> made;
    // Structures that are cut from their page, by hash_of_points().
    std::unordered_multimap<std::size_t, std::size_t> same_points;
    // Pages that may still be looked at for a fold that is not where it should be.
    std::size_t page_looks_left = 20'000;
    // Exchanges of points that may still be tried: thousands of elements may need one.
    std::size_t trials_left = 20'000;
    // For folds_of_card(): filled as structures are reached.
    CardFolds* names = nullptr;
    std::vector<std::optional<std::size_t>> which_of;  // of each structure, the fold of its owner's row
    std::unordered_map<std::string, std::size_t> numbers;

    Checker(const Design& input, const CheckOptions& opts, Diagnostics& diags)
        : authored(input),
          options(opts),
          diagnostics(diags),
          design(input),
          paper(opts.tolerances),
          made(input.structures.size()) {}

    std::optional<CheckedDesign> run();
    void note_folds();

 private:
    void check_structure(std::size_t number);
    bool ground_is_named(const Structure& structure, const ElementInfo& info, const Placing& placing);
    bool stand(Structure& structure, Placing& placing);
    std::optional<PlateMatch> plate_of(const Structure& structure, const Placing& placing) const;
    bool stand_on_plate(Structure& structure, Placing& placing);
    void no_plate(const Structure& structure, const Placing& placing);
    PaperQuery query_of(const Element& element) const;
    bool make(Structure& structure, Placing& placing);
    // What is said of an element once it is known whether it can be made.
    struct Told {
        Severity severity;
        std::string code, what, hint;
        std::optional<Change> change;
    };
    void tell(const Structure& structure, const Placing& placing, std::vector<Told> findings, bool failed);
    std::string neighbours(const Placing& placing, std::vector<Related>& related) const;
    std::string page_word(int page) const;
    std::vector<int> pages_with_its_fold(const Structure& structure, const Placing& placing);
    const Structure* original_of(const Structure& structure) const;
    bool points_are_exchanged(const Structure& structure, const Placing& placing, const FoldMatch* match);
    bool needs_no_repair(const Structure& trial, const Placing& of, const FoldMatch* match);
    void lower(const Placing& placing, const Element& before);
    std::string owner_of(int plate) const;
    enum class Foothold { beside, cut_away, stands };
    Foothold look(Placing& placing, const FoldMatch& match, double slack) const;
    static double middle_on(const Placing& placing, const Fold& fold);
    void follow(const Placing& placing, int page, std::vector<FoldMatch>& matches) const;
    std::optional<FoldMatch> find_fold(const Structure& structure, Placing& placing);
    bool beyond_its_fold(const Structure& structure, const Placing& placing);
    void no_fold(const Structure& structure, const Placing& placing, const FoldMatch* dead);
    bool may_stand(const Structure& structure, const Placing& placing);
    void keep_ghost(const Element& before);
    std::optional<FoldMatch> named_fold(const Structure& structure) const;
    std::optional<PlateMatch> named_plate(const Structure& structure) const;
    PageFold fold_lines_of(const FoldMatch& match) const;
    std::optional<PageFold> beside(const Structure& structure) const;
    void note(std::size_t number, const Placing& placing);
    [[nodiscard]] std::optional<std::size_t> owner_number(const std::string& id) const;
    void drop(Structure& structure);
    bool page_is_there(int page, Place place, std::string_view what);
    const Fold& fold_of(const FoldMatch& match) const {
        const auto number = static_cast<std::size_t>(match.fold);
        return match.ghost ? ghosts[number] : skeleton->folds[number];
    }
};

}  // namespace popup
