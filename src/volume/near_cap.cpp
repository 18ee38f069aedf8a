#include "volume/near_cap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "volume/orient.h"

namespace gnomon {
namespace {

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

/// Corners and cut points in clip space. Each is a function of its corner, or of its edge, alone.
class NearPlane {
  public:
    NearPlane(const Mesh& mesh, const glm::vec4& light, const View& view)
        : m_mesh(mesh),
          m_light(light),
          m_near(view.nearPlane),
          m_clip(clipFromEye(view) * eyeFromWorld(view)),
          m_lightHeight(heightOf(m_clip * m_light)) {}

    bool directional() const { return m_light.w == 0; }

    /// A directional light has one point at infinity for all vertices.
    Corner atInfinity(std::uint32_t vertex) const { return {directional() ? 0 : vertex, true}; }

    glm::dvec4 clip(const Corner& c) const {
        if (!c.infinite) return m_clip * glm::dvec4(m_mesh.positions[c.vertex], 1);
        if (directional()) return m_clip * -m_light;
        return m_clip * glm::dvec4(glm::dvec3(m_mesh.positions[c.vertex]) - glm::dvec3(m_light), 0);
    }

    /// Positive beyond the near plane; z + w in clip space. At infinity it is a difference of two heights,
    /// whose sign is exact: so a face has its corners beyond the plane in one run, whatever the rounding of
    /// the heights.
    double height(const Corner& c) const {
        if (!c.infinite) return heightOf(clip(c));
        return (directional() ? 0 : heightOf(clip({c.vertex, false}))) - m_lightHeight;
    }

    /// The corner as drawn.
    glm::vec4 drawn(const Corner& c) const {
        const glm::dvec4 p = clip(c);
        const auto w = static_cast<float>(std::max(p.w, 0.0));
        const auto z = static_cast<float>(p.z);
        return {static_cast<float>(p.x), static_cast<float>(p.y), c.infinite ? w : std::max(z, -w), w};
    }

    /// Where the edge meets the near plane, raised by @p lift; double precision, z is not set.
    glm::dvec4 cutPoint(Corner a, Corner b, double lift = 0) const {
        if (b < a) std::swap(a, b);
        const double ha = std::abs(height(a) - (a.infinite ? 0 : lift));
        const double hb = std::abs(height(b) - (b.infinite ? 0 : lift));
        const double u = ha / (ha + hb), v = hb / (ha + hb);
        glm::dvec4 p = v * clip(a) + u * clip(b);
        // Near plane: w is its distance, exact where the sum would cancel.
        p.w = (m_near + lift / 2) * (v * (a.infinite ? 0 : 1) + u * (b.infinite ? 0 : 1));
        return p;
    }

    /// The cut point as drawn: exactly at the near plane.
    glm::vec4 drawnCut(const Corner& a, const Corner& b) const {
        const glm::dvec4 p = cutPoint(a, b);
        const auto w = static_cast<float>(p.w);
        return {static_cast<float>(p.x), static_cast<float>(p.y), -w, w};
    }

  private:
    static double heightOf(const glm::dvec4& clip) { return clip.z + clip.w; }

    const Mesh& m_mesh;
    glm::dvec4 m_light;
    double m_near;
    glm::dmat4 m_clip;
    double m_lightHeight;
};

using Face = Few<Corner, 4>;
using Faces = Few<Face, 5>;

struct Edge {
    Corner from{}, to{};
};

/// The side that hangs from the edge, counter-clockwise seen from outside.
Face sideFace(const NearPlane& plane, std::uint32_t from, std::uint32_t to) {
    Face face;
    face.push_back({to, false});
    face.push_back({from, false});
    face.push_back(plane.atInfinity(from));
    if (!plane.directional()) face.push_back(plane.atInfinity(to));
    return face;
}

Face lightCap(const glm::uvec3& t) {
    Face face;
    for (int k = 0; k < 3; ++k) face.push_back({t[k], false});
    return face;
}

Face farCap(const glm::uvec3& t) {
    Face face;
    for (const int k : {0, 2, 1}) face.push_back({t[k], true});
    return face;
}

/// All faces of the volume of one triangle.
Faces prism(const NearPlane& plane, const glm::uvec3& t) {
    Faces faces;
    faces.push_back(lightCap(t));
    for (int k = 0; k < 3; ++k) faces.push_back(sideFace(plane, t[k], t[(k + 1) % 3]));
    if (!plane.directional()) faces.push_back(farCap(t));
    return faces;
}

/// Appends the part of @p face beyond the near plane, as a fan; @p reversed: wound the other way. A
/// rasteriser that swaps the first two vertices of a clockwise triangle then sets up both windings from the
/// same three vertices.
void appendBeyond(const NearPlane& plane, const Face& face, bool reversed,
                  std::vector<glm::vec4>& triangles) {
    Few<glm::vec4, 8> polygon;
    for (int i = 0; i < face.size(); ++i) {
        const Corner a = face[i], b = face[(i + 1) % face.size()];
        const bool aBeyond = plane.height(a) >= 0, bBeyond = plane.height(b) >= 0;
        if (aBeyond) polygon.push_back(plane.drawn(a));
        if (aBeyond != bBeyond) polygon.push_back(plane.drawnCut(a, b));
    }
    for (int i = 2; i < polygon.size(); ++i) {
        triangles.push_back(polygon[reversed ? i - 1 : 0]);
        triangles.push_back(polygon[reversed ? 0 : i - 1]);
        triangles.push_back(polygon[i]);
    }
}

/// Appends a side. Sides that hang from one edge in opposite directions (of two volumes that share it) get
/// the same triangles, so that their depths are the same to the bit and cancel.
void appendSide(const NearPlane& plane, std::uint32_t from, std::uint32_t to,
                std::vector<glm::vec4>& triangles) {
    const bool reversed = from < to;
    appendBeyond(plane, reversed ? sideFace(plane, to, from) : sideFace(plane, from, to), reversed,
                 triangles);
}

/// The edges of the section of a prism with the plane, in order, so that the section is counter-clockwise
/// seen from before the plane. @p lift moves the plane away from the eye.
Few<Edge, 5> section(const NearPlane& plane, const glm::uvec3& triangle, double lift = 0) {
    // Each face that the plane cuts leaves it at one edge and comes back at another.
    struct Cut {
        Edge enter{}, leave{};
    };
    Few<Cut, 5> cuts;
    for (const Face& face : prism(plane, triangle)) {
        Cut cut;
        bool isCut = false;
        for (int i = 0; i < face.size(); ++i) {
            const Corner a = face[i], b = face[(i + 1) % face.size()];
            const bool aBeyond = plane.height(a) >= (a.infinite ? 0 : lift);
            const bool bBeyond = plane.height(b) >= (b.infinite ? 0 : lift);
            if (aBeyond && !bBeyond) cut.leave = {a, b};
            if (!aBeyond && bBeyond) cut.enter = {b, a};  // as the neighbour walks it
            isCut = isCut || aBeyond != bBeyond;
        }
        if (isCut) cuts.push_back(cut);
    }
    if (cuts.size() == 0) return {};

    // The face that enters over an edge follows the face that left over it: the corners beyond the plane are
    // connected, so there is one ring.
    Few<Edge, 5> ring;
    const auto isSame = [](const Edge& a, const Edge& b) { return a.from == b.from && a.to == b.to; };
    Edge at = cuts[0].enter;
    do {
        ring.push_back(at);
        const auto* cut =
            std::find_if(cuts.begin(), cuts.end(), [&](const Cut& c) { return isSame(c.enter, at); });
        if (cut == cuts.end()) return {};
        at = cut->leave;
    } while (!isSame(at, cuts[0].enter) && ring.size() < cuts.size());
    return ring;
}

/// The near rectangle with its margin, and the pyramid between it and the light.
class NearRectangle {
  public:
    NearRectangle(const glm::vec4& light, const View& view) {
        // 2 pixels, and half of one for all rounding.
        m_limitX = 1 + 5.0 / view.width;
        m_limitY = 1 + 5.0 / view.height;

        const glm::dvec3 centre = view.eye + view.nearPlane * view.forward;
        const glm::dvec3 x = view.nearPlane * view.tanHalfX * m_limitX * view.right;
        const glm::dvec3 y = view.nearPlane * view.tanHalfY * m_limitY * view.up;
        const glm::dvec3 corners[4] = {centre - x - y, centre + x - y, centre + x + y, centre - x + y};

        const glm::dvec3 toLight = light.w == 0 ? glm::dvec3(light) : glm::dvec3(light) - centre;
        const double above = glm::dot(toLight, view.forward);
        const double extent = glm::length(x) + glm::length(y);
        // A light in the near plane spans no pyramid.
        if (std::abs(above) < 1e-6 * (light.w == 0 ? 1 : extent + glm::length(toLight))) return;

        for (int i = 0; i < 4; ++i) {
            const glm::dvec3 edge = corners[(i + 1) % 4] - corners[i];
            addPlane(glm::cross(edge, light.w == 0 ? toLight : glm::dvec3(light) - corners[i]), corners[i],
                     centre);
        }
        // Only what lies on the light's side of the near plane can hide it; the margin is that of touching().
        addPlane(view.forward * above, centre - view.forward * std::copysign(1e-3 * view.nearPlane, above),
                 centre + toLight);
        if (light.w != 0) addPlane(view.forward * above, glm::dvec3(light), centre);
    }

    /// Whether all of @p points lie outside one plane of the pyramid.
    bool misses(std::span<const glm::dvec3> points) const {
        return std::any_of(m_planes.begin(), m_planes.end(), [&](const glm::dvec4& plane) {
            return std::all_of(points.begin(), points.end(), [&](const glm::dvec3& p) {
                const glm::dvec3 terms = glm::dvec3(plane) * p;
                const double size =
                    std::abs(terms.x) + std::abs(terms.y) + std::abs(terms.z) + std::abs(plane.w);
                return terms.x + terms.y + terms.z + plane.w > 1e-9 * size;
            });
        });
    }

    /// Whether the convex polygon of homogeneous points (x, y, -, w) has a point in the rectangle.
    bool meets(std::vector<glm::dvec4>& polygon) const {
        for (const glm::dvec3 limit : {glm::dvec3(1, 0, m_limitX), glm::dvec3(-1, 0, m_limitX),
                                       glm::dvec3(0, 1, m_limitY), glm::dvec3(0, -1, m_limitY)}) {
            const auto distance = [&](const glm::dvec4& p) {
                return limit.x * p.x + limit.y * p.y + limit.z * p.w;
            };
            std::vector<glm::dvec4> kept;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const glm::dvec4 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
                const double da = distance(a), db = distance(b);
                if (da >= 0) kept.push_back(a);
                if ((da >= 0) != (db >= 0))
                    kept.push_back((std::abs(db) * a + std::abs(da) * b) / std::abs(da - db));
            }
            polygon.swap(kept);
        }
        return !polygon.empty();
    }

  private:
    /// The plane through @p at with @p inside on its negative side.
    void addPlane(glm::dvec3 normal, const glm::dvec3& at, const glm::dvec3& inside) {
        if (glm::dot(normal, inside - at) > 0) normal = -normal;
        m_planes.push_back({normal, -glm::dot(normal, at)});
    }

    double m_limitX, m_limitY;
    Few<glm::dvec4, 6> m_planes;  ///< dot(plane, (p, 1)) > 0 outside; none: no quick answer
};

}  // namespace

bool touchesNearRectangle(const Scene& scene, const LitCaster& caster, const glm::vec4& light,
                          const View& view) {
    const Mesh& mesh = scene.objects[caster.object].mesh;
    const NearRectangle rectangle(light, view);

    // Quick answer for the whole caster by its bounding box.
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const glm::uvec3& t : caster.lit) {
        for (int k = 0; k < 3; ++k) {
            low = glm::min(low, glm::dvec3(mesh.positions[t[k]]));
            high = glm::max(high, glm::dvec3(mesh.positions[t[k]]));
        }
    }
    std::array<glm::dvec3, 8> box;
    for (int i = 0; i < 8; ++i)
        box[i] = {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
    if (caster.lit.empty() || rectangle.misses(box)) return false;

    // Each triangle: its section with the near plane, and with planes a little before and behind it, so that
    // rounding can't lose a volume that only just reaches the plane.
    const NearPlane plane(mesh, light, view);
    std::vector<glm::dvec4> polygon;
    for (const glm::uvec3& t : caster.lit) {
        const std::array<glm::dvec3, 3> corners = {mesh.positions[t.x], mesh.positions[t.y],
                                                   mesh.positions[t.z]};
        if (rectangle.misses(corners)) continue;
        for (const double lift : {0.0, -1e-4 * view.nearPlane, 1e-4 * view.nearPlane}) {
            polygon.clear();
            for (const Edge& e : section(plane, t, lift))
                polygon.push_back(plane.cutPoint(e.from, e.to, lift));
            if (rectangle.meets(polygon)) return true;
        }
    }
    return false;
}

NearCut cutAtNearPlane(const Scene& scene, const LitCaster& caster, const glm::vec4& light,
                       const View& view) {
    const Mesh& mesh = scene.objects[caster.object].mesh;
    const NearPlane plane(mesh, light, view);
    NearCut cut;

    // Sides: front where the eye lies on the outer side of the plane through the edge and the light.
    for (const Side& side : caster.sides) {
        const glm::dvec3 from = mesh.positions[side.from], to = mesh.positions[side.to];
        const bool isFront = orientation(from, to, view.eye, glm::dvec4(light)) < 0;
        for (int i = 0; i < side.weight; ++i)
            appendSide(plane, side.from, side.to, isFront ? cut.fronts : cut.backs);
    }

    // Far cap: always a back, as the eye is on this side of infinity.
    if (!plane.directional()) {
        for (const glm::uvec3& t : caster.lit) appendBeyond(plane, farCap(t), false, cut.backs);
    }

    // Near cap: one polygon per lit triangle.
    for (const glm::uvec3& t : caster.lit) {
        Few<glm::vec4, 5> polygon;
        for (const Edge& e : section(plane, t)) polygon.push_back(plane.drawnCut(e.from, e.to));
        for (int i = 2; i < polygon.size(); ++i) {
            for (const int k : {0, i - 1, i}) cut.cap.push_back(polygon[k]);
        }
    }
    return cut;
}

}  // namespace gnomon
