// A mesh file, the first byte of the input says which: '0' OBJ, '1' PLY, '2' STL, '3' glTF, '4' GLB. Its walk
// is tried here; only what that takes is loaded whole, in the process of its own in which Assimp may crash.

#ifdef GNOMON_LIBFUZZER
#include <pthread.h>
#include <sanitizer/common_interface_defs.h>

#include <csignal>
#endif

#include <chrono>

#include "scene/gltf.h"
#include "scene/mesh_check.h"
#include "scene_checks.h"

namespace gnomon::fuzz {
namespace {

constexpr const char* kNames[] = {"mesh.obj", "mesh.ply", "mesh.stl", "mesh.gltf", "mesh.glb"};

void checkGltf(const GltfFacts& facts) {
    checkLights(facts.lights);
    for (const std::string& note : facts.notes) require(!note.empty() && isOneLine(note), "note");
}

/// What the file says of itself.
MeshFacts walk(const std::filesystem::path& file, std::string_view content, int format) {
    if (format == 0) return checkObj(file, content, kSmallLimits);
    if (format == 1) return checkPly(file, content, kSmallLimits);
    if (format == 2) return checkStl(file, content, kSmallLimits);
    const GltfFacts facts = readGltf(file, content, kSmallLimits);
    checkGltf(facts);
    return facts.mesh;
}

/// Adds the seconds of its life to a sum.
class Timer {
  public:
    explicit Timer(double& sum) : m_sum(sum) {}
    ~Timer() { m_sum += std::chrono::duration<double>(Clock::now() - m_begin).count(); }
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;

  private:
    using Clock = std::chrono::steady_clock;
    double& m_sum;
    Clock::time_point m_begin = Clock::now();
};

/// A crash of Assimp's is to end its process, and libFuzzer is to hear nothing of it.
void leaveCrashesAlone() {
#ifdef GNOMON_LIBFUZZER
    pthread_atfork(nullptr, nullptr, [] {
        __sanitizer_set_death_callback([] {});
        for (const int one : {SIGSEGV, SIGBUS, SIGABRT, SIGILL, SIGFPE, SIGTRAP}) std::signal(one, SIG_DFL);
    });
#endif
}

}  // namespace
}  // namespace gnomon::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon::fuzz;
    static const Folder folder;
    static const bool isLeftAlone = (leaveCrashesAlone(), true);
    if (!isLeftAlone || size == 0) return 0;
    const std::string_view content = textOf(data + 1, size - 1);
    const int format = (data[0] + 5 - '0' % 5) % 5;
    const auto file = folder.write(kNames[format], content);
    // A process for each good input takes long: half of the time is for walks.
    static double walked = 0, loaded = 0;
    constexpr double kLoadedFirst = 10;  // seconds: enough for a corpus
    takenOrRefused<gnomon::SceneError>(file.string() + ":", [&] {
        {
            const Timer timer(walked);
            const gnomon::MeshFacts facts = walk(file, content, format);
            require(facts.triangles <= kSmallLimits.triangles, "more triangles than the limit");
        }
        if (loaded > walked + kLoadedFirst) return;
        const Timer timer(loaded);
        checkScene(gnomon::loadScene(file, {}, kSmallLimits));
    });
    return 0;
}
