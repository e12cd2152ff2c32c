// What pages are told: what is to be shown now, and since when.
//
//     Board board;
//     board.put({.model = R"({"title":"castle"})"});
//     board.newer_than(0);  // {"version":1,…,"model":{"title":"castle"}}
//     board.put({.errors = 1, .trouble = "<ul>…</ul>", .stale = true});
//     board.newer_than(1);  // the same without a model: the page has the last one
//     board.newer_than(2);  // null
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace popup::live {

// What came of a save.
struct News {
    // JSON; none: the last ones stay.
    std::optional<std::string> model = {};
    std::optional<std::string> sheets = {};
    std::size_t errors = 0;
    std::string trouble = {};  // the errors, as markup
    bool stale = false;        // the model is older than the errors
    std::size_t finding_count = 0;
    std::string findings = {};  // all of them, as markup
};

// Remembers the last news, the last model and the last sheets, and nothing before.
class Board {
 public:
    void put(News news);
    // Of what was put last; 0: nothing was.
    [[nodiscard]] std::uint64_t version() const { return version_; }
    // What a page has to be told that shows version `after`, as JSON: {version, errors, trouble, stale,
    // finding_count, findings}, and `model` and `sheets` where the page does not have the last ones. Null
    // where there is nothing new. A page that shows what was never put is told all. Cost: that of the text,
    // once for all pages that have the same.
    [[nodiscard]] std::shared_ptr<const std::string> newer_than(std::uint64_t after) const;

 private:
    // What stays when later news have none; `since`: when it was put, 0: never.
    struct Kept {
        std::string json;
        std::uint64_t since = 0;
    };
    std::uint64_t version_ = 0;
    std::string rest_;  // the news but for these two, without the brace that closes them
    Kept model_;
    Kept sheets_;
    mutable std::array<std::shared_ptr<const std::string>, 4> texts_;  // made when they are asked for
};

}  // namespace popup::live
