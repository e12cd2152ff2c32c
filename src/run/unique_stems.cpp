#include "run/unique_stems.h"

#include <map>
#include <set>
#include <utility>

namespace popup {

std::vector<std::string> unique_stems(std::vector<std::string> stems) {
    std::set<std::string> taken(stems.begin(), stems.end());
    std::map<std::string, int> used;  // stem as given → the last number given out for it
    for (std::string& stem : stems) {
        int& last = used[stem];
        if (++last == 1) continue;
        std::string name = stem + "~" + std::to_string(last);
        while (!taken.insert(name).second) name = stem + "~" + std::to_string(++last);
        stem = std::move(name);
    }
    return stems;
}

}  // namespace popup
