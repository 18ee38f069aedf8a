// Faults planted in all that makes a mask: volumes, OpenGL calls, the chip's arithmetic, the read-out. Each
// must be told from a frame without it by pixels that hold what is not predicted. Those of the predictor:
// false_predictions_test.cpp.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "fault_set_ups.h"

namespace gnomon {
namespace planted_faults_test {

/// A fault in what is drawn.
struct Fault {
    std::string name{};
    SetUp setUp{};
    std::function<void(FaultRig&)> plant{};
    int pixels = 0;  ///< that are not predicted; 0: any number but 0
};
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

TEST(PlantedFaults, AreAtLeastThirtyAndInEveryPart) {
    EXPECT_GE(volumeFaults().size(), 12u);
    EXPECT_GE(callFaults().size(), 8u);
    EXPECT_GE(arithmeticFaults().size(), 6u);
    EXPECT_GE(readOutFaults().size(), 4u);
}

}  // namespace planted_faults_test
}  // namespace gnomon
