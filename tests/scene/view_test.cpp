#include "scene/view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon {
namespace view_test {

constexpr double kRounding = 1e-12;  // some tens of operations on numbers near 1, in double

View exampleView() {
    return viewOf({.eye = {1, 2, 7}, .target = {0.5f, 1, -1}, .fovDegrees = 50, .nearPlane = 0.25f}, 640,
                  480);
}

TEST(View, HasAnOrthonormalBasis) {
    const View view = exampleView();
    EXPECT_NEAR(glm::length(view.right), 1, kRounding);
    EXPECT_NEAR(glm::length(view.up), 1, kRounding);
    EXPECT_NEAR(glm::dot(view.right, view.up), 0, kRounding);
    EXPECT_NEAR(glm::length(glm::cross(view.right, view.up) + view.forward), 0, kRounding);
}

TEST(View, RaysMeetTheirPixelInClipSpace) {
    const View view = exampleView();
    for (const glm::dvec2 window : {glm::dvec2(0.5, 0.5), {639.5, 0.5}, {17.25, 400}, {320, 240}})
        for (const double z : {0.25, 3.0, 1000.0}) {
            const glm::dvec3 point = view.eye + z * rayDirection(view, window.x, window.y);
            const glm::dvec4 clip = clipFromEye(view) * eyeFromWorld(view) * glm::dvec4(point, 1);
            EXPECT_NEAR(clip.w, z, kRounding * 1000);
            EXPECT_NEAR((clip.x / clip.w + 1) / 2 * view.width, window.x, 1e-9);
            EXPECT_NEAR((clip.y / clip.w + 1) / 2 * view.height, window.y, 1e-9);
            EXPECT_NEAR((clip.z / clip.w + 1) / 2, windowDepth(view, z), kRounding);
        }
}

TEST(View, RayAdvancesByOneAlongForward) {
    const View view = exampleView();
    EXPECT_NEAR(glm::dot(rayDirection(view, 3.5, 470.5), view.forward), 1, kRounding);
}

TEST(View, PointAtInfinityHasDepthOne) {
    const View view = exampleView();
    const glm::dvec4 clip = clipFromEye(view) * eyeFromWorld(view) * glm::dvec4(view.forward, 0);
    EXPECT_NEAR(clip.z / clip.w, 1, kRounding);
    EXPECT_TRUE(std::isinf(distanceAtDepth(view, 1)));
}

TEST(View, DistanceInvertsDepth) {
    const View view = exampleView();
    EXPECT_EQ(windowDepth(view, view.nearPlane), 0);
    EXPECT_NEAR(distanceAtDepth(view, windowDepth(view, 12.5)), 12.5, 1e-10);
}

TEST(View, TakesAnotherUpWhereItLooksAlongUp) {
    for (const glm::vec3 target : {glm::vec3(0, -1, 0), glm::vec3(0, 1, 0)}) {
        const View view = viewOf({.eye = {0, 0, 0}, .target = target}, 8, 8);
        EXPECT_NEAR(glm::length(view.right), 1, kRounding);
        EXPECT_NEAR(glm::dot(view.right, view.forward), 0, kRounding);
    }
}

TEST(View, IsWiderThanHighByTheAspectRatio) {
    const View view = exampleView();
    EXPECT_NEAR(view.tanHalfX / view.tanHalfY, 640.0 / 480, kRounding);
}

}  // namespace view_test
}  // namespace gnomon
