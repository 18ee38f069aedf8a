#include "process/message.h"

#include <sys/socket.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

namespace gnomon {
namespace {

constexpr std::size_t kHead = 1 + sizeof(std::uint64_t);  ///< the kind and the text's size

}  // namespace

bool sendMessage(int socket, char kind, std::string_view text) {
    std::string bytes(1, kind);
    const std::uint64_t size = text.size();
    bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes.append(text);
    for (std::size_t done = 0; done < bytes.size();) {
        // A process that has lost its other side is told so here, not by a signal.
        const ssize_t n = send(socket, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        done += std::size_t(n);
    }
    return true;
}

bool MessageReader::read(int socket) {
    m_bytes.erase(0, m_at);
    m_at = 0;
    char buffer[65536];
    ssize_t n = -1;
    do n = recv(socket, buffer, sizeof buffer, 0);
    while (n < 0 && errno == EINTR);
    if (n <= 0) return false;
    m_bytes.append(buffer, std::size_t(n));
    return true;
}

std::optional<Message> MessageReader::next() {
    if (m_bytes.size() - m_at < kHead) return std::nullopt;
    std::uint64_t size = 0;
    std::memcpy(&size, m_bytes.data() + m_at + 1, sizeof size);
    if (m_bytes.size() - m_at - kHead < size) return std::nullopt;
    Message message{m_bytes[m_at], m_bytes.substr(m_at + kHead, size)};
    m_at += kHead + size;
    return message;
}

std::optional<Message> MessageReader::wait(int socket) {
    for (;;) {
        if (auto message = next()) return message;
        if (!read(socket)) return std::nullopt;
    }
}

}  // namespace gnomon
