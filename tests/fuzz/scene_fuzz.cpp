// A scene file: what draws can take all of it, or it is refused in one line.

#include "scene_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon::fuzz;
    static const Folder folder;
    const auto file = folder.write("scene.toml", textOf(data, size));
    takenOrRefused<gnomon::SceneError>(file.string() + ":",
                                       [&] { checkScene(gnomon::loadScene(file, {}, kSmallLimits)); });
    return 0;
}
