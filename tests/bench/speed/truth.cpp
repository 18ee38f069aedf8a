// Exact shadow queries: beside them Embree's own occlusion rays, one by one, in float and without any
// exactness. What is timed is what a frame of 512x512 asks once its visible points are known: a query for
// each point and all around it (1/256 pixel, one quantum of depth), and where that is unsure, the point
// itself and its neighbours one by one.

#include <embree3/rtcore.h>

#include <memory>
#include <stdexcept>

#include "bench/speed/speed_row.h"
#include "bench/torus.h"
#include "gl/stopwatch.h"
#include "scene/primitives.h"
#include "truth/eye_hits.h"
#include "truth/shadow_queries.h"

namespace gnomon {
namespace {

/// A torus over a floor, and the points that a frame sees and that take the tracer's quick way.
struct TorusFrame {
    TorusFrame(std::uint32_t quads, int size)
        : scene(sceneOf(quads)),
          world(scene, scene.lights[0].position, Silhouette::Winding),
          view(viewOf(scene.frames[0], size, size)),
          rays(world, view, ties) {
        EyeHits hits(rays);
        constexpr int kTile = 8;  // in the tracer's order
        for (int i = 0; i < size * size; ++i) {
            const int tile = i / (kTile * kTile), within = i % (kTile * kTile), tiles = size / kTile;
            const double x = tile % tiles * kTile + within % kTile + 0.5;
            const double y = size - (tile / tiles * kTile + within / kTile + 0.5);
            const EyeRay ray = rays.at(x, y);
            const EyeHits::Quick quick = hits.quick(ray);
            if (!quick.isSure || !quick.hit) continue;
            const SeenSurface surface = rays.surfaceOf(quick.hit->triangle, ray);
            visible.push_back({x, y, *quick.hit, surface, RayPoint(ray, rays.triangle(surface))});
        }
        answers.resize(visible.size());
    }

    static Scene sceneOf(std::uint32_t quads) {
        Scene scene{.id = "torus"};
        scene.objects.push_back({.name = "torus", .mesh = torusGrid(quads)});
        Mesh floor = rectangle({12, 12});
        for (glm::vec3& p : floor.positions) p.y = -1.03f;
        scene.objects.push_back({.name = "floor", .mesh = floor, .casts = false});
        scene.lights.push_back({.position = {1.7f, 4.1f, 0.9f, 1}});
        scene.frames.push_back({.eye = {2.9f, 2.3f, 3.1f}, .target = {0, -0.3f, 0}, .nearPlane = 0.5f});
        return scene;
    }

    Scene scene;
    World world;
    View view;
    DepthTies ties = depthTies(24);
    FrameRays rays;
    std::vector<Visible> visible{};
    std::vector<ShadowQueries::Answered> answers{};
};

/// Embree's tree of the casters' triangles, and a ray from each visible point to the light.
class PlainRays {
  public:
    explicit PlainRays(const TorusFrame& frame) : m_device(rtcNewDevice("threads=1,set_affinity=0")) {
        if (!m_device) throw std::runtime_error("Embree gives no device");
        std::vector<glm::vec3> corners;
        for (const LitTriangle& t : frame.world.triangles)
            if (t.casts) corners.insert(corners.end(), t.corners, t.corners + 3);
        const RTCGeometry geometry = rtcNewGeometry(m_device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* const positions = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), corners.size()));
        auto* const indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), corners.size() / 3));
        for (std::size_t i = 0; i < corners.size(); ++i) {
            for (int k = 0; k < 3; ++k) positions[3 * i + std::size_t(k)] = corners[i][k];
            indices[i] = unsigned(i);
        }
        m_scene = rtcNewScene(m_device);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(m_scene, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(m_scene);

        for (const Visible& seen : frame.visible) {
            const glm::vec3 from(seen.point.position());
            const glm::vec3 way(glm::dvec3(frame.world.light) - seen.point.position());
            RTCRay ray{};
            ray.org_x = from.x, ray.org_y = from.y, ray.org_z = from.z;
            ray.dir_x = way.x, ray.dir_y = way.y, ray.dir_z = way.z;
            ray.tnear = 1e-4f, ray.tfar = 1, ray.mask = ~0u;
            m_rays.push_back(ray);
        }
    }
    ~PlainRays() {
        rtcReleaseScene(m_scene);
        rtcReleaseDevice(m_device);
    }
    PlainRays(const PlainRays&) = delete;
    PlainRays& operator=(const PlainRays&) = delete;

    /// Milliseconds for all rays.
    double trace() const {
        std::vector<RTCRay> rays = m_rays;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        const double start = threadCpuMs();
        for (RTCRay& ray : rays) rtcOccluded1(m_scene, &context, &ray);
        return threadCpuMs() - start;
    }

  private:
    RTCDevice m_device = nullptr;
    RTCScene m_scene = nullptr;
    std::vector<RTCRay> m_rays{};
};

SpeedRow row(std::uint32_t quads, double target, const std::string& name, const std::string& what) {
    return {.name = "Truth/" + name,
            .what = "exact shadow queries, one core: " + what,
            .bar = Bar::AtLeast,
            .target = target,
            .unit = "M/s",
            .sides = "M/s (plain rays)",
            .prepare = [=](Load load) -> Round {
                const bool isFull = load == Load::Full;
                const auto frame = std::make_shared<TorusFrame>(isFull ? quads : 12, isFull ? 512 : 32);
                const auto plain = std::make_shared<const PlainRays>(*frame);
                return [=] {
                    ShadowQueries queries(frame->rays);
                    const double start = threadCpuMs();
                    queries.answer(frame->visible, frame->answers);
                    const double ours = double(queries.asked()) / ((threadCpuMs() - start) * 1e3);
                    const double rays = double(frame->visible.size()) / (plain->trace() * 1e3);
                    return Measured{ours, ours, rays};
                };
            }};
}

}  // namespace

std::vector<SpeedRow> truthRows() {
    return {row(224, 8, "100k", "100k triangles"), row(708, 5, "1M", "1M triangles")};
}

}  // namespace gnomon
