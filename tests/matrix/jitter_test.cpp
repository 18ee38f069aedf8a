// Tiny motions of eye and light, 10^-6 to 10^-5 of the scene's size: a pixel that is tied neither before nor
// after, and in which truth stays the same, must not turn from right to wrong nor back.
//
// GNOMON_JITTER=1000 in the environment makes so many motions of each scene; a test run makes few.

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "nasty_scenes.h"
#include "shown.h"
#include "variants.h"

namespace gnomon {
namespace jitter_test {

constexpr int kMotions = 5;  ///< unless the environment says otherwise

int motions() {
    const char* wanted = std::getenv("GNOMON_JITTER");
    return wanted ? std::max(1, std::atoi(wanted)) : kMotions;
}

/// Moves positions by 10^-6 to 10^-5 of a scene's extent along each axis, or by one unit in the last place
/// where that is more.
class Jitter {
  public:
    explicit Jitter(Scene scene) {
        glm::vec3 low(INFINITY), high(-INFINITY);
        eachPosition(scene, [&](const glm::vec3& p) { low = glm::min(low, p), high = glm::max(high, p); });
        m_extent = glm::distance(low, high);
    }

    glm::vec3 moved(glm::vec3 p) { return moved(p, m_extent); }
    glm::vec3 turned(const glm::vec3& direction) { return moved(direction, 1); }

  private:
    glm::vec3 moved(glm::vec3 p, float size) {
        std::uniform_real_distribution<float> exponent(-6, -5);
        for (int k = 0; k < 3; ++k) {
            const float by = size * std::pow(10.0f, exponent(m_random)) * (m_random() % 2 ? 1.0f : -1.0f);
            p[k] = p[k] + by != p[k] ? p[k] + by : std::nextafter(p[k], by > 0 ? INFINITY : -INFINITY);
        }
        return p;
    }

    std::mt19937 m_random{11};
    float m_extent = 0;
};

bool isWrong(PixelVerdict verdict) {
    return verdict >= PixelVerdict::WrongEdge;
}

/// Whether a pixel beside pixel @p i is wrong, or right, as @p wrong says.
bool hasBeside(const Shown& shown, std::size_t i, bool wrong) {
    const int width = shown.cell.width, height = shown.cell.height;
    const int x = int(i) % width, y = int(i) / width;
    for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u) {
            const std::size_t at = std::size_t(v) * std::size_t(width) + std::size_t(u);
            if (at != i && isWrong(shown.pictures.judgement.pixels[at]) == wrong) return true;
        }
    }
    return false;
}

/// The untied pixels that turn from right to wrong or back although truth there stays the same; empty if
/// none.
///
/// A mask that loses counts has regions that are wrong, and they end where one volume more or less lies
/// before the surface, which is no tie. So where the frame was not exact to begin with, a pixel may become
/// what one beside it has been: the region's boundary moved.
std::string turnedPixels(const Shown& before, const Shown& after) {
    const bool withBoundary = before.cell.verdict != Verdict::Exact;
    std::string text;
    for (std::size_t i = 0; i < before.pictures.judgement.pixels.size(); ++i) {
        const PixelVerdict a = before.pictures.judgement.pixels[i], b = after.pictures.judgement.pixels[i];
        if (a == PixelVerdict::Tied || b == PixelVerdict::Tied || isWrong(a) == isWrong(b)) continue;
        if (before.pictures.truth.data[i] != after.pictures.truth.data[i]) continue;
        if (withBoundary && hasBeside(before, i, isWrong(b))) continue;
        text += fmt::format("({}, {}) {} ", i % std::size_t(before.cell.width),
                            i / std::size_t(before.cell.width), isWrong(b) ? "is wrong" : "is right");
    }
    return text;
}

class JitteredScenes : public testing::TestWithParam<std::vector<std::string>> {
  protected:
    static void expectStable(const Scene& scene);
};

void JitteredScenes::expectStable(const Scene& scene) {
    const std::vector<Way> ways = {{chip("ideal"), with(method("heidmann"), Count::ZpassCap)},
                                   {chip("tnt"), method("carmack")},
                                   {chip("voodoo2"), method("roettger-screen")}};
    std::vector<Shown> before;
    Lab lab(scene);
    for (const Way& way : ways) {
        before.push_back(shown(lab, way));
        ASSERT_FALSE(before.back().pictures.judgement.pixels.empty())
            << way.name() << ": " << resultOf(before.back().cell);
    }

    Jitter jitter(scene);
    const int count = motions();
    // A light that moves makes all volumes anew.
    const int motionsOfEye = std::max(5, count / 20);
    for (int motion = 0; motion < count; motion += motionsOfEye) {
        Scene moved = scene;
        for (Light& light : moved.lights) {
            const glm::vec3 p(light.position);
            light.position =
                light.position.w == 0 ? glm::vec4(jitter.turned(p), 0) : glm::vec4(jitter.moved(p), 1);
        }
        moved.frames.assign(std::size_t(std::min(motionsOfEye, count - motion)), scene.frames[0]);
        for (Camera& camera : moved.frames) camera.eye = jitter.moved(camera.eye);
        Lab other(moved);
        for (int frame = 0; frame < int(moved.frames.size()); ++frame) {
            for (std::size_t w = 0; w < ways.size(); ++w) {
                const std::string pixels = turnedPixels(before[w], shown(other, ways[w], frame));
                EXPECT_EQ(pixels, "") << ways[w].name() << ", motion " << motion + frame;
            }
        }
    }
}

TEST_P(JitteredScenes, TurnNoUntiedPixelWrongOrRight) {
    for (const std::string& id : GetParam()) {
        SCOPED_TRACE(id);
        expectStable(stableScene(id));
    }
}

INSTANTIATE_TEST_SUITE_P(Groups, JitteredScenes, testing::ValuesIn(stableSceneGroups()),
                         [](const auto& test) { return testNameOf(test.param); });

}  // namespace jitter_test
}  // namespace gnomon
