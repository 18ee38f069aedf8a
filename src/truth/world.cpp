#include "truth/world.h"

#include "volume/orient.h"

namespace gnomon {
namespace {

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
    for (const LitCaster& caster : litCasters(scene, light, silhouette)) {
        const auto& positions = scene.objects[caster.object].mesh.positions;
        for (const Side& side : caster.sides)
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

World::World(const Scene& scene, const glm::vec4& l, Silhouette silhouette)
    : light(l),
      triangles(trianglesOf(scene, l)),
      sides(sidesOf(scene, l, silhouette)),
      // Reach: rays beside the pixel's own ray and points beside the visible point look for what they
      // would meet through one ray. 10^-4 of the scene holds 1/256 pixel; the sides' band of depth is
      // longer.
      surfaces(boxesOf(triangles), 1e-4 * diagonal(boxesOf(triangles))),
      edges(boxesOf(sides), 1e-3 * diagonal(boxesOf(triangles))),
      casters(triangles, light) {}

}  // namespace gnomon
