#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "scene/view.h"

namespace gnomon {

/// A short list on the stack: a prism has 5 faces, and a cut adds one corner to each.
template <class T, int N>
class Few {
  public:
    void push_back(const T& value) { m_items[m_size++] = value; }
    int size() const { return m_size; }
    const T& operator[](int i) const { return m_items[i]; }
    const T* begin() const { return m_items.data(); }
    const T* end() const { return m_items.data() + m_size; }

  private:
    std::array<T, N> m_items{};
    int m_size = 0;
};

/// A corner of a volume: a vertex of the mesh, or its point at infinity.
struct Corner {
    std::uint32_t vertex = 0;
    bool infinite = false;
    friend auto operator<=>(const Corner&, const Corner&) = default;
};

using Face = Few<Corner, 4>;
using ClipPolygon = Few<glm::vec4, 8>;

/// An edge of a volume, or the point in which it is cut.
struct CornerEdge {
    Corner from{}, to{};
};

/// The corners and cut points of one mesh and its volumes in clip space, computed in double precision and
/// rounded once. Each is a function of its corner, or of its edge, alone: faces that share an edge share its
/// points to the bit, and so do surfaces and the caps that lie on them.
class ClipSpace {
  public:
    /// @param offset  volumes start this far behind their vertices, away from the light, world units
    ClipSpace(const Mesh& mesh, const glm::vec4& light, const View& view, float offset = 0);

    bool directional() const { return m_light.w == 0; }

    /// A directional light has one point at infinity for all vertices.
    Corner atInfinity(std::uint32_t vertex) const { return {directional() ? 0 : vertex, true}; }

    /// Clip coordinates of a corner.
    glm::dvec4 clip(const Corner& c) const;

    /// Positive beyond the near plane: z + w. At infinity it is a difference of two heights, whose sign is
    /// exact: so a face has its corners beyond the plane in one run, whatever the rounding of the heights.
    double height(const Corner& c) const;

    /// Positive in front of the plane through the eye, parallel to the near plane: w, as exact as height().
    double eyeHeight(const Corner& c) const;

    /// The corner as drawn, beyond the near plane.
    glm::vec4 drawn(const Corner& c) const;

    /// Where the edge meets the near plane, raised by @p lift; double precision, z is not set.
    glm::dvec4 cutPoint(Corner a, Corner b, double lift = 0) const;

    /// The cut point as drawn: exactly at the near plane.
    glm::vec4 drawnCut(const Corner& a, const Corner& b) const;

    /// The part of @p face beyond the near plane.
    ClipPolygon beyond(const Face& face) const;

    /// The part of @p face between the plane through the eye and the near plane.
    /// @param flatten  onto the near plane (z = -w), as a depth clamp would; else at its own depth
    ClipPolygon before(const Face& face, bool flatten) const;

    /// The part of @p face in front of the plane through the eye (Usta et al. 2019, section 4).
    ClipPolygon inFront(const Face& face) const;

    /// @p face as it is; corners behind the eye have w < 0.
    ClipPolygon whole(const Face& face) const;

  private:
    double heightOf(const glm::dvec4& clip) const { return clip.z + clip.w; }
    glm::vec4 eyeCut(Corner a, Corner b) const;

    const Mesh& m_mesh;
    glm::dvec4 m_light;
    double m_near, m_offset;
    glm::dmat4 m_clip;
    glm::dvec4 m_clipLight;
};

/// The side that hangs from the edge, counter-clockwise seen from outside the volume.
Face sideFace(const ClipSpace& space, std::uint32_t from, std::uint32_t to);

/// A triangle with its smallest vertex first and then the smaller of the others, and whether that turned its
/// winding round. Drawn from it, a triangle and its copies of any rotation and winding have the same depth to
/// the bit.
struct Canonical {
    glm::uvec3 triangle{};
    bool reversed = false;
};
Canonical canonical(const glm::uvec3& triangle);

Face lightCap(const glm::uvec3& triangle);
Face farCap(const glm::uvec3& triangle);

/// Appends a convex polygon as a fan. @p reversed: wound the other way; a rasteriser that swaps the first two
/// vertices of a clockwise triangle then sets up both windings from the same three vertices.
template <class Points, class Out>
void appendFan(const Points& polygon, bool reversed, Out& triangles) {
    const int corners = int(std::size(polygon));
    for (int i = 2; i < corners; ++i) {
        triangles.push_back(polygon[reversed ? i - 1 : 0]);
        triangles.push_back(polygon[reversed ? 0 : i - 1]);
        triangles.push_back(polygon[i]);
    }
}

}  // namespace gnomon
