#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "app/commands.h"
#include "app/options.h"
#include "report/mesh_report.h"

namespace gnomon {
namespace {

constexpr int kMostRingLights = 10'000;

struct MeshOptions {
    SceneOption scenes{};
    int ringLights = 16;
    FormatOption format{};
};

int run(MeshOptions options) {
    options.scenes.ground = "no";
    options.scenes.lights = "all";
    std::vector<MeshFacts> meshes;
    for (const Scene& scene : options.scenes.load()) {
        if (std::none_of(scene.objects.begin(), scene.objects.end(),
                         [](const Object& object) { return object.casts; }))
            throw UsageError(fmt::format("{}: no object casts a shadow", scene.id));
        for (const std::string& note : scene.notes) fmt::print(stderr, "{}: {}\n", scene.id, note);
        meshes.push_back(meshFacts(scene, options.ringLights));
    }
    fmt::print("{}", showMeshes(meshes, options.format.value()));
    return 0;
}

}  // namespace

void addMesh(CLI::App& app, Task& chosen) {
    const auto options = std::make_shared<MeshOptions>();
    CLI::App* command = app.add_subcommand("mesh", "What a mesh's topology means for shadow volumes");
    command->add_option("scene,--scene", options->scenes.ids, "mesh file, scene file, scene id")
        ->delimiter(',')
        ->required()
        ->type_name("ID|FILE");
    command->add_option("--light", options->scenes.light,
                        "x,y,z of a point light, or x,y,z,0 towards one at infinity, instead of the file's");
    command
        ->add_option("--ring", options->ringLights,
                     "number of lights of the ring around the mesh for which volumes are counted; 0: no ring")
        ->capture_default_str()
        ->check(CLI::Range(0, kMostRingLights));
    options->format.addTo(*command);
    command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace gnomon
