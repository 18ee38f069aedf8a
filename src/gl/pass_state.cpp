#include "gl/pass_state.h"

#include <algorithm>

#include "gl/words.h"
#include "profile/blend.h"

namespace gnomon {

void PassState::bound(const std::optional<WindowRect>& part) {
    turn(GL_SCISSOR_TEST, m_scissorTest, part.has_value());
    if (part) scissor(*part);
}

void PassState::scissor(const WindowRect& part) {
    if (m_scissor == part) return;
    gl.Scissor(part.x, part.y, std::max(part.width, 0), std::max(part.height, 0));
    m_scissor = part;
}

void PassState::set(const Pass& pass, int reference) {
    colourMask(pass.write);
    if (pass.depthTest || pass.depthWrite) {
        gl.Enable(GL_DEPTH_TEST);
        gl.DepthFunc(glEnum(pass.depthTest ? pass.depthFunction : Compare::Always));
    } else {
        gl.Disable(GL_DEPTH_TEST);
    }
    gl.DepthMask(pass.depthWrite);

    // A chip without these has no such calls to make.
    turn(GL_COLOR_LOGIC_OP, m_logicOp, pass.logicInvert);
    if (pass.logicInvert) gl.LogicOp(GL_INVERT);
    turn(GL_ALPHA_TEST, m_alphaTest, pass.alphaTest.enabled);
    if (pass.alphaTest.enabled) gl.AlphaFunc(glEnum(pass.alphaTest.function), pass.alphaTest.reference);
    if (pass.blend.enabled) {
        gl.Enable(GL_BLEND);
        // The equation is an extension: a chip that only adds has no such call to make.
        if (pass.blend.equation != m_equation) gl.BlendEquation(glEnum(m_equation = pass.blend.equation));
        if (pass.blend.equation != BlendEquation::Min && pass.blend.equation != BlendEquation::Max)
            gl.BlendFunc(glEnum(pass.blend.source), glEnum(pass.blend.destination));
        const float c = pass.blend.constant;
        if (isConstant(pass.blend.source) || isConstant(pass.blend.destination)) gl.BlendColor(c, c, c, c);
    } else {
        gl.Disable(GL_BLEND);
    }

    const Stencil& s = pass.stencil;
    if (!s.enabled) return gl.Disable(GL_STENCIL_TEST);
    gl.Enable(GL_STENCIL_TEST);
    stencilMask(s.writeMask);
    gl.StencilFunc(glEnum(s.function), reference, s.readMask);
    if (s.front == s.back) {
        gl.StencilOp(GL_KEEP, glEnum(s.front.onDepthFail), glEnum(s.front.onPass));
    } else {
        gl.StencilOpSeparate(GL_FRONT, GL_KEEP, glEnum(s.front.onDepthFail), glEnum(s.front.onPass));
        gl.StencilOpSeparate(GL_BACK, GL_KEEP, glEnum(s.back.onDepthFail), glEnum(s.back.onPass));
    }
}

void PassState::setDefaults() {
    if (m_equation != BlendEquation::Add) gl.BlendEquation(glEnum(m_equation = BlendEquation::Add));
    stencilMask(~0u);
    turn(GL_COLOR_LOGIC_OP, m_logicOp, false);
    turn(GL_ALPHA_TEST, m_alphaTest, false);
    turn(GL_SCISSOR_TEST, m_scissorTest, false);
}

void PassState::turn(GLenum what, bool& is, bool on) {
    if (is == on) return;
    on ? gl.Enable(what) : gl.Disable(what);
    is = on;
}

void resetState(const GlTable& gl) {
    for (const GLenum what : {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_BLEND, GL_CULL_FACE, GL_TEXTURE_2D,
                              GL_DEPTH_CLAMP, GL_ALPHA_TEST, GL_COLOR_LOGIC_OP, GL_SCISSOR_TEST})
        gl.Disable(what);
    gl.UseProgram(0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.StencilMask(~0u);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_TRUE);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.Color4f(1, 1, 1, 1);
    gl.DisableClientState(GL_COLOR_ARRAY);
    gl.DisableClientState(GL_TEXTURE_COORD_ARRAY);
    gl.EnableClientState(GL_VERTEX_ARRAY);
}

}  // namespace gnomon
