#include <fmt/format.h>

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
    const std::string test = fmt::format("stencil {} {}, op ", upper(name(s.function)), s.reference);
    if (s.front == s.back) return test + ops(s.front);
    return fmt::format("{}front {} back {}", test, ops(s.front), ops(s.back));
}

}  // namespace

std::string describeState(const Pass& pass) {
    const auto& c = pass.colour;
    if (pass.kind == PassKind::Clear) {
        std::string text;
        if (pass.write.red)
            text += pass.clearsToBackground ? "colour of the background" : fmt::format("colour {:.4g}", c.r);
        if (pass.write.alpha) text += fmt::format("{}alpha {:.4g}", text.empty() ? "" : ", ", c.a);
        return text + (pass.clearsDepth ? ", depth 1" : "") + (pass.clearsStencil ? ", stencil 0" : "");
    }
    if (pass.kind == PassKind::Copy) {
        return pass.texture == MaskTexture::Alpha       ? "alpha to ALPHA"
               : pass.texture == MaskTexture::Intensity ? "colour to INTENSITY"
                                                        : "colour to RGB";
    }
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    if (pass.depthTest)
        add(fmt::format("depth {}{}", upper(name(pass.depthFunction)), pass.depthWrite ? " write" : ""));
    if (pass.stencil.enabled) add(stencilState(pass.stencil));
    if (pass.blend.enabled) {
        if (pass.blend.equation == BlendEquation::Min || pass.blend.equation == BlendEquation::Max)
            add("blend " + upper(name(pass.blend.equation)));
        else
            add(fmt::format("blend {} {}", upper(name(pass.blend.source)),
                            upper(name(pass.blend.destination))));
    }
    if (pass.texture != MaskTexture::None) add("mask texture");
    if (pass.write.any() && pass.kind != PassKind::Scene && pass.texture == MaskTexture::None)
        add(pass.write.red ? fmt::format("colour {:.3g}", c.r) : fmt::format("alpha {:.3g}", c.a));
    add("write " + channels(pass.write));
    return text;
}

}  // namespace gnomon
