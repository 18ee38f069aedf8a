// Stability as a property: a scene that is told in another way, moved, turned, or drawn larger, shows the
// same shadows in every pixel that is not tied, right or wrong, with every method.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <optional>
#include <set>

#include "expected/known_results.h"
#include "nasty_scenes.h"
#include "shown.h"
#include "variants.h"

namespace gnomon {
namespace stability_test {

std::vector<Way> ways() {
    std::vector<Way> all;
    const auto add = [&](const std::string& profile, const Axes& axes) {
        all.push_back({chip(profile), axes});
    };
    add("ideal", method("heidmann"));
    add("tnt", method("carmack"));
    add("ideal", with(method("heidmann"), Count::ZpassCap));
    add("voodoo2", method("roettger-screen"));
    add("dreamcast", method("roettger-alpha"));  // no stencil
    add("psp-5551", method("roettger-screen"));  // five bits
    add("psp-5551", method("roettger-screen-max"));
    add("ideal", method("hornus"));
    add("ideal", method("eisemann"));
    add("ideal", method("counter"));
    add("ideal", method("parity"));
    for (const Silhouette s : {Silhouette::PerTriangle, Silhouette::Triangular, Silhouette::Visible})
        add("ideal", with(with(method("heidmann"), Count::ZpassCap), s));
    return all;
}

/// One way to tell a scene anew.
struct Variant {
    std::string name{};
    std::function<std::optional<Scene>(const Scene&)> make{};
    bool onGrid = false;    ///< of a scene on a grid
    bool reorders = false;  ///< volumes come in another order
};

std::vector<Variant> variants() {
    std::vector<Variant> all = {
        {"corners", [](const Scene& s) { return cornersTurned(s, 1); }},
        {"triangles", [](const Scene& s) { return trianglesShuffled(s, 2); }},
        {"vertices", [](const Scene& s) { return verticesShuffled(s, 3); }},
        {"volumes", [](const Scene& s) { return volumesShuffled(s, 4); }, false, true},
        {"larger", [](const Scene& s) { return scaled(s, 7); }},
        {"smaller", [](const Scene& s) { return scaled(s, -11); }},
        {"turned about x", [](const Scene& s) { return turned(s, 0); }},
        {"turned about y", [](const Scene& s) { return turned(s, 1); }},
        {"turned about z", [](const Scene& s) { return turned(s, 2); }},
        {"unseen caster", withUnseenCaster},
        {"moved",
         [](const Scene& s) {
             const float most = std::ldexp(1.0f, exponentOf(s));
             return moved(s, {most, -most / 4, most / 2});
         },
         true},
        {"split", [](const Scene& s) { return edgesSplit(s, 3, 5); }, true},
    };
    return all;
}

/// A test run draws each scene in two ways, others from scene to scene; GNOMON_STABILITY=all in the
/// environment makes it all of them.
std::vector<Way> waysFor(const std::string& scene) {
    const std::vector<std::string> ids = stableSceneIds();
    const auto place = std::size_t(std::find(ids.begin(), ids.end(), scene) - ids.begin());
    const char* wanted = std::getenv("GNOMON_STABILITY");
    const bool isAll = wanted && std::string(wanted) == "all";
    const auto known = knownResults("stability.txt");  // says why
    std::vector<Way> all = ways(), chosen;
    for (std::size_t i = 0; i < all.size(); ++i)
        if ((isAll || (i + place) % 7 == 0) && !known.contains({scene, all[i].name()}))
            chosen.push_back(all[i]);
    return chosen;
}

class StableScenes : public testing::TestWithParam<std::vector<std::string>> {
  protected:
    /// Holds the ways to draw @p base against how they draw its variants.
    static void expectStable(const Scene& base, bool onGrid) {
        const std::vector<Way> all = waysFor(base.id);
        std::vector<Shown> before;
        Lab lab(base);
        for (const Way& way : all) {
            before.push_back(shown(lab, way));
            // A cell without pictures would be like any other.
            ASSERT_FALSE(before.back().pictures.judgement.pixels.empty())
                << way.name() << ": " << resultOf(before.back().cell);
        }
        for (const Variant& variant : variants()) {
            const std::optional<Scene> told = variant.onGrid == onGrid ? variant.make(base) : std::nullopt;
            if (!told) continue;
            Lab other(*told);
            for (std::size_t i = 0; i < all.size(); ++i) {
                if (variant.reorders && all[i].dependsOnOrder()) continue;
                EXPECT_EQ(difference(before[i], shown(other, all[i])), "")
                    << variant.name << ", " << all[i].name();
            }
        }
    }
};

TEST_P(StableScenes, ShowTheSameHoweverTheyAreTold) {
    for (const std::string& id : GetParam()) {
        SCOPED_TRACE(id);
        const Scene scene = stableScene(id);
        expectStable(scene, false);
        expectStable(onGrid(scene), true);
    }
}

INSTANTIATE_TEST_SUITE_P(Groups, StableScenes, testing::ValuesIn(stableSceneGroups()),
                         [](const auto& test) { return testNameOf(test.param); });

}  // namespace stability_test
}  // namespace gnomon
