#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>

#include "plan/plan.h"

namespace gnomon {
namespace {

std::string upper(std::string word) {
    for (char& c : word) c = char(std::toupper(static_cast<unsigned char>(c)));
    return word;
}

std::string channels(const ColourWrite& w) {
    if (!w.any()) return "nothing";
    return fmt::format("{}{}{}{}", w.red ? "R" : "", w.green ? "G" : "", w.blue ? "B" : "",
                       w.alpha ? "A" : "");
}

std::string ops(const StencilSide& side) {
    return fmt::format("KEEP {} {}", upper(name(side.onDepthFail)), upper(name(side.onPass)));
}

std::string stencilState(const Stencil& s) {
    const std::string test =
        fmt::format("stencil {} {}{}{}{}, op ", upper(name(s.function)), s.reference,
                    s.minusBlockers ? " minus the atomic count" : "",
                    s.readMask == ~0u ? "" : fmt::format(" & {:#x}", s.readMask),
                    s.writeMask == ~0u ? "" : fmt::format(", write mask {:#x}", s.writeMask));
    if (s.front == s.back) return test + ops(s.front);
    return fmt::format("{}front {} back {}", test, ops(s.front), ops(s.back));
}

}  // namespace

namespace {

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
    return pass.texture == MaskTexture::Alpha       ? "alpha to ALPHA"
           : pass.texture == MaskTexture::Intensity ? "colour to INTENSITY"
                                                    : "colour to RGB";
}

const char* describeTarget(const Pass& pass) {
    return pass.target == Target::Mask       ? "mask's viewport"
           : pass.target == Target::DepthMap ? "depth map's viewport"
           : pass.target == Target::OnePixel ? "viewport 1x1"
                                             : nullptr;
}

}  // namespace

std::string describeState(const Pass& pass) {
    if (pass.kind == PassKind::Clear) return describeClear(pass);
    if (pass.kind == PassKind::Copy) return describeCopy(pass);
    std::vector<std::string> parts;
    const auto add = [&](const std::string& part) { parts.push_back(part); };
    if (const char* target = describeTarget(pass)) add(target);
    if (pass.depthTest)
        add(fmt::format("depth {}{}", upper(name(pass.depthFunction)), pass.depthWrite ? " write" : ""));
    if (pass.depthClamp) add("depth clamp");
    if (pass.stencil.enabled) add(stencilState(pass.stencil));
    if (pass.blend.enabled) {
        if (pass.blend.equation == BlendEquation::Min || pass.blend.equation == BlendEquation::Max)
            add("blend " + upper(name(pass.blend.equation)));
        else
            add(fmt::format("blend {} {}", upper(name(pass.blend.source)),
                            upper(name(pass.blend.destination))));
    }
    if (pass.program == Program::CountFaces)
        add(fmt::format("program: 16 bits of RG, front {:+d} back {:+d}", pass.frontCount, -pass.frontCount));
    if (pass.program == Program::ShadeCount) add("program: by the 16 bits of RG");
    if (pass.drawn == Drawn::Silhouettes) add("geometry shader with an atomic counter");
    if (pass.shading == Shading::Mask) add("depth map compared");
    if (pass.texture != MaskTexture::None) add(pass.frameTexture ? "frame texture" : "mask texture");
    if (pass.write.any() && pass.kind != PassKind::Scene && pass.texture == MaskTexture::None &&
        pass.program == Program::None)
        add(pass.write.red ? fmt::format("colour {:.3g}", pass.colour.r)
                           : fmt::format("alpha {:.3g}", pass.colour.a));
    add("write " + channels(pass.write));
    return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace gnomon
