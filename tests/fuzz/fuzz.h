#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

/// What libFuzzer calls with every input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace gnomon::fuzz {

/// Ends the harness with what is wrong about this input.
[[noreturn]] inline void complain(std::string_view what, std::string_view about = {}) {
    std::fprintf(stderr, "FUZZ: %.*s%s%.*s\n", int(what.size()), what.data(), about.empty() ? "" : ": ",
                 int(about.size()), about.data());
    std::fflush(stderr);
    __builtin_trap();
}

/// What must hold of a value that was taken.
inline void require(bool holds, std::string_view what) {
    if (!holds) complain(what);
}

/// Whether @p text is one line for people: no character that breaks it.
inline bool isOneLine(std::string_view text) {
    return std::none_of(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == 0; });
}

/// A message must be one line that begins with @p start, and says something after it.
inline void requireMessage(std::string_view message, std::string_view start) {
    if (!isOneLine(message)) complain("a message of several lines", message);
    if (!message.starts_with(start) || message.size() == start.size())
        complain("a message that doesn't name the file", message);
}

/// Does @p work, which may throw a @p Refusal with such a message, and nothing else.
template <class Refusal, class Work>
void takenOrRefused(std::string_view start, const Work& work) {
    try {
        work();
    } catch (const Refusal& refusal) {
        requireMessage(refusal.what(), start);
    } catch (const std::exception& error) {
        complain("another kind of exception", error.what());
    } catch (...) {
        complain("an exception of no kind");
    }
}

/// A folder of this process for the files that are read, in memory where the system has that. Removed at
/// exit.
class Folder {
  public:
    Folder() : m_owner(getpid()) {
        std::error_code none;
        const char* chosen = std::getenv("TMPDIR");
        const bool inMemory = !chosen && std::filesystem::is_directory("/dev/shm", none);
        const auto base =
            inMemory ? std::filesystem::path("/dev/shm") : std::filesystem::temp_directory_path();
        std::string name = base / "gnomon-fuzz-XXXXXX";
        if (!mkdtemp(name.data())) throw std::runtime_error(name + ": can't be made");
        m_path = name;
    }
    ~Folder() {
        std::error_code none;
        if (getpid() == m_owner) std::filesystem::remove_all(m_path, none);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    /// A file of this content; the next one of that name takes its place.
    std::filesystem::path write(const std::string& name, std::string_view content) const {
        const auto file = m_path / name;
        std::ofstream out(file, std::ios::binary | std::ios::trunc);
        out.write(content.data(), std::streamsize(content.size()));
        if (!out.flush()) throw std::runtime_error(file.string() + ": can't be written");
        return file;
    }

  private:
    pid_t m_owner;
    std::filesystem::path m_path{};
};

/// The input as text.
inline std::string_view textOf(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

}  // namespace gnomon::fuzz
