#include "matrix/cost_setting.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace gnomon {
namespace {

/// What of @p axes differs from @p row, in words: "levels 3". The shade is no part of it.
std::vector<std::string> differences(const Axes& row, const Axes& axes) {
    std::vector<std::string> words;
    const auto compare = [&](auto member, const auto& word) {
        if (row.*member != axes.*member) words.push_back(word(axes.*member));
    };
    const auto named = [](const auto& value) { return name(value); };
    compare(&Axes::store, named);
    compare(&Axes::arithmetic, named);
    compare(&Axes::levels, [](int levels) { return fmt::format("levels {}", levels); });
    compare(&Axes::count, named);
    compare(&Axes::silhouette, named);
    compare(&Axes::maskDivisor, [](int divisor) { return fmt::format("mask {}", maskScaleName(divisor)); });
    compare(&Axes::apply, [](Apply apply) { return fmt::format("apply {}", name(apply)); });
    compare(&Axes::start, [](Start start) { return fmt::format("start {}", name(start)); });
    compare(&Axes::overflow, named);
    compare(&Axes::capFaces, [](CapFaces faces) { return fmt::format("caps {}", name(faces)); });
    compare(&Axes::clip, [](Clip clip) { return fmt::format("clip {}", name(clip)); });
    compare(&Axes::offset, [](float offset) { return fmt::format("offset {}", offset); });
    compare(&Axes::mapSize, [](int size) { return fmt::format("map {}", size); });
    compare(&Axes::mapBias, [](float bias) { return fmt::format("bias {}", bias); });
    return words;
}

std::string withShade(const std::string& text, Shade shade) {
    return shade == Shade::Attenuated ? text : fmt::format("{}, {}", text, name(shade));
}

/// The named method @p id at @p shade.
Axes rowOf(const char* id, Shade shade) {
    Axes axes = findMethod(id)->axes;
    axes.shade = shade;
    return axes;
}

/// Whether the chip computes anything in another way than OpenGL's ideal.
bool hasOwnArithmetic(const Profile& profile) {
    const ChipArithmetic own = arithmeticOf(profile, {.fidelity = Fidelity::Chip}), ideal{};
    return own.unit != ideal.unit || own.dither != ideal.dither || own.undithered != ideal.undithered ||
           own.depth != ideal.depth;
}

/// The named methods with other values of one axis each.
std::vector<Axes> sweptAxes(Shade shade) {
    std::vector<Axes> all;
    const auto sweep = [&](const char* id, auto member, auto values) {
        for (const auto value : values) {
            Axes axes = rowOf(id, shade);
            if (axes.*member == value) continue;
            axes.*member = value;
            all.push_back(axes);
        }
    };
    // The masks of 1, 1/2 and 1/4 of the window are named methods.
    for (const char* id : {"roettger-screen", "roettger-alpha"})
        sweep(id, &Axes::levels, std::initializer_list<int>{1, 2, 3, 4});
    sweep("heidmann", &Axes::silhouette,
          std::initializer_list<Silhouette>{Silhouette::Triangular, Silhouette::Visible, Silhouette::Manifold,
                                            Silhouette::PerTriangle});
    sweep("williams", &Axes::mapSize, std::initializer_list<int>{256, 512, 1024, 2048});
    return all;
}

}  // namespace

std::string settingName(const Axes& given) {
    const Axes axes = normalised(given);
    std::string best;
    for (const NamedMethod& row : namedMethods()) {
        if (row.axes.automatic != axes.automatic) continue;
        const std::vector<std::string> words = differences(row.axes, axes);
        if (words.empty()) return withShade(row.id, axes.shade);
        if (words.size() == 1 && best.empty() && row.axes.store == axes.store)
            best = fmt::format("{} {}", row.id, words.front());
    }
    return withShade(best.empty() ? methodId(axes) : best, axes.shade);
}

std::vector<CostSetting> costSettings(const Profile& profile, const std::vector<Axes>& methods,
                                      const std::vector<FidelityChoice>& fidelities,
                                      const std::optional<Effects>& effects) {
    std::vector<CostSetting> settings;
    for (const FidelityChoice& fidelity : fidelities)
        for (const Axes& axes : methods) {
            const std::string words = settingName(axes);
            const bool isChip = fidelity.fidelity == Fidelity::Chip;
            settings.push_back({.name = isChip ? fmt::format("{}, chip", words) : words,
                                .way = {profile, axes, fidelity, effects},
                                .isNamed = !isChip && findMethod(words)});
        }
    return settings;
}

std::vector<CostSetting> costSweep(const Profile& profile, Shade shade,
                                   const std::vector<FidelityChoice>& fidelities,
                                   const std::optional<Effects>& effects) {
    std::vector<Axes> named;
    for (const NamedMethod& row : namedMethods()) named.push_back(rowOf(row.id.c_str(), shade));

    std::vector<FidelityChoice> drawn = fidelities.empty() ? std::vector<FidelityChoice>{{}} : fidelities;
    if (fidelities.empty() && hasOwnArithmetic(profile)) drawn.push_back({.fidelity = Fidelity::Chip});
    std::vector<CostSetting> all = costSettings(profile, named, drawn, effects);

    for (CostSetting& setting : costSettings(profile, sweptAxes(shade), {drawn.front()}, effects))
        all.push_back(std::move(setting));

    for (std::size_t i = 1; i < profile.depthBits.size(); ++i) {
        Profile other = profile;
        std::swap(other.depthBits.front(), other.depthBits[i]);
        std::vector<Axes> methods;
        for (const char* id : {"heidmann", "carmack", "roettger-screen"}) methods.push_back(rowOf(id, shade));
        for (CostSetting& setting : costSettings(other, methods, {drawn.front()}, effects)) {
            setting.name = fmt::format("{}, depth {}", setting.name, other.depthBits.front());
            setting.isNamed = false;
            all.push_back(std::move(setting));
        }
    }
    return all;
}

}  // namespace gnomon
