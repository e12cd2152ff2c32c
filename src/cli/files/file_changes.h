// Changes to files, as inotify tells them.
#pragma once

#include <sys/stat.h>

#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace popup::cli {

// Watches files by the directories they are in, because editors put a new file in the place of the old one.
// Files, directories and links on the way that are not there yet, or go and come back, are seen as well. What
// other machines do on a shared file system is not.
class FileChanges {
 public:
    // UsageError that names the setting when the system gives no more inotify instances or watches.
    FileChanges();
    FileChanges(const FileChanges&) = delete;
    FileChanges& operator=(const FileChanges&) = delete;
    ~FileChanges();

    // From now on these files, and no others. What has happened and was not told yet stays to be told.
    // UsageError as above.
    void look_at(const std::vector<std::string>& files);

    // Waits until one of the files has changed, or may have, and gives its name as it was given; empty when
    // `wake` became readable or the time was over first. Without a time it waits as long as it takes. Whoever
    // writes to a file tells when it is closed.
    std::optional<std::string> wait(int wake, std::optional<std::chrono::milliseconds> longest);

 private:
    // What tells whether a file has changed where an event does not.
    struct Fingerprint {
        bool exists = false;
        struct stat status {};
        [[nodiscard]] bool same(const Fingerprint& other) const;
    };
    struct Directory {
        std::string path;
        std::set<std::string> names;  // in it, that matter
    };
    static Fingerprint fingerprint(const std::string& file);
    void watch_way(const std::string& file, std::map<std::string, unsigned>& masks,
                   std::map<std::string, std::set<std::string>>& names);
    void renew();
    [[nodiscard]] std::optional<std::string> changed_file();
    std::optional<std::string> read_events();

    int inotify_ = -1;
    bool unsure_ = false;  // something may have changed without an event
    std::vector<std::string> files_;
    std::map<std::string, Fingerprint> prints_;                            // by file
    std::map<int, Directory> directories_;                                 // by watch
    std::map<std::pair<std::string, std::string>, std::string> of_entry_;  // directory, name: the file itself
};

}  // namespace popup::cli
