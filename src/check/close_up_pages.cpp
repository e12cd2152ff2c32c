// What goes when a glued element goes: the page of its piece.
#include <algorithm>
#include <vector>

#include "popup/check.h"

namespace popup {

void close_up_pages(Design& design) {
    std::vector<int> renamed{0};
    int next = 1;
    for (const Structure& structure : design.structures) {
        if (find_element(structure.type)->glued) renamed.push_back(structure.dropped ? -1 : next++);
    }
    const auto rename = [&](int old) {
        return old >= 0 && old < static_cast<int>(renamed.size()) ? renamed[static_cast<std::size_t>(old)]
                                                                  : old;
    };
    for (Structure& structure : design.structures) {
        if (structure.dropped) continue;
        const int to = rename(structure.ground_page());
        if (!structure.named().given() && to != structure.ground_page()) {
            (structure.plate ? structure.plate->page : structure.fold.page) = to;
            (structure.plate ? structure.plate->page_changed : structure.fold.page_changed) = true;
        }
        const auto rename_of = [&](auto& drawn) {
            if (!drawn.page || rename(*drawn.page) == *drawn.page) return;
            drawn.page = rename(*drawn.page);
            drawn.changed = true;
        };
        for (DesignPoint& point : structure.points) rename_of(point);
        for (Argument& argument : structure.arguments) rename_of(argument);
    }
    const auto rename_printed = [&rename](auto& printed) {
        const int to = rename(printed.page);
        if (to == printed.page) return;
        printed.dropped = to < 0;
        printed.page_changed = !printed.dropped;
        printed.page = std::max(to, 0);
    };
    for (DrawnLine& line : design.lines) rename_printed(line);
    for (DrawnPrint& print : design.prints) rename_printed(print);
}

}  // namespace popup
