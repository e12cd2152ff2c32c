// `popupc view` beside a test.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/background.h"
#include "support/run_program.h"
#include "support/wire.h"

namespace popup::test {

// A live view of files in a scratch directory, without a browser.
class LiveView {
 public:
    LiveView() { options.directory = scratch.path(); }
    LiveView(const LiveView&) = delete;
    LiveView& operator=(const LiveView&) = delete;
    ~LiveView() = default;

    // Starts it and waits for its address.
    void start(std::vector<std::string> arguments = {"card.xml"});
    // Puts a new file in the place of the old one, as editors do.
    void replace(const std::string& name, const std::string& bytes) const;
    // Asks for news until `wanted` likes what is shown, and gives that: the last news, with the last model
    // and sheets. Null, and a failure, when it takes a minute.
    nlohmann::json until(const std::function<bool(const nlohmann::json&)>& wanted);
    // The title of the model; until it has this many errors, or sheets.
    nlohmann::json until_errors(std::size_t count);
    nlohmann::json until_model_with(const std::string& text);
    // Signals it, and gives its exit status.
    int end(int signal);

    ScratchDirectory scratch;
    RunOptions options;
    std::unique_ptr<Background> program;
    std::string address;
    nlohmann::json shown;  // as a page would have it
};

}  // namespace popup::test
