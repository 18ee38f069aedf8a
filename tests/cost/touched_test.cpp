// What the passes of a plan draw and touch: rectangles, sides, extents, and the renderer's own count of
// vertices.

#include "cost/touched.h"

#include <gtest/gtest.h>

#include "cost/coverage.h"
#include "gl/renderer.h"
#include "gl/surface.h"
#include "gl/tools.h"

namespace gnomon {
namespace touched_test {

constexpr int kWidth = 64, kHeight = 48, kPixels = kWidth * kHeight;

/// A rectangle of the window as two triangles, in clip space; seen from behind if @p back.
std::vector<glm::vec4> quad(const WindowRect& r, bool back = false) {
    const auto at = [](int x, int y) {
        return glm::vec4(float(x) / kWidth * 2 - 1, float(y) / kHeight * 2 - 1, 0, 1);
    };
    const glm::vec4 a = at(r.x, r.y), b = at(r.x + r.width, r.y), c = at(r.x + r.width, r.y + r.height),
                    d = at(r.x, r.y + r.height);
    return back ? std::vector{a, c, b, a, d, c} : std::vector{a, b, c, a, c, d};
}

/// Two volumes: the sides of each are a front face of 20x10 pixels and a back face of 10x10, the second's
/// reach 30 pixels further to the right; the first has a light cap of 4x4.
struct TwoVolumes {
    TwoVolumes() {
        auto volumes = std::make_shared<FrameVolumes>();
        for (const int x : {0, 30}) {
            auto& sides = volumes->parts[std::size_t(Part::Sides)];
            for (const auto& list : {quad({x, 0, 20, 10}), quad({x, 20, 10, 10}, true)})
                sides.vertices.insert(sides.vertices.end(), list.begin(), list.end());
            auto& caps = volumes->parts[std::size_t(Part::LightCap)];
            if (x == 0) caps.vertices = quad({40, 40, 4, 4});
            for (auto& runs : volumes->parts) runs.begins.push_back(runs.vertices.size());
        }
        light.volumes = volumes;
        surfaces.positions = quad({0, 0, kWidth, 24});
        plan.width = kWidth, plan.height = kHeight;
        plan.maskWidth = kWidth, plan.maskHeight = kHeight;
    }

    DrawnAmount of(const Pass& pass) {
        plan.passes = {pass};
        return drawnAmount(plan, surfaces, [this](int) -> const LightFrame& { return light; });
    }
    std::int64_t volumePixels(const Pass& pass) { return of(pass).pixels.volume; }

    Plan plan{};
    FrameSurfaces surfaces{};
    LightFrame light{};
};

Pass volumePass(Faces faces, Parts parts = Part::Sides, int volume = kAllVolumes) {
    return {.kind = PassKind::Volume, .parts = parts, .volume = volume, .faces = faces};
}

TEST(TouchedPixels, OfVolumesAreThoseOfTheFacesThatAreNotCulled) {
    TwoVolumes s;
    EXPECT_EQ(s.volumePixels(volumePass(Faces::Front)), 400);
    EXPECT_EQ(s.volumePixels(volumePass(Faces::Back)), 200);
    EXPECT_EQ(s.volumePixels(volumePass(Faces::Both)), 600);
    EXPECT_EQ(s.volumePixels(volumePass(Faces::Both, Part::Sides | Part::LightCap)), 616);
    EXPECT_EQ(s.volumePixels(volumePass(Faces::Both, Part::LightCap, 1)), 0);
    EXPECT_EQ(s.volumePixels(volumePass(Faces::Both, Part::Sides, 1)), 300);
    EXPECT_EQ(s.of(volumePass(Faces::Front)).vertices, 24) << "culled faces are sent too";
}

TEST(TouchedPixels, OfVolumesEndAtTheScissor) {
    TwoVolumes s;
    s.plan.windows = {{.all = {5, 0, 30, 5}, .volumes = {{5, 0, 10, 5}, {}}}};
    Pass pass = volumePass(Faces::Front);
    pass.extent = Extent::Shadows;
    EXPECT_EQ(s.volumePixels(pass), 15 * 5 + 5 * 5) << "both volumes under the rectangle of all";
    EXPECT_EQ(s.of(pass).vertices, 24);
    pass.extent = Extent::Volumes;
    EXPECT_EQ(s.volumePixels(pass), 10 * 5) << "each under its own";
    EXPECT_EQ(s.of(pass).vertices, 12) << "that of no pixel is not drawn";
    pass.volume = 1;
    EXPECT_EQ(s.of(pass), DrawnAmount{});
}

TEST(TouchedPixels, OfAMaskAreOfItsOwnSize) {
    TwoVolumes s;
    s.plan.maskWidth = kWidth / 2, s.plan.maskHeight = kHeight / 2;
    Pass pass = volumePass(Faces::Front);
    pass.target = Target::Mask;
    EXPECT_EQ(s.volumePixels(pass), 100);
    EXPECT_EQ(s.of({.kind = PassKind::Rectangle, .target = Target::Mask}).pixels.rectangle, kPixels / 4);
}

TEST(TouchedPixels, OfClearsAreTheBuffersOnce) {
    TwoVolumes s;
    EXPECT_EQ(s.of({.clearsDepth = true, .clearsStencil = true}).pixels.clear, kPixels);
    EXPECT_EQ(s.of({.write = kWriteNothing}).pixels.clear, 0) << "nothing is cleared";
    s.plan.maskWidth = kWidth / 2;
    EXPECT_EQ(s.of({.target = Target::Mask}).pixels.clear, kPixels) << "no viewport bounds a clear";
    s.plan.windows = {{.all = {1, 2, 3, 4}}};
    EXPECT_EQ(s.of({.extent = Extent::Shadows}).pixels.clear, 12);
    EXPECT_EQ(s.of({.kind = PassKind::Rectangle, .extent = Extent::Shadows}).pixels.rectangle, 12);
    s.plan.windows = {{}};
    EXPECT_EQ(s.of({.kind = PassKind::Rectangle, .extent = Extent::Shadows}).pixels.rectangle, 0);
}

TEST(TouchedPixels, OfTheSceneAreItsSurfacesAndOverAMaskWhatLiesAtInfinity) {
    TwoVolumes s;
    const Pass depth{.kind = PassKind::Scene, .write = kWriteNothing};
    EXPECT_EQ(s.of(depth), (DrawnAmount{{.scene = kPixels / 2}, 6}));
    const Pass over{.kind = PassKind::Scene,
                    .shading = Shading::Lit,
                    .blend = {.enabled = true, .source = BlendFactor::DstColor}};
    EXPECT_EQ(s.of(over), (DrawnAmount{{.scene = kPixels / 2 + kPixels}, 12}));
}

TEST(TouchedPixels, OfCopiesAreTexelsWithTheirBorder) {
    TwoVolumes s;
    s.plan.textureWidth = kWidth, s.plan.textureHeight = kHeight;
    const Pass copy{.kind = PassKind::Copy, .texture = MaskTexture::Rgb};
    EXPECT_EQ(s.of(copy), (DrawnAmount{{.copy = kPixels}, 0}));
    s.plan.textureHeight = 64;
    EXPECT_EQ(s.of(copy).pixels.copy, kPixels + kWidth);
    s.plan.frameTextureWidth = s.plan.frameTextureHeight = 256;
    Pass frame = copy;
    frame.frameTexture = true;
    EXPECT_EQ(s.of(frame).pixels.copy, (kWidth + 1) * (kHeight + 1));
}

TEST(TouchedPixels, OfADepthMapAreOfItsFaces) {
    TwoVolumes s;
    s.plan.mapSize = 16;
    s.light.depthMap.faces = {{}, quad({0, 0, kWidth, kHeight}, true)};
    const Pass clear{.clearsDepth = true, .write = kWriteNothing, .target = Target::DepthMap, .mapFace = 1};
    EXPECT_EQ(s.of(clear).pixels.clear, 256);
    const Pass face{
        .kind = PassKind::Scene, .write = kWriteNothing, .target = Target::DepthMap, .mapFace = 1};
    EXPECT_EQ(s.of(face), (DrawnAmount{{.scene = 256}, 6}));
}

TEST(TouchedPixels, OfBlockersAreOnePixelForEach) {
    TwoVolumes s;
    for (int i = 0; i < 3; ++i)
        for (const glm::vec4& p : quad({0, 0, kWidth, kHeight})) s.light.blockers.push_back(p);
    Pass pass = volumePass(Faces::Both);
    pass.drawn = Drawn::Blockers;
    pass.target = Target::OnePixel;
    EXPECT_EQ(s.of(pass), (DrawnAmount{{.volume = 3}, 18}));
}

TEST(TouchedPixels, OfAGeometryShaderAreThoseOfTheSidesIfTheyAreGiven) {
    TwoVolumes s;
    s.light.silhouettes.indices.resize(30);
    Pass pass = volumePass(Faces::Both, {});
    pass.drawn = Drawn::Silhouettes;
    EXPECT_EQ(s.of(pass), (DrawnAmount{{.volume = 600}, 30}));
    s.light.volumes.reset();
    EXPECT_EQ(s.of(pass), (DrawnAmount{{}, 30}));
}

/// What is measured once is not counted once.
TEST(TouchedPixels, OfAPlanAreTheSumOfItsPasses) {
    TwoVolumes s;
    s.plan.passes = {volumePass(Faces::Front), volumePass(Faces::Front), volumePass(Faces::Both)};
    const auto lights = [&](int) -> const LightFrame& { return s.light; };
    EXPECT_EQ(touchedPixels(s.plan, s.surfaces, lights), (TouchedPixels{.volume = 400 + 400 + 600}));
    const auto each = drawnAmounts(s.plan, s.surfaces, lights);
    ASSERT_EQ(each.size(), 3u);
    EXPECT_EQ(each[2].pixels.volume, 600);
}

/// The renderer and this know nothing of each other.
TEST(DrawnVertices, AreThoseThatTheRendererSends) {
    const Scene scene = twoBoxes();
    const Frame frame = frameOf(scene, kWidth, kHeight);
    const Profile ideal = chip("ideal");
    Surface surface(bufferFormatOf(ideal), kWidth, kHeight, arithmeticOf(ideal, {}));
    for (const NamedMethod& method : namedMethods()) {
        const Plan plan =
            planFrame(method.axes, shapeOf(int(frame.volumes().size()), kWidth, kHeight), ideal);
        if (!missing(ideal, plan).empty()) continue;
        const Rendered drawn = render(surface, ideal, plan, frame.surfaces, frame.lights());
        EXPECT_EQ(drawnAmount(plan, frame.surfaces, frame.lights()).vertices, drawn.counts.vertices)
            << method.id;
    }
}

TEST(TouchedPixels, OfAFrameAreInNoRectangleMoreThanInTheWhole) {
    const Frame frame = frameOf(twoBoxes(), kWidth, kHeight);
    Plan plan = planFrame({}, shapeOf(int(frame.volumes().size()), kWidth, kHeight), chip("ideal"));
    const std::int64_t whole = touchedPixels(plan, frame.surfaces, frame.lights()).volume;
    std::int64_t parts = 0;
    for (const WindowRect& rect : {WindowRect{0, 0, 20, kHeight}, WindowRect{20, 0, kWidth - 20, 17},
                                   WindowRect{20, 17, kWidth - 20, kHeight - 17}}) {
        plan.windows = {{.all = rect, .volumes = std::vector(frame.volumes().size(), rect)}};
        for (Pass& pass : plan.passes)
            if (pass.kind == PassKind::Volume) pass.extent = Extent::Volumes;
        parts += touchedPixels(plan, frame.surfaces, frame.lights()).volume;
    }
    EXPECT_GT(whole, 0);
    EXPECT_EQ(parts, whole) << "rectangles that fill the window";
}

}  // namespace touched_test
}  // namespace gnomon
