#include "volume/clip_space.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

ClipSpace::ClipSpace(const Mesh& mesh, const glm::vec4& light, const View& view, float offset)
    : m_mesh(mesh),
      m_light(light),
      m_near(view.nearPlane),
      m_offset(offset),
      m_clip(clipFromEye(view) * eyeFromWorld(view)),
      m_clipLight(m_clip * m_light) {}

glm::dvec4 ClipSpace::clip(const Corner& c) const {
    if (c.infinite && directional()) return m_clip * -m_light;
    glm::dvec3 p(m_mesh.positions[c.vertex]);
    if (c.infinite) return m_clip * glm::dvec4(p - glm::dvec3(m_light), 0);
    if (m_offset != 0)
        p += m_offset * glm::normalize(directional() ? glm::dvec3(-m_light) : p - glm::dvec3(m_light));
    return m_clip * glm::dvec4(p, 1);
}

double ClipSpace::height(const Corner& c) const {
    if (!c.infinite) return heightOf(clip(c));
    return (directional() ? 0 : heightOf(clip({c.vertex, false}))) - heightOf(m_clipLight);
}

double ClipSpace::eyeHeight(const Corner& c) const {
    if (!c.infinite) return clip(c).w;
    return (directional() ? 0 : clip({c.vertex, false}).w) - m_clipLight.w;
}

glm::vec4 ClipSpace::drawn(const Corner& c) const {
    const glm::dvec4 p = clip(c);
    const auto w = static_cast<float>(std::max(p.w, 0.0));
    const auto z = static_cast<float>(p.z);
    return {static_cast<float>(p.x), static_cast<float>(p.y), c.infinite ? w : std::max(z, -w), w};
}

glm::dvec4 ClipSpace::cutPoint(Corner a, Corner b, double lift) const {
    if (b < a) std::swap(a, b);
    const double ha = std::abs(height(a) - (a.infinite ? 0 : lift));
    const double hb = std::abs(height(b) - (b.infinite ? 0 : lift));
    const double u = ha / (ha + hb), v = hb / (ha + hb);
    glm::dvec4 p = v * clip(a) + u * clip(b);
    // Near plane: w is its distance, exact where the sum would cancel.
    p.w = (m_near + lift / 2) * (v * (a.infinite ? 0 : 1) + u * (b.infinite ? 0 : 1));
    return p;
}

glm::vec4 ClipSpace::drawnCut(const Corner& a, const Corner& b) const {
    const glm::dvec4 p = cutPoint(a, b);
    const auto w = static_cast<float>(p.w);
    return {static_cast<float>(p.x), static_cast<float>(p.y), -w, w};
}

/// Where the edge meets the plane through the eye: w = 0.
glm::vec4 ClipSpace::eyeCut(Corner a, Corner b) const {
    if (b < a) std::swap(a, b);
    const double ha = std::abs(eyeHeight(a)), hb = std::abs(eyeHeight(b));
    const glm::dvec4 p = hb / (ha + hb) * clip(a) + ha / (ha + hb) * clip(b);
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 0.0f};
}

ClipPolygon ClipSpace::beyond(const Face& face) const {
    ClipPolygon polygon;
    for (int i = 0; i < face.size(); ++i) {
        const Corner a = face[i], b = face[(i + 1) % face.size()];
        const bool aBeyond = height(a) >= 0, bBeyond = height(b) >= 0;
        if (aBeyond) polygon.push_back(drawn(a));
        if (aBeyond != bBeyond) polygon.push_back(drawnCut(a, b));
    }
    return polygon;
}

ClipPolygon ClipSpace::before(const Face& face, bool flatten) const {
    // Before the near plane: corners, and cut points on edges of the face.
    struct Point {
        CornerEdge edge{};
        bool isCut = false;
    };
    Few<Point, 8> points;
    for (int i = 0; i < face.size(); ++i) {
        const Corner a = face[i], b = face[(i + 1) % face.size()];
        const bool aBefore = height(a) < 0, bBefore = height(b) < 0;
        if (aBefore) points.push_back({{a, a}, false});
        if (aBefore != bBefore) points.push_back({{a, b}, true});
    }
    // Of that, in front of the eye. Only edges of the face cross the plane through the eye.
    ClipPolygon polygon;
    const auto isInFront = [&](const Point& p) { return p.isCut || eyeHeight(p.edge.from) >= 0; };
    for (int i = 0; i < points.size(); ++i) {
        const Point &p = points[i], &q = points[(i + 1) % points.size()];
        if (p.isCut) {
            polygon.push_back(drawnCut(p.edge.from, p.edge.to));
        } else if (isInFront(p)) {
            const glm::dvec4 at = clip(p.edge.from);
            const auto w = static_cast<float>(at.w);
            polygon.push_back({static_cast<float>(at.x), static_cast<float>(at.y),
                               flatten ? -w : static_cast<float>(at.z), w});
        }
        if (isInFront(p) != isInFront(q)) {
            const CornerEdge edge = p.isCut   ? p.edge
                                    : q.isCut ? q.edge
                                              : CornerEdge{p.edge.from, q.edge.from};
            glm::vec4 cut = eyeCut(edge.from, edge.to);
            if (flatten) cut.z = -0.0f;
            polygon.push_back(cut);
        }
    }
    return polygon;
}

ClipPolygon ClipSpace::inFront(const Face& face) const {
    ClipPolygon polygon;
    for (int i = 0; i < face.size(); ++i) {
        const Corner a = face[i], b = face[(i + 1) % face.size()];
        const bool aFront = eyeHeight(a) >= 0, bFront = eyeHeight(b) >= 0;
        if (aFront) polygon.push_back(glm::vec4(clip(a)));
        if (aFront != bFront) polygon.push_back(eyeCut(a, b));
    }
    return polygon;
}

ClipPolygon ClipSpace::whole(const Face& face) const {
    ClipPolygon polygon;
    for (const Corner& c : face) polygon.push_back(glm::vec4(clip(c)));
    return polygon;
}

Face sideFace(const ClipSpace& space, std::uint32_t from, std::uint32_t to) {
    Face face;
    face.push_back({to, false});
    face.push_back({from, false});
    face.push_back(space.atInfinity(from));
    if (!space.directional()) face.push_back(space.atInfinity(to));
    return face;
}

Canonical canonical(const glm::uvec3& t) {
    const int first = t.x < t.y ? (t.x < t.z ? 0 : 2) : (t.y < t.z ? 1 : 2);
    const glm::uvec3 turned(t[first], t[(first + 1) % 3], t[(first + 2) % 3]);
    if (turned.y < turned.z) return {turned, false};
    return {{turned.x, turned.z, turned.y}, true};
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

}  // namespace gnomon
