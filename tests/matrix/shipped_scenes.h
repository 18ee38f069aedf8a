#pragma once

#include <cctype>
#include <cstdlib>
#include <string>
#include <vector>

#include "scenes.h"

namespace gnomon {

/// Whether the environment asks for all chips and frames: GNOMON_MINIMAL=all.
inline bool wantsAllChips() {
    const char* wanted = std::getenv("GNOMON_MINIMAL");
    return wanted && std::string(wanted) == "all";
}

/// All chips, or one of each kind.
inline std::vector<Profile> chipsOfEachKind() {
    if (!wantsAllChips()) return {chip("ideal"), chip("voodoo2"), chip("ps2"), chip("tnt"), chip("psp-5551")};
    std::vector<Profile> all;
    for (const std::string& id : profileIds(kSource / "profiles")) all.push_back(chip(id));
    return all;
}

/// The same for a scene: hundreds of volumes in one another take long with each method.
inline std::vector<Profile> chipsOfEachKind(const std::string& scene) {
    std::vector<Profile> chips = chipsOfEachKind();
    if (scene.find("hard/layers-") == 0 && !wantsAllChips()) chips.resize(1);
    return chips;
}

/// Ids of all scenes and hard cases.
inline std::vector<std::string> allSceneIds() {
    std::vector<std::string> all = sceneIds(kSource / "scenes");
    for (const std::string& id : hardSceneIds(kSource / "scenes")) all.push_back(id);
    return all;
}

/// "hard/eye-on-side" -> "hard_eye_on_side"
inline std::string testNameOf(std::string id) {
    for (char& c : id)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return id;
}

}  // namespace gnomon
