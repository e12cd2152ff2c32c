// How popupc runs where tests are linked with what sanitizers look at.
#pragma once

namespace popup::test {

// What a fork of the sanitized tests does in place of popupc: its main(), with its exit status. Null where
// tests start the program. Sanitized, it takes a fifth of a second to start, more than most runs take, and is
// the same code; a fork takes half of that. Set before anything that is initialized at run time.
extern int (*const kPopupcHere)(int argc, char** argv);

// The threads of popupc that are not its own: ThreadSanitizer has one in each program. Otherwise 0.
extern const int kSanitizersThreads;

}  // namespace popup::test
