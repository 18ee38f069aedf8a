#include "scene/scene.h"

namespace gnomon {

std::size_t triangleCount(const Scene& scene) {
    std::size_t count = 0;
    for (const Object& object : scene.objects) count += object.mesh.triangles.size();
    return count;
}

}  // namespace gnomon
