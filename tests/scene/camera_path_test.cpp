#include "scene/camera_path.h"

#include <gtest/gtest.h>

#include "scene/primitives.h"

namespace gnomon {
namespace camera_path_test {

Scene roomOrBox(const glm::vec3& eye) {
    Scene scene;
    scene.objects = {{.name = "box", .mesh = box({6, 4, 8})}};
    scene.frames = {{.eye = eye, .target = {0, 0, 0}}};
    return scene;
}

TEST(CameraPath, OfAnEyeOutsideGoesOnceAroundAtItsHeightAndDistance) {
    const auto path = cameraPath(roomOrBox({3, 5, 9}), 8);
    ASSERT_EQ(path.size(), 8u);
    glm::vec3 sum(0);
    for (const Camera& camera : path) {
        EXPECT_NEAR(glm::length(camera.eye), std::sqrt(115.0), 1e-4);
        EXPECT_FLOAT_EQ(camera.eye.y, 5);
        EXPECT_GT(camera.nearPlane, 0);
        sum += camera.eye;
    }
    EXPECT_NEAR(sum.x, 0, 1e-4);
    EXPECT_NEAR(sum.z, 0, 1e-4);
}

TEST(CameraPath, OfAnEyeInsideStaysInsideAndLooksAhead) {
    const auto path = cameraPath(roomOrBox({0.5f, -1, 1}), 12);
    for (std::size_t i = 0; i < path.size(); ++i) {
        const glm::vec3 eye = path[i].eye, next = path[(i + 1) % path.size()].eye;
        EXPECT_LT(std::abs(eye.x), 3);
        EXPECT_LT(std::abs(eye.z), 4);
        EXPECT_EQ(eye.y, -1);
        EXPECT_GT(glm::dot(path[i].target - eye, next - eye), 0);
    }
}

TEST(CameraPath, OfManyFramesIsSpreadOverThem) {
    Scene scene = roomOrBox({3, 5, 9});
    for (int i = 1; i < 60; ++i) scene.frames.push_back({.eye = {3, 5, 9 + float(i)}});
    const auto path = cameraPath(scene, 3);
    ASSERT_EQ(path.size(), 3u);
    EXPECT_EQ(path[0].eye.z, 9);
    EXPECT_EQ(path[1].eye.z, 29);
    EXPECT_EQ(path[2].eye.z, 49);
}

}  // namespace camera_path_test
}  // namespace gnomon
