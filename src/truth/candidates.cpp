#include "truth/candidates.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace gnomon {
namespace {

struct SearchContext {
    RTCIntersectContext embree{};  // first: Embree hands a pointer to it back
    void* self;
    double (*call)(void*, std::uint32_t);
    double origin;  ///< the caller's parameter where Embree's is 0
};

/// Asks the visitor, and shortens Embree's ray to what it says.
void visit(RTCIntersectContext* embree, unsigned index, RTCRay& ray) {
    auto& context = *reinterpret_cast<SearchContext*>(embree);
    const double limit = context.call(context.self, index) - context.origin;
    // One float further than the limit.
    if (limit < ray.tfar)
        ray.tfar = std::nextafter(static_cast<float>(limit), std::numeric_limits<float>::infinity());
    if (std::isinf(limit) && limit < 0) ray.tfar = -std::numeric_limits<float>::infinity();
}

void boundsOf(const RTCBoundsFunctionArguments* args) {
    const Box& box = static_cast<const Box*>(args->geometryUserPtr)[args->primID];
    RTCBounds& out = *args->bounds_o;
    out.lower_x = static_cast<float>(box.low.x);
    out.lower_y = static_cast<float>(box.low.y);
    out.lower_z = static_cast<float>(box.low.z);
    out.upper_x = static_cast<float>(box.high.x);
    out.upper_y = static_cast<float>(box.high.y);
    out.upper_z = static_cast<float>(box.high.z);
}

void intersect(const RTCIntersectFunctionNArguments* args) {
    if (args->valid[0]) visit(args->context, args->primID, reinterpret_cast<RTCRayHit*>(args->rayhit)->ray);
}

void occluded(const RTCOccludedFunctionNArguments* args) {
    if (args->valid[0]) visit(args->context, args->primID, *reinterpret_cast<RTCRay*>(args->ray));
}

}  // namespace

struct Candidates::Impl {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    ~Impl() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
};

Candidates::Candidates(std::span<const Box> boxes, double reach) : m_impl(std::make_unique<Impl>()) {
    for (const Box& box : boxes) {
        m_bounds.low = glm::min(m_bounds.low, box.low);
        m_bounds.high = glm::max(m_bounds.high, box.high);
    }
    if (boxes.empty()) return;

    // Rounding of the ray and of the boxes to float: some 2^-24 of the largest coordinate each, and of the
    // ray's length.
    double largest = 0;
    for (int k = 0; k < 3; ++k)
        largest = std::max({largest, std::abs(m_bounds.low[k]), std::abs(m_bounds.high[k])});
    const double rounding = 4e-6 * largest + std::numeric_limits<float>::min();
    m_reach = reach;
    m_bounds.low -= reach + rounding;
    m_bounds.high += reach + rounding;

    std::vector<Box> inflated(boxes.begin(), boxes.end());
    for (Box& box : inflated) {
        box.low -= reach + rounding;
        box.high += reach + rounding;
    }
    // One thread: workers are processes, and they fill the machine.
    m_impl->device = rtcNewDevice("threads=1,set_affinity=0");
    if (!m_impl->device) throw std::runtime_error("Embree gives no device");
    m_impl->scene = rtcNewScene(m_impl->device);
    rtcSetSceneFlags(m_impl->scene, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(m_impl->device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(inflated.size()));
    rtcSetGeometryUserData(geometry, inflated.data());
    rtcSetGeometryBoundsFunction(
        geometry, [](const RTCBoundsFunctionArguments* args) { boundsOf(args); }, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect);
    rtcSetGeometryOccludedFunction(geometry, occluded);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(m_impl->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(m_impl->scene);  // reads the boxes for the last time
    if (rtcGetDeviceError(m_impl->device) != RTC_ERROR_NONE)
        throw std::runtime_error("Embree can't build its tree");
}

Candidates::~Candidates() = default;

std::pair<double, double> Candidates::clip(const glm::dvec3& origin, const glm::dvec3& direction,
                                           double first, double last) const {
    for (int k = 0; k < 3; ++k) {
        if (direction[k] == 0) {
            if (origin[k] < m_bounds.low[k] || origin[k] > m_bounds.high[k]) return {1, 0};
            continue;
        }
        const double a = (m_bounds.low[k] - origin[k]) / direction[k];
        const double b = (m_bounds.high[k] - origin[k]) / direction[k];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return {first, last};
}

void Candidates::search(const glm::dvec3& origin, const glm::dvec3& direction, double first, double last,
                        Visitor visitor, bool ordered) const {
    if (!m_impl->scene) return;
    // From where the ray enters the boxes, so that its rounding is small against them however far the eye is.
    const auto [enter, leave] = clip(origin, direction, first, last);
    if (!(enter <= leave)) return;
    const glm::dvec3 start = origin + enter * direction;
    SearchContext context{.self = visitor.self, .call = visitor.call, .origin = enter};
    rtcInitIntersectContext(&context.embree);

    RTCRayHit query{};
    RTCRay& ray = query.ray;
    ray.org_x = static_cast<float>(start.x);
    ray.org_y = static_cast<float>(start.y);
    ray.org_z = static_cast<float>(start.z);
    ray.dir_x = static_cast<float>(direction.x);
    ray.dir_y = static_cast<float>(direction.y);
    ray.dir_z = static_cast<float>(direction.z);
    ray.tfar = static_cast<float>((leave - enter) * 1.000001);
    ray.mask = ~0u;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    if (ordered)
        rtcIntersect1(m_impl->scene, &context.embree, &query);
    else
        rtcOccluded1(m_impl->scene, &context.embree, &ray);
}

}  // namespace gnomon
