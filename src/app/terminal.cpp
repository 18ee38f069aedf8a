#include "app/terminal.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "process/interrupt.h"
#include "report/page.h"

namespace gnomon {
namespace {

constexpr std::size_t kUsualColumns = 80;

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kAnswerTime(200);

/// What @p terminal answers to @p question, up to the letter @p last; as much of it as came within @p time.
std::string askFor(int terminal, std::string_view question, char last, std::chrono::milliseconds time) {
    std::string answer;
    if (write(terminal, question.data(), question.size()) != ssize_t(question.size())) return answer;
    const auto end = Clock::now() + time;
    while (answer.find(last) == std::string::npos) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
        pollfd wait{terminal, POLLIN, 0};
        const int ready = left > 0 ? poll(&wait, 1, int(left)) : 0;
        if (ready < 0 && errno == EINTR) continue;
        char buffer[256];
        const ssize_t n = ready > 0 ? read(terminal, buffer, sizeof buffer) : 0;
        if (n <= 0) break;
        answer.append(buffer, std::size_t(n));
    }
    return answer;
}

void writeNow(const std::string& text) {
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
}

}  // namespace

bool isTerminal(int file) {
    const char* term = std::getenv("TERM");
    return term && *term != 0 && std::string_view(term) != "dumb" && isatty(file);
}

bool takesColours(int file) {
    const char* noColour = std::getenv("NO_COLOR");
    return isTerminal(file) && !(noColour && *noColour != 0);
}

std::size_t windowColumns(int file) {
    winsize window{};
    return ioctl(file, TIOCGWINSZ, &window) == 0 && window.ws_col > 0 ? window.ws_col : kUsualColumns;
}

std::size_t textColumns() {
    if (!isatty(STDOUT_FILENO)) return kPageColumns;
    const std::string_view columns = std::getenv("COLUMNS") ? std::getenv("COLUMNS") : "";
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(columns.data(), columns.data() + columns.size(), value);
    const bool isNumber = error == std::errc() && end == columns.data() + columns.size() && value > 0;
    return isNumber ? value : windowColumns(STDOUT_FILENO);
}

std::size_t pictureColumns() {
    return isatty(STDOUT_FILENO) ? textColumns() : kUsualColumns;
}

std::size_t windowPixels(int file) {
    winsize window{};
    const bool isKnown = ioctl(file, TIOCGWINSZ, &window) == 0 && window.ws_xpixel > 0;
    return isKnown ? window.ws_xpixel : 8 * windowColumns(file);
}

bool namesSixel(const std::string& answer) {
    const std::size_t begin = answer.find("\x1b[?");
    const std::size_t end = begin == std::string::npos ? begin : answer.find('c', begin);
    if (end == std::string::npos) return false;
    // The first number is the terminal's class, not an attribute.
    const std::string attributes = answer.substr(begin + 3, end - begin - 3) + ";";
    return attributes.find(";4;") != std::string::npos;
}

bool terminalHasSixel() {
    if (!isTerminal(STDOUT_FILENO)) return false;
    const int terminal = open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (terminal < 0) return false;
    termios before{};
    std::string answer;
    if (tcgetattr(terminal, &before) == 0) {
        // Else the answer would wait for a line end, and be seen.
        termios raw = before;
        raw.c_lflag &= ~tcflag_t(ICANON | ECHO);
        tcsetattr(terminal, TCSANOW, &raw);
        answer = askFor(terminal, "\x1b[c", 'c', kAnswerTime);
        tcsetattr(terminal, TCSANOW, &before);
    }
    close(terminal);
    return namesSixel(answer);
}

TerminalProgress::TerminalProgress(const std::string& unit)
    : m_isShown(isTerminal(STDERR_FILENO)), m_start(std::chrono::steady_clock::now()), m_bar(unit) {}

void TerminalProgress::show(const Progress& progress) {
    if (!m_isShown) return;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - m_start;
    if (const auto text = m_bar.draw(progress, passed.count(), windowColumns(STDERR_FILENO))) {
        writeOnInterrupt(kClearLine);
        writeNow(*text);
    }
}

void TerminalProgress::clear() {
    if (!m_isShown) return;
    writeNow(m_bar.clear());
    writeOnInterrupt(nullptr);
}

}  // namespace gnomon
