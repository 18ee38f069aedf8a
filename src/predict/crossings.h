#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "scene/scene.h"
#include "scene/view.h"
#include "truth/truth.h"
#include "volume/volume.h"

namespace gnomon {

/// Where a face lies on an eye ray, with regard to the surface that is seen there; bits, so that they can be
/// possibilities.
enum Where : std::uint8_t {
    kAbsent = 0,
    kBefore = 1,
    kAt = 2,  ///< at its depth: the same polygon, or the background's
    kBehind = 4,
    kMaybeAbsent = 8,  ///< the ray passes a border of the face so closely that the face may not be drawn
};

/// The faces of a volume by how plans draw them.
enum class Piece : std::uint8_t {
    Side,          ///< beyond the near plane
    NearSide,      ///< between eye and near plane
    FarCap,        ///< at infinity
    LightCap,      ///< beyond the near plane
    NearLightCap,  ///< between eye and near plane
    NearCap,       ///< in the near plane
};

/// One crossing of an eye ray with a face of a volume.
struct Crossing {
    std::uint32_t volume = 0;  ///< below volumeCount()
    Piece piece = Piece::Side;
    bool front = false;
    bool own = false;           ///< of the seen triangle: its cap, or a side that hangs from one of its edges
    std::uint8_t exact = 0;     ///< kAbsent, kBefore, kAt or kBehind
    std::uint8_t possible = 0;  ///< bits: all that a rasteriser and a depth buffer may make of it
    auto operator<=>(const Crossing&) const = default;
    bool isSure() const { return exact == possible; }
};

/// All crossings of one ray, sorted. Those of equal volumes stand together.
using Signature = std::vector<Crossing>;

/// How many volumes hold the visible point, by all crossings before it: at the near plane and beyond, in
/// exact arithmetic. The background lies before infinity.
int volumesAround(const Signature& signature);

/// What every pixel's eye ray crosses. Pixels whose rays cross the same faces in the same way share one
/// signature.
struct Crossings {
    int width = 0, height = 0;
    std::vector<Signature> signatures{};
    std::vector<std::uint32_t> exact{};  ///< by pixel, rows from the top: index into signatures
    /// Pixels in which another surface may be seen, or the same with other crossings: all signatures that are
    /// possible there besides the exact one.
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> others{};

    /// Calls @p visit with each signature that is possible at @p pixel, the exact one first.
    template <class Visit>
    void each(std::uint32_t pixel, Visit&& visit) const {
        visit(exact[pixel]);
        if (others.empty()) return;
        const auto found = others.find(pixel);
        if (found == others.end()) return;
        for (const std::uint32_t signature : found->second) visit(signature);
    }
};

/// How many volumes the predictor numbers, caster by caster: none of one without lit triangles, one per lit
/// triangle where the caster says so. Those that no pixel sees are counted too, unlike a plan's.
std::size_t volumeCount(std::span<const LitCaster> lit);

/// Finds all crossings of all eye rays of @p view, in front of and behind the visible surface.
///
/// Faces are never cut: each is a cone of directions (cone.h), found in the pixels of its rows by its borders
/// and decided in exact arithmetic where a border or a depth is too close for doubles. What a rasteriser may
/// see otherwise (corners rounded to 1/256 pixel, depths within @p ties) is kept as a possibility.
///
/// @param lit     litCasters(): the plain builder, not the fast one that is drawn
/// @param offset  volumes start this far behind their casters, world units
Crossings crossingsOf(const Scene& scene, std::span<const LitCaster> lit, const glm::vec4& light,
                      const View& view, const DepthTies& ties, float offset = 0);

}  // namespace gnomon
