// Faults planted in all that makes a mask and all that judges it: volumes, OpenGL calls, the chip's
// arithmetic, the predictor, the read-out. Each must be told from a frame without it: by pixels that hold
// what is not predicted, or, where the plan itself is at fault and the prediction follows it, by the right
// cause.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "fault_rig.h"
#include "fault_scenes.h"

namespace gnomon {
namespace {

Axes method(const std::string& id) {
    return findMethod(id)->axes;
}

const SetUp kCarmack{.scene = twoBoxes, .axes = method("carmack")};
const SetUp kCarmackInBooks{.scene = twoBooks, .axes = method("carmack")};
const SetUp kCarmackBeforeLight{.scene = boxesBeforeTheLight, .axes = method("carmack")};
const SetUp kHeidmannInSky{.scene = boxesBeforeTheSky, .axes = method("heidmann")};
const SetUp kHeidmann{.scene = twoBoxes, .axes = method("heidmann")};
const SetUp kHeidmannInSun{.scene = twoBoxesInTheSun, .axes = method("heidmann")};
const SetUp kHeidmannInBooks{.scene = twoBooks, .axes = method("heidmann")};
const SetUp kOneSided{.scene = twoBoxes, .profile = "tnt", .axes = method("heidmann")};
const SetUp kNearCapped{.scene = underASlab,
                        .axes = {.store = Store::Stencil, .count = gnomon::Count::ZpassCap}};
const SetUp kParity{.scene = twoBoxes, .axes = method("parity")};
const SetUp kScreen{.scene = twoBoxes, .axes = method("roettger-screen")};
const SetUp kScreenInBooks{.scene = twoBooks, .axes = method("roettger-screen"), .known = "mask clamps"};
const SetUp kScreenMax{.scene = twoBoxes, .axes = method("roettger-screen-max")};
const SetUp kScreenOfEightLevels{
    .scene = twoBoxes, .axes = {.store = Store::Screen, .arithmetic = Arithmetic::Double, .levels = 8}};
const SetUp kAlpha{.scene = twoBoxes, .axes = method("roettger-alpha")};

/// A set-up at the chip's own arithmetic.
SetUp onChip(const std::string& profile, const std::string& id, Scene (*scene)(), bool dithers = false,
             const std::string& known = "right") {
    return {.scene = scene,
            .profile = profile,
            .axes = method(id),
            .fidelity = {.fidelity = Fidelity::Chip, .dithers = dithers},
            .known = known};
}

/// A fault in what is drawn, or in what the predictor believes of it.
struct Fault {
    std::string name{};
    SetUp setUp{};
    std::function<void(FaultRig&)> plant{};
    int pixels = 0;  ///< that are not predicted; 0: any number but 0
};

/// Of a number of pixels that are not predicted.
testing::Matcher<int> isExpected(int pixels) {
    if (pixels > 0) return testing::Eq(pixels);
    return testing::Gt(0);
}

std::string nameOf(const testing::TestParamInfo<Fault>& test) {
    return test.param.name;
}
void PrintTo(const Fault& fault, std::ostream* out) {
    *out << fault.name;
}

// ---- Volumes ----

using Runs = FrameVolumes::Runs;

Runs& runsOf(FaultRig& rig, Part part) {
    return rig.volumes.parts[std::size_t(part)];
}

/// Leaves out vertices [first, last).
void drop(Runs& runs, std::size_t first, std::size_t last) {
    runs.vertices.erase(runs.vertices.begin() + std::ptrdiff_t(first),
                        runs.vertices.begin() + std::ptrdiff_t(last));
    for (std::size_t& begin : runs.begins)
        if (begin > first) begin -= std::min(begin, last) - first;
}

void dropAll(FaultRig& rig, Part part) {
    drop(runsOf(rig, part), 0, runsOf(rig, part).vertices.size());
}

void flip(Runs& runs, std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; v += 3) std::swap(runs.vertices[v + 1], runs.vertices[v + 2]);
}

glm::dvec2 onWindow(const glm::vec4& v) {
    return glm::dvec2(v.x, v.y) / double(std::max(v.w, 1e-6f));
}

/// The first vertex of the triangle that covers most of the window.
std::size_t largest(const Runs& runs) {
    const auto area = [&](std::size_t v) {
        const glm::dvec2 a = onWindow(runs.vertices[v]), b = onWindow(runs.vertices[v + 1]) - a,
                         c = onWindow(runs.vertices[v + 2]) - a;
        return std::abs(b.x * c.y - b.y * c.x);
    };
    std::size_t best = 0;
    for (std::size_t v = 3; v < runs.vertices.size(); v += 3)
        if (area(v) > area(best)) best = v;
    return best;
}

/// The volumes anew, of casters that @p change has changed.
std::function<void(FaultRig&)> rebuilt(const std::function<void(std::vector<LitCaster>&)>& change) {
    return [change](FaultRig& rig) {
        std::vector<LitCaster> lit = rig.lit;
        change(lit);
        rig.volumes = rig.built(lit, rig.light());
    };
}

/// The last caster's side that hangs nearest to the eye, so that its shadow is seen.
std::size_t nearestSide(const FaultRig& rig) {
    const LitCaster& caster = rig.lit.back();
    const auto& positions = rig.scene.objects[caster.object].mesh.positions;
    const auto distance = [&](const Side& side) {
        return glm::distance(glm::dvec3(positions[side.from] + positions[side.to]) / 2.0, rig.view.eye);
    };
    const auto nearest =
        std::min_element(caster.sides.begin(), caster.sides.end(),
                         [&](const Side& a, const Side& b) { return distance(a) < distance(b); });
    return std::size_t(nearest - caster.sides.begin());
}

/// Moves clip coordinates to the right by @p pixels.
glm::vec4 movedRight(glm::vec4 v, double pixels) {
    v.x += float(2 * pixels / FaultRig::kWidth) * v.w;
    return v;
}

std::vector<Fault> volumeFaults() {
    const auto sides = [](auto&& change) {
        return [change](FaultRig& rig) {
            rebuilt([&](std::vector<LitCaster>& lit) { change(lit.back().sides, nearestSide(rig)); })(rig);
        };
    };
    return {
        {"AllFarCapsDropped", kCarmackBeforeLight, [](FaultRig& rig) { dropAll(rig, Part::FarCap); }},
        {"AllFarCapsDroppedFromTheSky", kHeidmannInSky, [](FaultRig& rig) { dropAll(rig, Part::FarCap); }},
        {"FarCapOfOneVolumeDropped", kCarmackBeforeLight,
         [](FaultRig& rig) {
             Runs& runs = runsOf(rig, Part::FarCap);
             drop(runs, runs.begins[1], runs.begins[2]);
         }},
        {"FarCapsFlipped", kCarmackBeforeLight,
         [](FaultRig& rig) {
             Runs& runs = runsOf(rig, Part::FarCap);
             flip(runs, 0, runs.vertices.size());
         }},
        {"OneSideDropped", kHeidmann, sides([](std::vector<Side>& all, std::size_t one) {
             all.erase(all.begin() + std::ptrdiff_t(one));
         })},
        {"OneSideDoubled", kHeidmann,
         sides([](std::vector<Side>& all, std::size_t one) { all[one].weight = 2; })},
        {"OneSideFlipped", kHeidmann,
         sides([](std::vector<Side>& all, std::size_t one) { std::swap(all[one].from, all[one].to); })},
        {"OneSideFlippedInTheSun", kHeidmannInSun,
         sides([](std::vector<Side>& all, std::size_t one) { std::swap(all[one].from, all[one].to); })},
        {"HeavySideDrawnOnce", kHeidmannInBooks, sides([](std::vector<Side>& all, std::size_t) {
             for (Side& side : all) side.weight = 1;
         })},
        {"OneTriangleOfASideDropped", kHeidmann,
         [](FaultRig& rig) {
             Runs& runs = runsOf(rig, Part::Sides);
             const std::size_t first = largest(runs);
             drop(runs, first, first + 3);
         }},
        {"OneTriangleOfASideDroppedForDoubling", kScreen,
         [](FaultRig& rig) {
             Runs& runs = runsOf(rig, Part::Sides);
             const std::size_t first = largest(runs);
             drop(runs, first, first + 3);
         }},
        {"AllSidesFlipped", kHeidmann,
         [](FaultRig& rig) {
             Runs& runs = runsOf(rig, Part::Sides);
             flip(runs, 0, runs.vertices.size());
         }},
        {"NearCapMissingWithTheEyeInside", kNearCapped, [](FaultRig& rig) { dropAll(rig, Part::NearCap); }},
        {"LightCapsMissing", kCarmack, [](FaultRig& rig) { dropAll(rig, Part::LightCap); }},
        {"OneLightCapFlipped", kCarmack,
         [](FaultRig& rig) {
             Runs& runs = runsOf(rig, Part::LightCap);
             const std::size_t first = largest(runs);
             flip(runs, first, first + 3);
         }},
        {"OneLightCapDropped", kCarmackInBooks,
         [](FaultRig& rig) {
             Runs& runs = runsOf(rig, Part::LightCap);
             const std::size_t first = largest(runs);
             drop(runs, first, first + 3);
         }},
        {"VolumeLeftOutWithItsNumber", kScreen,
         [](FaultRig& rig) {
             rig.volumes = rig.built({rig.lit[0]}, rig.light());
             rig.plan = rig.planned(rig.axes);
         }},
        {"VolumeLeftOutWithoutItsNumber", kScreen,
         [](FaultRig& rig) {
             for (Runs& runs : rig.volumes.parts) drop(runs, runs.begins[1], runs.begins[2]);
         }},
        {"VolumesInAnotherOrder", kScreenInBooks,
         [](FaultRig& rig) {
             const std::vector<std::uint32_t> ordinals = rig.volumes.ordinals;
             rig.volumes = rig.built({rig.lit[1], rig.lit[0]}, rig.light());
             rig.volumes.ordinals = ordinals;
         }},
        {"OneVertexMovedByAPixel", kHeidmann,
         [](FaultRig& rig) {
             Runs& runs = runsOf(rig, Part::Sides);
             glm::vec4& v = runs.vertices[largest(runs)];
             v = movedRight(v, 1);
         }},
        {"AllVerticesMovedByAPixel", kHeidmann,
         [](FaultRig& rig) {
             for (Runs& runs : rig.volumes.parts)
                 for (glm::vec4& v : runs.vertices) v = movedRight(v, 1);
         }},
        {"AllVerticesMovedByHalfAPixelForDoubling", kScreen,
         [](FaultRig& rig) {
             for (Runs& runs : rig.volumes.parts)
                 for (glm::vec4& v : runs.vertices) v = movedRight(v, 0.5);
         }},
        {"FarVerticesNotAtInfinity", kCarmackBeforeLight,
         [](FaultRig& rig) {
             // All that lies at infinity comes as near as the boxes are.
             for (const Part part : {Part::Sides, Part::FarCap})
                 for (glm::vec4& v : runsOf(rig, part).vertices)
                     if (v.z == v.w) v.z = float(windowDepth(rig.view, 6) * 2 - 1) * v.w;
         }},
        {"SidesFromTheWrongLight", kHeidmann,
         [](FaultRig& rig) { rig.volumes = rig.built(rig.lit, rig.light() + glm::vec4(0.7f, 0, 0, 0)); }},
        {"SidesStartBehindTheirCaster", kCarmack,
         [](FaultRig& rig) {
             CutStyle style;
             style.offset = 0.3f;
             rig.volumes =
                 frameVolumes(rig.scene, rig.lit, rig.light(), rig.view, partsOf(rig.axes.count), style);
         }},
    };
}

// ---- OpenGL calls ----

std::function<void(FaultRig&)> inCalls(const std::function<void(GlTable&)>& fault) {
    return [fault](FaultRig& rig) {
        rig.surface.decorate([&](GlTable gl) {
            fault(gl);
            return gl;
        });
    };
}

/// Calls that take one word, with another for it.
std::function<void(GLenum)> replaced(std::function<void(GLenum)> call, GLenum word, GLenum by) {
    return [=](GLenum given) { call(given == word ? by : given); };
}

/// Stencil operations with another for one of them.
void replaceStencilOp(GlTable& gl, GLenum word, GLenum by) {
    const auto other = [=](GLenum op) { return op == word ? by : op; };
    gl.StencilOp = [=, call = gl.StencilOp](GLenum s, GLenum d, GLenum p) {
        call(other(s), other(d), other(p));
    };
    gl.StencilOpSeparate = [=, call = gl.StencilOpSeparate](GLenum face, GLenum s, GLenum d, GLenum p) {
        call(face, other(s), other(d), other(p));
    };
}

/// Volumes leave the pixel at (x, y) out, y up: they are drawn around it, in four rectangles.
void makeHole(GlTable& gl, int x, int y) {
    const auto writesDepth = std::make_shared<bool>(true);
    gl.DepthMask = [writesDepth, call = gl.DepthMask](GLboolean on) { call(*writesDepth = on); };
    gl.DrawArrays = [=, enable = gl.Enable, disable = gl.Disable, call = gl.DrawArrays](
                        GLenum mode, GLint first, GLsizei count) {
        if (*writesDepth || mode != GL_TRIANGLES) return call(mode, first, count);
        const int width = FaultRig::kWidth, height = FaultRig::kHeight;
        enable(GL_SCISSOR_TEST);
        for (const glm::ivec4& r : {glm::ivec4(0, 0, width, y), glm::ivec4(0, y + 1, width, height - y - 1),
                                    glm::ivec4(0, y, x, 1), glm::ivec4(x + 1, y, width - x - 1, 1)}) {
            // The driver's own: no table has it, since nothing but this fault cuts a draw.
            glScissor(r.x, r.y, r.z, r.w);
            call(mode, first, count);
        }
        disable(GL_SCISSOR_TEST);
    };
}

std::vector<Fault> callFaults() {
    const auto hole = [](FaultRig& rig) {
        const int p = int(rig.shadowPixel());
        inCalls([=](GlTable& gl) {
            makeHole(gl, p % FaultRig::kWidth, FaultRig::kHeight - 1 - p / FaultRig::kWidth);
        })(rig);
    };
    const auto losesLast = inCalls([](GlTable& gl) {
        gl.DrawArrays = [call = gl.DrawArrays](GLenum mode, GLint first, GLsizei count) {
            call(mode, first, mode == GL_TRIANGLES ? std::max(0, count - 3) : count);
        };
    });
    const auto shifted = inCalls([](GlTable& gl) {
        gl.Viewport = [call = gl.Viewport](GLint x, GLint y, GLsizei w, GLsizei h) { call(x + 1, y, w, h); };
    });
    return {
        {"DepthLequalIsLess", kHeidmannInSky,
         inCalls([](GlTable& gl) { gl.DepthFunc = replaced(gl.DepthFunc, GL_LEQUAL, GL_LESS); })},
        {"DepthLessIsLequal", kCarmack,
         inCalls([](GlTable& gl) { gl.DepthFunc = replaced(gl.DepthFunc, GL_LESS, GL_LEQUAL); })},
        {"DepthIsAlways", kHeidmann,
         inCalls([](GlTable& gl) { gl.DepthFunc = replaced(gl.DepthFunc, GL_LEQUAL, GL_ALWAYS); })},
        {"CullFaceIgnored", kOneSided, inCalls([](GlTable& gl) { gl.CullFace = [](GLenum) {}; })},
        {"CullingNotEnabled", kScreen, inCalls([](GlTable& gl) {
             gl.Enable = [call = gl.Enable](GLenum what) {
                 if (what != GL_CULL_FACE) call(what);
             };
         })},
        {"IncrementSaturates", kHeidmann,
         inCalls([](GlTable& gl) { replaceStencilOp(gl, GL_INCR_WRAP, GL_INCR); })},
        {"DecrementIsZero", kHeidmann,
         inCalls([](GlTable& gl) { replaceStencilOp(gl, GL_DECR_WRAP, GL_ZERO); })},
        {"DecrementIsKept", kCarmack,
         inCalls([](GlTable& gl) { replaceStencilOp(gl, GL_DECR_WRAP, GL_KEEP); })},
        {"FrontAndBackStencilExchanged", kHeidmann, inCalls([](GlTable& gl) {
             gl.StencilOpSeparate = [call = gl.StencilOpSeparate](GLenum face, GLenum s, GLenum d, GLenum p) {
                 call(face == GL_FRONT ? GL_BACK : GL_FRONT, s, d, p);
             };
         })},
        {"DepthFailAndPassExchanged", kHeidmann, inCalls([](GlTable& gl) {
             gl.StencilOpSeparate = [call = gl.StencilOpSeparate](GLenum face, GLenum s, GLenum d, GLenum p) {
                 call(face, s, p, d);
             };
         })},
        {"StencilMaskIgnored", kParity, inCalls([](GlTable& gl) { gl.StencilMask = [](GLuint) {}; })},
        {"StencilReferenceIgnored", kParity, inCalls([](GlTable& gl) {
             gl.StencilFunc = [call = gl.StencilFunc](GLenum f, GLint, GLuint mask) { call(f, 0, mask); };
         })},
        {"ClearLeavesTheStencil", kHeidmann, inCalls([](GlTable& gl) {
             gl.Clear = [call = gl.Clear](GLbitfield bits) {
                 call(bits & ~GLbitfield(GL_STENCIL_BUFFER_BIT));
             };
         })},
        {"BlendFactorsExchanged", kScreen, inCalls([](GlTable& gl) {
             gl.BlendFunc = [call = gl.BlendFunc](GLenum s, GLenum d) { call(d, s); };
         })},
        {"BlendEquationIgnored", kScreenMax, inCalls([](GlTable& gl) { gl.BlendEquation = [](GLenum) {}; })},
        {"ColourMaskIgnoredByTheScreen", kScreen, inCalls([](GlTable& gl) {
             gl.ColorMask = [call = gl.ColorMask](GLboolean, GLboolean, GLboolean, GLboolean) {
                 call(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
             };
         })},
        {"ColourMaskIgnoredByAlpha", kAlpha, inCalls([](GlTable& gl) {
             gl.ColorMask = [call = gl.ColorMask](GLboolean, GLboolean, GLboolean, GLboolean) {
                 call(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
             };
         })},
        {"HalfIs127", kScreen, inCalls([](GlTable& gl) {
             gl.Color4f = [call = gl.Color4f](GLfloat r, GLfloat g, GLfloat b, GLfloat a) {
                 const auto half = [](GLfloat v) { return v > 0.4f && v < 0.6f ? 127 / 255.0f : v; };
                 call(half(r), half(g), half(b), half(a));
             };
         })},
        {"ViewportShiftedByAPixel", kHeidmann, shifted},
        {"VolumesWriteDepth", kHeidmann,
         inCalls([](GlTable& gl) { gl.DepthMask = [call = gl.DepthMask](GLboolean) { call(GL_TRUE); }; })},
        {"DrawLosesItsLastTriangle", kHeidmann, losesLast},
        {"DrawLosesItsLastTriangleForDoubling", kScreen, losesLast},
        {"HoleOfOnePixel", kHeidmann, hole, 1},
        {"HoleOfOnePixelForDoubling", kScreen, hole, 1},
        {"HoleOfOnePixelBehindTheSurface", kCarmack, hole, 1},
    };
}

// ---- Arithmetic: the surface computes otherwise than the predictor believes ----

std::function<void(FaultRig&)> believingUnit(BlendUnit unit) {
    return [=](FaultRig& rig) { rig.arithmetic.unit = unit; };
}
std::function<void(FaultRig&)> believingDither(DitherMode mode) {
    return [=](FaultRig& rig) { rig.arithmetic.undithered = mode; };
}

std::vector<Fault> arithmeticFaults() {
    const auto voodoo = [](bool dithers) { return onChip("voodoo2", "roettger-screen", twoBoxes, dithers); };
    const auto inBooks = [](const std::string& profile, const std::string& id,
                            const std::string& known = "mask clamps") {
        return onChip(profile, id, twoBooks, false, known);
    };
    const SetUp geforce565 = onChip("geforce2mx-565", "roettger-screen", twoBoxes);
    return {
        {"CutForRounded", inBooks("ideal", "roettger-screen"), believingUnit(BlendUnit::IdealFloor)},
        {"CutForRoundedFromOneDown", onChip("ideal", "roettger-screen-max", twoBoxes),
         believingUnit(BlendUnit::IdealFloor)},
        {"RoundedForCutHalves", inBooks("ps2", "screen-texture"), believingUnit(BlendUnit::IdealRound)},
        {"RoundedForCutSteps", inBooks("ps2-5551", "screen-count", "right"),
         believingUnit(BlendUnit::IdealRound)},
        {"CodesThatRepeatForLowBitsOfZero", geforce565, believingUnit(BlendUnit::ProductsRound)},
        {"LowBitsOfZeroForCodesThatRepeat", voodoo(false), believingUnit(BlendUnit::Nv2a)},
        {"OneOf255For256", onChip("dreamcast", "roettger-alpha", twoBoxes),
         believingUnit(BlendUnit::IdealRound)},
        {"SumsThatWrapForThoseThatClamp", onChip("ps2", "screen-texture", twoBoxes),
         believingUnit(BlendUnit::GsWrap)},
        {"OpenGlForTheChip", geforce565, [](FaultRig& rig) { rig.arithmetic.fidelity = Fidelity::Gl; }},
        {"DitherOnForOff", voodoo(false), believingDither(DitherMode::Matrix4x4)},
        {"DitherOffForOn", voodoo(true), believingDither(DitherMode::Off)},
        {"AnotherDitherMatrix", voodoo(true), believingDither(DitherMode::Matrix2x2Subtract)},
        {"DitherWithoutSubtraction", voodoo(true), believingDither(DitherMode::Matrix4x4)},
        {"SixBitsForFive", voodoo(false), [](FaultRig& rig) { rig.format.red = 6; }},
        {"SevenBitsForEight", kScreenOfEightLevels, [](FaultRig& rig) { rig.format.red = 7; }},
    };
}

// ---- Read-out ----

std::function<void(FaultRig&)> reading(const std::function<void(Rendered&, std::size_t deep)>& change) {
    return [=](FaultRig& rig) {
        rig.readOut = [=, deep = rig.shadowPixel()](Rendered& rendered) { change(rendered, deep); };
    };
}

std::vector<Fault> readOutFaults() {
    const auto shift = [](std::ptrdiff_t by) {
        return reading([=](Rendered& rendered, std::size_t) {
            auto& values = rendered.values[0];
            auto& shadow = rendered.masks[0];
            std::rotate(values.begin(), values.begin() + by, values.end());
            std::rotate(shadow.begin(), shadow.begin() + by, shadow.end());
        });
    };
    const auto flipOne = reading([](Rendered& rendered, std::size_t deep) {
        rendered.values[0][deep] = 0;
        rendered.masks[0][deep] = false;
    });
    return {
        {"MaskShiftedByAPixel", kHeidmann, shift(1)},
        {"MaskShiftedByARow", kHeidmann, shift(FaultRig::kWidth)},
        {"RowsFromTheBottom", kHeidmann, reading([](Rendered& rendered, std::size_t) {
             auto& values = rendered.values[0];
             for (int y = 0; y < FaultRig::kHeight / 2; ++y)
                 std::swap_ranges(values.begin() + y * FaultRig::kWidth,
                                  values.begin() + (y + 1) * FaultRig::kWidth,
                                  values.end() - (y + 1) * FaultRig::kWidth);
         })},
        {"OnePixelFlipped", kHeidmann, flipOne, 1},
        {"OnePixelOneTooMany", kHeidmann,
         reading([](Rendered& rendered, std::size_t deep) { ++rendered.values[0][deep]; }), 1},
        {"OnePixelOneCodeTooMany", kScreen,
         reading([](Rendered& rendered, std::size_t deep) { ++rendered.values[0][deep]; }), 1},
    };
}

class PlantedFault : public testing::TestWithParam<Fault> {};

TEST_P(PlantedFault, IsNotPredicted) {
    const Fault& fault = GetParam();
    FaultRig rig(fault.setUp);
    const Verified right = rig.draw();
    ASSERT_EQ(right.text(), fault.setUp.known) << "without a fault";
    fault.plant(rig);
    const Verified faulty = rig.draw();
    EXPECT_THAT(faulty.unpredicted, isExpected(fault.pixels));
    // Near borders the prediction allows more than one value, which hides some; 96 of 100 were seen at least.
    EXPECT_GE(10 * faulty.unpredicted, 9 * faulty.differentFrom(right));
}

INSTANTIATE_TEST_SUITE_P(Volumes, PlantedFault, testing::ValuesIn(volumeFaults()), nameOf);
INSTANTIATE_TEST_SUITE_P(Calls, PlantedFault, testing::ValuesIn(callFaults()), nameOf);
INSTANTIATE_TEST_SUITE_P(Arithmetic, PlantedFault, testing::ValuesIn(arithmeticFaults()), nameOf);
INSTANTIATE_TEST_SUITE_P(ReadOut, PlantedFault, testing::ValuesIn(readOutFaults()), nameOf);

// ---- The predictor: a frame without a fault, a belief with one ----

struct FalseBelief {
    std::string name{};
    SetUp setUp{};
    std::function<void(Belief&, const FaultRig&)> falsify{};
    int pixels = 0;  ///< as Fault::pixels
};
void PrintTo(const FalseBelief& belief, std::ostream* out) {
    *out << belief.name;
}

/// Changes every crossing of every ray.
std::function<void(Belief&, const FaultRig&)> inCrossings(const std::function<void(Crossing&)>& change) {
    return [=](Belief& belief, const FaultRig&) {
        for (Signature& signature : belief.crossings.signatures) {
            for (Crossing& c : signature) change(c);
            std::sort(signature.begin(), signature.end());
        }
    };
}

/// Changes what the ray of one pixel deep in a shadow crosses, and of no other.
std::function<void(Belief&, const FaultRig&)> inOneRay(const std::function<void(Signature&)>& change) {
    return [=](Belief& belief, const FaultRig& rig) {
        const std::size_t deep = rig.shadowPixel();
        Crossings& all = belief.crossings;
        Signature signature = all.signatures[all.exact[deep]];
        change(signature);
        std::sort(signature.begin(), signature.end());
        all.exact[deep] = std::uint32_t(all.signatures.size());
        all.signatures.push_back(signature);
    };
}

std::uint8_t exchanged(std::uint8_t where) {
    return std::uint8_t((where & (kAt | kMaybeAbsent)) | (where & kBefore ? kBehind : 0) |
                        (where & kBehind ? kBefore : 0));
}

std::vector<FalseBelief> falseBeliefs() {
    const auto isSureEntry = [](const Crossing& c) {
        return c.piece == Piece::Side && c.front && c.exact == kBefore && c.isSure();
    };
    const auto dropEntry = [=](Signature& signature) {
        signature.erase(std::find_if(signature.begin(), signature.end(), isSureEntry));
    };
    return {
        {"CrossingDropped", kHeidmann, inOneRay(dropEntry), 1},
        {"EntriesDroppedOfADoubledMask", kScreen, inOneRay([](Signature& signature) {
             std::erase_if(signature, [](const Crossing& c) { return c.front; });
         }),
         1},
        {"CrossingFoundTwice", kHeidmann, inOneRay([=](Signature& signature) {
             signature.push_back(*std::find_if(signature.begin(), signature.end(), isSureEntry));
         }),
         1},
        {"NothingIsCrossedInOnePixel", kHeidmann, inOneRay([](Signature& signature) { signature.clear(); }),
         1},
        {"FrontAndBackExchanged", kHeidmann, inCrossings([](Crossing& c) { c.front = !c.front; })},
        {"FrontAndBackExchangedForDoubling", kScreen, inCrossings([](Crossing& c) { c.front = !c.front; })},
        {"FrontAndBackExchangedInOneRay", kHeidmann, inOneRay([=](Signature& signature) {
             std::find_if(signature.begin(), signature.end(), isSureEntry)->front = false;
         }),
         1},
        {"BeforeAndBehindExchanged", kHeidmann,
         inCrossings([](Crossing& c) { c.exact = exchanged(c.exact), c.possible = exchanged(c.possible); })},
        {"BeforeAndBehindExchangedFromInfinity", kCarmack,
         inCrossings([](Crossing& c) { c.exact = exchanged(c.exact), c.possible = exchanged(c.possible); })},
        {"FarCapsBehindTheSky", kHeidmannInSky, inCrossings([](Crossing& c) {
             if (c.piece == Piece::FarCap) c.exact = c.possible = kBehind;
         })},
        {"FarCapsForgotten", kCarmackBeforeLight, inCrossings([](Crossing& c) {
             if (c.piece == Piece::FarCap) c.exact = kAbsent, c.possible = kMaybeAbsent;
         })},
        {"NearCapsForgotten", kNearCapped, inCrossings([](Crossing& c) {
             if (c.piece == Piece::NearCap) c.exact = kAbsent, c.possible = kMaybeAbsent;
         })},
        {"LightCapsForgotten", kCarmack, inCrossings([](Crossing& c) {
             if (c.piece == Piece::LightCap) c.exact = kAbsent, c.possible = kMaybeAbsent;
         })},
        {"VolumesExchanged", kScreenInBooks,
         [](Belief& belief, const FaultRig&) { std::swap(belief.planVolumes[0], belief.planVolumes[1]); }},
        {"OneVolumeForAll", kScreenInBooks, inCrossings([](Crossing& c) { c.volume = 0; })},
        {"VolumeTakenForUndrawn", kScreen,
         [](Belief& belief, const FaultRig&) { belief.planVolumes[1] = -1; }},
        {"ImageShiftedByAPixel", kHeidmann,
         [](Belief& belief, const FaultRig&) {
             auto& exact = belief.crossings.exact;
             std::rotate(exact.begin(), exact.begin() + 1, exact.end());
         }},
        {"ImageShiftedByARow", kScreen,
         [](Belief& belief, const FaultRig&) {
             auto& exact = belief.crossings.exact;
             std::rotate(exact.begin(), exact.begin() + FaultRig::kWidth, exact.end());
         }},
        {"CountStartsAtOne", kHeidmann,
         [](Belief& belief, const FaultRig&) { belief.plan.passes[0].stencilValue = 1; }},
        {"MaskStartsAtAHalf", kScreen,
         [](Belief& belief, const FaultRig&) { belief.plan.passes[0].colour = glm::vec4(0.5f); }},
        {"EyeHeldByOneMore",
         {.scene = underASlab, .axes = {.store = Store::Stencil, .count = gnomon::Count::PlusPlusZp}},
         [](Belief& belief, const FaultRig&) { ++belief.holdingEye; }},
        {"HalfOf127", kScreen,
         [](Belief& belief, const FaultRig&) {
             for (Pass& pass : belief.plan.passes)
                 if (pass.colour == glm::vec4(128 / 255.0f)) pass.colour = glm::vec4(127 / 255.0f);
         }},
        {"CapacityOfOneBitLess", kScreenOfEightLevels,
         [](Belief& belief, const FaultRig&) { belief.arithmetic.format.red = 7; }},
        {"BacksNotCounted", kHeidmann,
         [](Belief& belief, const FaultRig&) {
             for (Pass& pass : belief.plan.passes)
                 if (pass.kind == PassKind::Volume) pass.stencil.back.onPass = StencilOp::Keep;
         }},
        {"LastPassForgotten", kScreen,
         [](Belief& belief, const FaultRig&) {
             // The last that counts: nothing else halves.
             const auto isHalving = [](const Pass& pass) {
                 return pass.kind == PassKind::Volume && pass.faces == Faces::Back;
             };
             const auto last =
                 std::find_if(belief.plan.passes.rbegin(), belief.plan.passes.rend(), isHalving);
             last->faces = Faces::Front;
         }},
    };
}

class FalsePrediction : public testing::TestWithParam<FalseBelief> {};

TEST_P(FalsePrediction, IsNotWhatIsDrawn) {
    const FalseBelief& belief = GetParam();
    FaultRig rig(belief.setUp);
    ASSERT_EQ(rig.unpredictedBy({}), 0) << "without a fault";
    const int unpredicted = rig.unpredictedBy([&](Belief& falsified) { belief.falsify(falsified, rig); });
    EXPECT_THAT(unpredicted, isExpected(belief.pixels));
}

INSTANTIATE_TEST_SUITE_P(Predictor, FalsePrediction, testing::ValuesIn(falseBeliefs()),
                         [](const auto& test) { return test.param.name; });

// ---- Plans that can't be right: the prediction follows them, and names the cause ----

struct WrongPlan {
    std::string name{};
    SetUp setUp{};  ///< known: the cause
};
void PrintTo(const WrongPlan& plan, std::ostream* out) {
    *out << plan.name;
}

std::vector<WrongPlan> wrongPlans() {
    Axes odd = method("heidmann");
    odd.silhouette = Silhouette::Triangular;
    Axes once = method("roettger-screen");
    once.levels = 1;
    return {
        {"NoNearCapWithTheEyeInside",
         {.scene = underASlab, .axes = method("heidmann"), .known = "eye inside a volume"}},
        {"HeavySidesDrawnOnce",
         {.scene = twoBooks, .axes = odd, .known = "open or inconsistently wound caster"}},
        {"OneLevelForTwoFronts", {.scene = twoBooks, .axes = once, .known = "mask clamps"}},
        {"OneBitForOverlappingVolumes",
         {.scene = twoBoxes,
          .axes = {.store = Store::Screen, .arithmetic = Arithmetic::Parity, .levels = 0},
          .known = "parity of overlapping volumes"}},
        {"NoShadowsAtAll", {.scene = twoBoxes, .axes = method("none"), .known = "no shadow is drawn"}},
        {"VolumesBehindTheirCasters",
         {.scene = twoBoxes,
          .axes = {.store = Store::Stencil, .count = gnomon::Count::Zfail, .offset = 1.2f},
          .known = "volume begins behind its caster"}},
        {"HalfTheMask", {.scene = twoBoxes, .axes = method("roettger-half"), .known = "low mask resolution"}},
    };
}

class PlanAtFault : public testing::TestWithParam<WrongPlan> {};

TEST_P(PlanAtFault, IsGivenItsCause) {
    FaultRig rig(GetParam().setUp);
    const Verified drawn = rig.draw();
    EXPECT_EQ(drawn.text(), GetParam().setUp.known);
    EXPECT_GT(drawn.wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(Plans, PlanAtFault, testing::ValuesIn(wrongPlans()),
                         [](const auto& test) { return test.param.name; });

TEST(PlantedFaults, AreAtLeastThirtyAndInEveryPart) {
    EXPECT_GE(volumeFaults().size(), 12u);
    EXPECT_GE(callFaults().size(), 8u);
    EXPECT_GE(arithmeticFaults().size(), 6u);
    EXPECT_GE(falseBeliefs().size(), 6u);
    EXPECT_GE(volumeFaults().size() + callFaults().size() + arithmeticFaults().size() +
                  readOutFaults().size() + falseBeliefs().size() + wrongPlans().size(),
              30u);
}

}  // namespace
}  // namespace gnomon
