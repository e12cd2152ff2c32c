// The tree of JSON that has its places.
#include <nlohmann/json.hpp>

#include "base/text/json_tree.h"
#include "fuzz/targets/target.h"

namespace popup::fuzz {

void look_at_json(std::string_view bytes) {
    Diagnostics told("fuzz.json");
    const auto tree = read_json(bytes, "oa-syntax", told);
    expect_told(told, bytes);
    expect(tree.has_value() == !told.has_errors(), "a tree, or an error");
    if (tree) expect(nlohmann::json::accept(bytes), "what is read is JSON");
}

}  // namespace popup::fuzz
