#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>

#include "app/command_line.h"
#include "app/options.h"
#include "matrix/cell_store.h"
#include "matrix/expectations.h"
#include "process/interrupt.h"
#include "report/run_file.h"
#include "text/one_line.h"

namespace {

enum Exit { kBadInput = 2, kOurFault = 3 };

int fail(Exit status, const std::string& what) {
    // Where standard error is closed, too, there is nobody to tell.
    std::fputs(fmt::format("gnomon: {}\n", gnomon::oneLine(what)).c_str(), stderr);
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    gnomon::exitOnInterrupt();
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of who writes it
    int status = 0;
    try {
        gnomon::CommandLine commandLine;
        status = commandLine.parse(argc, argv)();
    } catch (const gnomon::UsageError& error) {
        return fail(kBadInput, error.what());
    } catch (const gnomon::ExpectationError& error) {
        return fail(kBadInput, error.what());
    } catch (const gnomon::StoreError& error) {
        return fail(kBadInput, error.what());
    } catch (const gnomon::RunError& error) {
        return fail(kBadInput, error.what());
    } catch (const gnomon::SceneError& error) {
        return fail(kBadInput, error.what());
    } catch (const gnomon::ProfileError& error) {
        return fail(kBadInput, error.what());
    } catch (const std::exception& error) {
        const bool isOutput = std::ferror(stdout) || std::ferror(stderr);
        return fail(isOutput ? kBadInput : kOurFault, error.what());
    }
    errno = 0;
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
        return fail(kBadInput, fmt::format("standard output: {}", std::strerror(errno ? errno : EIO)));
    return status;
}
