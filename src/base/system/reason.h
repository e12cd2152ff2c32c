// Why the system refused, in the words of the messages.
#pragma once

#include <string>

namespace popup {

// Of an error number as errno has it, in lower case and the same on every system and in every locale where
// people meet it often: ENOSPC and EDQUOT are "no space is left on the disk". Others are told as the system
// tells them.
std::string reason_of(int error);

}  // namespace popup
