// What a mesh's topology means, as text, JSON and CSV.

#include "report/mesh_report.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "scene/primitives.h"

namespace gnomon {
namespace mesh_report_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
using Json = nlohmann::json;

/// A box in two objects, each open; its top a second time; a degenerate triangle of each kind.
MeshFacts faulty(int ringLights) {
    Scene scene;
    scene.id = "models/a, \"b\".ply";
    const Mesh whole = box({2, 2, 2});
    for (int part = 0; part < 2; ++part) {
        Mesh half = whole;
        half.triangles.assign(whole.triangles.begin() + 6 * part, whole.triangles.begin() + 6 * (part + 1));
        scene.objects.push_back({.name = part == 0 ? "left" : "right", .mesh = half});
    }
    scene.objects[0].mesh.triangles.push_back(whole.triangles[0]);
    scene.dropped = {.repeatedVertex = 5, .flat = {{glm::vec3(0), glm::vec3(1), glm::vec3(2)}}};
    scene.lights = {{.position = {5, 5, 5, 1}}};
    return meshFacts(scene, ringLights);
}

MeshFacts closed(int ringLights) {
    Scene scene;
    scene.id = "torus";
    scene.objects.push_back({.name = "torus", .mesh = torus(2, 0.5, 16, 8)});
    scene.chosenLight = true;
    return meshFacts(scene, ringLights);
}

std::string lineWith(const std::string& text, const std::string& words) {
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        if (line.find(words) != std::string::npos) return line;
    return "no line with " + words;
}

TEST(MeshReport, TextSaysWhatAClosedMeshIsInOneColumn) {
    const std::string text = showMeshes({closed(0)}, Format::Text);
    EXPECT_THAT(text, HasSubstr("torus: closed manifold, genus 1\n"));
    EXPECT_THAT(text, Not(HasSubstr("as drawn")));
    EXPECT_THAT(text, Not(HasSubstr("object by object")));
    EXPECT_EQ(lineWith(text, "unique edges"), "unique edges                          384");
    EXPECT_THAT(text, HasSubstr("triangular    right\nvisible       right\nmanifold      right\n"
                                "winding       right\nper-triangle  right\n"));
    EXPECT_THAT(text, Not(HasSubstr("Published"))) << "no light, no volume";
}

TEST(MeshReport, TextSaysWhereObjectsDifferFromTheWhole) {
    const std::string text = showMeshes({faulty(4)}, Format::Text);
    EXPECT_THAT(text, AllOf(HasSubstr("as drawn"), HasSubstr("object by object")));
    EXPECT_THAT(text, HasSubstr("degenerate: 5 triangles repeat a vertex and are left out; 1 have no area"));
    EXPECT_THAT(lineWith(text, "duplicates, the same way"), HasSubstr("1"));
    EXPECT_THAT(lineWith(text, "manifold   "), HasSubstr("refused"));
    EXPECT_THAT(lineWith(text, "caps turned"), HasSubstr("refused"));
    EXPECT_THAT(text, AllOf(HasSubstr("4 point lights around (0, 0, 0)"), HasSubstr("of the scene")));
    EXPECT_THAT(text, AllOf(HasSubstr("per-triangle / winding, of all lights: polygons "),
                            HasSubstr("1.846 = 4440000")));
}

TEST(MeshReport, TextSaysWhereOnlyTheWholeIsClosed) {
    Scene scene;
    const Mesh whole = box({2, 2, 2});
    for (int part = 0; part < 2; ++part) {
        Mesh half = whole;
        half.triangles.assign(whole.triangles.begin() + 6 * part, whole.triangles.begin() + 6 * (part + 1));
        scene.objects.push_back({.mesh = half});
    }
    EXPECT_THAT(showMeshes({meshFacts(scene, 0)}, Format::Text),
                HasSubstr("Closed as a whole, but 2 of 2 objects are open"));
}

TEST(MeshReport, JsonHoldsWhatTheTextShows) {
    const Json json = Json::parse(showMeshes({faulty(4), closed(1)}, Format::Json));
    ASSERT_THAT(json, SizeIs(2));
    EXPECT_EQ(json[0]["mesh"], "models/a, \"b\".ply");
    EXPECT_EQ(json[0]["degenerate"]["repeated_vertex"], 5);
    EXPECT_EQ(json[0]["degenerate"]["zero_area"], 1);
    EXPECT_EQ(json[0]["file"]["triangles"], 14);
    EXPECT_EQ(json[0]["drawn"]["triangles"], 13);
    EXPECT_EQ(json[0]["drawn"]["edges_by_valence"], (Json{{"2", 15}, {"3", 3}}));
    EXPECT_EQ(json[0]["drawn"]["genus"], nullptr);
    EXPECT_EQ(json[0]["objects"][1]["name"], "right");
    EXPECT_EQ(json[0]["silhouettes"][2]["silhouette"], "manifold");
    EXPECT_EQ(json[0]["silhouettes"][2]["verdict"], "refused");
    ASSERT_THAT(json[0]["lights"], SizeIs(2));
    EXPECT_THAT(json[0]["lights"][0]["volumes"], SizeIs(4)) << "manifold is refused";
    EXPECT_THAT(json[0]["lights"][0]["lights"], SizeIs(4));

    EXPECT_EQ(json[1]["file"]["genus"], 1);
    const Json& winding = json[1]["lights"][0]["volumes"][3];
    EXPECT_EQ(winding["silhouette"], "winding");
    EXPECT_EQ(winding["sides"]["min"], winding["sides"]["max"]) << "one light";
}

TEST(MeshReport, CsvHasALinePerLightsAndSilhouette) {
    const std::string csv = showMeshes({faulty(4), closed(0)}, Format::Csv);
    std::istringstream stream(csv);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    ASSERT_THAT(lines, SizeIs(1 + 2 * kSilhouettes + kSilhouettes));
    EXPECT_TRUE(lines[1].starts_with("\"models/a, \"\"b\"\".ply\","));
    const auto commas = [](std::string line) {
        // Not those within quotes.
        bool quoted = false;
        std::size_t count = 0;
        for (const char c : line) {
            if (c == '"') quoted = !quoted;
            count += c == ',' && !quoted;
        }
        return count;
    };
    for (const std::string& line : lines) EXPECT_EQ(commas(line), commas(lines[0])) << line;
}

}  // namespace mesh_report_test
}  // namespace gnomon
