#include "cli/progress_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace popup {
namespace {

constexpr std::size_t kShortestBar = 10;
constexpr std::size_t kLongestBar = 60;

// "8 s", "1:43", "2:05:09".
std::string duration(double seconds) {
    const double whole = std::min(std::ceil(seconds), 359'999.0);
    const auto all = static_cast<long>(whole);
    if (all < 60) return fmt::format("{} s", all);
    if (all < 3600) return fmt::format("{}:{:02}", all / 60, all % 60);
    return fmt::format("{}:{:02}:{:02}", all / 3600, all / 60 % 60, all % 60);
}

}  // namespace

std::string progress_text(const ProgressState& state) {
    std::string text = fmt::format("{} of {} designs", state.done, state.total);
    if (state.done == 0 || state.seconds <= 0.0) return text;
    const double rate = static_cast<double>(state.done) / state.seconds;
    text += rate < 100.0 ? fmt::format(", {:.1f}/s", rate) : fmt::format(", {:.0f}/s", rate);
    if (state.done < state.total) {
        text += ", " + duration(static_cast<double>(state.total - state.done) / rate) + " left";
    }
    return text;
}

std::string progress_bar(const ProgressState& state, std::size_t columns) {
    std::string text = progress_text(state);
    const std::size_t room = std::max<std::size_t>(columns, 1) - 1;
    constexpr std::size_t kFrame = 3;  // brackets and a blank
    if (room < text.size() + kFrame + kShortestBar) return text.substr(0, room);
    const std::size_t length = std::min(room - text.size() - kFrame, kLongestBar);
    const double share =
        static_cast<double>(state.done) / static_cast<double>(std::max<std::size_t>(state.total, 1));
    const auto filled = std::min(static_cast<std::size_t>(share * static_cast<double>(length)), length);
    std::string bar(filled, '=');
    if (filled < length) bar += '>';
    bar.resize(length, ' ');
    return "[" + bar + "] " + text;
}

}  // namespace popup
