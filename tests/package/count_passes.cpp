// count_passes FILE: how many passes a method takes on the chip of a profile, and what draws.

#include <cstdio>

#include "gl/device.h"
#include "method/method.h"
#include "profile/profile.h"

int main(int, char** arguments) {
    using namespace gnomon;
    const Profile profile = loadProfile(arguments[1]);
    const FrameShape frame{.width = 320, .height = 240, .lights = {{.volumes = 2}}};
    for (const char* id : {"heidmann", "roettger-screen"}) {
        const Plan plan = planFrame(findMethod(id)->axes, frame, profile);
        const bool lacks = !missing(profile, plan).empty();
        std::printf("%s: %zu passes%s\n", id, plan.passes.size(), lacks ? ", refused" : "");
    }
    std::printf("%s\n", name(defaultDevice()));
}
