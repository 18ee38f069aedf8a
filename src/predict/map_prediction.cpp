#include "predict/map_prediction.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "profile/frame_channel.h"

namespace gnomon {
namespace {

const double kUlp = std::ldexp(1.0, -24);  ///< of a float, as a share
/// Roundings between a vertex's coordinates and a fragment's: interpolated as shares of 1 / w.
constexpr double kInterpolation = 4;
/// Roundings of window positions from which that starts, ulps of the window's size.
constexpr double kPosition = 4;
constexpr double kDivision = 4;  ///< roundings from the coordinates to a texel
constexpr int kMostTexels = 64;  ///< that a point may lie in, along each axis, before anything goes

int axisOf(int face) {
    return face / 2;
}

}  // namespace

MapPrediction::MapPrediction(const MapMaskInputs& inputs) : in(inputs) {
    const View& view = in.window.view();
    m_answers.resize(std::size_t(view.width) * std::size_t(view.height));
    for (std::size_t p = 0; p < m_answers.size(); ++p) m_answers[p] = answersAt(p);
}

std::uint8_t MapPrediction::answersAt(std::size_t pixel) const {
    std::uint8_t answers = 0;
    bool isFirst = true;
    for (const Seen& seen : in.window.at(pixel)) {
        // What is not drawn stays as it was cleared: lit.
        const std::uint8_t here = seen.face ? answersOf(pixel, seen) : std::uint8_t(kLit);
        answers |= isFirst ? here : here & kBoth;
        isFirst = false;
    }
    return answers;
}

std::uint8_t MapPrediction::answersOf(std::size_t pixel, const Seen& seen) const {
    if (seen.inverse <= 0) return kBoth;  // a plane seen so edge-on that it ends at infinity
    const Place place = placeOf(pixel, seen);
    std::uint8_t answers = 0;

    // Exactly
    const int size = in.depths.size();
    const auto texel = [&](double at) { return int(std::clamp(std::floor(at), 0.0, double(size - 1))); };
    const int own = faceOf(place.at);
    const InFace exact = inFace(place, own);
    const StoredDepth& stored = in.depths.at(own, texel(exact.texel.x), texel(exact.texel.y)).front();
    if (behind(exact, stored, in.plan.mapBias) > 0)
        answers |= kShadowExactly | kShadow;
    else
        answers |= kLit;

    // And all else
    const glm::dvec3 farthest = glm::abs(place.at) + place.error, nearest = glm::abs(place.at) - place.error;
    const double most = std::max({nearest.x, nearest.y, nearest.z});
    for (int face = 0; face < int(in.depths.map().faces.size()); ++face) {
        if (face != own) {
            const int axis = axisOf(face);
            const double along = face % 2 == 0 ? place.at[axis] : -place.at[axis];
            if (farthest[axis] < most || along < -place.error[axis]) continue;
        }
        const InFace point = inFace(place, face);
        if (!(point.depth > point.depthError) && !in.depths.map().parallel) return answers | kBoth;
        const glm::dvec2 least = point.texel - point.texelError, last = point.texel + point.texelError;
        const glm::ivec2 low(texel(least.x), texel(least.y)), high(texel(last.x), texel(last.y));
        if (high.x - low.x >= kMostTexels || high.y - low.y >= kMostTexels) return answers | kBoth;
        for (int y = low.y; y <= high.y; ++y) {
            for (int x = low.x; x <= high.x; ++x) {
                for (const StoredDepth& depth : in.depths.at(face, x, y)) {
                    const double value = behind(point, depth, in.plan.mapBias);
                    const double error = behindError(point, depth);
                    if (value > -error) answers |= kShadow;
                    if (value <= error) answers |= kLit;
                }
                if ((answers & kBoth) == kBoth) return answers;
            }
        }
    }
    return answers;
}

MapPrediction::Place MapPrediction::placeOf(std::size_t pixel, const Seen& seen) const {
    const View& view = in.window.view();
    const double x = double(pixel % std::size_t(view.width)) + 0.5,
                 y = view.height - 0.5 - double(pixel / std::size_t(view.width));
    const LightMap& map = in.depths.map();
    const glm::dvec3 direction = rayDirection(view, x, y);
    Place place{.at = map.coordinates(view.eye + direction / seen.inverse)};

    // How far the point moves with a pixel.
    const glm::dvec2 slope = seen.slope / -view.nearPlane;
    const auto moved = [&](const glm::dvec3& step, double inverseStep) {
        return glm::abs(map.coordinateStep((step - direction * (inverseStep / seen.inverse)) / seen.inverse));
    };
    const double most = std::max(view.width, view.height);
    place.error = kPosition * kUlp * most *
                  (moved(2 * view.tanHalfX / view.width * view.right, slope.x) +
                   moved(2 * view.tanHalfY / view.height * view.up, slope.y));

    // Floats round at the triangle's corners, and as shares of 1 / w.
    const Mesh& mesh = in.window.scene().objects[seen.face->object].mesh;
    double size = 0, nearest = 0;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 corner = mesh.positions[seen.face->corners[k]];
        const glm::dvec3 at = glm::abs(map.coordinates(corner));
        size = std::max({size, at.x, at.y, at.z});
        const double distance = glm::dot(corner - view.eye, view.forward);
        nearest = std::max(nearest, distance > view.nearPlane ? 1 / distance : 1 / view.nearPlane);
    }
    const double atOrigin = seen.inverse - slope.x * x - slope.y * y;
    const double inWindow =
        atOrigin + std::max(0.0, slope.x * view.width) + std::max(0.0, slope.y * view.height);
    nearest = std::max(seen.inverse, std::min(nearest, inWindow));
    place.error += kUlp * size * (1 + 2 * kInterpolation * nearest / seen.inverse);
    return place;
}

int MapPrediction::faceOf(const glm::dvec3& at) const {
    if (in.depths.map().parallel) return 0;
    const glm::dvec3 size = glm::abs(at);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * axis + (at[axis] > 0 ? 0 : 1);
}

MapPrediction::InFace MapPrediction::inFace(const Place& place, int face) const {
    const double half = 0.5 * in.depths.size();
    InFace out{.face = face};
    glm::dvec2 at(place.at), error(place.error);
    if (in.depths.map().parallel) {
        out.depth = place.at.z, out.depthError = place.error.z;
    } else {
        const CubeFace& axes = kCubeFaces[face];
        const auto along = [&](const glm::vec3& axis) { return glm::dot(place.at, glm::dvec3(axis)); };
        const auto errorAlong = [&](const glm::vec3& axis) {
            return glm::dot(place.error, glm::dvec3(glm::abs(axis)));
        };
        out.depth = along(axes.forward), out.depthError = errorAlong(axes.forward);
        at = glm::dvec2(along(axes.right), along(axes.up)) / out.depth;
        error = (glm::dvec2(errorAlong(axes.right), errorAlong(axes.up)) + glm::abs(at) * out.depthError) /
                (out.depth - out.depthError);
    }
    out.texel = (at + 1.0) * half;
    out.texelError = half * (error + kDivision * kUlp);
    return out;
}

double MapPrediction::behind(const InFace& point, const StoredDepth& stored, double bias) const {
    if (in.depths.map().parallel) return point.depth - (1 - stored.inverse) - bias;
    return point.depth * stored.inverse - (1 + bias);
}

double MapPrediction::behindError(const InFace& point, const StoredDepth& stored) const {
    const LightMap& map = in.depths.map();
    if (map.parallel) return point.depthError + stored.slack + 2 * kUlp;
    if (stored.inverse == 0) return 0;  // depth 1: at infinity
    return point.depth * stored.slack / map.faces.front().nearPlane + point.depthError * stored.inverse +
           kDivision * kUlp * (1 + in.plan.mapBias);
}

int MapPrediction::shown(std::size_t pixel, bool shadow) const {
    const auto width = std::size_t(in.window.view().width);
    const float value = shadow ? float(in.plan.shadowShare) : 1;
    const int code = clearedTo(in.arithmetic, int(pixel % width), int(pixel / width), value);
    return replicated(code, in.arithmetic.bits());
}

bool MapPrediction::allows(std::size_t pixel, int value) const {
    return ((m_answers[pixel] & kLit) && value == shown(pixel, false)) ||
           ((m_answers[pixel] & kShadow) && value == shown(pixel, true));
}

Cause MapPrediction::causeOf(std::size_t pixel, bool blocked) const {
    if (shadow(pixel) == blocked) return Cause::DepthPrecision;
    const Seen& seen = in.window.at(pixel).front();
    if (!seen.face || seen.inverse <= 0) return Cause::Unexplained;
    const Place place = placeOf(pixel, seen);
    const InFace point = inFace(place, faceOf(place.at));
    // Casters that the point touches don't hide it.
    constexpr double kTouch = 1e-9;
    const auto isRight = [&](double bias, bool uncut) {
        const double inverse = in.depths.along(point.face, point.texel.x, point.texel.y, *seen.face, uncut);
        return (behind(point, {inverse, 0}, bias) > kTouch) == blocked;
    };
    if (!blocked) {
        // A surface that shadows itself, since its depth changes within the texel: the bias is too small.
        const double others = in.depths.along(point.face, std::floor(point.texel.x) + 0.5,
                                              std::floor(point.texel.y) + 0.5, *seen.face);
        if (behind(point, {others, 0}, in.plan.mapBias) <= kTouch) return Cause::MapBias;
    }
    if (isRight(in.plan.mapBias, false)) return Cause::MapResolution;
    if (isRight(0, false)) return Cause::MapBias;
    return isRight(0, true) ? Cause::NearPlaneCuts : Cause::Unexplained;
}

}  // namespace gnomon
