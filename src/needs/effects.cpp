#include "needs/effects.h"

#include <algorithm>
#include <array>

namespace gnomon {
namespace {

const std::array<std::string, kEffects>& names() {
    static const std::array<std::string, kEffects> kNames{
        "lights", "ambient", "volumes", "near-caps", "far-caps", "levels", "window", "emulation", "mask"};
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

std::string toString(const Effects& effects) {
    if (effects == Effects::all()) return "full";
    std::string words;
    for (int i = 0; i < kEffects; ++i)
        if (effects.has(Effect(i))) words += (words.empty() ? "" : ",") + name(Effect(i));
    return words.empty() ? "needed" : words;
}

std::optional<Effects> effectsFrom(const std::string& words) {
    if (words == "full") return Effects::all();
    if (words == "needed") return Effects::none();
    Effects effects;
    for (std::size_t begin = 0; begin <= words.size();) {
        const std::size_t end = std::min(words.find(',', begin), words.size());
        const auto effect = effectNamed(words.substr(begin, end - begin));
        if (!effect) return std::nullopt;
        effects.add(*effect);
        begin = end + 1;
    }
    return effects;
}

}  // namespace gnomon
