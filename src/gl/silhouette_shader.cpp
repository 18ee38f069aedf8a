#include "gl/silhouette_shader.h"

namespace gnomon {

const char* const kSilhouetteVertex = R"(
#version 450 compatibility
out Vertex {
    vec4 at;
    flat int id;
} v;
void main() {
    v.at = gl_Vertex;
    v.id = gl_VertexID;
}
)";

const char* const kSilhouetteGeometry = R"(
#version 450 compatibility
layout(triangles_adjacency, invocations = 4) in;  // a side each, and the cap
layout(triangle_strip, max_vertices = 96) out;
layout(binding = 0, offset = 0) uniform atomic_uint blockers;

uniform dvec4 light;
uniform dvec4 clipFromWorld[4];  // columns
uniform dvec4 eye;
uniform dvec4 frustum;  // limits of x and y over w, near plane
uniform int clipMode;   // 0: the frustum, 1: the plane through the eye, 2: nothing
uniform int counts;     // 1: what hides the eye is counted

in Vertex {
    vec4 at;
    flat int id;
} v[];

struct Corner {
    int vertex;  // of the primitive
    bool infinite;
};

bool directional() { return light.w == 0.0; }

// --- Clip space: ClipSpace of the host

dvec4 transformed(dvec4 p) {
    precise dvec4 a = clipFromWorld[0] * p.x + clipFromWorld[1] * p.y;
    precise dvec4 b = clipFromWorld[2] * p.z + clipFromWorld[3] * p.w;
    precise dvec4 sum = a + b;
    return sum;
}

dvec4 clipOf(Corner c) {
    if (c.infinite && directional()) return transformed(-light);
    precise dvec3 p = dvec3(v[c.vertex].at.xyz);
    if (c.infinite) {
        p = p - light.xyz;
        return transformed(dvec4(p, 0.0));
    }
    return transformed(dvec4(p, 1.0));
}

double height(Corner c) {
    precise dvec4 p = clipOf(Corner(c.vertex, false));
    if (!c.infinite) return p.z + p.w;
    precise dvec4 l = transformed(light);
    precise double own = directional() ? 0.0 : p.z + p.w;
    precise double lights = l.z + l.w;
    return own - lights;
}

double eyeHeight(Corner c) {
    precise dvec4 p = clipOf(Corner(c.vertex, false));
    if (!c.infinite) return p.w;
    precise dvec4 l = transformed(light);
    return (directional() ? 0.0 : p.w) - l.w;
}

vec4 drawn(Corner c) {
    dvec4 p = clipOf(c);
    float w = float(max(p.w, 0.0));
    float z = float(p.z);
    return vec4(float(p.x), float(p.y), c.infinite ? w : max(z, -w), w);
}

vec4 drawnCut(Corner a, Corner b) {
    precise double ha = abs(height(a)), hb = abs(height(b));
    precise double s = ha + hb;
    precise double u = ha / s, t = hb / s;
    precise dvec4 pa = t * clipOf(a), pb = u * clipOf(b);
    precise dvec4 p = pa + pb;
    precise double share = t * (a.infinite ? 0.0 : 1.0) + u * (b.infinite ? 0.0 : 1.0);
    float w = float(frustum.z * share);
    return vec4(float(p.x), float(p.y), -w, w);
}

vec4 eyeCut(Corner a, Corner b) {
    precise double ha = abs(eyeHeight(a)), hb = abs(eyeHeight(b));
    precise double s = ha + hb;
    precise dvec4 pa = (hb / s) * clipOf(a), pb = (ha / s) * clipOf(b);
    precise dvec4 p = pa + pb;
    return vec4(float(p.x), float(p.y), float(p.z), 0.0);
}

// --- Polygons

const int kMost = 12;
vec4 polygon[kMost];
int corners = 0;

void cutAtWindow(int axis, double sign) {
    vec4 kept[kMost];
    int count = 0;
    for (int i = 0; i < corners; ++i) {
        vec4 a = polygon[i], b = polygon[(i + 1) % corners];
        precise double la = frustum[axis] * double(a.w), lb = frustum[axis] * double(b.w);
        precise double ha = la - sign * double(a[axis]), hb = lb - sign * double(b[axis]);
        if (ha >= 0.0) kept[count++] = a;
        if ((ha >= 0.0) != (hb >= 0.0)) {
            ha = abs(ha);
            hb = abs(hb);
            precise double s = ha + hb;
            precise double t = hb / s, u = ha / s;
            precise dvec4 pa = t * dvec4(a), pb = u * dvec4(b);
            precise dvec4 p = pa + pb;
            kept[count++] = vec4(p);
        }
    }
    polygon = kept;
    corners = count;
}

void emitPolygon(bool reversed) {
    int sidesToCut = 0;
    for (int i = 0; i < corners && clipMode == 0; ++i)
        if (abs(double(polygon[i].x)) > frustum.x * double(polygon[i].w) ||
            abs(double(polygon[i].y)) > frustum.y * double(polygon[i].w))
            sidesToCut = 4;
    for (int side = 0; side < sidesToCut; ++side) cutAtWindow(side / 2, side % 2 == 0 ? 1.0 : -1.0);
    for (int i = 2; i < corners; ++i) {
        gl_Position = polygon[reversed ? i - 1 : 0];
        EmitVertex();
        gl_Position = polygon[reversed ? 0 : i - 1];
        EmitVertex();
        gl_Position = polygon[i];
        EmitVertex();
        EndPrimitive();
    }
}

// The part of the face beyond the near plane, in front of the eye, or all of it.
void visiblePart(Corner face[4], int size) {
    corners = 0;
    for (int i = 0; i < size; ++i) {
        Corner a = face[i], b = face[(i + 1) % size];
        if (clipMode == 2) {
            polygon[corners++] = vec4(clipOf(a));
            continue;
        }
        bool aIn = clipMode == 0 ? height(a) >= 0.0 : eyeHeight(a) >= 0.0;
        bool bIn = clipMode == 0 ? height(b) >= 0.0 : eyeHeight(b) >= 0.0;
        if (aIn) polygon[corners++] = clipMode == 0 ? drawn(a) : vec4(clipOf(a));
        if (aIn != bIn) polygon[corners++] = clipMode == 0 ? drawnCut(a, b) : eyeCut(a, b);
    }
}

// The part between the plane through the eye and the near plane, at its own depth: for the depth clamp.
void nearPart(Corner face[4], int size) {
    Corner from[8];
    Corner to[8];
    bool isCut[8];
    int count = 0;
    for (int i = 0; i < size; ++i) {
        Corner a = face[i], b = face[(i + 1) % size];
        bool aBefore = height(a) < 0.0, bBefore = height(b) < 0.0;
        if (aBefore) {
            from[count] = a;
            to[count] = a;
            isCut[count++] = false;
        }
        if (aBefore != bBefore) {
            from[count] = a;
            to[count] = b;
            isCut[count++] = true;
        }
    }
    corners = 0;
    for (int i = 0; i < count; ++i) {
        int k = (i + 1) % count;
        bool inFront = isCut[i] || eyeHeight(from[i]) >= 0.0;
        bool nextInFront = isCut[k] || eyeHeight(from[k]) >= 0.0;
        if (isCut[i])
            polygon[corners++] = drawnCut(from[i], to[i]);
        else if (inFront)
            polygon[corners++] = vec4(clipOf(from[i]));
        if (inFront != nextInFront) {
            if (isCut[i])
                polygon[corners++] = eyeCut(from[i], to[i]);
            else if (isCut[k])
                polygon[corners++] = eyeCut(from[k], to[k]);
            else
                polygon[corners++] = eyeCut(from[i], from[k]);
        }
    }
}

// --- Facing

// Positive on the side from which a, b, c are counter-clockwise; the same, but for its sign, in whatever
// order they come.
double side(int a, int b, int c, dvec4 from) {
    double sign = 1.0;
    int t;
    if (v[a].id > v[b].id) { t = a; a = b; b = t; sign = -sign; }
    if (v[b].id > v[c].id) { t = b; b = c; c = t; sign = -sign; }
    if (v[a].id > v[b].id) { t = a; a = b; b = t; sign = -sign; }
    precise dvec3 p = dvec3(v[a].at.xyz);
    precise dvec3 e = dvec3(v[b].at.xyz) - p, f = dvec3(v[c].at.xyz) - p;
    precise dvec3 d = from.xyz - from.w * p;
    precise dvec3 n = cross(e, f);
    return sign * dot(n, d);
}

// 1: casts, as it is wound; -1: the other way round; 0: does not cast.
int facing(int a, int b, int c) {
    double s = side(a, b, c, light);
    if (s > 0.0) return 1;
    return s < 0.0 && v[a].at.w > 1.5 ? -1 : 0;
}

// On which side of the line from the eye to the light an edge passes; the same for both of its triangles,
// and never on it, so that a line through the edge meets one of them.
double passes(int a, int b) {
    double sign = 1.0;
    if (v[a].id > v[b].id) {
        int t = a;
        a = b;
        b = t;
        sign = -1.0;
    }
    precise dvec3 p = dvec3(v[a].at.xyz) - eye.xyz, q = dvec3(v[b].at.xyz) - eye.xyz;
    precise dvec3 d = light.xyz - light.w * eye.xyz;
    precise dvec3 n = cross(p, q);
    precise double height = dot(n, d);
    return height == 0.0 ? sign : sign * height;
}

bool hidesEye(int own) {
    if (double(own) * side(0, 2, 4, eye) >= 0.0) return false;
    double a = passes(0, 2), b = passes(2, 4), c = passes(4, 0);
    return (a > 0.0 && b > 0.0 && c > 0.0) || (a < 0.0 && b < 0.0 && c < 0.0);
}

// --- Faces, each drawn in at most two parts

Corner face[4];
int faceSize = 0;

void setSide(int from, int to) {
    // Sides that hang from one edge in opposite directions are the same face.
    bool reversed = v[from].id < v[to].id;
    int a = reversed ? to : from, b = reversed ? from : to;
    face[0] = Corner(b, false);
    face[1] = Corner(a, false);
    face[2] = Corner(a, true);
    face[3] = Corner(b, true);
    faceSize = directional() ? 3 : 4;
}

void setFarCap(int own) {
    face[0] = Corner(own > 0 ? 0 : 2, true);
    face[1] = Corner(4, true);
    face[2] = Corner(own > 0 ? 2 : 0, true);
    faceSize = 3;
}

// The light cap from the vertex with the smallest index and then the smaller of the others; returns whether
// that turned it round.
bool setLightCap() {
    int a = 0, b = 2, c = 4;
    for (int k = 0; k < 2; ++k) {
        if (v[a].id > v[b].id || v[a].id > v[c].id) {
            int t = a;
            a = b;
            b = c;
            c = t;
        }
    }
    bool reversed = v[b].id > v[c].id;
    face[0] = Corner(a, false);
    face[1] = Corner(reversed ? c : b, false);
    face[2] = Corner(reversed ? b : c, false);
    faceSize = 3;
    return reversed;
}

// llvmpipe runs both ways of an if for all primitives, but no round of a loop that none of them needs; and
// each function's text is compiled wherever it is called. So there is one loop with one call of each.
void main() {
    int own = facing(0, 2, 4);
    bool isCap = gl_InvocationID == 3;
    int from = 2 * (gl_InvocationID % 3), far = from + 1, to = (from + 2) % 6;
    bool held = v[far].at.w < -0.5;
    int weight = held ? 0 : own - (v[far].at.w < 0.5 ? 0 : facing(to, from, far));
    int times = isCap ? abs(own) : abs(weight);

    bool near = false;
    for (int k = 0; k < 3 && times > 0; ++k) near = near || height(Corner(2 * k, false)) < 0.0;
    for (int k = 0; k < 3 && times > 0 && !isCap; ++k) near = near || height(Corner(2 * k, true)) < 0.0;
    near = near && (clipMode == 0 || isCap);
    bool visible = !isCap || !directional();

    for (int n = 0; n < (isCap && counts == 1 ? times : 0); ++n)
        if (hidesEye(own)) atomicCounterIncrement(blockers);
    int rounds = times * ((near ? 1 : 0) + (visible ? 1 : 0));
    for (int n = 0; n < rounds; ++n) {
        bool drawsNear = near && (!visible || n % 2 == 1);
        bool reversed = false;
        if (!isCap) {
            int a = weight > 0 ? from : to, b = weight > 0 ? to : from;
            setSide(a, b);
            reversed = v[a].id < v[b].id;
        } else if (drawsNear) {
            reversed = setLightCap() == (own > 0);
        } else {
            setFarCap(own);
        }
        for (int m = 0; m < (drawsNear ? 1 : 0); ++m) nearPart(face, faceSize);
        for (int m = 0; m < (drawsNear ? 0 : 1); ++m) visiblePart(face, faceSize);
        emitPolygon(reversed);
    }
}
)";

}  // namespace gnomon
