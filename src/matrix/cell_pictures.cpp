#include "matrix/cell_pictures.h"

#include <fmt/format.h>

#include "image/image.h"
#include "matrix/cell_store.h"

namespace gnomon {
namespace {

/// Whether @p target is the picture @p source now, or was there before.
std::error_code linked(const std::filesystem::path& source, const std::filesystem::path& target) {
    std::error_code error;
    if (std::filesystem::exists(target, error)) return {};
    std::filesystem::create_hard_link(source, target, error);
    if (!error) return {};
    const auto copy = target.parent_path() / ("." + target.filename().string());
    std::filesystem::copy_file(source, copy, std::filesystem::copy_options::overwrite_existing, error);
    if (!error) std::filesystem::rename(copy, target, error);
    return error;
}

}  // namespace

std::filesystem::path imageFileOf(const std::filesystem::path& folder, const std::string& digest) {
    return folder / (digest + ".png");
}

std::filesystem::path maskFileOf(const std::filesystem::path& folder, const std::string& digest) {
    return folder / (digest + "-mask.png");
}

void writePictures(const std::filesystem::path& folder, const std::string& digest, const Pictures& pictures) {
    const auto writeNew = [](const std::filesystem::path& file, const Image& image) {
        std::error_code none;
        if (!std::filesystem::exists(file, none)) writeImage(file, image);
    };
    writeNew(imageFileOf(folder, digest), pictures.image);
    writeNew(maskFileOf(folder, digest), pictures.mask);
}

bool hasPictures(const std::filesystem::path& folder, const std::string& digest) {
    std::error_code none;
    return digest.empty() || (std::filesystem::exists(imageFileOf(folder, digest), none) &&
                              std::filesystem::exists(maskFileOf(folder, digest), none));
}

bool linkPictures(const std::filesystem::path& from, const std::filesystem::path& to,
                  const std::string& digest) {
    return !linked(imageFileOf(from, digest), imageFileOf(to, digest)) &&
           !linked(maskFileOf(from, digest), maskFileOf(to, digest));
}

void linkAllPictures(const std::filesystem::path& from, const std::filesystem::path& to) {
    std::error_code error;
    if (!std::filesystem::is_directory(from, error)) return;
    std::filesystem::create_directories(to, error);
    if (error) throw StoreError(fmt::format("{}: {}", to.string(), error.message()));
    for (const auto& entry : std::filesystem::directory_iterator(from)) {
        if (entry.path().filename().string().starts_with(".")) continue;
        const auto target = to / entry.path().filename();
        if (const auto why = linked(entry.path(), target))
            throw StoreError(fmt::format("{}: {}", target.string(), why.message()));
    }
}

void removeHalfWritten(const std::filesystem::path& folder) {
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none))
        if (entry.path().filename().string().starts_with(".")) std::filesystem::remove(entry.path(), none);
}

}  // namespace gnomon
