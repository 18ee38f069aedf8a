// Plans as OpenGL calls to copy, against the calls that the renderer makes of the same plans.

#include "report/gl_listing.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <regex>
#include <sstream>

#include "gl/free_channels.h"
#include "gl/renderer.h"
#include "gl/surface.h"
#include "gl/tools.h"

namespace gnomon {
namespace gl_listing_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr int kWidth = 21, kHeight = 13;
constexpr double kAny = std::numeric_limits<double>::quiet_NaN();  ///< a value that only the program knows

using Arguments = std::vector<double>;
struct Call {
    std::string name{};
    Arguments arguments{};
};

bool sameValue(double a, double b) {
    return std::isnan(a) || std::isnan(b) || std::abs(a - b) < 1e-6;
}

/// What OpenGL does: state by the call that sets it, and what was cleared and copied under it.
class Machine {
  public:
    explicit Machine(int width, int height) {
        m_state["Viewport"] = {0, 0, double(width), double(height)};
        m_state["ColorMask"] = {1, 1, 1, 1};
        m_state["DepthMask"] = {1};
        m_state["StencilMask"] = {double(~0u)};
        m_state["BlendEquation"] = {GL_FUNC_ADD};
    }

    void call(const Call& c) {
        if (c.name == "Enable" || c.name == "Disable") {
            m_on[c.arguments[0]] = c.name == "Enable";
        } else if (c.name == "StencilOp" || c.name == "StencilOpSeparate") {
            const bool both = c.name == "StencilOp";
            const Arguments ops(c.arguments.end() - 3, c.arguments.end());
            if (both || c.arguments[0] == GL_FRONT) m_state["front"] = ops;
            if (both || c.arguments[0] == GL_BACK) m_state["back"] = ops;
        } else if (c.name == "Clear") {
            m_events.push_back(c);
            const auto bits = unsigned(c.arguments[0]);
            if (bits & GL_COLOR_BUFFER_BIT) keep({"ClearColor", "ColorMask"});
            if (bits & GL_DEPTH_BUFFER_BIT) keep({"DepthMask"});
            if (bits & GL_STENCIL_BUFFER_BIT) keep({"ClearStencil", "StencilMask"});
        } else if (c.name.starts_with("CopyTex") || c.name == "TexImage2D" || c.name == "TexParameteri") {
            m_events.push_back(c);
        } else {
            m_state[c.name] = c.arguments;
        }
    }

    /// The state that a draw depends on now, and no other.
    std::map<std::string, Arguments> drawState() const {
        std::map<std::string, Arguments> all;
        const auto take = [&](const char* name) {
            const auto found = m_state.find(name);
            all[name] = found == m_state.end() ? Arguments{} : found->second;
        };
        const auto feature = [&](GLenum what, const std::vector<const char*>& names) {
            const auto found = m_on.find(what);
            const bool on = found != m_on.end() && found->second;
            all[fmt::format("enabled {:#x}", what)] = {double(on)};
            if (on)
                for (const char* name : names) take(name);
        };
        take("Viewport"), take("ColorMask");
        feature(GL_DEPTH_TEST, {"DepthFunc", "DepthMask"});
        feature(GL_STENCIL_TEST, {"StencilFunc", "front", "back", "StencilMask"});
        feature(GL_BLEND, {"BlendEquation"});
        if (all["enabled 0xbe2"][0] != 0) {
            const double equation = all["BlendEquation"][0];
            if (equation != GL_MIN && equation != GL_MAX) take("BlendFunc");
            for (const double factor : all["BlendFunc"])
                if (factor >= GL_CONSTANT_COLOR && factor <= GL_ONE_MINUS_CONSTANT_ALPHA) take("BlendColor");
        }
        feature(GL_ALPHA_TEST, {"AlphaFunc"});
        feature(GL_CULL_FACE, {"CullFace"});
        feature(GL_COLOR_LOGIC_OP, {"LogicOp"});
        feature(GL_TEXTURE_2D, {});
        feature(GL_DEPTH_CLAMP, {});
        return all;
    }
    Arguments colour() const { return m_state.count("Color4f") ? m_state.at("Color4f") : Arguments{}; }

    std::vector<Call> takeEvents() { return std::exchange(m_events, {}); }

  private:
    void keep(const std::vector<const char*>& names) {
        for (const char* name : names) m_events.push_back({name, m_state[name]});
    }

    std::map<std::string, Arguments> m_state{};
    std::map<double, bool> m_on{};
    std::vector<Call> m_events{};
};

/// What a pass does, by either way.
struct Done {
    std::map<std::string, Arguments> state{};  ///< of the last draw; empty without one
    Arguments colour{};
    std::vector<Call> events{};
};

/// Hears the renderer's calls.
class Recorder {
  public:
    Recorder() : m_machine(kWidth, kHeight) {}

    GlTable listen(GlTable gl) {
        hear(gl.Enable, "Enable"), hear(gl.Disable, "Disable"), hear(gl.Viewport, "Viewport");
        hear(gl.ColorMask, "ColorMask"), hear(gl.DepthFunc, "DepthFunc"), hear(gl.DepthMask, "DepthMask");
        hear(gl.StencilFunc, "StencilFunc"), hear(gl.StencilOp, "StencilOp");
        hear(gl.StencilOpSeparate, "StencilOpSeparate"), hear(gl.StencilMask, "StencilMask");
        hear(gl.BlendFunc, "BlendFunc"), hear(gl.BlendEquation, "BlendEquation");
        hear(gl.BlendColor, "BlendColor"), hear(gl.AlphaFunc, "AlphaFunc"), hear(gl.LogicOp, "LogicOp");
        hear(gl.CullFace, "CullFace"), hear(gl.Color4f, "Color4f"), hear(gl.ClearColor, "ClearColor");
        hear(gl.ClearStencil, "ClearStencil"), hear(gl.Clear, "Clear");
        hear(gl.TexImage2D, "TexImage2D"), hear(gl.TexParameteri, "TexParameteri");
        hear(gl.CopyTexImage2D, "CopyTexImage2D"), hear(gl.CopyTexSubImage2D, "CopyTexSubImage2D");
        gl.DrawArrays = [this, next = gl.DrawArrays](GLenum mode, GLint first, GLsizei count) {
            drawn();
            next(mode, first, count);
        };
        gl.DrawElements = [this, next = gl.DrawElements](GLenum mode, GLsizei count, GLenum type,
                                                         const void* indices) {
            drawn();
            next(mode, count, type, indices);
        };
        return gl;
    }

    Done takePass() {
        m_done.events = m_machine.takeEvents();
        return std::exchange(m_done, {});
    }

  private:
    template <class... Args>
    void hear(std::function<void(Args...)>& entry, const char* name) {
        entry = [this, name, next = entry](Args... args) {
            m_machine.call({name, {asNumber(args)...}});
            next(args...);
        };
    }
    static double asNumber(const void*) { return kAny; }
    static double asNumber(double value) { return value; }

    void drawn() {
        m_done.state = m_machine.drawState();
        m_done.colour = m_machine.colour();
    }

    Machine m_machine;
    Done m_done{};
};

double valueOf(const std::string& word) {
    static const std::map<std::string, double> kWords{
#define GNOMON_WORD(word) {#word, double(word)}
        GNOMON_WORD(GL_TRUE),
        GNOMON_WORD(GL_FALSE),
        GNOMON_WORD(GL_DEPTH_TEST),
        GNOMON_WORD(GL_STENCIL_TEST),
        GNOMON_WORD(GL_BLEND),
        GNOMON_WORD(GL_ALPHA_TEST),
        GNOMON_WORD(GL_CULL_FACE),
        GNOMON_WORD(GL_COLOR_LOGIC_OP),
        GNOMON_WORD(GL_TEXTURE_2D),
        GNOMON_WORD(GL_SCISSOR_TEST),
        GNOMON_WORD(GL_DEPTH_CLAMP),
        GNOMON_WORD(GL_NEVER),
        GNOMON_WORD(GL_LESS),
        GNOMON_WORD(GL_EQUAL),
        GNOMON_WORD(GL_LEQUAL),
        GNOMON_WORD(GL_GREATER),
        GNOMON_WORD(GL_NOTEQUAL),
        GNOMON_WORD(GL_GEQUAL),
        GNOMON_WORD(GL_ALWAYS),
        GNOMON_WORD(GL_KEEP),
        GNOMON_WORD(GL_REPLACE),
        GNOMON_WORD(GL_INCR),
        GNOMON_WORD(GL_DECR),
        GNOMON_WORD(GL_INCR_WRAP),
        GNOMON_WORD(GL_DECR_WRAP),
        GNOMON_WORD(GL_INVERT),
        GNOMON_WORD(GL_ZERO),
        GNOMON_WORD(GL_ONE),
        GNOMON_WORD(GL_SRC_COLOR),
        GNOMON_WORD(GL_DST_COLOR),
        GNOMON_WORD(GL_SRC_ALPHA),
        GNOMON_WORD(GL_DST_ALPHA),
        GNOMON_WORD(GL_ONE_MINUS_SRC_COLOR),
        GNOMON_WORD(GL_ONE_MINUS_DST_COLOR),
        GNOMON_WORD(GL_CONSTANT_COLOR),
        GNOMON_WORD(GL_CONSTANT_ALPHA),
        GNOMON_WORD(GL_FUNC_ADD),
        GNOMON_WORD(GL_FUNC_SUBTRACT),
        GNOMON_WORD(GL_FUNC_REVERSE_SUBTRACT),
        GNOMON_WORD(GL_MIN),
        GNOMON_WORD(GL_MAX),
        GNOMON_WORD(GL_FRONT),
        GNOMON_WORD(GL_BACK),
        GNOMON_WORD(GL_COLOR_BUFFER_BIT),
        GNOMON_WORD(GL_DEPTH_BUFFER_BIT),
        GNOMON_WORD(GL_STENCIL_BUFFER_BIT),
        GNOMON_WORD(GL_RGB),
        GNOMON_WORD(GL_ALPHA),
        GNOMON_WORD(GL_INTENSITY),
        GNOMON_WORD(GL_LUMINANCE),
        GNOMON_WORD(GL_UNSIGNED_BYTE),
        GNOMON_WORD(GL_NEAREST),
        GNOMON_WORD(GL_LINEAR),
        GNOMON_WORD(GL_CLAMP_TO_EDGE),
        GNOMON_WORD(GL_TEXTURE_MIN_FILTER),
        GNOMON_WORD(GL_TEXTURE_MAG_FILTER),
        GNOMON_WORD(GL_TEXTURE_WRAP_S),
        GNOMON_WORD(GL_TEXTURE_WRAP_T),
        GNOMON_WORD(GL_TEXTURE_ENV),
        GNOMON_WORD(GL_TEXTURE_ENV_MODE),
        GNOMON_WORD(GL_FRAMEBUFFER),
        GNOMON_WORD(GL_STENCIL_INDEX)
#undef GNOMON_WORD
    };
    if (word.starts_with("0x")) return double(std::stoul(word, nullptr, 16));
    if (std::isdigit(word[0]) || word[0] == '-') return std::stod(word);
    const auto found = kWords.find(word);
    if (word.starts_with("GL_") && found == kWords.end()) ADD_FAILURE() << "no such word: " << word;
    return found == kWords.end() ? kAny : found->second;
}

/// What OpenGL would do, were the listing its program.
class Reader {
  public:
    Reader() : m_machine(kWidth, kHeight) {}

    Done read(const std::string& calls) {
        Done done;
        std::istringstream lines(calls);
        for (std::string line; std::getline(lines, line);) {
            static const std::regex kCall("gl([A-Za-z0-9]+)\\((.*)\\);"), kComment("/\\*[^*]*\\*/"),
                kDraw("(blockers = )?draw[A-Za-z]+\\(.*\\);");
            std::smatch match;
            if (std::regex_match(line, match, kCall)) {
                call(match[1], match[2]);
            } else if (std::regex_match(line, kDraw)) {
                done.state = m_machine.drawState();
                done.colour = m_machine.colour();
            } else {
                EXPECT_TRUE(std::regex_match(line, kComment)) << line;
            }
        }
        done.events = m_machine.takeEvents();
        return done;
    }

  private:
    void call(const std::string& name, const std::string& list) {
        static const std::vector<std::string> kOthers{"BindTexture", "TexEnvi",    "BindFramebuffer",
                                                      "ReadPixels",  "ClearDepth", "Scissor"};
        if (std::find(kOthers.begin(), kOthers.end(), name) != kOthers.end()) return;
        Arguments arguments;
        std::istringstream words(list);
        for (std::string word; std::getline(words, word, ',');) {
            while (word.front() == ' ') word.erase(0, 1);
            if (name == "Clear") {
                unsigned bits = 0;
                std::istringstream parts(word);
                for (std::string part; parts >> part;)
                    if (part != "|") bits |= unsigned(valueOf(part));
                arguments.push_back(bits);
            } else {
                arguments.push_back(word.front() == '(' ? kAny : valueOf(word));
            }
        }
        m_machine.call({name, arguments});
    }

    Machine m_machine;
};

void expectSame(const Arguments& listed, const Arguments& drawn, const std::string& where) {
    ASSERT_EQ(listed.size(), drawn.size()) << where;
    for (std::size_t i = 0; i < listed.size(); ++i)
        EXPECT_TRUE(sameValue(listed[i], drawn[i])) << where << ": " << listed[i] << " for " << drawn[i];
}

/// A chip's surface, and who hears what is drawn to it.
struct Rig {
    explicit Rig(const Profile& p)
        : profile(p), surface(bufferFormatOf(p), kWidth, kHeight, arithmeticOf(p, {})) {
        surface.decorate([this](GlTable gl) { return recorder.listen(std::move(gl)); });
    }
    Profile profile;
    Recorder recorder{};
    Surface surface;
};

/// The events of a copy into a texture whose storage an earlier copy of the frame has made: a listing shows
/// each pass as it is the first time.
std::vector<Call> intoStorage(const std::vector<Call>& events) {
    std::vector<Call> copied;
    for (const Call& c : events) {
        const Arguments& a = c.arguments;
        if (c.name == "TexImage2D") continue;
        if (c.name == "CopyTexImage2D")
            copied.push_back({"CopyTexSubImage2D", {a[0], a[1], 0, 0, a[3], a[4], a[5], a[6]}});
        else
            copied.push_back(c);
    }
    return copied;
}

/// The events of a clear without the channels that no pass uses, which the renderer clears with what lies in
/// the same words; a listing has only what the method calls for.
std::vector<Call> withoutFree(std::vector<Call> events, const FreeChannels& free, const Pass& pass) {
    for (Call& c : events)
        if (c.name == "ColorMask" && free.alpha && pass.write == kWriteColour) c.arguments.back() = 0;
    if (!free.stencil || pass.clearsStencil) return events;
    for (Call& c : events)
        if (c.name == "Clear") c.arguments[0] = double(unsigned(c.arguments[0]) & ~GL_STENCIL_BUFFER_BIT);
    std::erase_if(events, [](const Call& c) { return c.name == "ClearStencil" || c.name == "StencilMask"; });
    return events;
}

/// Draws @p plan and holds each pass against its listing.
void expectListed(Rig& rig, const Plan& plan, const FrameSurfaces& surfaces, const LightFrames& lights,
                  const std::string& what) {
    Recorder& recorder = rig.recorder;
    Reader reader;
    // Masks are read in ways of their own.
    Plan untapped = plan;
    untapped.masks.clear();
    recorder.takePass();
    // A listing is a program's first frame; the next copies into textures that are there.
    rig.surface.makeCurrent();
    rig.surface.objects().clear(rig.surface.driver());
    render(rig.surface, rig.profile, untapped, surfaces, lights, {.afterPass = [&](std::size_t i) {
               const Pass& pass = plan.passes[i];
               const std::string where = fmt::format("{}, pass {}: {}", what, i + 1, pass.label);
               Done listed = reader.read(glCalls(pass, plan));
               const Done drawn = recorder.takePass();
               const bool isCopyAgain =
                   pass.kind == PassKind::Copy &&
                   std::any_of(plan.passes.begin(), plan.passes.begin() + std::ptrdiff_t(i),
                               [&](const Pass& earlier) {
                                   return earlier.kind == PassKind::Copy &&
                                          earlier.frameTexture == pass.frameTexture;
                               });
               if (isCopyAgain) listed.events = intoStorage(listed.events);
               const bool toMap = pass.target == Target::DepthMap;
               std::vector<std::string> names;
               for (const auto& [name, arguments] : listed.state) {
                   names.push_back(name);
                   if (name == "BlendEquation" && pass.blend.equation > BlendEquation::Max) continue;
                   ASSERT_TRUE(drawn.state.count(name)) << where << ": " << name;
                   expectSame(arguments, drawn.state.at(name), fmt::format("{}: {}", where, name));
               }
               EXPECT_EQ(names.size(), drawn.state.size()) << where;
               if (pass.kind == PassKind::Volume || (pass.kind == PassKind::Rectangle && !toMap))
                   expectSame(listed.colour, drawn.colour, fmt::format("{}: colour", where));
               std::vector<Call> events = drawn.events;
               // The renderer makes a texture to draw a depth map into.
               if (toMap) std::erase_if(events, [](const Call& c) { return c.name.starts_with("Tex"); });
               if (pass.kind == PassKind::Clear)
                   events = withoutFree(events, freeChannels(plan, rig.profile, rig.surface.format()), pass);
               ASSERT_EQ(listed.events.size(), events.size()) << where;
               for (std::size_t k = 0; k < events.size(); ++k) {
                   EXPECT_EQ(listed.events[k].name, events[k].name) << where;
                   expectSame(listed.events[k].arguments, events[k].arguments,
                              fmt::format("{}: {}", where, events[k].name));
               }
           }});
}

TEST(GlCalls, SetTheStateThatTheRendererDrawsEachMethodsPassesUnder) {
    Rig ideal(chip("ideal"));
    const Frame frame = frameOf(twoBoxes(), kWidth, kHeight);
    const FrameShape shape = shapeOf(int(frame.volumes().size()), kWidth, kHeight);
    int plans = 0;
    for (const NamedMethod& method : namedMethods()) {
        for (const Shade shade : {Shade::Black, Shade::Ambient, Shade::Attenuated}) {
            Axes axes = method.axes;
            axes.shade = shade;
            if (axes.mapSize > 0) axes.mapSize = 16;
            const Plan plan = planFrame(axes, shape, ideal.profile);
            ASSERT_THAT(missing(ideal.profile, plan), IsEmpty()) << method.id;
            expectListed(ideal, plan, frame.surfaces, frame.lights(), describe(axes));
            ++plans;
        }
    }
    EXPECT_GT(plans, 60);
}

TEST(GlCalls, DoSoOfTwoLightsAndOfChipsWithOtherWays) {
    Scene scene = twoBoxes();
    scene.lights.push_back({.position = {-3.1f, 7.2f, 2.3f, 1}});
    const Frame first = frameOf(scene, kWidth, kHeight, 0), second = frameOf(scene, kWidth, kHeight, 1);
    const LightFrames lights = [&](int light) -> const LightFrame& {
        return light == 0 ? first.light : second.light;
    };
    FrameShape shape = shapeOf(int(first.volumes().size()), kWidth, kHeight);
    shape.lights.push_back({.volumes = int(second.volumes().size())});
    std::vector<std::string> ids{"ideal"};
    ids.insert(ids.end(), kLimitedChips.begin(), kLimitedChips.end());
    int plans = 0;
    for (const std::string& id : ids) {
        Rig rig(chip(id));
        for (const NamedMethod& method : namedMethods()) {
            if (method.axes.store == Store::DepthMap) continue;
            const Plan plan = planFrame(method.axes, shape, rig.profile);
            if (!missing(rig.profile, plan).empty()) continue;
            expectListed(rig, plan, first.surfaces, lights, fmt::format("{} {}", id, method.id));
            ++plans;
        }
    }
    EXPECT_GT(plans, 50);
}

/// A volume pass under a scissor in a plan that has no other state.
struct Bounded {
    Bounded() {
        plan.width = 320, plan.height = 240;
        plan.windows = {
            {.all = {60, 40, 183, 122}, .volumes = {{60, 40, 9, 8}, {60, 40, 9, 8}, {}, {100, 80, 7, 6}}}};
        Pass& pass = plan.passes.emplace_back();
        pass.kind = PassKind::Volume;
        pass.parts = Part::Sides | Part::FarCap;
    }
    std::string calls(Extent extent, int volume = kAllVolumes) {
        plan.passes[0].extent = extent;
        plan.passes[0].volume = volume;
        return glCalls(plan.passes[0], plan);
    }
    Plan plan{};
};

TEST(GlCalls, BoundPassesByAScissor) {
    Bounded b;
    EXPECT_THAT(b.calls(Extent::Shadows), AllOf(HasSubstr("glEnable(GL_SCISSOR_TEST);\n"
                                                          "glScissor(60, 40, 183, 122);\n"),
                                                HasSubstr("\ndrawAllVolumes(0, SIDES | FAR_CAPS);\n")));
    EXPECT_THAT(b.calls(Extent::Volumes, 3), AllOf(HasSubstr("glScissor(100, 80, 7, 6);\n"),
                                                   HasSubstr("\ndrawVolumes(0, 3, 3, SIDES | FAR_CAPS);\n")));
    EXPECT_THAT(b.calls(Extent::Whole), Not(HasSubstr("SCISSOR"))) << "no pass has one";
    b.plan.passes.push_back(b.plan.passes[0]);
    b.plan.passes[1].extent = Extent::Shadows;
    EXPECT_THAT(b.calls(Extent::Whole), HasSubstr("glDisable(GL_SCISSOR_TEST);\n"));
}

TEST(GlCalls, DrawRunsOfVolumesUnderTheScissorThatTheyShare) {
    EXPECT_THAT(Bounded().calls(Extent::Volumes), HasSubstr("glScissor(60, 40, 9, 8);\n"
                                                            "drawVolumes(0, 0, 1, SIDES | FAR_CAPS);\n"
                                                            "glScissor(100, 80, 7, 6);\n"
                                                            "drawVolumes(0, 3, 3, SIDES | FAR_CAPS);\n"));
}

TEST(GlCalls, BoundClearsAndRectanglesToo) {
    Bounded b;
    b.plan.passes[0] = {.kind = PassKind::Clear, .extent = Extent::Shadows};
    EXPECT_THAT(glCalls(b.plan.passes[0], b.plan), HasSubstr("glScissor(60, 40, 183, 122);\n"));
    b.plan.windows[0].all = {};
    EXPECT_THAT(glCalls(b.plan.passes[0], b.plan), HasSubstr("glScissor(0, 0, 0, 0);\n"));
}

TEST(BeyondOpenGl11, IsNothingForThePapersMethodAndNamedForOthers) {
    const FrameShape shape = shapeOf(2, 256, 128);
    const auto needs = [&](const std::string& method, const std::string& profile) {
        return beyondOpenGl11(planFrame(findMethod(method)->axes, shape, chip(profile)));
    };
    EXPECT_THAT(needs("roettger-screen", "voodoo2"), IsEmpty());
    EXPECT_THAT(needs("roettger-screen-max", "ideal"), ElementsAre(HasSubstr("GL_EXT_blend_minmax")));
    EXPECT_THAT(needs("heidmann", "tnt"), ElementsAre(HasSubstr("GL_EXT_stencil_wrap")));
    EXPECT_THAT(needs("carmack", "ideal"),
                ElementsAre(HasSubstr("GL_EXT_stencil_wrap"), HasSubstr("glStencilOpSeparate")));
    EXPECT_THAT(needs("screen-texture", "voodoo3"), ElementsAre(HasSubstr("GL_CLAMP_TO_EDGE")));
    EXPECT_THAT(needs("screen-count", "ps2"), testing::Contains(HasSubstr("OpenGL has none")));
}

TEST(GlListing, NumbersPassesAndPutsTheChipsTermsAboveThem) {
    const Plan plan = planFrame(findMethod("roettger-screen")->axes, shapeOf(1, 64, 64), chip("voodoo2"));
    const std::string text = glListing(plan, "voodoo2", {"", "", "grAlphaBlendFunction"});
    EXPECT_THAT(text, AllOf(HasSubstr("\nglDisable(GL_DITHER);\n\n/* pass 1: mask starts */\nglColorMask("),
                            HasSubstr("\n\n/* pass 3: front faces of volume 0: double */\n"
                                      "/* voodoo2: grAlphaBlendFunction */\n")));
    EXPECT_EQ(text.find("voodoo2:"), text.rfind("voodoo2:"));
}

TEST(GlCalls, OfAPlanAreThoseOfItsPasses) {
    const Plan plan = planFrame(findMethod("roettger-half")->axes, shapeOf(2, 64, 64), chip("ideal"));
    const std::vector<std::string> all = glCalls(plan);
    ASSERT_EQ(all.size(), plan.passes.size());
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], glCalls(plan.passes[i], plan));
}

TEST(GlListing, SaysHowManyVolumePassesAreLikeTheOthers) {
    const Plan plan = planFrame(findMethod("roettger-screen")->axes, shapeOf(9, 64, 64), chip("voodoo2"));
    const std::string text = glListing(plan, "voodoo2", {});
    const std::size_t fold =
        text.find("\n/* 10 more volume passes, front and back faces in turn */\n\n/* pass");
    EXPECT_NE(fold, std::string::npos) << text;
    EXPECT_GT(text.find("of volume 3"), 0u);
    EXPECT_EQ(text.find("of volume 4"), std::string::npos);
}

}  // namespace gl_listing_test
}  // namespace gnomon
