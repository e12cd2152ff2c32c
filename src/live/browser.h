// The reader's browser.
#pragma once

#include <string>

namespace popup::live {

// Starts a browser at this address and lets it run by itself: it outlives this process, hears nothing of its
// terminal's signals, and has none of its files open. The commands of $BROWSER, with colons between them, are
// tried in turn, then xdg-open; a command may have arguments, of which "%s" is the address (which else comes
// last). No shell sees any of it. From now on children of this process that end are forgotten (SIGCHLD).
// False where none of them could be started; whether one that was then shows the address is not known.
bool open_browser(const std::string& address);

}  // namespace popup::live
