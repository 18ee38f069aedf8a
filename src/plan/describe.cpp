#include <fmt/format.h>
#include <fmt/ranges.h>

#include "plan/plan.h"
#include "profile/words.h"

namespace gnomon {
namespace {

std::string channels(const ColourWrite& w) {
    if (!w.any()) return "nothing";
    return fmt::format("{}{}{}{}", w.red ? "R" : "", w.green ? "G" : "", w.blue ? "B" : "",
                       w.alpha ? "A" : "");
}

std::string ops(const StencilSide& side) {
    return fmt::format("KEEP {} {}", upperCase(name(side.onDepthFail)), upperCase(name(side.onPass)));
}

std::string stencilState(const Stencil& s) {
    const std::string test =
        fmt::format("stencil {} {}{}{}{}, op ", upperCase(name(s.function)), s.reference,
                    s.minusBlockers ? " minus the atomic count" : "",
                    s.readMask == ~0u ? "" : fmt::format(" & {:#x}", s.readMask),
                    s.writeMask == ~0u ? "" : fmt::format(", write mask {:#x}", s.writeMask));
    if (s.front == s.back) return test + ops(s.front);
    return fmt::format("{}front {} back {}", test, ops(s.front), ops(s.back));
}

bool isConstant(BlendFactor f) {
    return f == BlendFactor::ConstantColor || f == BlendFactor::OneMinusConstantColor ||
           f == BlendFactor::ConstantAlpha || f == BlendFactor::OneMinusConstantAlpha;
}

std::string blendState(const Blend& b) {
    const bool extreme = b.equation == BlendEquation::Min || b.equation == BlendEquation::Max;
    if (extreme) return "blend " + upperCase(name(b.equation));
    const std::string equation =
        b.equation == BlendEquation::Add ? "" : fmt::format("{} ", upperCase(name(b.equation)));
    const bool constant = isConstant(b.source) || isConstant(b.destination);
    return fmt::format("blend {}{} {}{}", equation, upperCase(name(b.source)), upperCase(name(b.destination)),
                       constant ? fmt::format(", constant {:.3g}", b.constant) : "");
}

/// The colour that a draw writes, once where its channels agree.
std::string sourceColour(const Pass& pass) {
    const glm::vec4& c = pass.colour;
    if (!pass.write.red) return fmt::format("alpha {:.3g}", c.a);
    if (c.r == c.g && c.g == c.b) return fmt::format("colour {:.3g}", c.r);
    return fmt::format("colour {:.3g} {:.3g} {:.3g}", c.r, c.g, c.b);
}

std::string describeClear(const Pass& pass) {
    std::vector<std::string> parts;
    const auto& c = pass.colour;
    if (pass.write.red)
        parts.push_back(pass.clearsToBackground ? "colour of the background"
                                                : fmt::format("colour {:.4g}", c.r));
    if (pass.write.alpha) parts.push_back(fmt::format("alpha {:.4g}", c.a));
    if (pass.clearsDepth) parts.push_back("depth 1");
    if (pass.stencilIsBlockers)
        parts.push_back("stencil to the count of one pixel");
    else if (pass.clearsStencil)
        parts.push_back(fmt::format(
            "stencil {}{}", pass.stencilValue,
            pass.stencil.writeMask == ~0u ? "" : fmt::format(" in mask {:#x}", pass.stencil.writeMask)));
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string describeCopy(const Pass& pass) {
    const char* to = pass.texture == MaskTexture::Alpha       ? "alpha to ALPHA"
                     : pass.texture == MaskTexture::Intensity ? "colour to INTENSITY"
                                                              : "colour to RGB";
    return fmt::format("{}{}", to, pass.nearest ? ", unfiltered" : "");
}

const char* describeTarget(const Pass& pass) {
    return pass.target == Target::Mask       ? "mask's viewport"
           : pass.target == Target::DepthMap ? "depth map's viewport"
           : pass.target == Target::OnePixel ? "viewport 1x1"
                                             : nullptr;
}

/// Nothing for a pass that is not bounded.
std::string describeScissor(const Pass& pass, std::span<const MaskWindow> windows) {
    if (pass.extent == Extent::Whole || pass.kind == PassKind::Copy) return "";
    const bool ofEach = pass.extent == Extent::Volumes && pass.volume == kAllVolumes;
    if (windows.empty()) return ofEach ? "scissor of each volume" : "scissor";
    const WindowRect part = *scissorOf(pass, windows);
    if (part.empty()) return "empty scissor";
    return fmt::format("scissor {}{},{} {}x{}", ofEach ? "of each volume within " : "", part.x, part.y,
                       part.width, part.height);
}

}  // namespace

std::string describeState(const Pass& pass, std::span<const MaskWindow> windows) {
    std::vector<std::string> parts;
    const auto add = [&](const std::string& part) { parts.push_back(part); };
    const std::string scissor = describeScissor(pass, windows);
    if (pass.kind == PassKind::Copy) return describeCopy(pass);
    if (pass.kind == PassKind::Clear)
        return scissor.empty() ? describeClear(pass) : fmt::format("{}, {}", scissor, describeClear(pass));
    if (const char* target = describeTarget(pass)) add(target);
    if (!scissor.empty()) add(scissor);
    if (pass.depthTest)
        add(fmt::format("depth {}{}", upperCase(name(pass.depthFunction)), pass.depthWrite ? " write" : ""));
    if (pass.depthClamp) add("depth clamp");
    if (pass.stencil.enabled) add(stencilState(pass.stencil));
    if (pass.alphaTest.enabled)
        add(fmt::format("alpha {} {:.3g}", upperCase(name(pass.alphaTest.function)),
                        pass.alphaTest.reference));
    if (pass.blend.enabled) add(blendState(pass.blend));
    if (pass.logicInvert) add("logic op INVERT");
    if (pass.program == Program::CountFaces)
        add(fmt::format("program: 16 bits of RG, front {:+d} back {:+d}", pass.frontCount, -pass.frontCount));
    if (pass.program == Program::ShadeCount) add("program: by the 16 bits of RG");
    if (pass.drawn == Drawn::Silhouettes)
        add(pass.countsBlockers ? "geometry shader with an atomic counter" : "geometry shader");
    if (pass.shading == Shading::Mask) add("depth map compared");
    if (pass.texture != MaskTexture::None) add(pass.frameTexture ? "frame texture" : "mask texture");
    // A texture of alpha leaves the colour to the draw.
    const bool colours =
        pass.texture == MaskTexture::None || (pass.texture == MaskTexture::Alpha && pass.alphaTest.enabled);
    if (pass.write.any() && pass.kind != PassKind::Scene && colours && pass.program == Program::None &&
        !pass.logicInvert)
        add(sourceColour(pass));
    add("write " + channels(pass.write));
    return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace gnomon
