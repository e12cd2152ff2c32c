// Contacts from the stretches in which two plates are not certainly clear.
#pragma once

#include <span>
#include <vector>

#include "motion/pair_search.h"

namespace popup {

struct Contacts {
    std::vector<Contact> contacts;
    std::vector<Undecided> undecided;
};

// `stretches`: all of plates a and b, ascending. First and last angles are found to 1e-5° by halving and
// rounded to 0.001°; a contact that is still there at the least opening begins with the sweep. Plates that
// touch in between and stand on each other's other side afterwards have gone through each other: a contact as
// well.
void find_contacts(int a, int b, std::span<const ContactRange> stretches, PairSearch& search,
                   Contacts& result);

}  // namespace popup
