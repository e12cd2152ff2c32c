#include "support/live_view.h"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

namespace popup::test {

void LiveView::start(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {kPopupc, "view", "--no-browser"});
    options.environment.try_emplace("POPUPC_NO_CONFIG", "1");
    program = std::make_unique<Background>(arguments, options);
    EXPECT_TRUE(eventually([this] { return program->out().ends_with('\n') || !program->running(); }));
    address = program->out();
    ASSERT_TRUE(address.ends_with("/\n")) << address << program->err();
    address.pop_back();
    shown = nlohmann::json{{"version", 0}};
}

void LiveView::replace(const std::string& name, const std::string& bytes) const {
    write_file(scratch / "new", bytes);
    std::filesystem::rename(scratch / "new", scratch / name);
}

nlohmann::json LiveView::until(const std::function<bool(const nlohmann::json&)>& wanted) {
    const bool came = eventually([&] {
        if (wanted(shown)) return true;
        const HttpAnswer answer = get(address, "next?after=" + shown.at("version").dump());
        if (answer.status == 200) shown.update(nlohmann::json::parse(answer.body));
        return wanted(shown);
    });
    EXPECT_TRUE(came) << shown << program->err();
    return shown;
}

nlohmann::json LiveView::until_errors(std::size_t count) {
    return until(
        [count](const nlohmann::json& news) { return news.value("errors", std::size_t{999}) == count; });
}

nlohmann::json LiveView::until_model_with(const std::string& text) {
    return until([&text](const nlohmann::json& news) {
        return news.contains("model") && news.at("errors") == 0 &&
               news.at("model").dump().find(text) != std::string::npos;
    });
}

int LiveView::end(int signal) {
    program->send(signal);
    return program->wait();
}

}  // namespace popup::test
