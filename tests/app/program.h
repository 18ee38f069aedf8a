#pragma once

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

/// What came of one run.
struct Outcome {
    int status = -1;  ///< 128 + signal if one ended it
    std::string out{}, err{};
};

inline std::string contentOf(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

/// A test with a folder of its own, removed afterwards, in which the program's outputs go.
class ProgramTest : public testing::Test {
  protected:
    ProgramTest() {
        std::string name = std::filesystem::temp_directory_path() / "gnomon-cli-XXXXXX";
        if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
        m_folder = name;
    }
    ~ProgramTest() override { std::filesystem::remove_all(m_folder); }

    Outcome run(const std::vector<std::string>& given) const {
        std::vector<std::string> arguments{GNOMON_PROGRAM};
        arguments.insert(arguments.end(), given.begin(), given.end());
        const std::string out = m_folder / "stdout", err = m_folder / "stderr";
        const pid_t pid = fork();
        if (pid == 0) {
            dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
            dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
            std::vector<char*> argv;
            for (std::string& argument : arguments) argv.push_back(argument.data());
            argv.push_back(nullptr);
            execv(argv[0], argv.data());
            _exit(127);
        }
        int status = 0;
        waitpid(pid, &status, 0);
        return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contentOf(out),
                contentOf(err)};
    }

    /// Holds @p outcome to the rule for bad arguments and files: status 2, one line on standard error that
    /// has @p what in it, nothing on standard output.
    static void expectRefused(const Outcome& outcome, const std::string& what) {
        using namespace testing;
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_THAT(outcome.err, AllOf(StartsWith("gnomon: "), EndsWith("\n"), HasSubstr(what)));
    }

    std::string write(const std::string& name, std::string_view content) const {
        std::ofstream(m_folder / name, std::ios::binary) << content;
        return m_folder / name;
    }
    std::string pathOf(const std::string& name) const { return m_folder / name; }

    /// Names of the files that a run left in the folder.
    std::vector<std::string> leftBehind() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(m_folder)) {
            const std::string name = entry.path().filename();
            if (name != "stdout" && name != "stderr") names.push_back(name);
        }
        return names;
    }

  private:
    std::filesystem::path m_folder{};
};

}  // namespace gnomon
