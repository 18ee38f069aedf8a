// Files that appear whole or not at all, interrupted too.

#include "image/whole_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "process/interrupt.h"

namespace gnomon {
namespace whole_file_test {

/// A folder that is removed afterwards.
class WriteWhole : public testing::Test {
  protected:
    WriteWhole() {
        std::string name = std::filesystem::temp_directory_path() / "gnomon-whole-XXXXXX";
        if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
        m_folder = name;
    }
    ~WriteWhole() override { std::filesystem::remove_all(m_folder); }

    /// The exit status of a process that is interrupted while it writes half of @p file, and before the rest.
    int statusOfInterrupted(const std::filesystem::path& file, int signal) const {
        const pid_t pid = fork();
        if (pid == 0) {
            exitOnInterrupt();
            writeWhole(file, [&](const std::filesystem::path& temporary) {
                std::ofstream out(temporary);
                out << "first";
                raise(signal);
                out << " second";
            });
            _exit(0);
        }
        int status = 0;
        waitpid(pid, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(m_folder))
            names.push_back(entry.path().filename());
        return names;
    }

    std::filesystem::path m_folder{};
};

TEST_F(WriteWhole, EndsItsFileBeforeAnInterruptEndsTheProcess) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        EXPECT_EQ(statusOfInterrupted(m_folder / "file.txt", signal), 128 + signal);
        EXPECT_THAT(files(), testing::ElementsAre("file.txt"));
        std::ostringstream text;
        text << std::ifstream(m_folder / "file.txt").rdbuf();
        EXPECT_EQ(text.str(), "first second");
    }
}

TEST_F(WriteWhole, WritesATextAsItIs) {
    const std::string text("a\0b\r\n", 5);
    writeWhole(m_folder / "file.txt", text);
    std::ostringstream back;
    back << std::ifstream(m_folder / "file.txt", std::ios::binary).rdbuf();
    EXPECT_EQ(back.str(), text);
}

TEST_F(WriteWhole, LeavesNothingOfWhatThrows) {
    EXPECT_THROW(writeWhole(m_folder / "file.txt",
                            [](const std::filesystem::path& temporary) {
                                std::ofstream(temporary) << "half";
                                throw std::runtime_error("no room");
                            }),
                 std::runtime_error);
    EXPECT_THAT(files(), testing::IsEmpty());
}

}  // namespace whole_file_test
}  // namespace gnomon
