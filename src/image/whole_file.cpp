#include "image/whole_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

#include "process/interrupt.h"

namespace gnomon {
namespace {

/// A name beside @p file that no other process uses; the extension stays, it chooses the format.
std::filesystem::path temporaryBeside(const std::filesystem::path& file) {
    const std::string name =
        fmt::format(".{}.{}{}", file.stem().string(), getpid(), file.extension().string());
    return file.parent_path() / name;
}

/// Where a link leads; else @p file itself.
std::filesystem::path placeOf(const std::filesystem::path& file) {
    constexpr int kMostLinks = 40;  // as many as Linux follows
    std::error_code error;
    std::filesystem::path place = file;
    for (int i = 0; i < kMostLinks && std::filesystem::is_symlink(place, error); ++i)
        place = place.parent_path() / std::filesystem::read_symlink(place, error);
    return place;
}

[[noreturn]] void fail(const std::filesystem::path& file, std::string what) {
    // The user knows the file by its own name only.
    const std::string temporary = temporaryBeside(placeOf(file)).string();
    for (std::size_t at; (at = what.find(temporary)) != std::string::npos;)
        what.replace(at, temporary.size(), file.string());
    while (!what.empty() && (what.back() == '\n' || what.back() == ' ')) what.pop_back();
    for (char& c : what)
        if (c == '\n' || c == '\r') c = ' ';
    throw std::runtime_error(fmt::format("{}: {}", file.string(), what.empty() ? "unknown error" : what));
}

}  // namespace

void writeWhole(const std::filesystem::path& file,
                const std::function<void(const std::filesystem::path&)>& write) {
    const std::filesystem::path place = placeOf(file), temporary = temporaryBeside(place);
    std::error_code error;
    if (std::filesystem::exists(place, error) && !std::filesystem::is_regular_file(place, error))
        fail(file, "is no regular file");
    const InterruptsHeld held;
    try {
        write(temporary);
    } catch (const std::exception& thrown) {
        std::filesystem::remove(temporary, error);
        fail(file, thrown.what());
    }
    std::filesystem::rename(temporary, place, error);
    if (!error) return;
    const std::string why = error.message();
    std::filesystem::remove(temporary, error);
    fail(file, why);
}

void writeWhole(const std::filesystem::path& file, std::string_view text) {
    writeWhole(file, [&](const std::filesystem::path& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out << text;
        out.close();
        if (!out) throw std::runtime_error("can't be written");
    });
}

void tryWhole(const std::filesystem::path& file) {
    const std::filesystem::path place = placeOf(file), temporary = temporaryBeside(place);
    std::error_code error;
    if (std::filesystem::exists(place, error) && !std::filesystem::is_regular_file(place, error))
        fail(file, "is no regular file");
    const InterruptsHeld held;
    errno = 0;
    const bool isOpen = std::ofstream(temporary).is_open();
    const int why = errno;
    std::filesystem::remove(temporary, error);
    if (!isOpen) fail(file, std::error_code(why, std::generic_category()).message());
}

}  // namespace gnomon
