#include "gl/programs.h"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <string>

#include "gl/silhouette_shader.h"

namespace gnomon {
namespace {

// 16 bits in two channels of 8: red holds the low ones.
constexpr const char* kCountFaces = R"(
#version 150 compatibility
#extension GL_EXT_shader_framebuffer_fetch : require
uniform int front;
inout vec4 stored;
void main() {
    int count = int(stored.r * 255.0 + 0.5) + 256 * int(stored.g * 255.0 + 0.5);
    count = (count + (gl_FrontFacing ? front : -front)) & 0xffff;
    stored = vec4(float(count & 255) / 255.0, float(count >> 8) / 255.0, stored.b, stored.a);
}
)";

constexpr const char* kShadeCount = R"(
#version 150 compatibility
#extension GL_EXT_shader_framebuffer_fetch : require
uniform float share;
inout vec4 stored;
void main() {
    bool lit = stored.r < 0.5 / 255.0 && stored.g < 0.5 / 255.0;
    stored = vec4(gl_Color.rgb * (lit ? 1.0 : share), stored.a);
}
)";

constexpr const char* kDepthMapVertex = R"(
#version 150 compatibility
out vec3 fromLight;
void main() {
    gl_Position = gl_Vertex;
    fromLight = gl_MultiTexCoord0.xyz;
}
)";

// The nearest depth of one texel, as Williams has it: no filtering. A point light's depths are 1 - near/w;
// compared as distances, so that the bias is the same share of each.
constexpr const char* kDepthMapFragment = R"(
#version 150 compatibility
in vec3 fromLight;
uniform sampler2D faces[6];
uniform int size;
uniform float near;      // 0: a directional light
uniform float bias;
uniform float share;
uniform mat3 axes[6];    // columns: right, up, forward

float stored(int face, vec2 at) {
    ivec2 texel = clamp(ivec2(floor((at * 0.5 + 0.5) * float(size))), ivec2(0), ivec2(size - 1));
    if (face == 0) return texelFetch(faces[0], texel, 0).r;
    if (face == 1) return texelFetch(faces[1], texel, 0).r;
    if (face == 2) return texelFetch(faces[2], texel, 0).r;
    if (face == 3) return texelFetch(faces[3], texel, 0).r;
    if (face == 4) return texelFetch(faces[4], texel, 0).r;
    return texelFetch(faces[5], texel, 0).r;
}

void main() {
    bool shadow;
    if (near == 0.0) {
        shadow = fromLight.z > stored(0, fromLight.xy) + bias;
    } else {
        vec3 size3 = abs(fromLight);
        int face = size3.x >= size3.y && size3.x >= size3.z ? (fromLight.x > 0.0 ? 0 : 1)
                   : size3.y >= size3.z                     ? (fromLight.y > 0.0 ? 2 : 3)
                                                            : (fromLight.z > 0.0 ? 4 : 5);
        vec3 p = fromLight * axes[face];
        float blocker = near / (1.0 - stored(face, p.xy / p.z));
        shadow = p.z > blocker * (1.0 + bias);
    }
    gl_FragColor = vec4(vec3(shadow ? share : 1.0), 1.0);
}
)";

}  // namespace

void Programs::use(const char* name, std::initializer_list<ShaderStage> stages) {
    const auto found = m_known.find(m_prefix + name);
    if (found != m_known.end()) {
        m_current = found->second;
    } else {
        m_current = linkProgram(gl, name, stages);
        m_known[m_prefix + name] = m_current;
    }
    gl.UseProgram(m_current);
}

void Programs::useCountFaces(int frontCount) {
    use("CountFaces", {{GL_FRAGMENT_SHADER, kCountFaces}});
    gl.Uniform1i(uniform("front"), frontCount);
}

void Programs::useShadeCount(float shadowShare) {
    use("ShadeCount", {{GL_FRAGMENT_SHADER, kShadeCount}});
    gl.Uniform1f(uniform("share"), shadowShare);
}

void Programs::useDepthMap(const DepthMapFrame& map, int size, float bias, float shadowShare) {
    use("DepthMap", {{GL_VERTEX_SHADER, kDepthMapVertex}, {GL_FRAGMENT_SHADER, kDepthMapFragment}});
    for (int f = 0; f < 6; ++f) {
        // Units without a map of their own see the first.
        gl.Uniform1i(uniform(fmt::format("faces[{}]", f).c_str()), f < int(map.faces.size()) ? f : 0);
        const CubeFace& face = kCubeFaces[f];
        const glm::mat3 axes(face.right, face.up, face.forward);
        gl.UniformMatrix3fv(uniform(fmt::format("axes[{}]", f).c_str()), 1, GL_FALSE, &axes[0][0]);
    }
    gl.Uniform1i(uniform("size"), size);
    gl.Uniform1f(uniform("near"), map.nearPlane);
    gl.Uniform1f(uniform("bias"), bias);
    gl.Uniform1f(uniform("share"), shadowShare);
}

std::optional<int> Programs::drawSilhouettes(const SilhouetteMesh& mesh, Clip clip, bool counts) {
    use("Silhouettes", {{GL_VERTEX_SHADER, kSilhouetteVertex}, {GL_GEOMETRY_SHADER, kSilhouetteGeometry}});
    gl.Uniform4dv(uniform("light"), 1, &mesh.light[0]);
    for (int column = 0; column < 4; ++column)
        gl.Uniform4dv(uniform(fmt::format("clipFromWorld[{}]", column).c_str()), 1,
                      &mesh.clipFromWorld[column][0]);
    const glm::dvec4 eye(mesh.eye, 1), frustum(mesh.window, mesh.nearPlane, 0);
    gl.Uniform4dv(uniform("eye"), 1, &eye[0]);
    gl.Uniform4dv(uniform("frustum"), 1, &frustum[0]);
    gl.Uniform1i(uniform("clipMode"), int(clip));
    gl.Uniform1i(uniform("counts"), counts);

    const auto draw = [&] {
        gl.VertexPointer(4, GL_FLOAT, 0, mesh.vertices.data());
        gl.DrawElements(GL_TRIANGLES_ADJACENCY, GLsizei(mesh.indices.size()), GL_UNSIGNED_INT,
                        mesh.indices.data());
    };
    if (!counts) {
        draw();
        return std::nullopt;
    }
    GLuint counter = 0;
    GLuint zero = 0;
    gl.GenBuffers(1, &counter);
    gl.BindBuffer(GL_ATOMIC_COUNTER_BUFFER, counter);
    gl.BufferData(GL_ATOMIC_COUNTER_BUFFER, sizeof zero, &zero, GL_DYNAMIC_READ);
    gl.BindBufferBase(GL_ATOMIC_COUNTER_BUFFER, 0, counter);
    draw();
    gl.MemoryBarrier(GL_ATOMIC_COUNTER_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    GLuint blockers = 0;
    gl.GetBufferSubData(GL_ATOMIC_COUNTER_BUFFER, 0, sizeof blockers, &blockers);
    gl.DeleteBuffers(1, &counter);
    return int(blockers);
}

}  // namespace gnomon
