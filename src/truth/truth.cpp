#include "truth/truth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "truth/candidates.h"
#include "truth/predicates.h"
#include "volume/orient.h"

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What a side hangs from, world space.
struct SideEdge {
    glm::vec3 from{}, to{};
    int weight = 1;
};

std::vector<LitTriangle> trianglesOf(const Scene& scene, const glm::vec4& light) {
    std::vector<LitTriangle> triangles;
    triangles.reserve(triangleCount(scene));
    for (const Object& object : scene.objects) {
        const auto& positions = object.mesh.positions;
        for (const glm::uvec3& t : object.mesh.triangles) {
            LitTriangle triangle{.corners = {positions[t.x], positions[t.y], positions[t.z]}};
            const int side =
                orientation(triangle.corners[0], triangle.corners[1], triangle.corners[2], light);
            if (side < 0) std::swap(triangle.corners[1], triangle.corners[2]);
            triangle.edgeOn = side == 0;
            triangle.casts = object.casts && (side > 0 || (side < 0 && object.twoSided));
            triangles.push_back(triangle);
        }
    }
    return triangles;
}

std::vector<SideEdge> sidesOf(const Scene& scene, const glm::vec4& light, Silhouette silhouette) {
    std::vector<SideEdge> sides;
    for (const Caster& caster : casters(scene)) {
        const auto& positions = scene.objects[caster.object].mesh.positions;
        for (const Side& side : litCaster(scene, caster, light, silhouette).sides)
            sides.push_back({positions[side.from], positions[side.to], side.weight});
    }
    return sides;
}

void extend(Box& box, const glm::vec3& p) {
    box.low = glm::min(box.low, glm::dvec3(p));
    box.high = glm::max(box.high, glm::dvec3(p));
}

std::vector<Box> boxesOf(const std::vector<LitTriangle>& triangles) {
    std::vector<Box> boxes(triangles.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (const glm::vec3& p : triangles[i].corners) extend(boxes[i], p);
    }
    return boxes;
}

std::vector<Box> boxesOf(const std::vector<SideEdge>& sides) {
    std::vector<Box> boxes(sides.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        extend(boxes[i], sides[i].from);
        extend(boxes[i], sides[i].to);
    }
    return boxes;
}

double diagonal(const std::vector<Box>& boxes) {
    Box all;
    for (const Box& box : boxes) {
        all.low = glm::min(all.low, box.low);
        all.high = glm::max(all.high, box.high);
    }
    return boxes.empty() ? 0 : glm::length(all.high - all.low);
}

}  // namespace

DepthTies depthTies(int bits) {
    const double quantum = std::ldexp(1.0, -bits), interpolation = std::ldexp(8.0, -24);
    return {quantum, bits >= 24 ? interpolation : quantum + interpolation};
}

struct Tracer::Impl {
    Impl(const Scene& scene, const Light& l, Silhouette silhouette)
        : light(l.position),
          triangles(trianglesOf(scene, l.position)),
          sides(sidesOf(scene, l.position, silhouette)),
          // Reach: rays beside the pixel's own ray and points beside the visible point look for what they
          // would meet through one ray. 10^-4 of the scene holds 1/256 pixel; the sides' band of depth is
          // longer.
          surfaces(boxesOf(triangles), 1e-4 * diagonal(boxesOf(triangles))),
          edges(boxesOf(sides), 1e-3 * diagonal(boxesOf(triangles))) {}

    glm::dvec4 light;
    std::vector<LitTriangle> triangles;
    std::vector<SideEdge> sides;
    Candidates surfaces;
    Candidates edges;

    /// Calls @p visit(index) for each triangle or side that may be near the segment from @p point to the
    /// light, until it returns false.
    template <class Visit>
    void towardsLight(const Candidates& among, const glm::dvec3& point, Visit&& visit) const {
        const glm::dvec3 way = light.w == 0 ? glm::dvec3(light) : glm::dvec3(light) - point;
        const double length = glm::length(way);
        if (length == 0) return;
        among.anyOrder(point, way / length, 0, light.w == 0 ? kInfinity : length,
                       [&](std::uint32_t index) { return visit(index) ? kInfinity : -kInfinity; });
    }
};

namespace {

/// A triangle that an eye ray meets, and bounds on where.
struct Hit {
    std::uint32_t triangle = 0;
    Interval t{};
};

/// What the eye ray of one pixel meets first.
struct Surface {
    std::uint32_t triangle = 0;
    bool facesAway = false;  ///< its seen side, from the light
};

}  // namespace

/// One frame. A pixel takes the quick way if that is certain of its answer for all the rays and points around
/// it, else each of them is decided exactly.
class Tracer::Frame {
  public:
    Frame(const Impl& world, const View& view, const DepthTies& ties)
        : m_world(world), m_view(view), m_ties(ties) {
        m_stepX = view.right * (2 * view.tanHalfX / view.width / kSubpixels);
        m_stepY = view.up * (2 * view.tanHalfY / view.height / kSubpixels);
    }

    struct Pixel {
        Shadow shadow = Shadow::Background;
        Tie tie = Tie::None;
        bool facesAway = false, blocked = false;
    };

    Pixel trace(double x, double y) {
        Pixel pixel;
        std::optional<Surface> surface;
        std::optional<RayPoint> point;
        const EyeRay ray = rayAt(x, y);
        bool tied = false;

        const Quick quick = isNarrow(ray) ? quickHit(ray) : Quick{.isSure = false};
        if (quick.isSure && !quick.hit) return pixel;
        if (quick.isSure) {
            surface = surfaceOf(quick.hit->triangle, ray);
            point.emplace(ray, triangle(*surface));
            tied = shadeQuickly(x, y, *quick.hit, *surface, *point, pixel);
        } else {
            findHits(ray);
            surface = nearest(ray);
            if (surface) {
                point.emplace(ray, triangle(*surface));
                pixel.blocked = ownBlocks(*surface) || isBlocked(*point, surface->triangle);
            }
            pixel.shadow = answer(surface, pixel.blocked);
            tied = (surface && (hidesAnother(*surface, *point, pixel.shadow) ||
                                changesWithDepth(*surface, *point, pixel.shadow))) ||
                   changesWithRay(x, y, pixel.shadow);
        }
        pixel.facesAway = surface && surface->facesAway;
        if (tied) {
            pixel.tie = Tie::Truth;
        } else {
            if (surface) pixel.tie = countTie(*surface, *point, {});
            if (!quick.isSure && pixel.tie != Tie::Count)
                pixel.tie = std::max(pixel.tie, countTieBeside(x, y));
        }
        return pixel;
    }

  private:
    static constexpr double kSubpixels = 256;  ///< of the rasteriser, per pixel and axis
    static constexpr double kLongestRise =
        0x1p-8;                                 ///< of a side within 1/256 pixel; steeper ones are too thin
    static constexpr double kFarBehind = 2000;  ///< in reaches: twice the scene's diagonal

    struct Quick {
        bool isSure = true;
        std::optional<Hit> hit{};
    };

    const LitTriangle& triangle(const Surface& surface) const { return m_world.triangles[surface.triangle]; }

    EyeRay rayAt(double x, double y) const { return {m_view.eye, rayDirection(m_view, x, y)}; }

    /// One quantum of depth at distance @p t.
    double quantumAt(double t) const { return m_ties.truthQuantum * t * t / m_view.nearPlane; }

    static Shadow answer(const std::optional<Surface>& surface, bool blocked) {
        if (!surface) return Shadow::Background;
        return surface->facesAway || blocked ? Shadow::InShadow : Shadow::Lit;
    }

    Surface surfaceOf(std::uint32_t index, const EyeRay& ray) const {
        const LitTriangle& t = m_world.triangles[index];
        const glm::dvec3 a = t.corners[0], b = t.corners[1], c = t.corners[2];
        return {index, t.edgeOn || orientation(a, b, c, ray.eye) < 0};
    }

    /// Just before the surface: on the other side of it than the light.
    bool ownBlocks(const Surface& surface) const { return surface.facesAway && triangle(surface).casts; }

    /// Whether all that 1/256 pixel around the ray may meet is within reach of it.
    bool isNarrow(const EyeRay& ray) const {
        const double leave = m_world.surfaces.clip(ray.eye, ray.direction, 0, kInfinity).second;
        return 2 * leave * (glm::length(m_stepX) + glm::length(m_stepY)) < m_world.surfaces.reach();
    }

    /// The one surface that all rays within 1/256 pixel see, with no other within one quantum of depth.
    Quick quickHit(const EyeRay& ray) {
        m_hits.clear();
        double doubtful = kInfinity;  // nearest distance of a triangle that only some of the rays may meet
        double limit = kInfinity;
        const glm::dvec3 stepX = 1.001 * m_stepX, stepY = 1.001 * m_stepY;
        m_world.surfaces.nearestFirst(ray.eye, ray.direction, 0, kInfinity, [&](std::uint32_t index) {
            const LitTriangle& t = m_world.triangles[index];
            const Answer met = meets(ray, t, stepX, stepY);
            if (met == Answer::No) return limit;
            const auto at = met == Answer::Yes ? planeHit(ray, t, stepX, stepY) : std::nullopt;
            if (!at || (at->low < m_view.nearPlane && at->high >= m_view.nearPlane)) {
                const auto distance = [&](const glm::vec3& p) {
                    return glm::dot(glm::dvec3(p) - ray.eye, m_view.forward);
                };
                const auto [nearest, farthest] =
                    std::minmax({distance(t.corners[0]), distance(t.corners[1]), distance(t.corners[2])});
                if (farthest * (1 + 1e-9) >= m_view.nearPlane)
                    doubtful = std::min(doubtful, std::max(m_view.nearPlane, nearest));
                return limit;
            }
            if (at->high < m_view.nearPlane) return limit;
            m_hits.push_back({index, *at});
            limit = std::min(limit, at->high + quantumAt(at->high));
            return limit;
        });
        if (doubtful * (1 - 1e-9) <= limit && doubtful < kInfinity) return {.isSure = false};
        const auto isNear = [&](const Hit& hit) { return hit.t.low <= limit; };
        if (std::count_if(m_hits.begin(), m_hits.end(), isNear) > 1) return {.isSure = false};
        const auto hit = std::find_if(m_hits.begin(), m_hits.end(), isNear);
        return hit == m_hits.end() ? Quick{} : Quick{.hit = *hit};
    }

    /// Whether all rays around @p ray pass inside the triangle, or none does.
    static Answer meets(const EyeRay& ray, const LitTriangle& t, const glm::dvec3& stepX,
                        const glm::dvec3& stepY) {
        constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();
        const glm::dvec3 p[3] = {glm::dvec3(t.corners[0]) - ray.eye, glm::dvec3(t.corners[1]) - ray.eye,
                                 glm::dvec3(t.corners[2]) - ray.eye};
        int positive = 0, negative = 0;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 &u = p[k], &v = p[(k + 1) % 3];
            const glm::dvec3 edge = glm::cross(u, v);
            const double value = glm::dot(edge, ray.direction);
            // |u| |v| |direction| is no less than the sum of the products' sizes over 3.
            const double slack =
                std::abs(glm::dot(edge, stepX)) + std::abs(glm::dot(edge, stepY)) +
                3 * kRounding *
                    std::sqrt(glm::dot(u, u) * glm::dot(v, v) * glm::dot(ray.direction, ray.direction));
            positive += value > slack;
            negative += value < -slack;
        }
        if (positive > 0 && negative > 0) return Answer::No;
        return positive == 3 || negative == 3 ? Answer::Yes : Answer::Unsure;
    }

    /// All triangles that the ray meets, up to one quantum behind the first; exact but for the order.
    void findHits(const EyeRay& ray) {
        m_hits.clear();
        double limit = kInfinity;
        m_world.surfaces.nearestFirst(ray.eye, ray.direction, 0, kInfinity, [&](std::uint32_t index) {
            const LitTriangle& t = m_world.triangles[index];
            Answer met = meets(ray, t, {}, {});
            if (met == Answer::Unsure) {
                int positive = 0;
                for (int k = 0; k < 3; ++k)
                    positive += edgeSide(ray, t.corners[k], t.corners[(k + 1) % 3]) > 0;
                met = positive == 0 || positive == 3 ? Answer::Yes : Answer::No;
            }
            if (met == Answer::No) return limit;
            const glm::dvec3 a = t.corners[0], b = t.corners[1], c = t.corners[2];
            if (orientation(a, b, c, ray.eye) == 0) return limit;
            auto at = planeHit(ray, t);
            if (!at) {
                const auto exact = exactPlaneHit(ray, t);
                if (!exact) return limit;
                const auto value = static_cast<double>(*exact);
                at = {value - 1e-15 * std::abs(value), value + 1e-15 * std::abs(value)};
            }
            if (at->high < m_view.nearPlane) return limit;
            if (at->low < m_view.nearPlane && *exactPlaneHit(ray, t) < Rational(m_view.nearPlane))
                return limit;
            m_hits.push_back({index, *at});
            limit = std::min(limit, at->high + quantumAt(at->high));
            return limit;
        });
    }

    /// The first of the hits; of equally distant ones that with the lowest index.
    std::optional<Surface> nearest(const EyeRay& ray) const {
        const auto isBefore = [&](const Hit& a, const Hit& b) {
            if (a.t.high < b.t.low) return true;
            if (b.t.high < a.t.low) return false;
            const Rational ta = *exactPlaneHit(ray, m_world.triangles[a.triangle]);
            const Rational tb = *exactPlaneHit(ray, m_world.triangles[b.triangle]);
            return ta != tb ? ta < tb : a.triangle < b.triangle;
        };
        const Hit* first = nullptr;
        for (const Hit& hit : m_hits) {
            if (!first || isBefore(hit, *first)) first = &hit;
        }
        if (!first) return {};
        return surfaceOf(first->triangle, ray);
    }

    /// Whether a caster other than @p own lies between the point and the light; exact.
    bool isBlocked(const RayPoint& point, std::uint32_t own) const {
        bool blocked = false;
        m_world.towardsLight(m_world.surfaces, point.position(), [&](std::uint32_t index) {
            const LitTriangle& t = m_world.triangles[index];
            blocked = t.casts && index != own && crossesExactly(t, m_world.light, point);
            return !blocked;
        });
        return blocked;
    }

    /// The same for all points within @p radius.
    Answer isBlockedAround(const RayPoint& point, std::uint32_t own, double radius) const {
        Answer blocked = Answer::No;
        m_world.towardsLight(m_world.surfaces, point.position(), [&](std::uint32_t index) {
            const LitTriangle& t = m_world.triangles[index];
            if (!t.casts || index == own) return true;
            const Answer crossed = crosses(t, m_world.light, point, radius);
            if (crossed != Answer::No) blocked = crossed;
            return blocked != Answer::Yes;
        });
        return blocked;
    }

    /// Fills @p pixel, where all rays around see the same surface; returns whether truth is tied.
    bool shadeQuickly(double x, double y, const Hit& hit, const Surface& surface, const RayPoint& point,
                      Pixel& pixel) {
        if (surface.facesAway) {
            pixel.shadow = Shadow::InShadow;
            pixel.blocked = ownBlocks(surface) || isBlocked(point, surface.triangle);
            return false;
        }

        // How far the visible point moves within 1/256 pixel, and within one quantum of depth.
        const double length = glm::length(point.ray().direction);
        const double beside = (hit.t.high - hit.t.low) * length +
                              1.01 * hit.t.high * (glm::length(m_stepX) + glm::length(m_stepY));
        const double along = quantumAt(hit.t.high) * length;
        const double reach = m_world.surfaces.reach() / 2;
        const bool coversDepth = beside + along < reach;
        if (beside < reach) {
            const Answer blocked =
                isBlockedAround(point, surface.triangle, coversDepth ? beside + along : beside);
            if (blocked != Answer::Unsure) {
                pixel.blocked = blocked == Answer::Yes;
                pixel.shadow = answer(surface, pixel.blocked);
                return !coversDepth && changesWithDepth(surface, point, pixel.shadow);
            }
        }
        pixel.blocked = isBlocked(point, surface.triangle);
        pixel.shadow = answer(surface, pixel.blocked);
        if (changesWithDepth(surface, point, pixel.shadow)) return true;
        return std::any_of(std::begin(kCorners), std::end(kCorners), [&](const glm::dvec2& corner) {
            const RayPoint moved(rayAt(x + corner.x, y + corner.y), triangle(surface));
            return answer(surface, isBlocked(moved, surface.triangle)) != pixel.shadow;
        });
    }

    /// Whether the answer changes when the point moves by one quantum of depth towards the eye, or away from
    /// it with its own triangle left out.
    bool changesWithDepth(const Surface& surface, const RayPoint& point, Shadow before) const {
        if (surface.facesAway) return false;
        const double quantum = quantumAt(point.t());
        for (const double shift : {-std::min(quantum, point.t() - m_view.nearPlane), quantum}) {
            const RayPoint moved(point.ray(), triangle(surface), shift);
            if (answer(surface, isBlocked(moved, surface.triangle)) != before) return true;
        }
        return false;
    }

    /// Whether a surface within one quantum behind the visible one has another answer; of the hits just
    /// found.
    bool hidesAnother(const Surface& surface, const RayPoint& point, Shadow before) const {
        const double limit = point.t() + quantumAt(point.t());
        return std::any_of(m_hits.begin(), m_hits.end(), [&](const Hit& hit) {
            if (hit.triangle == surface.triangle || hit.t.low > limit) return false;
            const Surface other = surfaceOf(hit.triangle, point.ray());
            return exactAnswer(point.ray(), other) != before;
        });
    }

    Shadow exactAnswer(const EyeRay& ray, const std::optional<Surface>& surface) const {
        if (!surface || surface->facesAway) return answer(surface, true);
        return answer(surface, isBlocked(RayPoint(ray, triangle(*surface)), surface->triangle));
    }

    /// Whether the answer changes within 1/256 pixel. The corners are enough: of a straight boundary that
    /// cuts the square, or touches it, one of them is on the other side.
    bool changesWithRay(double x, double y, Shadow before) {
        return std::any_of(std::begin(kCorners), std::end(kCorners), [&](const glm::dvec2& corner) {
            const EyeRay ray = rayAt(x + corner.x, y + corner.y);
            findHits(ray);
            return exactAnswer(ray, nearest(ray)) != before;
        });
    }

    /// countTie() for the surfaces that are seen within 1/256 pixel. Where a side hangs from the edge of a
    /// surface, a rasteriser that rounds the edge there may compare both right at the edge, where their
    /// depths meet, although the pixel's own ray misses them.
    Tie countTieBeside(double x, double y) {
        std::vector<std::pair<Surface, RayPoint>> seen;
        Beside beside{.centre = {x, y}, .reach = 2 * glm::length(kCorners[0])};
        const auto look = [&](const glm::dvec2& offset) {
            const EyeRay ray = rayAt(x + offset.x, y + offset.y);
            findHits(ray);
            const std::optional<Surface> surface = nearest(ray);
            if (surface) seen.emplace_back(*surface, RayPoint(ray, triangle(*surface)));
            const double depth = surface ? windowDepth(m_view, seen.back().second.t()) : 1;
            beside.farthest = std::max(beside.farthest, depth);
        };
        look({0, 0});
        for (const glm::dvec2& corner : kCorners) look(corner);

        Tie tie = Tie::None;
        for (const auto& [surface, point] : seen) tie = std::max(tie, countTie(surface, point, beside));
        return tie;
    }

    /// The neighbourhood of a pixel's centre in which a rasteriser may see what stands there.
    struct Beside {
        glm::dvec2 centre{};  ///< window position
        double reach = 0;     ///< pixels; 0: the centre's own ray alone
        double farthest = 0;  ///< window depth of the farthest surface that is seen there
    };

    /// How a plane's window depth rises, per pixel. Window depth is 1 - near/t, and 1/t is affine in the
    /// window.
    glm::dvec2 depthGradient(const glm::dvec3& normal, const glm::dvec3& onPlane) const {
        const double scale = -2 * m_view.nearPlane / glm::dot(normal, onPlane - m_view.eye);
        return scale * glm::dvec2(glm::dot(normal, m_view.right) * m_view.tanHalfX / m_view.width,
                                  glm::dot(normal, m_view.up) * m_view.tanHalfY / m_view.height);
    }

    /// Whether the sides of volumes near the visible point may change what the mask holds there.
    Tie countTie(const Surface& surface, const RayPoint& point, const Beside& beside) {
        const LitTriangle& own = triangle(surface);
        const glm::dvec3 corner(own.corners[0]);
        const glm::dvec2 gradient = depthGradient(
            glm::cross(glm::dvec3(own.corners[1]) - corner, glm::dvec3(own.corners[2]) - corner), corner);

        // The longest band around the point, cut off far behind it (where it is longer than the scene).
        const double depth = windowDepth(m_view, point.t());
        const double length = glm::length(point.ray().direction);
        const double longest = m_ties.countBand + (beside.reach > 0 ? kLongestRise : 0);
        const double first = distanceAtDepth(m_view, std::max(0.0, depth - longest));
        const double last = std::min(distanceAtDepth(m_view, depth + longest),
                                     point.t() + kFarBehind * m_world.edges.reach() / length);

        // A side crosses the band where its edge crosses the triangle between the band and the light: look
        // along rays to the light, close enough that one of them passes within reach of any such edge.
        m_near.clear();
        if (m_world.sides.empty()) return Tie::None;
        const double steps = std::ceil((last - first) * length / m_world.edges.reach());
        const int rays = std::max(1, static_cast<int>(steps));
        for (int i = 0; i < rays; ++i) {
            const double t = first + (last - first) * (i + 0.5) / rays;
            const glm::dvec3 from = point.ray().eye + t * point.ray().direction;
            m_world.towardsLight(m_world.edges, from, [&](std::uint32_t index) {
                m_near.push_back(index);
                return true;
            });
        }
        std::sort(m_near.begin(), m_near.end());
        m_near.erase(std::unique(m_near.begin(), m_near.end()), m_near.end());

        // The count at the point is that at the start of the band and the sides between; of them, and of
        // those just behind the point, the near ones may be counted or not. At worst all near backs are and
        // no near front is.
        bool any = false;
        int backs = 0;
        for (const std::uint32_t index : m_near) {
            const SideEdge& side = m_world.sides[index];
            const Crossing c = crossSide(side, point.ray());
            const bool isInRange = c.t >= first && c.t <= last;
            const double rise = std::min(kLongestRise, beside.reach * glm::length(c.gradient - gradient));
            const bool isClose = isInRange && c.miss <= glm::length(kCorners[0]) &&
                                 std::abs(windowDepth(m_view, c.t) - depth) <= m_ties.countBand + rise;
            const bool isNear = isClose || (beside.reach > 0 && hangsBeside(side, beside));
            any = any || isNear;
            if (isNear)
                backs -= std::min(c.face, 0);
            else if (isInRange && c.miss <= 0 && c.t < point.t())
                backs -= c.face;
        }
        if (!any) return Tie::None;
        return isCrossedMoreThan(backs, RayPoint(point.ray(), first)) ? Tie::CountIfClamped : Tie::Count;
    }

    /// Where an eye ray crosses the side of a volume.
    struct Crossing {
        int face = 0;             ///< the side's weight if it is a front, its negative if it is a back
        double miss = kInfinity;  ///< pixels by which the ray misses it; 0 or less: it crosses
        double t = 0;
        glm::dvec2 gradient{};  ///< of the side's window depth
    };

    /// Whether the edge from which the side hangs passes through the neighbourhood and is not hidden there.
    bool hangsBeside(const SideEdge& side, const Beside& beside) const {
        glm::dvec2 ends[2];
        double depths[2];
        for (int k = 0; k < 2; ++k) {
            const glm::dvec3 p = glm::dvec3(k == 0 ? side.from : side.to) - m_view.eye;
            const double t = glm::dot(p, m_view.forward);
            if (t < m_view.nearPlane) return false;
            ends[k] = {(glm::dot(p, m_view.right) / (t * m_view.tanHalfX) + 1) / 2 * m_view.width,
                       (glm::dot(p, m_view.up) / (t * m_view.tanHalfY) + 1) / 2 * m_view.height};
            depths[k] = windowDepth(m_view, t);
        }
        const glm::dvec2 way = ends[1] - ends[0];
        const double squared = glm::dot(way, way);
        const double u =
            squared > 0 ? std::clamp(glm::dot(beside.centre - ends[0], way) / squared, 0.0, 1.0) : 0;
        return glm::distance(beside.centre, ends[0] + u * way) <= beside.reach &&
               depths[0] + u * (depths[1] - depths[0]) <= beside.farthest + m_ties.countBand;
    }

    Crossing crossSide(const SideEdge& side, const EyeRay& ray) const {
        const glm::dvec3 l(m_world.light), from(side.from), to(side.to), d = ray.direction;
        const bool directional = m_world.light.w == 0;
        const glm::dvec3 f = from - ray.eye, g = to - ray.eye;
        const glm::dvec3 fAway = directional ? -l : from - l, gAway = directional ? -l : to - l;
        const glm::dvec3 borders[4] = {glm::cross(g, f), glm::cross(f, fAway),
                                       directional ? glm::dvec3(0) : glm::cross(fAway, gAway),
                                       glm::cross(gAway, g)};
        // Pixels by which the ray lies beyond the border that it is farthest beyond, for either winding.
        double beyond[2] = {-kInfinity, -kInfinity};
        for (const glm::dvec3& border : borders) {
            const glm::dvec2 rise(2 * m_view.tanHalfX / m_view.width * glm::dot(border, m_view.right),
                                  2 * m_view.tanHalfY / m_view.height * glm::dot(border, m_view.up));
            const double size = glm::length(rise);
            if (size == 0) continue;
            const double distance = glm::dot(border, d) / size;
            beyond[0] = std::max(beyond[0], -distance);
            beyond[1] = std::max(beyond[1], distance);
        }

        const glm::dvec3 outward = glm::cross(to - from, directional ? l : l - from);
        const double height = -glm::dot(outward, f), slope = glm::dot(outward, d);
        const double t = -height / slope;
        Crossing crossing{.face = height > 0 ? side.weight : -side.weight};
        if (height == 0 || slope == 0 || t < m_view.nearPlane) return crossing;
        crossing.miss = std::min(beyond[0], beyond[1]);
        crossing.t = t;
        crossing.gradient = depthGradient(outward, from);
        return crossing;
    }

    /// Whether more than @p count casters' triangles lie between the point and the light; exact.
    bool isCrossedMoreThan(int count, const RayPoint& point) {
        m_counted.clear();
        m_world.towardsLight(m_world.surfaces, point.position(), [&](std::uint32_t index) {
            const LitTriangle& t = m_world.triangles[index];
            if (t.casts && crossesExactly(t, m_world.light, point) &&
                std::find(m_counted.begin(), m_counted.end(), index) == m_counted.end())
                m_counted.push_back(index);
            return static_cast<int>(m_counted.size()) <= count;
        });
        return static_cast<int>(m_counted.size()) > count;
    }

    static constexpr glm::dvec2 kCorners[4] = {{-1 / kSubpixels, -1 / kSubpixels},
                                               {1 / kSubpixels, -1 / kSubpixels},
                                               {-1 / kSubpixels, 1 / kSubpixels},
                                               {1 / kSubpixels, 1 / kSubpixels}};

    const Impl& m_world;
    const View& m_view;
    const DepthTies& m_ties;
    glm::dvec3 m_stepX, m_stepY;  ///< 1/256 pixel, for directions
    std::vector<Hit> m_hits{};    ///< of the last search
    std::vector<std::uint32_t> m_near{}, m_counted{};
};

Tracer::Tracer(const Scene& scene, const Light& light, Silhouette silhouette)
    : m_impl(std::make_unique<Impl>(scene, light, silhouette)) {}

Tracer::~Tracer() = default;

Truth Tracer::trace(const View& view, const DepthTies& ties) const {
    const std::size_t pixels = static_cast<std::size_t>(view.width) * view.height;
    Truth truth{.width = view.width, .height = view.height};
    truth.shadow.resize(pixels);
    truth.tie.resize(pixels);
    truth.facesAway.resize(pixels);
    truth.blocked.resize(pixels);

    Frame frame(*m_impl, view, ties);
    std::size_t i = 0;
    for (int row = 0; row < view.height; ++row) {
        for (int x = 0; x < view.width; ++x, ++i) {
            const Frame::Pixel pixel = frame.trace(x + 0.5, view.height - 1 - row + 0.5);
            truth.shadow[i] = pixel.shadow;
            truth.tie[i] = pixel.tie;
            truth.facesAway[i] = pixel.facesAway;
            truth.blocked[i] = pixel.blocked;
        }
    }
    return truth;
}

}  // namespace gnomon
