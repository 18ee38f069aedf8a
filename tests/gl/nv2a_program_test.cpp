// The Xbox's programs on OSMesa against 39,962 results that were recorded on a console (nv2a.md).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "gl/pixel_words.h"
#include "gl/words.h"
#include "profile/nv2a_recordings.h"
#include "profile/words.h"
#include "test_surface.h"

namespace gnomon {
namespace nv2a_program_test {

constexpr int kSide = 256;

GLenum equationOf(BlendOperation operation) {
    for (std::size_t i = 0; i < names<BlendEquation>().size(); ++i)
        if (operationOf(BlendEquation(i)) == operation) return glEnum(BlendEquation(i));
    return 0;
}

/// One point per row, each with a colour of its own.
void draw(const GlTable& gl, const std::vector<const nv2a::Row*>& rows, Rgba nv2a::Row::*colour) {
    std::vector<std::array<float, 2>> positions;
    std::vector<std::array<std::uint8_t, 4>> colours;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto at = [](std::size_t pixel) { return float(2 * pixel + 1) / kSide - 1; };
        positions.push_back({at(i % kSide), at(i / kSide)});
        const Rgba& c = rows[i]->*colour;
        colours.push_back({std::uint8_t(c[0]), std::uint8_t(c[1]), std::uint8_t(c[2]), std::uint8_t(c[3])});
    }
    gl.EnableClientState(GL_VERTEX_ARRAY);
    gl.EnableClientState(GL_COLOR_ARRAY);
    gl.VertexPointer(2, GL_FLOAT, 0, positions.data());
    gl.ColorPointer(4, GL_UNSIGNED_BYTE, 0, colours.data());
    gl.DrawArrays(GL_POINTS, 0, GLsizei(rows.size()));
}

TEST(Nv2aPrograms, MakeEveryRecordedResult) {
    const auto rows = nv2a::recordings();
    if (rows.empty()) GTEST_SKIP() << nv2a::kRecordings << " is not there";
    using Key = std::tuple<BlendFactor, BlendFactor, BlendOperation, Rgba>;
    std::map<std::string, std::map<Key, std::vector<const nv2a::Row*>>> formats;
    for (const nv2a::Row& row : rows) {
        const BlendState& state = row.state;
        formats[row.format.name][{state.source, state.destination, state.operation, state.constant}]
            .push_back(&row);
    }
    std::size_t compared = 0;
    int wrong = 0;
    std::string first;
    for (const auto& [name, states] : formats) {
        const ColourFormat& f = states.begin()->second.front()->format;
        const BufferFormat buffers{
            .red = f.red, .green = f.green, .blue = f.blue, .alpha = f.alpha, .depth = 0, .stencil = 0};
        TestSurface surface(buffers, kSide, kSide, {.fidelity = Fidelity::Chip, .unit = BlendUnit::Nv2a});
        const GlTable& gl = surface.driver();
        gl.Viewport(0, 0, kSide, kSide);
        for (const auto& [key, group] : states) {
            const BlendState& state = group.front()->state;
            ASSERT_LE(group.size(), std::size_t(kSide) * kSide);
            gl.Disable(GL_BLEND);
            draw(gl, group, &nv2a::Row::destination);
            gl.Enable(GL_BLEND);
            gl.BlendFunc(glEnum(state.source), glEnum(state.destination));
            gl.BlendEquation(equationOf(state.operation));
            const auto share = [&](std::size_t c) { return float(std::max(state.constant[c], 0)) / 255; };
            gl.BlendColor(share(0), share(1), share(2), share(3));
            draw(gl, group, &nv2a::Row::source);
            std::vector<std::uint8_t> bytes(std::size_t(4) * kSide * kSide);
            gl.ReadPixels(0, 0, kSide, kSide, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
            for (std::size_t i = 0; i < group.size(); ++i)
                for (std::size_t c = 0; c < 4; ++c) {
                    const int expected = group[i]->result[c];
                    if (expected < 0 || channelBits(buffers, int(c)) == 0) continue;
                    ++compared;
                    if (bytes[4 * i + c] == expected) continue;
                    if (wrong++ == 0)
                        first = fmt::format("{} in {}: {}", int(bytes[4 * i + c]), c, group[i]->line);
                }
        }
    }
    EXPECT_EQ(wrong, 0) << "of " << compared << ", first: " << first;
    EXPECT_EQ(rows.size(), 39'962u);
    EXPECT_GT(compared, 80'000u);
}

}  // namespace nv2a_program_test
}  // namespace gnomon
