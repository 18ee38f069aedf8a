#pragma once

#include <signal.h>

namespace gnomon {

/// Dies of @p signal, whatever a sanitizer or a test framework makes of it.
inline void dieOf(int signal) {
    ::signal(signal, SIG_DFL);
    raise(signal);
}

}  // namespace gnomon
