#pragma once

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "method/method.h"
#include "predict/mask_prediction.h"

namespace gnomon {

inline Profile idealChip() {
    return loadProfile(std::filesystem::path(GNOMON_SOURCE) / "profiles" / "ideal.toml");
}

const MaskChannel kEightBits{.format = {"8888", 8, 8, 8, 8}};

/// A side that is surely before the surface.
inline Crossing side(bool front, std::uint32_t volume = 0) {
    return {.volume = volume, .piece = Piece::Side, .front = front, .exact = kBefore, .possible = kBefore};
}
inline Crossing in(std::uint32_t volume = 0) {
    return side(true, volume);
}
inline Crossing out(std::uint32_t volume = 0) {
    return side(false, volume);
}

/// The same, of which a depth buffer and a rasteriser may make @p possible.
inline Crossing doubtful(Crossing c, std::uint8_t possible) {
    c.possible = possible;
    return c;
}
inline Crossing behind(Crossing c) {
    c.exact = c.possible = kBehind;
    return c;
}
inline Crossing nearCap(std::uint32_t volume = 0) {
    return {.volume = volume, .piece = Piece::NearCap, .front = true, .exact = kBefore, .possible = kBefore};
}
inline Crossing farCap(std::uint32_t volume = 0) {
    return {.volume = volume, .piece = Piece::FarCap, .front = false, .exact = kBehind, .possible = kBehind};
}

/// @p crossing that many times.
inline Signature times(int count, const Crossing& crossing) {
    return Signature(std::size_t(count), crossing);
}
inline Signature operator+(Signature a, const Signature& b) {
    a.insert(a.end(), b.begin(), b.end());
    std::sort(a.begin(), a.end());
    return a;
}

/// A window of one row, each pixel's ray with crossings of its own.
inline Crossings row(std::vector<Signature> rays) {
    Crossings all{.width = int(rays.size()), .height = 1};
    for (std::uint32_t i = 0; i < rays.size(); ++i) all.exact.push_back(i);
    for (Signature& ray : rays) std::sort(ray.begin(), ray.end());
    all.signatures = std::move(rays);
    return all;
}

/// The plan of such a window with one light.
inline Plan planOf(const Axes& axes, int pixels, int volumes = 1, const Profile& profile = idealChip()) {
    return planFrame(axes, {.width = pixels, .height = 1, .lights = {{.volumes = volumes}}}, profile);
}

inline Axes method(const std::string& id) {
    return findMethod(id)->axes;
}

}  // namespace gnomon
