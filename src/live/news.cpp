#include "live/news.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace popup::live {

void Board::put(News news) {
    ++version_;
    texts_ = {};
    const nlohmann::ordered_json told{{"version", version_},
                                      {"errors", news.errors},
                                      {"trouble", std::move(news.trouble)},
                                      {"stale", news.stale},
                                      {"finding_count", news.finding_count},
                                      {"findings", std::move(news.findings)}};
    rest_ = told.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    rest_.pop_back();
    if (news.model) model_ = {std::move(*news.model), version_};
    if (news.sheets) sheets_ = {std::move(*news.sheets), version_};
}

std::shared_ptr<const std::string> Board::newer_than(std::uint64_t after) const {
    if (after == version_ || version_ == 0) return nullptr;
    if (after > version_) after = 0;
    const bool model = after < model_.since;
    const bool sheets = after < sheets_.since;
    auto& text = texts_.at((model ? 1U : 0U) + (sheets ? 2U : 0U));
    if (!text) {
        std::string all = rest_;
        if (model) all += ",\"model\":" + model_.json;
        if (sheets) all += ",\"sheets\":" + sheets_.json;
        text = std::make_shared<const std::string>(std::move(all) + "}");
    }
    return text;
}

}  // namespace popup::live
