#pragma once

#include <filesystem>
#include <string>

#include "matrix/lab.h"

namespace gnomon {

/// Where the image and the mask of a cell lie in the folder of pictures: cells that show the same share them.
/// @param digest  Cell::digest
std::filesystem::path imageFileOf(const std::filesystem::path& folder, const std::string& digest);
std::filesystem::path maskFileOf(const std::filesystem::path& folder, const std::string& digest);

/// Writes both, unless they are there; each appears whole or not at all.
/// @throws std::runtime_error "file: what"
void writePictures(const std::filesystem::path& folder, const std::string& digest, const Pictures& pictures);

/// Whether both are there; one that was not drawn (no digest) has none.
bool hasPictures(const std::filesystem::path& folder, const std::string& digest);

/// Has the pictures of a cell in another folder too: as links, or as copies on another disk.
/// @return false if one is missing, or can't be had there
bool linkPictures(const std::filesystem::path& from, const std::filesystem::path& to,
                  const std::string& digest);
/// The same of all pictures in a folder, if it is there; makes the other.
/// @throws StoreError
void linkAllPictures(const std::filesystem::path& from, const std::filesystem::path& to);

/// Removes what a process that was killed has left half-written.
void removeHalfWritten(const std::filesystem::path& folder);

}  // namespace gnomon
