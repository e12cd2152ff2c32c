#include "live/browser.h"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace popup::live {
namespace {

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(separator), text.size());
        if (end > 0) parts.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return parts;
}

std::vector<std::string> words_of(const std::string& command, const std::string& address) {
    std::vector<std::string> words = split(command, ' ');
    bool placed = false;
    for (std::string& word : words) {
        const std::size_t at = word.find("%s");
        if (at == std::string::npos) continue;
        word.replace(at, 2, address);
        placed = true;
    }
    if (!placed) words.push_back(address);
    return words;
}

}  // namespace

bool start_by_itself(const std::vector<std::string>& words) {
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t files{};
    posix_spawnattr_t attributes{};
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
    sigset_t none;
    sigset_t usual;
    sigemptyset(&none);
    sigemptyset(&usual);
    for (const int signal : {SIGPIPE, SIGXFSZ, SIGINT, SIGTERM, SIGCHLD}) sigaddset(&usual, signal);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    // Nobody waits for it.
    struct sigaction unheard {};
    unheard.sa_handler = SIG_IGN;
    unheard.sa_flags = SA_NOCLDWAIT;
    ::sigaction(SIGCHLD, &unheard, nullptr);
    pid_t child = 0;
    const int failed = ::posix_spawnp(&child, argv[0], &files, &attributes, argv.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return failed == 0;
}

bool open_browser(const std::string& address) {
    const char* wanted = std::getenv("BROWSER");
    std::vector<std::string> commands = split(wanted == nullptr ? "" : wanted, ':');
    commands.emplace_back("xdg-open");
    return std::any_of(commands.begin(), commands.end(), [&address](const std::string& command) {
        const std::vector<std::string> words = words_of(command, address);
        // A command of blanks alone has the address for its only word.
        return words.front() != address && start_by_itself(words);
    });
}

}  // namespace popup::live
