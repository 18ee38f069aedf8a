#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "predict/cone.h"
#include "scene/view.h"
#include "truth/count_ties.h"

namespace gnomon {

/// How far a rasteriser may move a corner, pixels.
constexpr double kCorner = 1.4142135623730951 * kSubpixel;
constexpr double kNearRounding = 1e-6;  ///< of a cut at the near plane, in window depth

/// A rectangle of pixels; rows from the bottom, as the window's y.
struct PixelBlock {
    int left = 0, bottom = 0, right = 0, top = 0;  ///< the last two are past the end
    bool isEmpty() const { return left >= right || bottom >= top; }
    int width() const { return right - left; }
    std::size_t pixels() const { return std::size_t(right - left) * std::size_t(top - bottom); }
    std::size_t slot(int x, int y) const {
        return std::size_t(y - bottom) * std::size_t(width()) + std::size_t(x - left);
    }
};

/// The pixels from one window position to another, and one more on each side; cut at the window.
inline PixelBlock blockAround(const View& view, glm::dvec2 least, glm::dvec2 most) {
    constexpr double kBeside = 1;
    const glm::dvec2 size(view.width, view.height);
    if (most.x < -kBeside || most.y < -kBeside || least.x > size.x + kBeside || least.y > size.y + kBeside)
        return {};
    least = glm::max(least, glm::dvec2(0)), most = glm::min(most, size);
    return {std::max(0, int(std::floor(least.x - kBeside))), std::max(0, int(std::floor(least.y - kBeside))),
            std::min(view.width, int(std::ceil(most.x + kBeside))),
            std::min(view.height, int(std::ceil(most.y + kBeside)))};
}

/// The pixels that a face with corners in these directions from the eye may touch; nothing where some of
/// them, not all, lie behind the eye.
inline std::optional<PixelBlock> blockOf(const View& view, std::span<const glm::dvec3> directions) {
    glm::dvec2 least(view.width, view.height), most(0);
    bool anyInFront = false, allInFront = true;
    for (const glm::dvec3& d : directions) {
        const double w = glm::dot(d, view.forward);
        const bool isInFront = w > 1e-9 * glm::length(d);
        anyInFront = anyInFront || w > 0;
        allInFront = allInFront && isInFront;
        if (!isInFront) continue;
        const glm::dvec2 at((glm::dot(d, view.right) / (w * view.tanHalfX) + 1) / 2 * view.width,
                            (glm::dot(d, view.up) / (w * view.tanHalfY) + 1) / 2 * view.height);
        least = glm::min(least, at), most = glm::max(most, at);
    }
    if (!anyInFront) return PixelBlock{};
    if (!allInFront) return {};
    return blockAround(view, least, most);
}

/// Calls @p visit(slot, x, y, isSure, holds) for each pixel of the block that the cone may cover: at its
/// centre, exactly, and however a rasteriser rounds the corners.
template <class Visit>
void eachPixel(const Cone& cone, const View& view, const PixelBlock& block, const Visit& visit) {
    if (cone.isEmpty()) return;
    const double slack = kCorner + cone.insideError();
    for (int row = block.bottom; row < block.top; ++row) {
        const double y = row + 0.5;
        const auto [first, last] = cone.columns(y, kCorner, view.width);
        const int begin = std::max(first, block.left), end = std::min(last, block.right);
        for (int column = begin; column < end; ++column) {
            const double x = column + 0.5, inside = cone.inside(x, y);
            const bool isSure = inside > slack;
            const bool holds = isSure || (std::abs(inside) > cone.insideError()
                                              ? inside > 0
                                              : cone.holds({view.eye, rayDirection(view, x, y)}, x, y));
            visit(block.slot(column, row), x, y, isSure, holds);
        }
    }
}

/// The slope of window depth over the window; depth is 1 - near / distance.
inline glm::dvec2 depthSlope(const WindowLine& inverse, double near) {
    return -near * glm::dvec2(inverse.x, inverse.y);
}

}  // namespace gnomon
