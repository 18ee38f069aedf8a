#include "image/whole_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <stdexcept>
#include <string>
#include <system_error>

namespace gnomon {
namespace {

/// A name beside @p file that no other process uses; the extension stays, it chooses the format.
std::filesystem::path temporaryBeside(const std::filesystem::path& file) {
    const std::string name =
        fmt::format(".{}.{}{}", file.stem().string(), getpid(), file.extension().string());
    return file.parent_path() / name;
}

[[noreturn]] void fail(const std::filesystem::path& file, std::string what) {
    // The user knows the file by its own name only.
    const std::string temporary = temporaryBeside(file).string();
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
    const std::filesystem::path temporary = temporaryBeside(file);
    std::error_code error;
    try {
        write(temporary);
    } catch (const std::exception& thrown) {
        std::filesystem::remove(temporary, error);
        fail(file, thrown.what());
    }
    std::filesystem::rename(temporary, file, error);
    if (!error) return;
    const std::string why = error.message();
    std::filesystem::remove(temporary, error);
    fail(file, why);
}

}  // namespace gnomon
