#include "truth/truth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "truth/count_ties.h"
#include "truth/world.h"
#include "volume/orient.h"

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

DepthTies depthTies(int bits) {
    const double quantum = std::ldexp(1.0, -bits), interpolation = std::ldexp(8.0, -24);
    return {quantum, bits >= 24 ? interpolation : quantum + interpolation};
}

struct Tracer::Impl {
    Impl(const Scene& scene, const Light& light, Silhouette silhouette)
        : world(scene, light.position, silhouette) {}
    World world;
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
    Frame(const World& world, const View& view, const DepthTies& ties)
        : m_world(world), m_view(view), m_ties(ties), m_countTies(world, view, ties) {
        m_stepX = view.right * (2 * view.tanHalfX / view.width * kSubpixel);
        m_stepY = view.up * (2 * view.tanHalfY / view.height * kSubpixel);
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
            if (surface) pixel.tie = m_countTies.at(triangle(*surface), *point, {});
            if (!quick.isSure && pixel.tie != Tie::Count && !pixel.facesAway)
                pixel.tie = std::max(pixel.tie, countTieBeside(x, y));
        }
        return pixel;
    }

  private:
    struct Quick {
        bool isSure = true;
        std::optional<Hit> hit{};
    };

    const LitTriangle& triangle(const Surface& surface) const { return m_world.triangles[surface.triangle]; }

    EyeRay rayAt(double x, double y) const { return {m_view.eye, rayDirection(m_view, x, y)}; }

    /// One quantum of depth at distance @p t.
    double quantumAt(double t) const {
        return m_ties.quantumAt(windowDepth(m_view, t)) * t * t / m_view.nearPlane;
    }

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

    /// Count ties of the surfaces that are seen within 1/256 pixel. Where a side hangs from the edge of a
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
        for (const auto& [surface, point] : seen) {
            // On a side that faces away the mask may hold anything.
            if (surface.facesAway) return Tie::Count;
            tie = std::max(tie, m_countTies.at(triangle(surface), point, beside));
        }
        return tie;
    }

    static constexpr glm::dvec2 kCorners[4] = {
        {-kSubpixel, -kSubpixel}, {kSubpixel, -kSubpixel}, {-kSubpixel, kSubpixel}, {kSubpixel, kSubpixel}};

    const World& m_world;
    const View& m_view;
    const DepthTies& m_ties;
    glm::dvec3 m_stepX, m_stepY;  ///< 1/256 pixel, for directions
    std::vector<Hit> m_hits{};    ///< of the last search
    CountTies m_countTies;
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

    Frame frame(m_impl->world, view, ties);
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
