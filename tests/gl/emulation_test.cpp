// The chips' programs against the integer functions of profile/, over all values of source and destination.

#include "gl/emulation.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "gl/words.h"
#include "profile/frame_channel.h"
#include "profile/words.h"
#include "test_surface.h"

namespace gnomon {
namespace emulation_test {

constexpr int kSide = 256;

/// The source of column @p x, the destination before it was stored in row @p y: all pairs of red, and much of
/// the others.
Rgba sourceOf(int x) {
    return {x, 255 - x, x ^ 0x55, x * 7 & 255};
}
Rgba destinationOf(int y) {
    return {y, y * 11 & 255, 255 - y, (y * 5 + 3) & 255};
}

/// A square surface, drawn to in columns or rows of one colour each.
class Square {
  public:
    Square(const ColourFormat& format, const ChipArithmetic& chip)
        : m_format{.red = format.red,
                   .green = format.green,
                   .blue = format.blue,
                   .alpha = format.alpha,
                   .depth = 0,
                   .stencil = 0},
          surface(m_format, kSide, kSide, chip),
          gl(surface.driver()) {
        gl.Viewport(0, 0, kSide, kSide);
        gl.EnableClientState(GL_VERTEX_ARRAY);
        for (int i = 0; i < kSide; ++i) {
            const float low = 2.0f * float(i) / kSide - 1, high = 2.0f * float(i + 1) / kSide - 1;
            for (const auto& [a, b] : {std::pair(low, -1.0f), {high, -1.0f}, {high, 1.0f}, {low, 1.0f}}) {
                m_columns.push_back({a, b});
                m_rows.push_back({b, a});
            }
        }
    }

    void drawColumns(const std::function<Rgba(int)>& colour) { draw(m_columns, colour); }
    /// Rows from the bottom.
    void drawRows(const std::function<Rgba(int)>& colour) { draw(m_rows, colour); }

    /// One rectangle over all in the current colour.
    void fill() {
        static constexpr std::array<float, 8> kAll{-1, -1, 1, -1, 1, 1, -1, 1};
        gl.VertexPointer(2, GL_FLOAT, 0, kAll.data());
        gl.DrawArrays(GL_QUADS, 0, 4);
    }

    /// The codes as they stand, by row from the bottom.
    std::vector<Rgba> codes() {
        std::vector<std::uint8_t> bytes(std::size_t(4) * kSide * kSide);
        gl.ReadPixels(0, 0, kSide, kSide, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
        std::vector<Rgba> all(std::size_t(kSide) * kSide);
        for (std::size_t i = 0; i < all.size(); ++i)
            for (std::size_t c = 0; c < 4; ++c) {
                const int bits = channelBits(m_format, int(c));
                all[i][c] = bits == 0 ? 0 : bytes[4 * i + c] >> (8 - bits);
            }
        return all;
    }

    const BufferFormat m_format;
    TestSurface surface;
    const GlTable& gl;

  private:
    void draw(const std::vector<std::array<float, 2>>& quads, const std::function<Rgba(int)>& colour) {
        std::vector<std::array<std::uint8_t, 4>> colours;
        for (int i = 0; i < kSide; ++i) {
            const Rgba c = colour(i);
            for (int corner = 0; corner < 4; ++corner)
                colours.push_back(
                    {std::uint8_t(c[0]), std::uint8_t(c[1]), std::uint8_t(c[2]), std::uint8_t(c[3])});
        }
        gl.EnableClientState(GL_COLOR_ARRAY);
        gl.VertexPointer(2, GL_FLOAT, 0, quads.data());
        gl.ColorPointer(4, GL_UNSIGNED_BYTE, 0, colours.data());
        gl.DrawArrays(GL_QUADS, 0, 4 * kSide);
        gl.DisableClientState(GL_COLOR_ARRAY);
    }

    std::vector<std::array<float, 2>> m_columns{}, m_rows{};
};

ColourFormat format(const char* name) {
    const auto all = knownColourFormats();
    return *std::find_if(all.begin(), all.end(), [&](const ColourFormat& f) { return f.name == name; });
}

struct Case {
    BlendUnit unit = BlendUnit::IdealRound;
    const char* format = "8888";
    DitherMode dither = DitherMode::Off;
};

class EachUnit : public testing::TestWithParam<Case> {
  protected:
    FrameState frameAt(int x, int y) const {
        return {GetParam().unit, format(GetParam().format), GetParam().dither, x, kSide - 1 - y};
    }

    ChipArithmetic chip() const {
        return {.fidelity = Fidelity::Chip,
                .unit = GetParam().unit,
                .dither = GetParam().dither,
                .undithered = GetParam().dither};
    }

    bool isGs() const { return GetParam().unit == BlendUnit::Gs || GetParam().unit == BlendUnit::GsWrap; }

    /// The PS2's alpha is 1 at 128: OpenGL's 255.
    Rgba entering(Rgba source) const {
        if (isGs()) source[3] = (2 * source[3] * 128 + 255) / 510;
        return source;
    }

    /// How many pixels are not what blendInto() says, after @p state blended sourceOf(x + @p shift) over
    /// @p before.
    int differences(const BlendState& state, int shift, const std::vector<Rgba>& before,
                    const std::vector<Rgba>& after, std::string& first) const {
        int wrong = 0;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const auto i = std::size_t(y) * kSide + std::size_t(x);
                const Rgba source = sourceOf((x + shift) & 255);
                const auto expected = blendInto(frameAt(x, y), state, entering(source), before[i]);
                if (expected && *expected == after[i]) continue;
                if (wrong++ == 0)
                    first = fmt::format("{} {}: S {} D {}: {} instead of {}", name(state.source),
                                        name(state.destination), testing::PrintToString(source),
                                        testing::PrintToString(before[i]), testing::PrintToString(after[i]),
                                        testing::PrintToString(*expected));
            }
        return wrong;
    }

    static void blend(const GlTable& gl, const BlendState& state) {
        gl.Enable(GL_BLEND);
        gl.BlendFunc(glEnum(state.source), glEnum(state.destination));
        const bool wraps = state.operation == BlendOperation::AddWrap;
        gl.BlendEquation(wraps ? GL_FUNC_ADD_WRAP : glEnum(BlendEquation(state.operation)));
        gl.BlendColor(0.2f, 0.4f, 0.6f, 0.8f);
    }
};

/// The states that a unit has: each factor on each side, the pairs that belong together, each equation.
std::vector<BlendState> statesOf(const FrameState& frame, const Rgba& constant) {
    using enum BlendFactor;
    std::set<std::tuple<BlendFactor, BlendFactor, BlendOperation>> wanted;
    for (int factor = 0; factor < 15; ++factor) {
        wanted.insert({BlendFactor(factor), Zero, BlendOperation::Add});
        wanted.insert({One, BlendFactor(factor), BlendOperation::Add});
    }
    for (const BlendFactor factor : {SrcColor, DstColor, SrcAlpha, DstAlpha, ConstantColor, ConstantAlpha}) {
        wanted.insert({factor, BlendFactor(int(factor) + 1), BlendOperation::Add});
        wanted.insert({BlendFactor(int(factor) + 1), factor, BlendOperation::Add});
    }
    for (const BlendOperation operation : {BlendOperation::Subtract, BlendOperation::ReverseSubtract,
                                           BlendOperation::Min, BlendOperation::Max, BlendOperation::AddWrap})
        for (const auto& [source, destination] : {std::pair(One, One), {SrcAlpha, One}, {DstColor, SrcColor}})
            wanted.insert({source, destination, operation});
    std::vector<BlendState> states;
    for (const auto& [source, destination, operation] : wanted) {
        const BlendState state{source, destination, operation, constant};
        if (blendInto(frame, state, sourceOf(9), {1, 1, 1, 1})) states.push_back(state);
    }
    return states;
}

TEST_P(EachUnit, BlendsAllValuesAsItsIntegerFunctionDoes) {
    Square square(format(GetParam().format), chip());
    std::vector<Rgba> before;
    const std::vector<BlendState> states = statesOf(frameAt(0, 0), entering({51, 102, 153, 204}));
    EXPECT_GT(states.size(), 0u);
    for (const BlendState& state : states) {
        square.gl.Disable(GL_BLEND);
        square.drawRows(destinationOf);
        if (before.empty()) before = square.codes();
        blend(square.gl, state);
        square.drawColumns(sourceOf);
        std::string first;
        EXPECT_EQ(differences(state, 0, before, square.codes(), first), 0) << first;
    }
}

// All values at each of the matrix's cells: opaque, and under one blend.
TEST_P(EachUnit, DithersAllValuesInAllCells) {
    if (GetParam().dither == DitherMode::Off) return;
    Square square(format(GetParam().format), chip());
    const std::vector<BlendState> states = statesOf(frameAt(0, 0), {});
    const auto added = std::find_if(states.begin(), states.end(), [](const BlendState& s) {
        return s.source == BlendFactor::SrcAlpha && s.destination == BlendFactor::OneMinusSrcAlpha;
    });
    const BlendState& state = added == states.end() ? states.back() : *added;
    for (int rows = 0; rows < 4; ++rows)
        for (int columns = 0; columns < 4; ++columns) {
            square.gl.Disable(GL_BLEND);
            square.drawRows([&](int y) { return destinationOf((y + rows) & 255); });
            const std::vector<Rgba> before = square.codes();
            int wrong = 0;
            for (int y = 0; y < kSide; ++y)
                for (int x = 0; x < kSide; ++x) {
                    const Rgba value = entering(destinationOf((y + rows) & 255));
                    for (std::size_t c = 0; c < 3; ++c) {
                        const FrameState frame = frameAt(x, y);
                        const FrameChannel channel{frame.unit, channelBits(square.m_format, int(c)),
                                                   frame.dither, ditherCell(frame.dither, frame.x, frame.y)};
                        wrong += stored(channel, enteringSource(channel, value[c])) !=
                                 before[std::size_t(y) * kSide + std::size_t(x)][c];
                    }
                }
            EXPECT_EQ(wrong, 0);
            blend(square.gl, state);
            square.drawColumns([&](int x) { return sourceOf((x + columns) & 255); });
            std::string first;
            EXPECT_EQ(differences(state, columns, before, square.codes(), first), 0) << first;
        }
}

// The arithmetic of masks: one colour for a whole draw, which the program may be made for.
TEST_P(EachUnit, DoublesHalvesAndInvertsAllCodesAsMasksWantIt) {
    const BlendUnit unit = GetParam().unit;
    if (unit == BlendUnit::IdealRound || unit == BlendUnit::IdealFloor) return;  // they work on codes there
    Square square(format(GetParam().format), chip());
    struct Step {
        MaskOperation operation{};
        BlendFactor source{}, destination{};
        int grey = 255;
    };
    using enum BlendFactor;
    for (const Step& step :
         {Step{MaskOperation::Double, DstColor, One}, Step{MaskOperation::Halve, DstColor, Zero, 128},
          Step{MaskOperation::Halve, DstColor, Zero, 127}, Step{MaskOperation::Halve, Zero, SrcColor, 128},
          Step{MaskOperation::Invert, OneMinusDstColor, Zero}}) {
        square.gl.Disable(GL_BLEND);
        square.drawRows(destinationOf);
        const std::vector<Rgba> before = square.codes();
        blend(square.gl, {step.source, step.destination});
        const float grey = float(step.grey) / 255;
        square.gl.Color4f(grey, grey, grey, 1);
        const auto channelAt = [&](int c, int x, int y) {
            const FrameState frame = frameAt(x, y);
            return FrameChannel{unit, channelBits(square.m_format, c), frame.dither,
                                ditherCell(frame.dither, frame.x, frame.y)};
        };
        if (!apply(channelAt(0, 0, 0), step.operation, 1, step.grey)) continue;
        // apply() means black over the mask on the RIVA, and on the PlayStation the average with black.
        if (unit == BlendUnit::Nv3 || unit == BlendUnit::Psx) continue;
        // The same setting as (dst_color, zero) where the constant goes into a weight; another product else.
        const bool toWeight =
            isGs() || unit == BlendUnit::Rdp || unit == BlendUnit::Virge || unit == BlendUnit::Ds;
        if (step.destination == SrcColor && !toWeight) continue;
        square.fill();
        const std::vector<Rgba> after = square.codes();
        int wrong = 0;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                for (int c = 0; c < 3; ++c) {
                    const auto i = std::size_t(y) * kSide + std::size_t(x);
                    const FrameChannel channel = channelAt(c, x, y);
                    const auto expected =
                        apply(channel, step.operation, before[i][std::size_t(c)], step.grey);
                    wrong += expected && *expected != after[i][std::size_t(c)];
                }
        EXPECT_EQ(wrong, 0) << name(step.source) << " " << step.grey;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Chips, EachUnit,
    testing::Values(Case{BlendUnit::IdealRound}, Case{BlendUnit::IdealFloor},
                    Case{BlendUnit::ProductsRound, "565"}, Case{BlendUnit::ProductsFloor},
                    Case{BlendUnit::VoodooMame, "565"}, Case{BlendUnit::Voodoo86Box, "565"},
                    Case{BlendUnit::VoodooMame, "565", DitherMode::Matrix4x4Subtract},
                    Case{BlendUnit::VoodooMame, "565", DitherMode::Matrix4x4},
                    Case{BlendUnit::Voodoo86Box, "565", DitherMode::Matrix2x2Subtract},
                    Case{BlendUnit::PowerVr}, Case{BlendUnit::Flipper, "6666"}, Case{BlendUnit::Ge, "565"},
                    Case{BlendUnit::Ge, "4444"}, Case{BlendUnit::Nv2a}, Case{BlendUnit::Nv2a, "565"},
                    Case{BlendUnit::Nv2a, "555"}, Case{BlendUnit::Virge, "555"}, Case{BlendUnit::Rdp, "5551"},
                    Case{BlendUnit::Nv3, "555"}, Case{BlendUnit::Gs, "5551"},
                    Case{BlendUnit::Gs, "5551", DitherMode::Gs}, Case{BlendUnit::GsWrap, "888"},
                    Case{BlendUnit::Virge, "555", DitherMode::Virge}, Case{BlendUnit::Virge, "888"},
                    Case{BlendUnit::Rdp, "5551", DitherMode::RdpMagic},
                    Case{BlendUnit::Rdp, "8888", DitherMode::RdpBayer},
                    Case{BlendUnit::Ge, "5551", DitherMode::Ge}, Case{BlendUnit::Psx, "555", DitherMode::Psx},
                    Case{BlendUnit::Ds, "6666"}, Case{BlendUnit::PowerVr, "4444"},
                    Case{BlendUnit::IdealFloor, "1555"}),
    [](const auto& test) {
        const Case& c = test.param;
        return fmt::format("{}_{}_{}", name(c.unit), c.format, name(c.dither));
    });

}  // namespace emulation_test
}  // namespace gnomon
