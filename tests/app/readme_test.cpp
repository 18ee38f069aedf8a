// The README's blocks are what the commands above them print. To bring them up to date:
//     GNOMON_UPDATE_README=1 build/release/tests/app_tests --gtest_filter='Readme.*'

#include <fmt/format.h>

#include <cstdlib>

#include "program.h"

namespace gnomon {
namespace readme_test {

const std::filesystem::path kReadme = std::filesystem::path(GNOMON_SOURCE) / "README.md";

/// A block "<!-- gnomon ARGUMENTS -->", a fence, text, a fence. "| head -N" after the arguments leaves the
/// first N lines.
struct Block {
    std::vector<std::string> arguments{};
    std::size_t lines = std::string::npos;
    std::size_t begin = 0, end = 0;  ///< of the text
};

std::vector<Block> blocksOf(const std::string& readme) {
    const std::string mark = "<!-- gnomon ", fence = "```\n";
    std::vector<Block> blocks;
    for (std::size_t at = 0; (at = readme.find(mark, at)) != std::string::npos;) {
        Block block;
        const std::size_t close = readme.find(" -->", at);
        std::istringstream words(readme.substr(at + mark.size(), close - at - mark.size()));
        for (std::string word; words >> word && word != "|";) block.arguments.push_back(word);
        std::string head;
        int lines = 0;
        if (words >> head >> lines) block.lines = std::size_t(-lines);
        block.begin = readme.find(fence, close) + fence.size();
        block.end = readme.find(fence, block.begin);
        blocks.push_back(block);
        at = block.end;
    }
    return blocks;
}

std::string firstLines(const std::string& text, std::size_t lines) {
    std::size_t end = 0;
    for (; lines > 0 && end < text.size(); --lines) end = std::min(text.find('\n', end), text.size() - 1) + 1;
    return text.substr(0, end);
}

class Readme : public ProgramTest {};

TEST_F(Readme, BlocksAreWhatTheirCommandsPrint) {
    std::string readme = contentOf(kReadme);
    const std::vector<Block> blocks = blocksOf(readme);
    ASSERT_GE(blocks.size(), 4u);
    const bool update = std::getenv("GNOMON_UPDATE_README") != nullptr;
    // From the last to the first: replacing one leaves the places of those before it.
    for (std::size_t i = blocks.size(); i-- > 0;) {
        const Outcome outcome = run(blocks[i].arguments);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const std::string text = firstLines(outcome.out, blocks[i].lines);
        if (update)
            readme.replace(blocks[i].begin, blocks[i].end - blocks[i].begin, text);
        else
            EXPECT_EQ(readme.substr(blocks[i].begin, blocks[i].end - blocks[i].begin), text);
    }
    if (update) std::ofstream(kReadme, std::ios::binary) << readme;
}

/// The anchor that web pages of Markdown give a heading.
std::string anchorOf(const std::string& heading) {
    std::string anchor;
    for (const char c : heading) {
        if (c == ' ') anchor += '-';
        if (std::isalnum(static_cast<unsigned char>(c)) || c == '-')
            anchor += char(std::tolower(static_cast<unsigned char>(c)));
    }
    return anchor;
}

TEST_F(Readme, ContentsNameEverySectionInItsOrder) {
    std::istringstream lines(contentOf(kReadme));
    std::vector<std::string> named, sections;
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind("## ", 0) == 0)
            sections.push_back(fmt::format("- [{}](#{})", line.substr(3), anchorOf(line.substr(3))));
        if (line.rfind("- [", 0) == 0 && line.find("](#") != std::string::npos) named.push_back(line);
    }
    EXPECT_EQ(named, sections);
    EXPECT_GE(sections.size(), 10u);
}

/// The README's block of code in @p language number @p index.
std::string codeOf(const std::string& readme, const std::string& language, int index) {
    const std::string fence = fmt::format("```{}\n", language);
    std::size_t begin = 0;
    for (int i = 0; i <= index; ++i) begin = readme.find(fence, begin) + fence.size();
    return readme.substr(begin, readme.find("```", begin) - begin);
}

// The chip of the README is a chip.
TEST_F(Readme, ToyChipWorks) {
    const std::string toy = write("toy.toml", codeOf(contentOf(kReadme), "toml", 0));
    EXPECT_EQ(run({"profiles", toy}).status, 0);
    const Outcome outcome = run({"matrix", "boxes", "--frames", "0", "--size", "64x48", "--profile", toy});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, testing::ContainsRegex("\nroettger-screen +exact "));
}

// Its scene has a shadow to draw.
TEST_F(Readme, SceneWorks) {
    const std::string scene = write("my.toml", codeOf(contentOf(kReadme), "toml", 1));
    const Outcome outcome =
        run({"matrix", scene, "--size", "64x48", "--profile", "ideal", "--method", "none,carmack"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, testing::ContainsRegex("\nnone +WRONG "));
    EXPECT_THAT(outcome.out, testing::ContainsRegex("\ncarmack +exact "));
}

std::string withoutSpace(std::string text) {
    std::erase_if(text, [](unsigned char c) { return std::isspace(c); });
    return text;
}

// Its method stands where it says.
TEST_F(Readme, MethodIsOneOfTheSource) {
    const std::string names =
        contentOf(std::filesystem::path(GNOMON_SOURCE) / "src" / "method" / "names.cpp");
    EXPECT_THAT(withoutSpace(names), testing::HasSubstr(withoutSpace(codeOf(contentOf(kReadme), "cpp", 0))));
}

TEST_F(Readme, MapNamesEveryLayer) {
    const std::string readme = contentOf(kReadme);
    for (const auto& folder :
         std::filesystem::directory_iterator(std::filesystem::path(GNOMON_SOURCE) / "src")) {
        if (!folder.is_directory()) continue;
        EXPECT_NE(readme.find(fmt::format("src/{} ", folder.path().filename().string())), std::string::npos)
            << folder.path();
    }
}

}  // namespace readme_test
}  // namespace gnomon
