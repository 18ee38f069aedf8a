#include "truth/truth.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "truth/count_ties.h"
#include "truth/eye_hits.h"
#include "truth/frame_rays.h"
#include "truth/shadow_queries.h"

namespace gnomon {

DepthTies depthTies(int bits) {
    const double quantum = std::ldexp(1.0, -bits), interpolation = std::ldexp(8.0, -24);
    return {quantum, bits >= 24 ? interpolation : quantum + interpolation};
}

struct Tracer::Impl {
    Impl(const Scene& scene, const Light& light, Silhouette silhouette)
        : world(scene, light.position, silhouette) {}
    World world;
};

/// One frame. A pixel takes the quick way if that is certain of its answer for all the rays and points around
/// it, else each of them is decided exactly.
class Tracer::Frame {
  public:
    Frame(const World& world, const View& view, const DepthTies& ties)
        : m_rays(world, view, ties), m_hits(m_rays), m_shadows(m_rays), m_countTies(world, view, ties) {}

    struct Pixel {
        Shadow shadow = Shadow::Background;
        Tie tie = Tie::None;
        bool facesAway = false, blocked = false;
    };

    /// The pixels of a tile; @p first is the window position of its upper left one's centre.
    void trace(const glm::dvec2& first, int width, std::span<Pixel> pixels) {
        // Those that take the quick way have their shadows asked for together.
        m_visible.clear();
        m_pixels.clear();
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const int column = int(i) % width, row = int(i) / width;
            const double x = first.x + column, y = first.y - row;
            const EyeRay ray = m_rays.at(x, y);
            const EyeHits::Quick quick = m_hits.quick(ray);
            pixels[i] = quick.isSure ? Pixel{} : traceExactly(ray, x, y);
            if (!quick.isSure || !quick.hit) continue;
            const SeenSurface surface = m_rays.surfaceOf(quick.hit->triangle, ray);
            m_visible.push_back({x, y, *quick.hit, surface, RayPoint(ray, m_rays.triangle(surface))});
            m_pixels.push_back(i);
        }
        m_answers.resize(m_visible.size());
        m_shadows.answer(m_visible, m_answers);
        for (std::size_t k = 0; k < m_visible.size(); ++k) {
            const Visible& seen = m_visible[k];
            const auto [blocked, tied] = m_answers[k];
            pixels[m_pixels[k]] = {
                .shadow = shadowOf(seen.surface, blocked),
                .tie = tied ? Tie::Truth : m_countTies.at(m_rays.triangle(seen.surface), seen.point, {}),
                .facesAway = seen.surface.facesAway,
                .blocked = blocked};
        }
    }

  private:
    Pixel traceExactly(const EyeRay& ray, double x, double y) {
        Pixel pixel;
        std::optional<RayPoint> point;
        const std::vector<Hit>& hits = m_hits.find(ray);
        const std::optional<SeenSurface> surface = m_hits.nearest(ray);
        if (surface) {
            point.emplace(ray, m_rays.triangle(*surface));
            pixel.blocked = m_shadows.isBlocked(*point, *surface);
            pixel.facesAway = surface->facesAway;
        }
        pixel.shadow = shadowOf(surface, pixel.blocked);
        const bool tied = (surface && (hidesAnother(hits, *surface, *point, pixel.shadow) ||
                                       m_shadows.changesWithDepth(*surface, *point, pixel.blocked))) ||
                          changesWithRay(x, y, pixel.shadow);
        if (tied) {
            pixel.tie = Tie::Truth;
            return pixel;
        }
        if (surface) pixel.tie = m_countTies.at(m_rays.triangle(*surface), *point, {});
        if (pixel.tie != Tie::Count && !pixel.facesAway)
            pixel.tie = std::max(pixel.tie, countTieBeside(x, y));
        return pixel;
    }

    /// Whether a surface within one quantum behind the visible one has another answer.
    bool hidesAnother(const std::vector<Hit>& hits, const SeenSurface& surface, const RayPoint& point,
                      Shadow before) {
        const double limit = point.t() + m_rays.quantumAt(point.t());
        return std::any_of(hits.begin(), hits.end(), [&](const Hit& hit) {
            if (hit.triangle == surface.triangle || hit.t.low > limit) return false;
            const SeenSurface other = m_rays.surfaceOf(hit.triangle, point.ray());
            return exactAnswer(point.ray(), other) != before;
        });
    }

    Shadow exactAnswer(const EyeRay& ray, const std::optional<SeenSurface>& surface) {
        if (!surface || surface->facesAway) return shadowOf(surface, true);
        return shadowOf(surface,
                        m_shadows.isBlocked(RayPoint(ray, m_rays.triangle(*surface)), surface->triangle));
    }

    /// Whether the answer changes within 1/256 pixel. The corners are enough: of a straight boundary that
    /// cuts the square, or touches it, one of them is on the other side.
    bool changesWithRay(double x, double y, Shadow before) {
        return std::any_of(std::begin(kCorners), std::end(kCorners), [&](const glm::dvec2& corner) {
            const EyeRay ray = m_rays.at(x + corner.x, y + corner.y);
            m_hits.find(ray);
            return exactAnswer(ray, m_hits.nearest(ray)) != before;
        });
    }

    /// Count ties of the surfaces that are seen within 1/256 pixel. Where a side hangs from the edge of a
    /// surface, a rasteriser that rounds the edge there may compare both right at the edge, where their
    /// depths meet, although the pixel's own ray misses them.
    Tie countTieBeside(double x, double y) {
        std::vector<std::pair<SeenSurface, RayPoint>> seen;
        Beside beside{.centre = {x, y}, .reach = 2 * glm::length(kCorners[0])};
        const auto look = [&](const glm::dvec2& offset) {
            const EyeRay ray = m_rays.at(x + offset.x, y + offset.y);
            m_hits.find(ray);
            const std::optional<SeenSurface> surface = m_hits.nearest(ray);
            if (surface) seen.emplace_back(*surface, RayPoint(ray, m_rays.triangle(*surface)));
            const double depth = surface ? windowDepth(m_rays.view, seen.back().second.t()) : 1;
            beside.farthest = std::max(beside.farthest, depth);
        };
        look({0, 0});
        for (const glm::dvec2& corner : kCorners) look(corner);

        Tie tie = Tie::None;
        for (const auto& [surface, point] : seen) {
            // On a side that faces away the mask may hold anything.
            if (surface.facesAway) return Tie::Count;
            tie = std::max(tie, m_countTies.at(m_rays.triangle(surface), point, beside));
        }
        return tie;
    }

    FrameRays m_rays;
    EyeHits m_hits;
    ShadowQueries m_shadows;
    CountTies m_countTies;
    // Of one tile.
    std::vector<Visible> m_visible{};
    std::vector<ShadowQueries::Answered> m_answers{};
    std::vector<std::size_t> m_pixels{};
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
    // Tiles are small enough that neighbours below find in the caches what those above have brought.
    constexpr int kTile = 8;
    Frame::Pixel tile[kTile * kTile];
    for (int top = 0; top < view.height; top += kTile) {
        const int rows = std::min(kTile, view.height - top);
        for (int left = 0; left < view.width; left += kTile) {
            const int columns = std::min(kTile, view.width - left);
            frame.trace({left + 0.5, view.height - 1 - top + 0.5}, columns,
                        std::span(tile, std::size_t(columns * rows)));
            for (int k = 0; k < columns * rows; ++k) {
                const Frame::Pixel& pixel = tile[k];
                const std::size_t i =
                    std::size_t(top + k / columns) * view.width + std::size_t(left + k % columns);
                truth.shadow[i] = pixel.shadow;
                truth.tie[i] = pixel.tie;
                truth.facesAway[i] = pixel.facesAway;
                truth.blocked[i] = pixel.blocked;
            }
        }
    }
    return truth;
}

}  // namespace gnomon
