// The chips' programs against the integer functions of profile/, over all values of source and destination.

#include "gl/emulation.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gl/surface.h"
#include "gl/words.h"
#include "profile/frame_channel.h"
#include "profile/words.h"

namespace gnomon {
namespace {

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
    Surface surface;
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
    /// The PS2's alpha is 1 at 128: OpenGL's 255.
    static Rgba entering(Rgba source) {
        if (GetParam().unit == BlendUnit::Gs || GetParam().unit == BlendUnit::GsWrap)
            source[3] = (2 * source[3] * 128 + 255) / 510;
        return source;
    }

    /// Blends all sources over all destinations; how many pixels are not what blendInto() says.
    int differences(Square& square, const BlendState& state, std::string& first) {
        const GlTable& gl = square.gl;
        gl.Disable(GL_BLEND);
        square.drawRows(destinationOf);
        const std::vector<Rgba> before = square.codes();
        gl.Enable(GL_BLEND);
        gl.BlendFunc(glEnum(state.source), glEnum(state.destination));
        const bool wraps = state.operation == BlendOperation::AddWrap;
        gl.BlendEquation(wraps ? GL_FUNC_ADD_WRAP : glEnum(BlendEquation(state.operation)));
        gl.BlendColor(0.2f, 0.4f, 0.6f, 0.8f);
        square.drawColumns(sourceOf);
        const std::vector<Rgba> after = square.codes();
        int wrong = 0;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const auto i = std::size_t(y) * kSide + std::size_t(x);
                const FrameState frame{GetParam().unit, format(GetParam().format), GetParam().dither, x,
                                       kSide - 1 - y};
                const auto expected = blendInto(frame, state, entering(sourceOf(x)), before[i]);
                if (expected && *expected == after[i]) continue;
                if (wrong++ == 0)
                    first = fmt::format("{} {}: S {} D {}: {} instead of {}", name(state.source),
                                        name(state.destination), testing::PrintToString(sourceOf(x)),
                                        testing::PrintToString(before[i]), testing::PrintToString(after[i]),
                                        testing::PrintToString(*expected));
            }
        return wrong;
    }
};

TEST_P(EachUnit, BlendsAsItsIntegerFunctionDoes) {
    const Case& c = GetParam();
    Square square(format(c.format),
                  {.fidelity = Fidelity::Chip, .unit = c.unit, .dither = c.dither, .undithered = c.dither});
    int states = 0;
    for (const BlendOperation operation :
         {BlendOperation::Add, BlendOperation::Subtract, BlendOperation::ReverseSubtract, BlendOperation::Min,
          BlendOperation::AddWrap}) {
        for (int source = 0; source < 15; ++source) {
            for (int destination = 0; destination < 15; ++destination) {
                // All pairs are too many: each factor meets one, zero and itself.
                const bool few = destination <= 1 || source <= 1 || source == destination ||
                                 (source ^ 1) == (destination ^ 0);
                if (!few || (operation != BlendOperation::Add && source != destination)) continue;
                BlendState state{BlendFactor(source), BlendFactor(destination), operation,
                                 entering({51, 102, 153, 204})};
                if (!blendInto({c.unit, format(c.format), c.dither, 0, 0}, state, sourceOf(9), {1, 1, 1, 1}))
                    continue;
                ++states;
                std::string first;
                EXPECT_EQ(differences(square, state, first), 0) << first;
            }
        }
    }
    EXPECT_GT(states, 1);
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

}  // namespace
}  // namespace gnomon
