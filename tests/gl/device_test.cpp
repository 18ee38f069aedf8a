// Devices: whose buffers surfaces have, several devices in one process, and that both draw the same bits.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "fake_driver.h"
#include "gl/device_context.h"
#include "gl/emulation.h"
#include "gl/extensions.h"
#include "gl/renderer.h"
#include "gl/stopwatch.h"
#include "gl/window_object.h"
#include "test_surface.h"
#include "tools.h"

namespace gnomon {
namespace device_test {

using testing::HasSubstr;

/// Skips all tests on a device that the system has no driver for.
class NeedsDriver : public testing::Environment {
  public:
    void SetUp() override {
        try {
            TestSurface({}, 1, 1);
        } catch (const NoDriver& none) {
            // CTest goes by this mark, which GoogleTest has for single tests only.
            GTEST_SKIP() << "[  SKIPPED ] " << none.what();
        }
    }
};
[[maybe_unused]] const auto* const kNeedsDriver = testing::AddGlobalTestEnvironment(new NeedsDriver);

constexpr int kSide = 4;
const BufferFormat k565{.red = 5, .green = 6, .blue = 5, .alpha = 0, .depth = 16, .stencil = 0};

std::array<std::uint8_t, 4> pixelAt(const GlTable& gl, int x, int y) {
    std::array<std::uint8_t, 4> bytes{};
    gl.ReadPixels(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    return bytes;
}

int bitsOf(const GlTable& gl, GLenum what) {
    GLint bits = -1;
    gl.GetIntegerv(what, &bits);
    return bits;
}

// That it has no other buffers is checked when it is made; here, that this check is right.
TEST(DeviceBuffers, HoldWhatTheFormatCanHoldAndNoMore) {
    TestSurface surface(k565, kSide, kSide);
    const GlTable& gl = surface.driver();
    for (int value = 0; value < 256; ++value) {
        gl.ClearColor(float(value) / 255, float(value) / 255, 0, 0);
        gl.Clear(GL_COLOR_BUFFER_BIT);
        const int five = (value * 31 * 2 + 255) / (2 * 255), six = (value * 63 * 2 + 255) / (2 * 255);
        const auto pixel = pixelAt(gl, 1, 1);
        EXPECT_EQ(pixel[0], five << 3 | five >> 2) << value;
        EXPECT_EQ(pixel[1], six << 2 | six >> 4) << value;
        EXPECT_EQ(pixel[3], 255);
    }
    EXPECT_EQ(bitsOf(gl, GL_DEPTH_BITS), 16);
    EXPECT_EQ(bitsOf(gl, GL_STENCIL_BITS), 0);
}

TEST(DeviceBuffers, AreThoseOfEveryFormatThatNeedsNoEmulation) {
    for (const BufferFormat& colour : {BufferFormat{}, k565})
        for (const auto& [depth, stencil] : {std::pair{0, 0}, {16, 0}, {24, 0}, {32, 0}, {24, 8}}) {
            BufferFormat format = colour;
            format.depth = depth, format.stencil = stencil;
            if (depth == 32 && testDevice() == Device::Osmesa) continue;  // gives 24
            SCOPED_TRACE(testing::Message() << format.red << " " << depth << " " << stencil);
            ASSERT_FALSE(needsEmulation(format, {}));
            TestSurface surface(format, kSide, kSide);
            const GlTable& gl = surface.driver();
            EXPECT_EQ(bitsOf(gl, GL_RED_BITS), format.red);
            EXPECT_EQ(bitsOf(gl, GL_ALPHA_BITS), format.alpha);
            EXPECT_EQ(bitsOf(gl, GL_DEPTH_BITS), depth);
            EXPECT_EQ(bitsOf(gl, GL_STENCIL_BITS), stencil);
        }
}

TEST(DeviceBuffers, AreAllOfTheWindowAtFirst) {
    TestSurface surface({}, 7, 5);
    const GlTable& gl = surface.driver();
    gl.Enable(GL_SCISSOR_TEST);
    gl.Color4f(1, 0, 0, 1);
    gl.Rectf(-1, -1, 1, 1);
    for (const auto& [x, y] : {std::pair{0, 0}, {6, 0}, {0, 4}, {6, 4}})
        EXPECT_EQ(pixelAt(gl, x, y)[0], 255) << x << "," << y;
}

TEST(DeviceBuffers, RunFromTheBottomInReadsViewportsScissorsAndCopies) {
    TestSurface surface({}, 4, 4);
    const GlTable& gl = surface.driver();
    gl.Enable(GL_SCISSOR_TEST);
    for (int y = 0; y < 4; ++y) {
        gl.Scissor(0, y, 4, 1);
        gl.ClearColor(float(y) / 255, 0, 0, 0);
        gl.Clear(GL_COLOR_BUFFER_BIT);
    }
    gl.Disable(GL_SCISSOR_TEST);
    gl.Viewport(2, 3, 1, 1);
    gl.Color4f(9 / 255.0f, 0, 0, 0);
    gl.Rectf(-1, -1, 1, 1);
    std::array<std::uint8_t, 16> reds{};
    gl.ReadPixels(0, 0, 4, 4, GL_RED, GL_UNSIGNED_BYTE, reds.data());
    EXPECT_THAT(reds, testing::ElementsAre(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 9, 3));

    // The two rows in the middle, drawn from a texture at the bottom.
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl.TexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
    gl.CopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 1, 4, 2, 0);
    gl.Viewport(0, 0, 4, 2);
    gl.Enable(GL_TEXTURE_2D);
    const std::array<float, 8> at{-1, -1, 1, -1, 1, 1, -1, 1}, coordinates{0, 0, 1, 0, 1, 1, 0, 1};
    gl.EnableClientState(GL_VERTEX_ARRAY);
    gl.EnableClientState(GL_TEXTURE_COORD_ARRAY);
    gl.VertexPointer(2, GL_FLOAT, 0, at.data());
    gl.TexCoordPointer(2, GL_FLOAT, 0, coordinates.data());
    gl.DrawArrays(GL_QUADS, 0, 4);
    gl.ReadPixels(0, 0, 4, 4, GL_RED, GL_UNSIGNED_BYTE, reds.data());
    EXPECT_THAT(reds, testing::ElementsAre(1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 3, 3, 9, 3));
    EXPECT_EQ(gl.GetError(), GLenum(GL_NO_ERROR));
}

TEST(DeviceBuffers, AreBoundAgainWhenAnotherFramebufferIsUnboundOrDeleted) {
    TestSurface surface({}, kSide, kSide);
    const GlTable& gl = surface.driver();
    gl.ClearColor(1, 0, 0, 1);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    for (const bool deletes : {false, true}) {
        GLuint other = 0, texture = 0;
        gl.GenFramebuffers(1, &other);
        gl.GenTextures(1, &texture);
        gl.BindTexture(GL_TEXTURE_2D, texture);
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kSide, kSide, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        gl.BindFramebuffer(GL_FRAMEBUFFER, other);
        gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
        gl.ClearColor(0, 1, 0, 1);
        gl.Clear(GL_COLOR_BUFFER_BIT);
        EXPECT_EQ(pixelAt(gl, 1, 1)[1], 255);
        deletes ? gl.DeleteFramebuffers(1, &other) : gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
        EXPECT_EQ(pixelAt(gl, 1, 1)[0], 255) << deletes;
    }
    EXPECT_EQ(gl.GetError(), GLenum(GL_NO_ERROR));
}

TEST(DeviceBuffers, ThatRenderbuffersDontHaveAreRefused) {
    const GlTable gl = FakeDriver().table();
    EXPECT_THROW(withWindowObject({.red = 4, .green = 4, .blue = 4, .alpha = 4}, 4, 4, gl),
                 std::runtime_error);
    EXPECT_THROW(withWindowObject({.depth = 16, .stencil = 8}, 4, 4, gl), std::runtime_error);
}

TEST(Surfaces, OfSeveralDevicesTakeTurnsOnAThread) {
    std::vector<std::unique_ptr<Surface>> surfaces;
    for (int i = 0; i < 2 * kDevices; ++i) {
        try {
            surfaces.push_back(std::make_unique<Surface>(BufferFormat{}, kSide, kSide, ChipArithmetic{},
                                                         Device(i % kDevices)));
        } catch (const NoDriver& none) {
            GTEST_SKIP() << none.what();
        }
    }
    const auto draw = [&](std::size_t i, int value) {
        surfaces[i]->makeCurrent();
        surfaces[i]->driver().ClearColor(float(value) / 255, 0, 0, 0);
        surfaces[i]->driver().Clear(GL_COLOR_BUFFER_BIT);
    };
    const auto shown = [&](std::size_t i) {
        surfaces[i]->makeCurrent();
        return int(pixelAt(surfaces[i]->driver(), 1, 1)[0]);
    };
    for (std::size_t i = 0; i < surfaces.size(); ++i) draw(i, 10 * int(i) + 1);
    for (std::size_t i = 0; i < surfaces.size(); ++i) EXPECT_EQ(shown(i), 10 * int(i) + 1);

    // One that goes leaves the thread to the one that was current.
    draw(2, 77);
    surfaces[3].reset(), surfaces[0].reset();
    EXPECT_EQ(pixelAt(surfaces[2]->driver(), 1, 1)[0], 77);
    EXPECT_EQ(shown(1), 11);
}

TEST(Surfaces, AreOfTheDeviceThatTheyAreAskedOf) {
    TestSurface surface({}, kSide, kSide);
    EXPECT_EQ(surface.device(), testDevice());
    EXPECT_THAT(surface.driverName(), HasSubstr("OpenGL "));
}

TEST(Devices, ThatAreNotBuiltInAreRefusedInOneLine) {
    for (int i = 0; i < kDevices; ++i) {
        if (isBuilt(Device(i))) continue;
        try {
            newContext(Device(i), {}, 4, 4);
            FAIL() << "no error";
        } catch (const NoDriver& none) {
            EXPECT_EQ(std::string(none.what()),
                      std::string("this gnomon was built without ") + title(Device(i)));
        }
    }
    EXPECT_TRUE(isBuilt(defaultDevice()));
}

TEST(Extensions, AreFoundAsWholeNames) {
    EXPECT_TRUE(listsName("GL_A GL_B GL_CD", "GL_B"));
    EXPECT_TRUE(listsName("GL_A GL_B GL_CD", "GL_CD"));
    EXPECT_FALSE(listsName("GL_A GL_B GL_CD", "GL_C"));
    EXPECT_FALSE(listsName("", "GL_A"));
}

/// A driver that says that it is @p renderer, with @p extensions.
GlTable saying(GlTable gl, const char* renderer, const char* extensions = "") {
    gl.GetString = [=](GLenum what) {
        return reinterpret_cast<const GLubyte*>(what == GL_RENDERER ? renderer : extensions);
    };
    return gl;
}

TEST(Emulation, NamesTheExtensionThatADriverLacks) {
    try {
        emulate(k565, {.fidelity = Fidelity::Chip}, 4, 4, saying({}, "GeForce", "GL_EXT_shader_framebuffer"));
        FAIL() << "no error";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("the driver has no GL_EXT_shader_framebuffer_fetch"));
    }
}

TEST(Surfaces, AreSoftwareWhereTheDriverSaysSo) {
    TestSurface surface({}, kSide, kSide);
    for (const auto& [renderer, isSoftware] : {std::pair{"llvmpipe (LLVM 15.0.6, 256 bits)", true},
                                               {"softpipe", true},
                                               {"NVIDIA H100/PCIe/SSE2", false},
                                               {"AMD Radeon RX 580 (polaris10)", false}}) {
        surface.decorate([&, name = renderer](GlTable gl) { return saying(std::move(gl), name); });
        EXPECT_EQ(surface.isSoftware(), isSoftware) << renderer;
        EXPECT_EQ(clockOf(surface), isSoftware ? DrawClock::Thread : DrawClock::Gpu);
    }
}

TEST(Stopwatch, TakesTheTimeThatTheDriverMeasured) {
    TestSurface surface({}, 256, 256);
    const GlTable& gl = surface.driver();
    Stopwatch watch(surface, DrawClock::Gpu);
    gl.Color4f(1, 1, 1, 1);
    for (int round = 0; round < 2; ++round) {
        watch.start();
        for (int i = 0; i < 100; ++i) gl.Rectf(-1, -1, 1, 1);
        EXPECT_GT(watch.stop(), 0);
    }
    EXPECT_EQ(gl.GetError(), GLenum(GL_NO_ERROR));
}

// 1.5 ms for each query of elapsed time, as a driver of a GPU would say.
TEST(Stopwatch, AddsTheGpusTimeOfEachPassOfAFrame) {
    const Profile ideal = chip("ideal");
    TestSurface surface(bufferFormatOf(ideal), 32, 24);
    int running = 0, queries = 0;
    surface.decorate([&](GlTable gl) {
        gl = saying(std::move(gl), "NVIDIA H100/PCIe/SSE2", "");
        const auto begin = gl.BeginQuery;
        const auto end = gl.EndQuery;
        const auto result = gl.GetQueryObjectui64v;
        gl.BeginQuery = [&, begin](GLenum what, GLuint query) {
            if (what == GL_TIME_ELAPSED) {
                EXPECT_EQ(running++, 0) << "one at a time";
                ++queries;
            }
            begin(what, query);
        };
        gl.EndQuery = [&, end](GLenum what) {
            if (what == GL_TIME_ELAPSED) --running;
            end(what);
        };
        gl.GetQueryObjectui64v = [&, result](GLuint query, GLenum what, GLuint64* value) {
            result(query, what, value);
            if (what == GL_QUERY_RESULT) *value = 1'500'000;
        };
        return gl;
    });
    const Frame frame = frameOf(twoBoxes(), 32, 24);
    const Plan plan = planFrame(findMethod("carmack")->axes, shapeOf(2, 32, 24), ideal);
    const Rendered drawn =
        render(surface, ideal, plan, frame.surfaces, frame.lights(), {.timesPasses = true});
    EXPECT_EQ(running, 0);
    EXPECT_EQ(queries, int(plan.passes.size()));
    EXPECT_DOUBLE_EQ(drawn.cpuMs, 1.5 * double(plan.passes.size()));
    EXPECT_THAT(drawn.passMs, testing::Each(1.5));
}

/// One surface of each device, with the same buffers.
class BothDevices {
  public:
    /// @throws NoDriver
    BothDevices(const Profile& profile, Fidelity fidelity)
        : m_profile(profile),
          m_surfaces{makeSurface(Device::Osmesa, fidelity), makeSurface(Device::Egl, fidelity)} {}

    bool isSoftware() {
        m_surfaces[1]->makeCurrent();
        return m_surfaces[1]->isSoftware();
    }

    void expectAlike(const Plan& plan, const Frame& frame) {
        std::array<Rendered, 2> drawn;
        std::array<Image, 2> colour;
        for (std::size_t i = 0; i < 2; ++i) {
            Surface& surface = *m_surfaces[i];
            drawn[i] = render(surface, m_profile, plan, frame.surfaces, frame.lights());
            colour[i] = readColour(surface, surface.format().alpha > 0);
        }
        EXPECT_EQ(drawn[0].image, drawn[1].image);
        EXPECT_EQ(drawn[0].values, drawn[1].values);
        EXPECT_EQ(drawn[0].masks, drawn[1].masks);
        EXPECT_EQ(drawn[0].counts.passes, drawn[1].counts.passes);
        EXPECT_EQ(drawn[0].counts.vertices, drawn[1].counts.vertices);
        EXPECT_EQ(colour[0], colour[1]);
    }

  private:
    std::unique_ptr<Surface> makeSurface(Device device, Fidelity fidelity) const {
        return std::make_unique<Surface>(bufferFormatOf(m_profile), 96, 72,
                                         arithmeticOf(m_profile, {fidelity}), device);
    }
    Profile m_profile;
    std::array<std::unique_ptr<Surface>, 2> m_surfaces;
};

// The same triangles by another library: its rasteriser must not see a difference. In tied pixels too: rows
// of the window run the same way on both.
TEST(Devices, DrawTheSameBitsWithMesasRasteriser) {
    const Frame frame = frameOf(twoBoxes(), 96, 72);
    int frames = 0;
    for (const char* id : {"ideal", "voodoo2", "tnt", "geforce2mx", "ps2"})
        for (const Fidelity fidelity : {Fidelity::Gl, Fidelity::Chip}) {
            const Profile profile = chip(id);
            std::optional<BothDevices> devices;
            try {
                devices.emplace(profile, fidelity);
            } catch (const NoDriver& none) {
                GTEST_SKIP() << none.what();
            }
            if (!devices->isSoftware()) GTEST_SKIP() << "EGL draws on a GPU";
            const FrameShape shape = shapeOf(int(frame.volumes().size()), 96, 72);
            for (const NamedMethod& method : namedMethods()) {
                if (method.axes.automatic) continue;
                const Plan plan = planFrame(method.axes, shape, profile);
                if (!missing(profile, plan).empty()) continue;
                SCOPED_TRACE(testing::Message() << id << " " << name(fidelity) << " " << method.id);
                devices->expectAlike(plan, frame);
                ++frames;
            }
        }
    EXPECT_GT(frames, 80);
}

}  // namespace device_test
}  // namespace gnomon
