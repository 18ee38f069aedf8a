#include "volume/near_cap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "volume/orient.h"

namespace gnomon {
namespace {

using Faces = Few<Face, 5>;

/// All faces of the volume of one triangle.
Faces prism(const ClipSpace& space, const glm::uvec3& t) {
    Faces faces;
    faces.push_back(lightCap(t));
    for (int k = 0; k < 3; ++k) faces.push_back(sideFace(space, t[k], t[(k + 1) % 3]));
    if (!space.directional()) faces.push_back(farCap(t));
    return faces;
}

/// The edges of the section of a prism with the plane, in order, so that the section is counter-clockwise
/// seen from before the plane. @p lift moves the plane away from the eye.
Few<CornerEdge, 5> section(const ClipSpace& space, const glm::uvec3& triangle, double lift = 0) {
    // Each face that the plane cuts leaves it at one edge and comes back at another.
    struct Cut {
        CornerEdge enter{}, leave{};
    };
    Few<Cut, 5> cuts;
    for (const Face& face : prism(space, triangle)) {
        Cut cut;
        bool isCut = false;
        for (int i = 0; i < face.size(); ++i) {
            const Corner a = face[i], b = face[(i + 1) % face.size()];
            const bool aBeyond = space.height(a) >= (a.infinite ? 0 : lift);
            const bool bBeyond = space.height(b) >= (b.infinite ? 0 : lift);
            if (aBeyond && !bBeyond) cut.leave = {a, b};
            if (!aBeyond && bBeyond) cut.enter = {b, a};  // as the neighbour walks it
            isCut = isCut || aBeyond != bBeyond;
        }
        if (isCut) cuts.push_back(cut);
    }
    if (cuts.size() == 0) return {};

    // The face that enters over an edge follows the face that left over it: the corners beyond the plane are
    // connected, so there is one ring.
    Few<CornerEdge, 5> ring;
    const auto isSame = [](const CornerEdge& a, const CornerEdge& b) {
        return a.from == b.from && a.to == b.to;
    };
    CornerEdge at = cuts[0].enter;
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
    const ClipSpace space(mesh, light, view);
    std::vector<glm::dvec4> polygon;
    for (const glm::uvec3& t : caster.lit) {
        const std::array<glm::dvec3, 3> corners = {mesh.positions[t.x], mesh.positions[t.y],
                                                   mesh.positions[t.z]};
        if (rectangle.misses(corners)) continue;
        for (const double lift : {0.0, -1e-4 * view.nearPlane, 1e-4 * view.nearPlane}) {
            polygon.clear();
            for (const CornerEdge& e : section(space, t, lift))
                polygon.push_back(space.cutPoint(e.from, e.to, lift));
            if (rectangle.meets(polygon)) return true;
        }
    }
    return false;
}

ClipPolygon nearCap(const ClipSpace& space, const glm::uvec3& triangle) {
    ClipPolygon polygon;
    for (const CornerEdge& e : section(space, triangle)) polygon.push_back(space.drawnCut(e.from, e.to));
    return polygon;
}

}  // namespace gnomon
