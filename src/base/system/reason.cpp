#include "base/system/reason.h"

#include <cerrno>
#include <system_error>

namespace popup {

std::string reason_of(int error) {
    switch (error) {
        case ENOENT:
            return "no such file or directory";
        case EACCES:
        case EPERM:
            return "permission denied";
        case EISDIR:
            return "it is a directory";
        case ENOSPC:
        case EDQUOT:
            return "no space is left on the disk";
        case EPIPE:
            return "its reader has gone";
        case EROFS:
            return "the disk is read-only";
        default:
            return std::generic_category().message(error);
    }
}

}  // namespace popup
