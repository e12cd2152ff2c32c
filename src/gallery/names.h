// What the designs of a gallery are called, and the files that it has of them.
#pragma once

#include <string>
#include <vector>

namespace popup {

// One design of a library.
struct GalleryDesign {
    std::string file;   // as it was named, or found
    std::string label;  // its path from the library's root: "spring/castle.xml"
    std::string name;   // of its files, without a suffix: letters, digits, '-' and '_', at most 100
};

struct GalleryPlan {
    std::string root;                    // absolute: the deepest directory that all arguments have in common
    std::vector<GalleryDesign> designs;  // each once, by label_before()
};

// The designs of these files. `arguments` are what they were found by: directories, whose paths count
// themselves, and files, of which that of their directory counts. So labels are the same wherever the program
// runs and however its arguments are spelled. What is not on the disk keeps the name that it would have.
//
// A name follows from the label alone, so that a design that comes or goes changes no other's: that of
// "castle.xml" is "castle", all others end in a part of the label's SHA-256, which also tells apart what
// differs by case only. Precondition: no argument is "-" or empty.
GalleryPlan plan_gallery(const std::vector<std::string>& arguments, const std::vector<std::string>& files);

// The order of tiles: ASCII letters whatever their case, digits by their value, then the bytes.
bool label_before(const std::string& a, const std::string& b);

// Any bytes as ASCII that can stand in JSON, and back: what is not printable, '%' among it, is "%0A".
std::string escaped_name(const std::string& name);
std::string unescaped_name(const std::string& text);

}  // namespace popup
