#include "cli/batch/batch_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include "base/system/signal_cleanup.h"
#include "cli/files/read_settings.h"
#include "cli/report.h"

namespace popup::cli {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

std::string within(const std::string& directory, const std::string& name) {
    return name.starts_with('/') ? name : directory + "/" + name;
}

// Appends all of it in one call where the system lets it.
bool append(int fd, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t put = ::write(fd, bytes.data(), bytes.size());
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(put));
    }
    return true;
}

}  // namespace

std::string BatchFiles::absolute(const std::string& file) const { return within(home, file); }

std::vector<std::string> BatchFiles::results_beside() const {
    return name == "-" ? std::vector<std::string>() : popup::results_beside(absolute(name));
}

void BatchFiles::enter() const {
    if (directory.empty() || ::chdir(directory.c_str()) == 0) return;
    throw UsageError(fmt::format("{}: {}", directory, reason(errno)));
}

std::optional<BatchFiles> open_batch(const std::string& name, std::optional<ManifestForm> form,
                                     const MessageOptions& messages) {
    BatchFiles files;
    files.name = name;
    std::error_code error;
    files.home = std::filesystem::current_path(error).string();
    const std::size_t slash = name.rfind('/');
    if (name != "-" && slash != std::string::npos) files.directory = slash == 0 ? "/" : name.substr(0, slash);
    Diagnostics findings(name);
    std::optional<Source> source = read_settings(name, findings, kLongestManifest);
    const bool readable = source.has_value();
    if (source) files.manifest = read_manifest(std::move(*source), form, findings);
    if (!findings.sorted().empty()) {
        // Its text is shown, and has gone the way of the rows.
        Diagnostics again;
        if (readable && name != "-") source = read_settings(name, again, kLongestManifest);
        report(messages, {{&findings, readable && source ? std::string_view(source->text) : "", false}},
               Diagnostics());
    }
    if (!readable) return std::nullopt;
    return files;
}

ReadFiles files_of_batch(const BatchFiles& files, const Options& options) {
    ReadFiles read;
    if (files.name != "-") read.add(files.absolute(files.name), "the manifest");
    for (const std::string& name : options.settings_files)
        read.add(files.absolute(name), "which options are read from");
    for (std::size_t i = 0; i < files.manifest->size(); ++i) {
        for (const std::string& name : files.manifest->job(i).inputs) read.add(name, "an input of the batch");
    }
    return read;
}

std::string results_for(const std::string& manifest, int shard, int shards) {
    if (manifest == "-") {
        throw UsageError("a manifest from standard input has no place for its results",
                         {"name one with --results"});
    }
    std::error_code error;
    const std::filesystem::path path = std::filesystem::absolute(manifest, error);
    return results_name(error ? manifest : path.string(), shard, shards);
}

std::string ResultsFile::open(const std::string& name) {
    const auto refuse = [&name](const std::string& why) {
        throw UsageError(fmt::format("{}: {}", name, why),
                         {"results are kept there; --results FILE names another"});
    };
    fd_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (fd_ < 0) refuse(reason(errno));
    if (::flock(fd_, LOCK_EX | LOCK_NB) != 0) {
        refuse(errno == EWOULDBLOCK ? "another run is writing its results there" : reason(errno));
    }
    // A run that finished in between may have put another file in its place.
    struct stat held {};
    struct stat named {};
    if (::fstat(fd_, &held) != 0 || ::stat(name.c_str(), &named) != 0 || held.st_ino != named.st_ino ||
        held.st_dev != named.st_dev) {
        refuse("another run has just written its results there");
    }
    if (!S_ISREG(held.st_mode)) refuse("it is no file");
    // Somebody's file is not written to, let alone put in order.
    std::string begin(kResultBegin.size(), '\0');
    const ssize_t read = ::pread(fd_, begin.data(), begin.size(), 0);
    if (read > 0 && begin != kResultBegin) refuse("it holds something else than results");
    char last = '\n';
    if (held.st_size > 0 && ::pread(fd_, &last, 1, held.st_size - 1) != 1) refuse(reason(errno));
    if (last != '\n' && !append(fd_, "\n")) refuse(reason(errno));
    std::error_code error;
    const std::filesystem::path path = std::filesystem::canonical(name, error);
    name_ = error ? name : path.string();
    return name_;
}

bool ResultsFile::add(const JobResult& result, const ResultIndex& before) {
    const std::string line = to_line(result);
    for (const JobResult& one : before.of(result.key)) {
        if (to_line(one) == line) return true;
    }
    if (append(fd_, line)) return true;
    trouble_ = reason(errno);
    return false;
}

bool ResultsFile::settle(const Manifest& manifest) {
    const auto fail = [this](const std::string& why) {
        trouble_ = why;
        return false;
    };
    const SignalPause pause;
    Diagnostics trouble;
    ResultIndex index;
    if (!index.add(name_, trouble)) return fail("it cannot be read again");
    std::ifstream old(name_, std::ios::binary);
    NewFile made(name_);
    bool same = true;
    for (std::size_t i = 0; i < manifest.size(); ++i) {
        for (const JobResult& one : index.of(job_key(manifest.job(i)))) {
            const std::string line = to_line(one);
            std::string there;
            same = same && std::getline(old, there) && there + "\n" == line;
            if (!made.write(line)) return fail(made.trouble());
        }
    }
    if (same && old.peek() == std::ifstream::traits_type::eof()) {
        return ::futimens(fd_, nullptr) == 0 || fail(reason(errno));
    }
    struct stat now {};
    if (::fstat(fd_, &now) == 0) made.keep_mode(now.st_mode);
    return made.commit() || fail(made.trouble());
}

void ResultsFile::close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
}

}  // namespace popup::cli
