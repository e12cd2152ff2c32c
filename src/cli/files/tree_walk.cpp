#include "cli/files/tree_walk.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "base/system/reason.h"
#include "cli/files/read_settings.h"
#include "popup/files.h"

namespace popup {
namespace {

namespace fs = std::filesystem;

// An ignore file is written by hand; what is larger than this is none.
constexpr std::size_t kIgnoreFileLimit = std::size_t{1} << 20;

struct Entry {
    std::string name;
    bool directory = false;
};

// A directory on the way, and what of it is still to come.
struct Frame {
    std::string prefix;          // its path with "/" at the end; empty for "."
    std::vector<Entry> entries;  // in order
    std::size_t next = 0;
    PathPatterns ignored;
};

class Walker {
 public:
    Walker(const WalkOptions& options, const DiagnosticPolicy& policy) : options_(options), policy_(policy) {}

    TreeWalk run(const std::string& root) {
        std::string prefix = root;
        while (prefix.size() > 1 && prefix.ends_with('/')) prefix.pop_back();
        enter(prefix, prefix == "." ? "" : prefix == "/" ? "/" : prefix + "/");
        while (!way_.empty()) {
            Frame& frame = way_.back();
            if (frame.next == frame.entries.size()) {
                way_.pop_back();
                continue;
            }
            const Entry entry = std::move(frame.entries[frame.next++]);
            const std::string path = frame.prefix + entry.name;
            if (excluded(path, entry.directory)) continue;
            if (entry.directory) {
                enter(path, path + "/");
            } else if (included(path)) {
                // "-" alone would be standard input.
                result_.files.push_back(path == "-" ? "./-" : path);
            }
        }
        return std::move(result_);
    }

 private:
    void enter(const std::string& directory, std::string prefix) {
        Frame frame{std::move(prefix), {}, 0, {}};
        std::error_code error;
        bool ignore_file = false;
        fs::directory_iterator entries(directory, error);
        for (; !error && entries != fs::directory_iterator(); entries.increment(error)) {
            std::string name = entries->path().filename().string();
            if (name == kIgnoreFile) ignore_file = true;
            if (name.starts_with('.')) continue;
            if (std::optional<Entry> entry = examined(*entries, frame.prefix, std::move(name))) {
                frame.entries.push_back(std::move(*entry));
            }
        }
        if (error) {
            result_.unreadable.emplace_back(directory, policy_)
                .error("unreadable-input", {}, "this directory cannot be read: " + reason_of(error.value()));
            return;
        }
        std::sort(frame.entries.begin(), frame.entries.end(),
                  [](const Entry& a, const Entry& b) { return a.name < b.name; });
        if (ignore_file) read_ignore_file(frame);
        way_.push_back(std::move(frame));
    }

    // A directory or a wanted file; nullopt for everything else.
    [[nodiscard]] std::optional<Entry> examined(const fs::directory_entry& entry, const std::string& prefix,
                                                std::string name) {
        std::error_code error;
        const fs::file_status itself = entry.symlink_status(error);
        // Such as one whose path is longer than the system takes: there may be designs in it.
        if (error && error != std::errc::no_such_file_or_directory) {
            result_.unreadable.emplace_back(prefix + name, policy_)
                .error("unreadable-input", {}, "this cannot be looked at: " + reason_of(error.value()));
            return std::nullopt;
        }
        if (fs::is_directory(itself)) return Entry{std::move(name), true};
        if (!options_.wants(name)) return std::nullopt;
        // What cannot be found out is taken, and reading it tells why.
        const fs::file_status status = fs::is_symlink(itself) ? entry.status(error) : itself;
        const bool other = fs::exists(status) && !fs::is_regular_file(status);
        return other ? std::nullopt : std::optional(Entry{std::move(name), false});
    }

    void read_ignore_file(Frame& frame) {
        Diagnostics trouble(frame.prefix + std::string(kIgnoreFile), policy_);
        result_.ignore_files.push_back(trouble.file());
        if (const auto source = cli::read_settings(trouble.file(), trouble, kIgnoreFileLimit)) {
            frame.ignored = PathPatterns(source->text);
        } else {
            result_.unreadable.push_back(std::move(trouble));
        }
    }

    [[nodiscard]] std::string_view below(const Frame& frame, std::string_view path) const {
        return path.substr(frame.prefix.size());
    }

    [[nodiscard]] bool excluded(std::string_view path, bool directory) const {
        if (const auto said = options_.exclude.says(below(way_.front(), path), directory)) return *said;
        for (auto frame = way_.rbegin(); frame != way_.rend(); ++frame) {
            if (const auto said = frame->ignored.says(below(*frame, path), directory)) return *said;
        }
        return false;
    }

    [[nodiscard]] bool included(std::string_view path) const {
        return options_.include.empty() ||
               options_.include.says(below(way_.front(), path), false).value_or(false);
    }

    const WalkOptions& options_;
    const DiagnosticPolicy& policy_;
    std::vector<Frame> way_;
    TreeWalk result_;
};

}  // namespace

TreeWalk walk_tree(const std::string& root, const WalkOptions& options, const DiagnosticPolicy& policy) {
    return Walker(options, policy).run(root);
}

}  // namespace popup
