#include "needs/effects.h"

#include <array>

namespace gnomon {
namespace {

const std::array<std::string, kEffects>& names() {
    static const std::array<std::string, kEffects> kNames{"lights",   "ambient", "volumes", "near-caps",
                                                          "far-caps", "levels",  "window",  "mask"};
    return kNames;
}

}  // namespace

const std::string& name(Effect effect) {
    return names()[std::size_t(effect)];
}

std::optional<Effect> effectNamed(const std::string& word) {
    for (int i = 0; i < kEffects; ++i)
        if (names()[std::size_t(i)] == word) return Effect(i);
    return std::nullopt;
}

}  // namespace gnomon
