// The reader's browser, and other programs that go on by themselves.
#pragma once

#include <string>
#include <vector>

namespace popup::live {

// Starts a program, found in PATH, with its arguments, and lets it run by itself: it outlives this process,
// hears nothing of its terminal's signals, and has none of its files open. From now on children of this
// process that end are forgotten (SIGCHLD). False where it cannot be started. Precondition: there is a word.
bool start_by_itself(const std::vector<std::string>& words);

// Starts a browser at this address likewise. The commands of $BROWSER, with colons between them, are
// tried in turn, then xdg-open; a command may have arguments, of which "%s" is the address (which else comes
// last). No shell sees any of it. False where none of them could be started; whether one that was then shows
// the address is not known.
bool open_browser(const std::string& address);

}  // namespace popup::live
