// Mesh parsers in processes of their own: nothing is lost on the way, and a crash is a line.

#include "scene/parsed_apart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <new>

#include "process/die_of.h"
#include "scene/load.h"

namespace gnomon {
namespace parsed_apart_test {

using testing::StartsWith;
using testing::ThrowsMessage;

MeshFile meshFile() {
    MeshFile mesh;
    for (const char* name : {"", "second"}) {
        Object object{.name = name, .colour = {0.1f, 0.2f, 0.3f}, .casts = false, .twoSided = true};
        object.mesh.positions = {{1, 2, 3}, {4, 5, 6}, {-7, 8, 9}};
        object.mesh.triangles = {{0, 1, 2}};
        mesh.objects.push_back(object);
    }
    mesh.lights = {{.position = {1, 0, 0, 0}, .colour = {4, 5, 6}}};
    mesh.cameras = {{.eye = {9, 8, 7}, .nearPlane = 0.5f}};
    mesh.isGltf = true;
    mesh.notes = {"one", "two"};
    mesh.dropped.repeatedVertex = 3;
    mesh.dropped.flat = {{glm::vec3(1), glm::vec3(2), glm::vec3(3)}};
    return mesh;
}

TEST(ParsedApart, BringsAllOfAMeshFileBack) {
    const MeshFile mesh = meshFile(), back = parsedApart("file", meshFile);
    ASSERT_EQ(back.objects.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const Object &a = mesh.objects[i], &b = back.objects[i];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.mesh.positions, b.mesh.positions);
        EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
        EXPECT_EQ(a.colour, b.colour);
        EXPECT_EQ(a.casts, b.casts);
        EXPECT_EQ(a.twoSided, b.twoSided);
    }
    ASSERT_EQ(back.lights.size(), 1u);
    EXPECT_EQ(back.lights[0].position, mesh.lights[0].position);
    EXPECT_EQ(back.lights[0].colour, mesh.lights[0].colour);
    ASSERT_EQ(back.cameras.size(), 1u);
    EXPECT_EQ(back.cameras[0].eye, mesh.cameras[0].eye);
    EXPECT_EQ(back.cameras[0].nearPlane, mesh.cameras[0].nearPlane);
    EXPECT_TRUE(back.isGltf);
    EXPECT_EQ(back.notes, mesh.notes);
    EXPECT_EQ(back.dropped.repeatedVertex, 3u);
    EXPECT_EQ(back.dropped.flat, mesh.dropped.flat);
}

TEST(ParsedApart, MakesACrashOfTheParserABadFile) {
    const auto crashing = [](int signal) {
        return [=] {
            return parsedApart("bad.ply", [=] {
                dieOf(signal);
                return MeshFile();
            });
        };
    };
    EXPECT_THAT(crashing(SIGABRT),
                ThrowsMessage<SceneError>("bad.ply: its parser crashed: signal 6 (Aborted)"));
    EXPECT_THAT(crashing(SIGSEGV),
                ThrowsMessage<SceneError>(StartsWith("bad.ply: its parser crashed: signal 11")));
}

TEST(ParsedApart, KeepsTheLineOfWhatIsThrownAndNamesTheFileOfTheRest) {
    EXPECT_THAT(
        ([] { parsedApart("bad.obj", []() -> MeshFile { throw SceneError("bad.obj:7: no number"); }); }),
        ThrowsMessage<SceneError>("bad.obj:7: no number"));
    EXPECT_THAT(([] { parsedApart("bad.obj", []() -> MeshFile { throw std::bad_alloc(); }); }),
                ThrowsMessage<SceneError>("bad.obj: std::bad_alloc"));
}

}  // namespace parsed_apart_test
}  // namespace gnomon
