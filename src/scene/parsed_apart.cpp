#include "scene/parsed_apart.h"

#include "process/child.h"
#include "scene/mesh_bytes.h"
#include "scene/text.h"

namespace gnomon {

MeshFile parsedApart(const std::filesystem::path& file, const std::function<MeshFile()>& parse) {
    const Apart done = doneApart([&] {
        try {
            return toBytes(parse());
        } catch (const SceneError&) {
            throw;
        } catch (const std::exception& error) {
            fail(file, error.what());  // no memory, say
        }
    });
    if (!done.thrown.empty()) throw SceneError(done.thrown);
    if (!done.crash.empty()) fail(file, fmt::format("its parser {}", done.crash));
    return meshFileFrom(done.result);
}

}  // namespace gnomon
