#include "app/output_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "app/options.h"
#include "image/whole_file.h"

namespace gnomon {

void checkOutputFile(const std::string& file, const std::vector<std::string>& endings,
                     const std::string& what) {
    if (file.empty()) return;
    const std::filesystem::path path(file);
    const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    std::error_code error;
    if (std::find(endings.begin(), endings.end(), path.extension()) == endings.end())
        throw UsageError(fmt::format("{}: {}", file, what));
    if (!std::filesystem::is_directory(folder, error))
        throw UsageError(fmt::format("{}: no folder {}", file, folder.string()));
    writeChosen([&] { tryWhole(path); });
}

void checkPlotFile(const std::string& file) {
    checkOutputFile(file, {".svg", ".png"}, "a plot's name ends in .svg or .png");
}

void writeChosen(const std::function<void()>& write) {
    try {
        write();
    } catch (const std::runtime_error& error) {
        throw UsageError(error.what());
    }
}

}  // namespace gnomon
