#include "support/background.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "support/run_here.h"

namespace popup::test {

bool eventually(const std::function<bool()>& answer, std::chrono::milliseconds longest) {
    const auto end = std::chrono::steady_clock::now() + longest;
    for (;;) {
        if (answer()) return true;
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(3));
    }
}

Background::Background(const std::vector<std::string>& words, const RunOptions& options) {
    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    const std::string out = scratch_ / "out";
    const std::string err = scratch_ / "err";
    std::vector<std::string> settings;
    for (const auto& [name, value] : options.environment) settings.push_back(name + "=" + value);
    pid_ = ::fork();
    if (pid_ < 0) throw std::runtime_error("fork failed");
    if (pid_ > 0) return;
    const auto redirect = [](const char* path, int flags, int fd) {
        const int opened = ::open(path, flags, 0600);
        if (opened < 0 || ::dup2(opened, fd) < 0) ::_exit(126);
        ::close(opened);
    };
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
    if (!options.directory.empty() && ::chdir(options.directory.c_str()) != 0) ::_exit(126);
    for (std::string& setting : settings) ::putenv(setting.data());
    // A shell that starts the tests in the background has them ignored, and what is ignored stays so.
    for (const int signal : {SIGINT, SIGQUIT}) ::signal(signal, SIG_DFL);
    ::execvp(argv[0], argv.data());
    ::_exit(127);
}

Background::~Background() {
    if (!running()) return;
    ::kill(pid_, SIGKILL);
    wait();
}

void Background::send(int signal) const {
    if (exit_ < 0) ::kill(pid_, signal);
}

void Background::take(int status) {
    exit_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

bool Background::running() {
    int status = 0;
    if (exit_ < 0 && ::waitpid(pid_, &status, WNOHANG) == pid_) take(status);
    return exit_ < 0;
}

int Background::wait() {
    int status = 0;
    while (exit_ < 0) {
        if (::waitpid(pid_, &status, 0) == pid_) {
            take(status);
        } else if (errno != EINTR) {
            break;
        }
    }
    return exit_;
}

std::string Background::out() const { return read_file(scratch_ / "out"); }
std::string Background::err() const { return read_file(scratch_ / "err"); }

int Background::threads() const {
    std::istringstream status(read_file("/proc/" + std::to_string(pid_) + "/status"));
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("Threads:")) return std::stoi(line.substr(8)) - kSanitizersThreads;
    }
    return 0;
}

}  // namespace popup::test
