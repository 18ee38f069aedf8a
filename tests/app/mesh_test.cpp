// gnomon mesh, as a user runs it; real meshes where the folder GNOMON_SHARED/data is there.

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "program.h"

namespace gnomon {
namespace mesh_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::SizeIs;
using Json = nlohmann::json;

const std::filesystem::path kData = std::filesystem::path(GNOMON_SHARED) / "data";

class MeshCommand : public ProgramTest {
  protected:
    void expectRefused(const std::vector<std::string>& arguments, const std::string& what) const {
        ProgramTest::expectRefused(run(arguments), what);
    }

    Json jsonOf(const std::filesystem::path& file, const std::string& ringLights = "0") const {
        const Outcome outcome = run({"mesh", file.string(), "--ring", ringLights, "--format", "json"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return Json::parse(outcome.out, nullptr, false)[0];
    }
};

TEST_F(MeshCommand, RefusesBadInputInOneLine) {
    expectRefused({"mesh"}, "scene");
    expectRefused({"mesh", "boxen"}, "boxen: ");
    expectRefused({"mesh", "/nowhere/mesh.ply"}, "/nowhere/mesh.ply");
    expectRefused({"mesh", "boxes", "--ring", "-1"}, "--ring");
    expectRefused({"mesh", "boxes", "--ring", "many"}, "--ring");
    expectRefused({"mesh", "boxes", "--light", "1,2"}, "--light");
    expectRefused({"mesh", "boxes", "--format", "xml"}, "xml");
    const std::string broken = write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 one 0\nf 1 2 3\n");
    expectRefused({"mesh", broken}, broken + ":3: ");
    const std::string still =
        write("still.toml",
              "[light]\nposition = [0, 5, 0]\n[camera]\neye = [0, 1, 5]\ntarget = [0, 0, 0]\n"
              "[[objects]]\nshape = \"box\"\nsize = [1, 1, 1]\ncasts = false\n");
    expectRefused({"mesh", still}, still.substr(still.rfind('/') + 1, 5) + ": no object casts");
}

TEST_F(MeshCommand, PrintsOneObjectPerMesh) {
    const Outcome outcome = run({"mesh", "boxes,knot", "--format", "json"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
    const Json json = Json::parse(outcome.out, nullptr, false);
    ASSERT_TRUE(json.is_array());
    ASSERT_THAT(json, SizeIs(2));
    EXPECT_EQ(json[0]["mesh"], "boxes");
    EXPECT_EQ(json[0]["objects_without_shadow"], 1) << "the floor";
    EXPECT_EQ(json[1]["file"]["genus"], 1);
    EXPECT_EQ(json[1]["lights"][0]["lights"].size(), 16u);
}

// Assimp makes an object of each group; the file is one closed box.
TEST_F(MeshCommand, WeldsTheGroupsOfAFileAndAddsNoFloor) {
    const std::string box =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
        "g one\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\ng two\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 1 1 2\n";
    const Json mesh = jsonOf(write("box.obj", box));
    EXPECT_EQ(mesh["kind"], "closed manifold, genus 0");
    EXPECT_EQ(mesh["degenerate"]["repeated_vertex"], 1);
    EXPECT_THAT(mesh["objects"], SizeIs(2));
    EXPECT_EQ(mesh["by_object"]["balanced"], false);
    EXPECT_THAT(mesh["lights"], SizeIs(0)) << "no ring, and the file has no light";
    EXPECT_THAT(run({"mesh", pathOf("box.obj")}).out,
                HasSubstr("Closed as a whole, but 2 of 2 objects are open"));
}

TEST_F(MeshCommand, CountsForTheLightOfTheCommandLine) {
    const Json light =
        Json::parse(run({"mesh", "knot", "--ring", "0", "--light", "0,1,0,0", "--format", "json"}).out);
    EXPECT_EQ(light[0]["lights"][0]["lights"], (Json{{0, 1, 0, 0}}));
}

class RealMesh : public MeshCommand {
  protected:
    /// Over all lights of the file; 0 where the silhouette is refused.
    static std::size_t polygonsOf(const Json& mesh, const std::string& silhouette) {
        for (const Json& volumes : mesh["lights"][0]["volumes"])
            if (volumes["silhouette"] == silhouette) return volumes["polygons"]["sum"].get<std::size_t>();
        return 0;
    }

    void SetUp() override {
        if (!std::filesystem::exists(kData)) GTEST_SKIP() << kData << " is missing";
    }
};

TEST_F(RealMesh, MalformedOnesAreRefusedInOneLine) {
    for (const auto& entry : std::filesystem::directory_iterator(kData / "malformed")) {
        if (entry.path().extension() == ".bin") continue;
        SCOPED_TRACE(entry.path());
        expectRefused({"mesh", entry.path()}, entry.path().string() + ":");
    }
}

TEST_F(RealMesh, ArmadilloSuitsEveryBuilder) {
    const Json mesh = jsonOf(kData / "meshes/armadillo.ply");
    EXPECT_EQ(mesh["kind"], "closed manifold, genus 0");
    EXPECT_EQ(mesh["file"]["triangles"], 345944);
    EXPECT_EQ(mesh["file"]["vertices"], 172974);
    for (const Json& builder : mesh["silhouettes"]) EXPECT_EQ(builder["verdict"], "right");
}

TEST_F(RealMesh, NonManifoldMeshIsNamedEdgeByEdge) {
    const Json mesh = jsonOf(kData / "meshes/thingi_55581.stl");
    EXPECT_EQ(mesh["file"]["boundary_edges"], 3);
    EXPECT_EQ(mesh["file"]["non_manifold_edges"], 25);
    EXPECT_EQ(mesh["file"]["winding_conflicts"], 4);
    EXPECT_EQ(mesh["file"]["edges_by_valence"]["3"], 25);
    EXPECT_EQ(mesh["silhouettes"][2]["verdict"], "refused");
    EXPECT_THAT(mesh["silhouettes"][2]["refusal"].get<std::string>(),
                AllOf(HasSubstr("object 0"), HasSubstr("edge "), HasSubstr("from (")));
    EXPECT_EQ(mesh["silhouettes"][3]["verdict"], "right");
}

// The level that stands for that of Aldridge and Woods: 391,694 edges, 3,897 of three or more triangles.
TEST_F(RealMesh, CryptWithItsLightsNeedsLessThanHalfOfThePolygonsOfBruteForce) {
    const Json mesh = jsonOf(kData / "scenes/crypt_248lights_fine.glb");
    EXPECT_EQ(mesh["file"]["edges"], 391694);
    EXPECT_EQ(mesh["file"]["non_manifold_edges"], 3897);
    EXPECT_EQ(mesh["file"]["max_valence"], 6);
    EXPECT_EQ(mesh["file"]["t_junctions"], 1491);
    EXPECT_EQ(mesh["degenerate"]["zero_area"], 117);
    ASSERT_THAT(mesh["lights"], SizeIs(1));
    EXPECT_THAT(mesh["lights"][0]["lights"], SizeIs(248));
    EXPECT_EQ(polygonsOf(mesh, "manifold"), 0u) << "refused";
    // The signs are exact, so these are the same on every machine. The README has them.
    EXPECT_EQ(polygonsOf(mesh, "per-triangle"), 216'030'580u);
    EXPECT_EQ(polygonsOf(mesh, "winding"), 91'304'430u);
    const Json coarse = jsonOf(kData / "scenes/crypt_248lights.glb");
    EXPECT_EQ(polygonsOf(coarse, "per-triangle"), 34'854'755u);
    EXPECT_EQ(polygonsOf(coarse, "winding"), 17'025'011u);
}

}  // namespace mesh_test
}  // namespace gnomon
