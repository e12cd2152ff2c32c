#include "support/run_program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "support/run_here.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

// What starting a program would do to this process: signals that it handles are none of the program's, nor
// are files that it would not pass on. Sanitizers keep their own handlers.
void become_new(char** environment) {
    for (int signal = 1; signal < NSIG; ++signal) {
        if (signal == SIGSEGV || signal == SIGBUS || signal == SIGFPE || signal == SIGILL ||
            signal == SIGABRT)
            continue;
        struct sigaction action {};
        if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN)
            ::signal(signal, SIG_DFL);
    }
    std::vector<int> open;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
        open.push_back(std::stoi(entry.path().filename()));
    for (const int fd : open) {
        const int flags = ::fcntl(fd, F_GETFD);
        if (flags != -1 && (flags & FD_CLOEXEC) != 0) ::close(fd);
    }
    environ = environment;
}

// True where a fork of this process does as well as popupc: it has one thread, and nothing is asked of the
// loader or of the sanitizers.
bool can_run_here(const RunOptions& options) {
    if (kPopupcHere == nullptr) return false;
    for (const char* name : {"ASAN_OPTIONS", "GLIBC_TUNABLES", "LD_PRELOAD", "UBSAN_OPTIONS"}) {
        if (options.environment.contains(name)) return false;
    }
    const std::filesystem::directory_iterator threads("/proc/self/task");
    return std::distance(begin(threads), end(threads)) == 1;
}

// Runs words[0]; `here`: a fork of this process, in its place.
RunResult run_either(const std::vector<std::string>& words, const RunOptions& options, bool here) {
    const ScratchDirectory scratch;
    const std::string in = scratch / "in";
    const std::string out = scratch / "out";
    const std::string err = scratch / "err";
    write_file(in, options.input);

    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    std::map<std::string, std::string> environment;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view text = *entry;
        const std::size_t equals = text.find('=');
        // Settings of whoever runs the tests are none of the tests'.
        if (equals != std::string_view::npos && !text.starts_with("POPUPC_"))
            environment[std::string(text.substr(0, equals))] = text.substr(equals + 1);
    }
    environment["POPUPC_NO_CONFIG"] = "1";
    // To look for leaks takes a quarter of a short run. The cases do it, which run everything.
    if (kSanitized)
        environment.try_emplace("ASAN_OPTIONS", "detect_leaks=0:exitcode=86:malloc_context_size=3");
    // 1, what they end with by themselves, is an exit status of popupc's.
    environment.try_emplace("ASAN_OPTIONS", "exitcode=86");
    environment.try_emplace("UBSAN_OPTIONS", "exitcode=86");
    for (const auto& [name, value] : options.environment) environment[name] = value;
    std::vector<std::string> settings;
    for (const auto& [name, value] : environment) settings.push_back(name + "=" + value);
    std::vector<char*> envp;
    for (std::string& setting : settings) envp.push_back(setting.data());
    envp.push_back(nullptr);

    // What waits to be written would be written twice.
    std::fflush(nullptr);
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("fork failed");
    if (child == 0) {
        const auto redirect = [](const std::string& path, int flags, int fd) {
            const int opened = ::open(path.c_str(), flags, 0600);
            if (opened < 0 || ::dup2(opened, fd) < 0) ::_exit(126);
            ::close(opened);
        };
        redirect(in, O_RDONLY, STDIN_FILENO);
        redirect(out, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
        redirect(err, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
        if (!options.directory.empty() && ::chdir(options.directory.c_str()) != 0) ::_exit(126);
        if (here) {
            become_new(envp.data());
            ::_exit(kPopupcHere(static_cast<int>(words.size()), argv.data()));
        }
        ::execvpe(argv[0], argv.data(), envp.data());
        ::_exit(127);
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    RunResult result;
    result.exit = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    result.out = read_file(out);
    result.err = read_file(err);
    return result;
}

}  // namespace

RunResult run(const std::vector<std::string>& words, const RunOptions& options) {
    return run_either(words, options, false);
}

RunResult popupc(std::vector<std::string> arguments, const RunOptions& options) {
    arguments.insert(arguments.begin(), kPopupc);
    return run_either(arguments, options, can_run_here(options));
}

bool have_program(const std::string& name) { return run({name, "--version"}).exit != 127; }

ScratchDirectory::ScratchDirectory() {
    std::string pattern = (std::filesystem::temp_directory_path() / "popup-test-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no scratch directory can be made");
    path_ = pattern;
}

ScratchDirectory::~ScratchDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> ScratchDirectory::names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
        names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

std::string read_file(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return std::move(text).str();
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream out(path, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace popup::test
