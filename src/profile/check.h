#pragma once

#include <string>
#include <vector>

#include "profile/profile.h"

namespace gnomon {

/// A capability that the rest of its profile rules out.
struct Contradiction {
    std::string key{};   ///< the capability at fault, as the file spells it
    std::string what{};  ///< a phrase that names the key
};

/// What no chip can be: capabilities of @p profile that need another one which it lacks. Empty for every
/// chip. Asks for values, not for keys: "stencil_wrap = false" needs no stencil.
std::vector<Contradiction> contradictions(const Profile& profile);

}  // namespace gnomon
