#pragma once

#include <filesystem>
#include <string>

#include "profile/profile.h"

namespace gnomon {

inline const std::filesystem::path kFolder = std::filesystem::path(GNOMON_SOURCE) / "profiles";

/// A profile as it ships.
inline Profile chip(const std::string& id) {
    return loadProfile(kFolder / (id + ".toml"));
}

}  // namespace gnomon
