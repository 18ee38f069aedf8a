#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

namespace gnomon {

/// The kind of message in which a child says why it gives up, in one line.
constexpr char kErrorMessage = 'e';

/// A forked process, and this side of the socket to it.
struct Child {
    pid_t pid = -1;
    int socket = -1;
};

/// Forks a process that does @p work with its side of the socket, and ends. It dies with its parent, whatever
/// ends that, and leaves SIGINT, SIGTERM and SIGHUP to it. What @p work throws is sent as a kErrorMessage.
/// @throws std::system_error  the system has no more processes or sockets
Child startChild(const std::function<void(int socket)>& work);

/// Waits until @p child has ended.
/// @return how, in one line: "crashed: signal 11 (Segmentation fault)", "exit 3"; "" if all went well
std::string waitFor(Child& child);

/// What came of work in a process of its own; only one of the three is not empty, but the result may be.
struct Apart {
    std::string result{};
    std::string thrown{};  ///< what() of what it threw
    std::string crash{};   ///< how the process ended
};

/// Does @p work in a process of its own, so that a crash costs nothing but its result. Its standard error is
/// left out: a crash is told in one line by who asks.
Apart doneApart(const std::function<std::string()>& work);

}  // namespace gnomon
