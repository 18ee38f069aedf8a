#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>

#include "scene/view.h"
#include "volume/volume.h"

namespace gnomon {

/// The faces of a volume, by what they are needed for. Beyond the near plane unless it says otherwise.
enum class Part : std::uint8_t {
    Sides,      ///< from the edges of the silhouette to infinity
    NearFaces,  ///< sides and light cap between the plane through the eye and the near plane
    FarCap,     ///< the caps' triangles at infinity, turned round; a directional light has none
    LightCap,   ///< the caps' triangles themselves
    NearCap,    ///< at the near plane, z = -w to the bit; front faces
};
constexpr int kParts = 5;

/// A set of parts.
class Parts {
  public:
    constexpr Parts() = default;
    constexpr Parts(Part part) : m_bits(1u << int(part)) {}
    constexpr bool has(Part part) const { return (m_bits >> int(part)) & 1u; }
    constexpr bool empty() const { return m_bits == 0; }
    friend constexpr Parts operator|(Parts a, Parts b) {
        a.m_bits |= b.m_bits;
        return a;
    }
    friend constexpr auto operator<=>(const Parts&, const Parts&) = default;

  private:
    unsigned m_bits = 0;
};
constexpr Parts operator|(Part a, Part b) {
    return Parts(a) | Parts(b);
}

/// Where the host cuts volumes before OpenGL does.
enum class Clip : std::uint8_t {
    Frustum,  ///< at the near plane and the window's sides: OpenGL has nothing to cut
    Eye,      ///< at the plane through the eye, parallel to the near plane (Usta et al. 2019, section 4)
    None,     ///< nowhere
};
constexpr int kClips = 3;

/// How the volumes of a frame are cut.
struct CutStyle {
    Clip clip = Clip::Frustum;
    bool flatten = true;  ///< NearFaces lie in the near plane; else they keep their depth, for a depth clamp
    float offset = 0;     ///< volumes start this far behind their caster, away from the light, world units
    friend auto operator<=>(const CutStyle&, const CutStyle&) = default;
};

/// Takes a convex polygon in clip space, ready to be drawn with identity matrices; counter-clockwise seen
/// from outside the volume, or clockwise if @p reversed.
using PolygonSink = std::function<void(Part part, std::span<const glm::vec4> polygon, bool reversed)>;

/// Cuts the volume of @p caster into @p parts. With clip Frustum the parts beyond the near plane are closed
/// by the near cap. Faces share vertices to the bit, so the rasteriser leaves no crack between them. A face
/// with weight w is there w times.
///
/// Each cut point belongs to one edge of the volume (a vertex's ray, a mesh edge, or an edge at infinity), is
/// computed from that edge alone in a fixed direction, and so is the same for all faces there. Cut points of
/// edges at infinity have w = 0. Faces that coincide but for their winding (sides of two volumes that share
/// an edge, a cap and its surface) are the same polygon, once reversed.
///
/// Clip Eye and None don't split sides: Sides then are all of them, and NearFaces only the light cap. Light
/// caps are cut as the frame's surfaces are with any clip: they are the same polygons, and must keep their
/// depth to the bit.
void cutVolume(const Scene& scene, const LitCaster& caster, const glm::vec4& light, const View& view,
               Parts parts, const CutStyle& style, const PolygonSink& sink);

}  // namespace gnomon
