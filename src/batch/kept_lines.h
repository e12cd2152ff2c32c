// A file of lines that is added to while work goes on, so that what was finished is known whatever happens.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace popup {

// One process at a time has the file, from open() to close().
class KeptLines {
 public:
    KeptLines() = default;
    KeptLines(const KeptLines&) = delete;
    KeptLines& operator=(const KeptLines&) = delete;
    ~KeptLines() { close(); }

    // Opens or makes it, and ends a line that was cut off. A file that holds something, and not `begin`
    // first, is somebody else's. False: it cannot be had; trouble() says why.
    bool open(const std::string& name, std::string_view begin);
    // Adds a line, its line break included. False: it cannot be written, and trouble() says why.
    bool add(std::string_view line);
    // Leaves the lines that `next` gives, until it gives nullopt, and no others. What is so already is not
    // written again, but for the time of the last change. The old file stays until the new one is complete.
    // False as above.
    bool settle(const std::function<std::optional<std::string>()>& next);
    void close();

    // With links followed.
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
    bool fail(std::string why);
    std::string name_;
    std::string trouble_;
    int fd_ = -1;
};

}  // namespace popup
