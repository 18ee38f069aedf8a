#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gnomon {

/// What a process and its child send each other: a kind, and any bytes.
struct Message {
    char kind = 0;
    std::string text{};
};

/// Sends a message whole.
/// @return false if nobody is left at the other end of @p socket
bool sendMessage(int socket, char kind, std::string_view text);

/// Puts messages together of what comes in piece by piece.
class MessageReader {
  public:
    /// Takes what has come in at @p socket, or waits for it.
    /// @return false at the end: the other side has closed it, or is gone
    bool read(int socket);

    /// The next message that is whole by now.
    std::optional<Message> next();

    /// Waits until one is whole.
    /// @return nothing at the end
    std::optional<Message> wait(int socket);

  private:
    std::string m_bytes{};
    std::size_t m_at = 0;  ///< of the first byte that has not been given out
};

}  // namespace gnomon
