// What stands above a target, or round it.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <tuple>
#include <vector>

#include "gluing/bonds.h"

namespace popup {

class InTheWay {
 public:
    // `order` has its card and bearers. All of these must outlive it.
    InTheWay(const Assembly& assembly, const std::vector<Bond>& bonds, const GluingOrder& order,
             const GluePoses& poses);
    ~InTheWay();
    InTheWay(const InTheWay&) = delete;
    InTheWay& operator=(const InTheWay&) = delete;

    // The pieces that are glued on `ground`, of which one, or something that it bears, stands above the
    // target of the bond: not the piece of the bond, nor what its mate belongs to. A ground that is not the
    // card lies unfolded on the table: there only what is glued to the same side of the same plate can be
    // above.
    [[nodiscard]] std::set<int> above(const Bond& bond, int ground) const;

    // Of each piece, those on the same ground that had better be glued before it: those above whose targets
    // it stands, and those that its feet enclose.
    [[nodiscard]] std::map<int, std::set<int>> wants() const;

 private:
    [[nodiscard]] int member(int piece, int ground) const;
    void add_enclosed(std::map<int, std::set<int>>& wants) const;

    struct Boxes;
    const Assembly& in_;
    const std::vector<Bond>& bonds_;
    const GluingOrder& order_;
    const GluePoses& poses_;
    std::set<std::tuple<int, int, bool>>
        glued_to_;  // pieces, and the plates and sides that they are glued to
    std::unique_ptr<Boxes> boxes_;
};

}  // namespace popup
