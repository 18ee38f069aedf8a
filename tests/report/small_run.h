#pragma once

#include "matrix/run.h"
#include "profile/profile.h"
#include "report/run_pictures.h"
#include "scene/load.h"

namespace gnomon {

/// A small run with exact, wrong and refused cells, and all that it is drawn from.
struct SmallRun {
    MatrixRequest request{};
    RunSources sources{};
    std::vector<Cell> cells{};
};

inline const SmallRun& smallRun() {
    static const SmallRun run = [] {
        const std::filesystem::path root(GNOMON_SOURCE);
        SmallRun r;
        for (const char* id : {"ideal", "voodoo2", "tnt", "tnt2", "ps1"})
            r.request.profiles.push_back(loadProfile(root / "profiles" / (std::string(id) + ".toml")));
        for (const char* id : {"none", "carmack", "roettger-screen", "roettger-alpha", "roettger-half"})
            r.request.methods.push_back(findMethod(id)->axes);
        r.request.scenes = {loadScene(root / "scenes/boxes.toml")};
        r.request.sizes = {{48, 36}};
        r.request.frames = {0, 10};
        for (const Profile& profile : r.request.profiles) r.sources.profiles.emplace(profile.id, profile);
        r.sources.scenes.emplace(std::pair(r.request.scenes[0].id, r.request.view), r.request.scenes[0]);
        r.cells = runMatrix(r.request);
        return r;
    }();
    return run;
}

}  // namespace gnomon
