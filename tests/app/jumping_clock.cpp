// A library to be loaded before the C library: the time of day jumps by years from call to call, back and
// forth. Clocks that count from the start of the machine are as ever.

#include <dlfcn.h>
#include <sys/time.h>
#include <time.h>

#include <atomic>

namespace {

std::atomic<int> calls = 0;

/// Thirty years ago, or eighty years from now.
long jump() {
    constexpr long kYear = 31'557'600;
    return (++calls % 2 ? -30 : 80) * kYear;
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) {
    static const auto real =
        reinterpret_cast<int (*)(clockid_t, timespec*)>(dlsym(RTLD_NEXT, "clock_gettime"));
    const int status = real(clock, time);
    if (clock == CLOCK_REALTIME) time->tv_sec += jump();
    return status;
}

extern "C" time_t time(time_t* out) {
    timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    if (out) *out = now.tv_sec;
    return now.tv_sec;
}

extern "C" int gettimeofday(timeval* out, void*) {
    timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    *out = {now.tv_sec, now.tv_nsec / 1000};
    return 0;
}
