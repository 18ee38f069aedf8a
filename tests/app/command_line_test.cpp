// Command lines that are parsed and not run, and refusals of hostile ones.

#include "app/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <numeric>

#include "app/matrix_options.h"
#include "program.h"

namespace gnomon {
namespace command_line_test {

using testing::HasSubstr;
using testing::Not;

class CommandLines : public ProgramTest {
  protected:
    /// What is asked for; nothing if it is refused, and refusal() says why.
    Task parse(const std::vector<const char*>& words) {
        std::vector<const char*> arguments{"gnomon"};
        arguments.insert(arguments.end(), words.begin(), words.end());
        try {
            return m_commandLine.parse(int(arguments.size()), arguments.data());
        } catch (const UsageError& error) {
            m_refusal = error.what();
            return {};
        }
    }
    const std::string& refusal() const { return m_refusal; }

  private:
    CommandLine m_commandLine{};
    std::string m_refusal{};
};

TEST_F(CommandLines, AreNotRunWhenTheyAreParsed) {
    const std::string image = pathOf("a.png");
    const Task task = parse({"render", "no-such-scene", "-o", image.c_str()});
    ASSERT_TRUE(task);
    EXPECT_THAT(leftBehind(), testing::IsEmpty());
    EXPECT_THROW(task(), SceneError);
    ASSERT_TRUE(parse({"--version"}));
    testing::internal::CaptureStdout();
    EXPECT_EQ(parse({"--help"})(), 0);
    EXPECT_THAT(testing::internal::GetCapturedStdout(), HasSubstr("\n  matrix "));
}

TEST_F(CommandLines, AreTakenOneAfterTheOther) {
    EXPECT_FALSE(parse({"matrix", "--jobs", "0"}));
    EXPECT_THAT(refusal(), HasSubstr("--jobs"));
    EXPECT_TRUE(parse({"matrix", "--jobs", "1"}));
    EXPECT_FALSE(parse({}));
}

TEST_F(CommandLines, AreRefusedInOneLineWhateverTheyHold) {
    for (const char* hostile : {"a\nb", "\x1b[2J\n", "--a\nb", "--a\r=\nb", "-\n"})
        for (const char* command : {"matrix", "profiles", "render", ""}) {
            const std::vector<const char*> both{command, "--format", hostile};
            EXPECT_FALSE(parse(*command ? both : std::vector<const char*>{hostile})) << hostile;
            EXPECT_NE(refusal(), "");
            EXPECT_EQ(refusal().find_first_of("\n\r\x1b"), std::string::npos) << refusal();
        }
    expectRefused(run({"matrix\nboxes"}), "no such command 'matrix boxes'");
    expectRefused(run({"render", "--profile", "a\nb"}), "no such chip 'a b'");
    expectRefused(run({"render", "a\nb"}), "a b: neither a file nor a scene");
    expectRefused(run({"render", "--size", "4x4\n"}), "--size: '4 ' is not a whole number");
}

std::string numbersTo(int last) {
    std::vector<int> all(static_cast<std::size_t>(last));
    std::iota(all.begin(), all.end(), 1);
    return fmt::format("{}", fmt::join(all, ","));
}

TEST_F(CommandLines, WithMoreCombinationsThanTheLimitAreRefused) {
    const std::string thousand = numbersTo(1000);
    std::string dropped;
    const auto methods = [&](const std::string& line) { return optionsOf(choiceFrom(line)).methods; };
    EXPECT_EQ(methods("--method williams --map-size " + thousand).axes(dropped).size(), 1000u);
    EXPECT_THAT(
        ([&] {
            methods("--method williams --map-bias 0.1,0.2 --map-size " + numbersTo(8000)).axes(dropped);
        }),
        testing::ThrowsMessage<UsageError>(
            "more than the 10000 methods and combinations of axes that gnomon takes"));
}

TEST_F(CommandLines, NameAFrameOrASizeOnce) {
    EXPECT_THAT(parseFrames({"3", "0-4", "2-5", "0"}), testing::ElementsAre(3, 0, 1, 2, 4, 5));
    EXPECT_EQ(parseFrames(std::vector<std::string>(1000, "0-99999")).size(), 100'000u);
    expectRefused(run({"matrix", "boxes", "--frames", "0-2000000000"}),
                  "--frames: '0-2000000000' is no range of frames");
    expectRefused(run({"matrix", "boxes", "--frames", "0-100000"}), "is no range of frames");
    expectRefused(run({"render", "boxes", "--size", "100000x100000"}),
                  "100000 in '100000x100000' is not within 1 to 8192");
    EXPECT_EQ(optionsOf(choiceFrom("--size 4x4,5x5,4x4")).sizes.value().size(), 2u);
}

}  // namespace command_line_test
}  // namespace gnomon
