// Textures and buffers that stay in a context from frame to frame.

#include "gl/kept_objects.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gl/capability.h"
#include "gl/renderer.h"
#include "tools.h"

namespace gnomon {
namespace kept_objects_test {

/// Entry points that number objects, and remember which were deleted.
struct Maker {
    GLuint made = 0;
    std::vector<GLuint> deleted{};
    GlTable gl{};

    Maker() {
        gl.GenTextures = gl.GenFramebuffers =
            gl.GenBuffers = [this](GLsizei, GLuint* name) { *name = ++made; };
        gl.DeleteTextures = gl.DeleteFramebuffers =
            gl.DeleteBuffers = [this](GLsizei, const GLuint* name) { deleted.push_back(*name); };
    }
};

TEST(KeptObjects, AreMadeOncePerKindAndName) {
    Maker maker;
    KeptObjects kept;
    const KeptObjects::Object first = kept.texture(maker.gl, "mask");
    EXPECT_TRUE(first.isNew);
    const KeptObjects::Object again = kept.texture(maker.gl, "mask");
    EXPECT_FALSE(again.isNew);
    EXPECT_EQ(again.name, first.name);
    EXPECT_TRUE(kept.texture(maker.gl, "frame").isNew);
    EXPECT_TRUE(kept.buffer(maker.gl, "mask").isNew);
    EXPECT_TRUE(kept.framebuffer(maker.gl, "mask").isNew);
    EXPECT_EQ(maker.made, 4u);
}

TEST(KeptObjects, GoWhenNoFrameHasAskedForThemInAWhile) {
    Maker maker;
    KeptObjects kept;
    const GLuint used = kept.texture(maker.gl, "used").name, left = kept.texture(maker.gl, "left").name;
    for (int frame = 0; frame < KeptObjects::kFrames; ++frame) {
        kept.texture(maker.gl, "used");
        kept.endFrame(maker.gl);
    }
    EXPECT_THAT(maker.deleted, testing::IsEmpty());
    kept.endFrame(maker.gl);
    EXPECT_THAT(maker.deleted, testing::ElementsAre(left));
    EXPECT_EQ(kept.texture(maker.gl, "used").name, used);
    EXPECT_TRUE(kept.texture(maker.gl, "left").isNew);
}

TEST(KeptObjects, AllGoWhenCleared) {
    Maker maker;
    KeptObjects kept;
    kept.texture(maker.gl, "mask"), kept.buffer(maker.gl, "surfaces");
    kept.clear(maker.gl);
    EXPECT_EQ(maker.deleted.size(), 2u);
    EXPECT_TRUE(kept.texture(maker.gl, "mask").isNew);
}

constexpr int kWidth = 21, kHeight = 13;

/// Two lights that share the storage of what they add, one after the other, as Lab's do.
class Lights {
  public:
    Lights() {
        Scene scene = twoBoxes();
        scene.lights.push_back({.position = {-3.1f, 7.2f, 2.3f, 1}});
        m_frames = {frameOf(scene, kWidth, kHeight, 0), frameOf(scene, kWidth, kHeight, 1)};
    }
    const FrameSurfaces& surfaces() const { return m_frames[0].surfaces; }
    LightFrames frames() {
        return
            [this](int light) -> const LightFrame& { return m_current = m_frames[std::size_t(light)].light; };
    }
    /// The shape of a frame with the first of them or with both.
    FrameShape shape(int lights) const {
        FrameShape made = shapeOf(int(m_frames[0].volumes().size()), kWidth, kHeight);
        if (lights == 2) made.lights.push_back({.volumes = int(m_frames[1].volumes().size())});
        return made;
    }

  private:
    std::vector<Frame> m_frames{};
    LightFrame m_current{};
};

/// Each named method with one light and with two.
template <class Visit>
void forEachPlan(const Lights& lights, const Profile& profile, const Visit& visit) {
    for (const NamedMethod& method : namedMethods())
        for (const int count : {1, 2}) {
            Axes axes = method.axes;
            if (axes.mapSize > 0) axes.mapSize = 16;
            visit(planFrame(axes, lights.shape(count), profile), fmt::format("{}, {}", method.id, count));
        }
}

TEST(Frames, MakeTexturesAndTheirStorageOnce) {
    const Profile ideal = chip("ideal");
    Lights lights;
    Surface surface(bufferFormatOf(ideal), kWidth, kHeight, arithmeticOf(ideal, {}));
    int made = 0;
    surface.decorate([&](GlTable gl) {
        const auto counted = [&made](auto& entry) {
            entry = [&made, next = entry](auto... arguments) { ++made, next(arguments...); };
        };
        counted(gl.GenTextures), counted(gl.GenFramebuffers);
        counted(gl.TexImage2D), counted(gl.CopyTexImage2D);
        return gl;
    });
    int firstFrames = 0;
    forEachPlan(lights, ideal, [&](Plan plan, const std::string& what) {
        plan.masks.clear();  // they are read in ways of their own
        made = 0;
        render(surface, ideal, plan, lights.surfaces(), lights.frames());
        firstFrames += made;
        made = 0;
        render(surface, ideal, plan, lights.surfaces(), lights.frames());
        EXPECT_EQ(made, 0) << what;
    });
    EXPECT_GT(firstFrames, 20);
}

// The first frame is cut off between the making of a texture and its storage.
TEST(Frames, AreRefusedAgainWhatTheFrameBeforeWasRefused) {
    Profile small = chip("ideal");
    small.maxTextureSize = 4;
    Lights lights;
    Surface surface(bufferFormatOf(small), kWidth, kHeight, arithmeticOf(small, {}));
    const Plan plan = planFrame(findMethod("screen-texture")->axes, lights.shape(1), chip("ideal"));
    for (int frame = 0; frame < 2; ++frame) {
        try {
            render(surface, small, plan, lights.surfaces(), lights.frames());
            ADD_FAILURE() << "nothing is refused in frame " << frame;
        } catch (const CapabilityViolation& violation) {
            EXPECT_EQ(violation.capability, "max_texture_size");
        }
    }
}

TEST(VertexBuffers, ShowAndCountWhatArraysInHostMemoryDo) {
    for (const char* id : {"ideal", "voodoo2"}) {
        const Profile profile = chip(id);
        Lights lights;
        Surface surface(bufferFormatOf(profile), kWidth, kHeight, arithmeticOf(profile, {}));
        forEachPlan(lights, profile, [&](const Plan& plan, const std::string& what) {
            if (!missing(profile, plan).empty()) return;
            const auto drawn = [&](VertexSource source) {
                return render(surface, profile, plan, lights.surfaces(), lights.frames(),
                              {.vertices = source});
            };
            const Rendered host = drawn(VertexSource::HostMemory), buffers = drawn(VertexSource::Buffers);
            EXPECT_EQ(buffers.image, host.image) << id << " " << what;
            EXPECT_EQ(buffers.values, host.values) << id << " " << what;
            EXPECT_EQ(buffers.counts.passes, host.counts.passes) << id << " " << what;
            EXPECT_EQ(buffers.counts.vertices, host.counts.vertices) << id << " " << what;
        });
    }
}

TEST(VertexBuffers, AreSentOnceAFrame) {
    const Profile ideal = chip("ideal");
    Lights lights;
    Surface surface(bufferFormatOf(ideal), kWidth, kHeight, arithmeticOf(ideal, {}));
    int sent = 0;
    surface.decorate([&](GlTable gl) {
        gl.BufferData = [&sent, next = gl.BufferData](GLenum target, GLsizeiptr size, const void* data,
                                                      GLenum usage) {
            ++sent;
            next(target, size, data, usage);
        };
        return gl;
    });
    // Surfaces and their lit colours; sides, far caps and near caps, from which each volume is drawn twice.
    const Plan plan = planFrame(findMethod("roettger-alpha")->axes, lights.shape(1), ideal);
    for (int frame = 0; frame < 2; ++frame) {
        sent = 0;
        render(surface, ideal, plan, lights.surfaces(), lights.frames(), {.vertices = VertexSource::Buffers});
        EXPECT_EQ(sent, 5) << frame;
    }
}

}  // namespace kept_objects_test
}  // namespace gnomon
