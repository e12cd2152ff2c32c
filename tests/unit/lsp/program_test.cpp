// The verb as editors start it: a process, streams, exit codes; and a real client, Neovim.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lsp/frames.h"
#include "support/run_program.h"

namespace popup::test {
namespace {

using Json = nlohmann::json;

std::string message(const Json& body) { return lsp::framed(body.dump()); }

const std::string kGreeting =
    message({{"id", 1}, {"method", "initialize"}, {"params", {{"capabilities", Json::object()}}}});
const std::string kFarewell = message({{"id", 9}, {"method", "shutdown"}}) + message({{"method", "exit"}});

std::vector<Json> messages(const std::string& out) {
    lsp::FrameReader reader;
    reader.push(out);
    std::vector<Json> all;
    while (auto frame = reader.next()) all.push_back(Json::parse(frame->body));
    return all;
}

TEST(LspProgram, EndsAsItIsAskedTo) {
    RunOptions options;
    options.input = kGreeting + kFarewell;
    const RunResult polite = popupc({"lsp", "--stdio"}, options);
    EXPECT_EQ(polite.exit, 0) << polite.err;
    EXPECT_EQ(polite.err, "");
    const std::vector<Json> said = messages(polite.out);
    ASSERT_EQ(said.size(), 2U);
    EXPECT_EQ(said[0]["result"]["serverInfo"]["name"], "popupc");
    EXPECT_TRUE(said[1]["result"].is_null());
    options.input = kGreeting + message({{"method", "exit"}});
    EXPECT_EQ(popupc({"lsp"}, options).exit, 1) << "without shutdown";
    options.input = kGreeting;
    EXPECT_EQ(popupc({"lsp"}, options).exit, 1) << "the client has gone";
    options.input = "";
    EXPECT_EQ(popupc({"lsp"}, options).exit, 1);
}

TEST(LspProgram, GoesOnAfterWhatIsNoMessage) {
    RunOptions options;
    options.input = "hello\r\n\r\n" + kGreeting +
                    "Content-Length: 5\r\n\r\n{\"a\":Content-Length: x\r\n\r\n" +
                    lsp::framed(std::string(3000, '[')) + kFarewell;
    const RunResult result = popupc({"lsp"}, options);
    EXPECT_EQ(result.exit, 0) << result.err;
    std::size_t errors = 0;
    for (const Json& one : messages(result.out)) errors += one.contains("error") ? 1 : 0;
    EXPECT_EQ(errors, 4U);
}

TEST(LspProgram, TakesSettingsOfItsDirectory) {
    const ScratchDirectory scratch;
    write_file(scratch / "popupc.toml", "werror = true\n");
    RunOptions options;
    options.directory = scratch.path();
    options.environment = {{"POPUPC_NO_CONFIG", ""}};
    options.input = kGreeting + kFarewell;
    EXPECT_EQ(popupc({"lsp"}, options).exit, 0);
    write_file(scratch / "popupc.toml", "[lsp]\nwerror = 3\n");
    EXPECT_EQ(popupc({"lsp"}, options).exit, 2)
        << "a configuration that is none is told before anything is served";
}

// What editors are told in samples/editors is what this test starts Neovim with.
TEST(LspProgram, NeovimSeesAFindingAppliesItsRepairAndRenames) {
    if (!have_program("nvim")) GTEST_SKIP() << "no Neovim (nvim) to talk to";
    const ScratchDirectory scratch;
    const std::filesystem::path source = POPUP_SOURCE_DIR;
    write_file(scratch / "card.xml", read_file(source / "tests/unit/lsp/neovim/card.xml"));
    RunOptions options;
    options.directory = scratch.path();
    options.environment = {{"XDG_CONFIG_HOME", scratch.path()},
                           {"XDG_DATA_HOME", scratch.path()},
                           {"XDG_STATE_HOME", scratch.path()},
                           {"XDG_CACHE_HOME", scratch.path()},
                           {"POPUPC", kPopupc},
                           {"POPUP_EDITORS", source / "samples/editors"}};
    const std::string script = source / "tests/unit/lsp/neovim/session.lua";
    const RunResult result =
        run({"timeout", "120", "nvim", "--headless", "-u", "NONE", "-n", "-c", "luafile " + script}, options);
    EXPECT_EQ(result.exit, 0) << result.out << result.err;
    EXPECT_EQ(read_file(scratch / "said.txt"), read_file(source / "tests/unit/lsp/neovim/said.txt"));
    EXPECT_EQ(read_file(scratch / "card.xml"), read_file(source / "tests/unit/lsp/neovim/mended.xml"));
}

}  // namespace
}  // namespace popup::test
