#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "profile/profile.h"

namespace gnomon {
namespace load_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

/// Line 1 is a title, so that the line of an error isn't the line 1 that stands for "the whole file".
constexpr auto kMinimal = "title = \"Chip\"\ncolour_formats = [\"565\"]\n";
/// A source for facts that need one.
constexpr auto kManual = "sources = [\"M [document]: a manual\"]\n";

/// A file of its own for each test; tests may run side by side.
std::filesystem::path fileWith(const std::string& content) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string stem = std::string(test->test_suite_name()) + "." + test->name();
    for (char& c : stem)
        if (c == '/') c = '_';
    const auto file = std::filesystem::path(testing::TempDir()) / (stem + ".toml");
    std::ofstream(file) << content;
    return file;
}

/// What loading a file of @p content says, without the file's name: ":line: what", or "" if it loads.
std::string errorOf(const std::string& content) {
    const auto file = fileWith(content);
    std::string error;
    try {
        loadProfile(file);
    } catch (const ProfileError& e) {
        error = e.what();
        EXPECT_EQ(error.substr(0, file.string().size()), file.string());
        error.erase(0, file.string().size());
    }
    std::filesystem::remove(file);
    return error;
}

Profile load(const std::string& content) {
    const auto file = fileWith(content);
    const Profile profile = loadProfile(file);
    std::filesystem::remove(file);
    return profile;
}

auto isFact(const std::string& key, const std::string& value, const std::string& source) {
    return AllOf(Field(&Profile::Fact::key, key), Field(&Profile::Fact::value, value),
                 Field(&Profile::Fact::source, source));
}

TEST(LoadProfile, TakesIdFromFileAndLeavesOutWhatIsAbsent) {
    const Profile profile = load(kMinimal);
    EXPECT_EQ(profile.id, "LoadProfile.TakesIdFromFileAndLeavesOutWhatIsAbsent");
    EXPECT_EQ(profile.title, "Chip");
    EXPECT_FALSE(profile.depth);
    EXPECT_EQ(profile.stencilBits, 0);
    EXPECT_THAT(profile.blendEquations, IsEmpty());
    EXPECT_EQ(profile.writeMask, WriteMask::Fixed);
}

TEST(LoadProfile, ReadsTheChipsArithmeticWithItsGrade) {
    const Profile profile = load(std::string(kMinimal) + kManual +
                                 "source_factors = [\"one\"]\ndestination_factors = [\"one\"]\n"
                                 "blend_equations = [\"add\"]\n"
                                 "blend_units = { value = [\"voodoo_mame\", \"voodoo_86box\"], source = "
                                 "\"M p. 1\", grade = \"guess\" }\n"
                                 "dither_modes = [\"2x2_subtract\", \"off\"]\n");
    EXPECT_THAT(profile.blendUnits, ElementsAre(BlendUnit::VoodooMame, BlendUnit::Voodoo86Box));
    EXPECT_THAT(profile.ditherModes, ElementsAre(DitherMode::Matrix2x2Subtract, DitherMode::Off));
    EXPECT_EQ(profile.gradeOf("blend_units"), Evidence::Guess) << "as the file says, whatever M is";
    EXPECT_EQ(profile.gradeOf("dither_modes"), Evidence::Guess) << "it has no source";
}

TEST(LoadProfile, KeepsFactsInFileOrderWithSources) {
    const Profile profile = load(
        "title = \"Chip\"\n"
        "year = 1998\n"
        "sources = [\"M [document]: a manual\"]\n"
        "texture_units = { value = 2, source = \"M p. 3\" }\n"
        "max_texture_size = 256\n"
        "alpha_bits = { value = 8, source = \"unsourced\" }\n"
        "colour_formats = { value = [\"8888\", \"565\"], source = \"M p. 1\" }\n"
        "gigabytes_per_second = { value = 1.5, source = \"M p. 9\", also = \"N says 1.6\" }\n"
        "megapixels_per_second = { value = 45, also = \"N says 50\" }\n"
        "culling = { value = true, source = \"M p. 2\" }\n");
    EXPECT_EQ(profile.year, 1998);
    EXPECT_THAT(profile.sources, ElementsAre(Profile::Source{"M", Evidence::Document, "a manual"}));
    EXPECT_THAT(
        profile.facts,
        ElementsAre(isFact("texture_units", "2", "M p. 3"), isFact("max_texture_size", "256", "unsourced"),
                    isFact("alpha_bits", "8", "unsourced"), isFact("colour_formats", "8888, 565", "M p. 1"),
                    isFact("gigabytes_per_second", "1.5", "M p. 9; also N says 1.6"),
                    isFact("megapixels_per_second", "45", "unsourced; also N says 50"),
                    isFact("culling", "true", "M p. 2")));
    EXPECT_EQ(profile.sourceOf("texture_units"), "M p. 3");
    EXPECT_EQ(profile.sourceOf("max_texture_size"), "unsourced");
    EXPECT_EQ(profile.sourceOf("stencil_bits"), "not in the profile");
}

// The first of several faults is the first of the file, not the first of the alphabet.
TEST(LoadProfile, ReportsFirstFaultOfTheFile) {
    EXPECT_THAT(errorOf("title = \"Chip\"\nyear = true\nalpha_bits = true\n"), HasSubstr(":2: year"));
}

TEST(LoadProfile, TakesZeroAndFalseAsSourcedAbsence) {
    const Profile profile = load(std::string(kMinimal) + kManual +
                                 "stencil_bits = { value = 0, source = \"M\" }\n"
                                 "stencil_wrap = false\ntwo_sided_stencil = false\n"
                                 "alpha_excludes_depth = false\nframe_texture = \"none\"\n");
    EXPECT_EQ(profile.stencilBits, 0);
    EXPECT_EQ(profile.sourceOf("stencil_bits"), "M");
}

// "No depth buffer" is a fact, too: a refusal can then say who says so.
TEST(LoadProfile, TakesAnEmptyListAsAbsenceIfItHasASource) {
    const Profile profile =
        load(std::string(kMinimal) + kManual + "depth_bits = { value = [], source = \"M p. 2\" }\n");
    EXPECT_FALSE(profile.depth);
    EXPECT_THAT(profile.depthBits, IsEmpty());
    EXPECT_THAT(profile.facts.back(), isFact("depth_bits", "none", "M p. 2"));
}

/// The grade of the fact that @p claim is the source and grade of; its file knows a source of each grade.
Evidence gradeOf(const std::string& claim) {
    return load(std::string(kMinimal) + "culling = { value = true, " + claim +
                " }\n"
                "sources = [\"R [recorded]: r\", \"D [document]: d\", \"EM U [emulator]: e\", \"DR [driver]: "
                "d\", "
                "\"X [derived]: x\", \"G [guess]: g\"]\n")
        .gradeOf("culling");
}

TEST(LoadProfile, GradesAFactByTheBestOfItsSources) {
    EXPECT_EQ(gradeOf("source = \"R\""), Evidence::Recorded);
    EXPECT_EQ(gradeOf("source = \"D p. 3\""), Evidence::Document);
    EXPECT_EQ(gradeOf("source = \"EM U: none\""), Evidence::Emulator);
    EXPECT_EQ(gradeOf("source = \"G; DR a.c:3, 4\""), Evidence::Driver);
    EXPECT_EQ(gradeOf("source = \"DR, twice; R; D\""), Evidence::Recorded);
    EXPECT_EQ(gradeOf("source = \"X\""), Evidence::Derived);
    EXPECT_EQ(gradeOf("source = \"G\", also = \"R says otherwise\""), Evidence::Guess);
}

TEST(LoadProfile, GradesWhatIsComputedFromSourcesAsDerived) {
    EXPECT_EQ(gradeOf("source = \"derived: D p. 3; R\""), Evidence::Derived);
    EXPECT_EQ(gradeOf("source = \"derived\""), Evidence::Derived);
}

TEST(LoadProfile, GradesWhatHasNoSourceAsGuessed) {
    EXPECT_EQ(gradeOf("source = \"unsourced\""), Evidence::Guess);
    EXPECT_EQ(gradeOf("source = \"unsourced: common belief\""), Evidence::Guess);
    EXPECT_EQ(gradeOf("also = \"R\""), Evidence::Guess);
    EXPECT_EQ(Profile{}.gradeOf("culling"), Evidence::Guess);
}

TEST(LoadProfile, LetsAFactHaveAGradeOfItsOwn) {
    EXPECT_EQ(gradeOf("source = \"R (of another chip)\", grade = \"guess\""), Evidence::Guess);
    EXPECT_EQ(gradeOf("source = \"D; EM U\", grade = \"emulator\""), Evidence::Emulator);
}

TEST(LoadProfile, ReadsEveryKey) {
    const Profile profile = load(
        "title = \"Chip\"\ncolour_formats = [\"4444\", \"1555\"]\nalpha_bits = 4\nblend_writes_alpha = true\n"
        "write_mask = \"channel\"\ndepth_bits = [24, 16]\ndepth_functions = [\"less\", \"always\"]\n"
        "stencil_bits = 8\nstencil_wrap = true\ntwo_sided_stencil = true\nsource_factors = [\"one\"]\n"
        "destination_factors = [\"src_color\"]\nblend_pairs = [\"zero dst_alpha\"]\n"
        "constant_source_pairs = [\"dst_color one\"]\nalpha_source_factors = [\"zero\"]\n"
        "alpha_destination_factors = [\"one\"]\nseparate_alpha_factors = true\n"
        "blend_equations = [\"max\"]\ntexture_units = 3\nmax_texture_size = 512\nmax_texture_aspect = 4\n"
        "texture_non_power_of_two = true\nframe_texture = \"direct\"\nculling = true\n"
        "polygon_offset_units = true\npolygon_offset_factor = true\nclip_planes = 6\nshaders = true\n"
        "max_width = 800\nmax_height = 600\nframe_bytes = 4194304\nmegapixels_per_second = 90\n"
        "megatriangles_per_second = 3.5\ngigabytes_per_second = 0.72\non_chip_frame = true\n"
        "bus_megabytes_per_second = 133\n");
    ASSERT_EQ(profile.colourFormats.size(), 2u);
    EXPECT_EQ(profile.colourFormats[0].name, "4444");
    EXPECT_EQ(profile.colourFormats[1].green, 5);
    EXPECT_EQ(profile.alphaBits, 4);
    EXPECT_TRUE(profile.blendWritesAlpha);
    EXPECT_EQ(profile.writeMask, WriteMask::Channel);
    EXPECT_TRUE(profile.depth);
    EXPECT_THAT(profile.depthBits, ElementsAre(24, 16));
    EXPECT_THAT(profile.depthFunctions, ElementsAre(Compare::Less, Compare::Always));
    EXPECT_EQ(profile.stencilBits, 8);
    EXPECT_TRUE(profile.stencilWrap && profile.twoSidedStencil);
    EXPECT_THAT(profile.sourceFactors, ElementsAre(BlendFactor::One));
    EXPECT_THAT(profile.destinationFactors, ElementsAre(BlendFactor::SrcColor));
    EXPECT_THAT(profile.blendPairs, ElementsAre(BlendPair{BlendFactor::Zero, BlendFactor::DstAlpha}));
    EXPECT_THAT(profile.constantSourcePairs, ElementsAre(BlendPair{BlendFactor::DstColor, BlendFactor::One}));
    EXPECT_THAT(profile.alphaSourceFactors, ElementsAre(BlendFactor::Zero));
    EXPECT_THAT(profile.alphaDestinationFactors, ElementsAre(BlendFactor::One));
    EXPECT_TRUE(profile.separateAlphaFactors);
    EXPECT_THAT(profile.blendEquations, ElementsAre(BlendEquation::Max));
    EXPECT_EQ(profile.textureUnits, 3);
    EXPECT_EQ(profile.maxTextureSize, 512);
    EXPECT_EQ(profile.maxTextureAspect, 4);
    EXPECT_TRUE(profile.textureNonPowerOfTwo);
    EXPECT_EQ(profile.frameTexture, FrameTexture::Direct);
    EXPECT_TRUE(profile.culling && profile.polygonOffsetUnits && profile.polygonOffsetFactor);
    EXPECT_EQ(profile.clipPlanes, 6);
    EXPECT_TRUE(profile.shaders);
    EXPECT_EQ(profile.maxWidth, 800);
    EXPECT_EQ(profile.maxHeight, 600);
    EXPECT_EQ(profile.frameBytes, 4194304);
    EXPECT_EQ(profile.megapixelsPerSecond, 90);
    EXPECT_EQ(profile.megatrianglesPerSecond, 3.5);
    EXPECT_EQ(profile.gigabytesPerSecond, 0.72);
    EXPECT_TRUE(profile.onChipFrame);
    EXPECT_EQ(profile.busMegabytesPerSecond, 133);
    EXPECT_EQ(profile.facts.size(), 35u /* one per line but the title */);
}

TEST(LoadProfile, ReadsWhatAChipDoesItsOwnWay) {
    const Profile profile =
        load(std::string(kMinimal) +
             "depth_bits = [16]\ndepth_functions = [\"less\"]\ndepth_encodings = [\"voodoo_w\", \"linear\"]\n"
             "alpha_functions = [\"gequal\", \"never\"]\nlogic_ops = true\nblend_pairs = [\"one one\"]\n"
             "blend_equations = [\"add_wrap\"]\nblend_units = [\"rdp\", \"gs_wrap\"]\n"
             "dither_modes = [\"gs_4x4\", \"virge_4x4\", \"psx_4x4\", \"rdp_magic\", \"rdp_bayer\", "
             "\"ge_4x4\"]\n");
    EXPECT_THAT(profile.depthEncodings, ElementsAre(DepthEncoding::VoodooW, DepthEncoding::Linear));
    EXPECT_THAT(profile.alphaFunctions, ElementsAre(Compare::Never, Compare::Gequal));
    EXPECT_TRUE(profile.logicOps);
    EXPECT_THAT(profile.blendEquations, ElementsAre(BlendEquation::AddWrap));
    EXPECT_THAT(profile.blendUnits, ElementsAre(BlendUnit::Rdp, BlendUnit::GsWrap));
    EXPECT_THAT(profile.ditherModes, ElementsAre(DitherMode::Gs, DitherMode::Virge, DitherMode::Psx,
                                                 DitherMode::RdpMagic, DitherMode::RdpBayer, DitherMode::Ge));
}

TEST(LoadProfile, AllowsProductOfSetsAndListedPairs) {
    const Profile profile = load(std::string(kMinimal) +
                                 "source_factors = [\"zero\", \"one\"]\n"
                                 "destination_factors = [\"zero\", \"src_color\"]\n"
                                 "blend_pairs = [\"one one\"]\n"
                                 "constant_source_pairs = [\"dst_color one\"]\n"
                                 "blend_equations = [\"add\"]\n");
    EXPECT_TRUE(profile.allowsBlend(BlendFactor::One, BlendFactor::SrcColor));
    EXPECT_TRUE(profile.allowsBlend(BlendFactor::One, BlendFactor::One));
    EXPECT_FALSE(profile.allowsBlend(BlendFactor::Zero, BlendFactor::One));
    EXPECT_FALSE(profile.allowsBlend(BlendFactor::DstColor, BlendFactor::One));
    EXPECT_TRUE(profile.allowsBlendWithConstantSource(BlendFactor::DstColor, BlendFactor::One));
    EXPECT_TRUE(profile.allowsBlendWithConstantSource(BlendFactor::One, BlendFactor::Zero));
    EXPECT_FALSE(profile.allowsBlendWithConstantSource(BlendFactor::Zero, BlendFactor::One));
}

// A file without lines to speak of: "file: what".
TEST(LoadProfileErrors, NameFileThatCantBeRead) {
    // A FIFO that nobody writes would block for ever.
    const std::string fifo = std::filesystem::path(testing::TempDir()) / "a_fifo.toml";
    std::filesystem::remove(fifo);
    ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
    for (const std::string& file : {std::string("/nowhere/chip.toml"), testing::TempDir(), fifo}) {
        try {
            loadProfile(file);
            ADD_FAILURE() << file << " was read";
        } catch (const ProfileError& e) {
            EXPECT_EQ(e.what(), file + ": can't be read");
        }
    }
}

TEST(LoadProfileErrors, NameFileAsPassedIn) {
    const auto file = fileWith("title = 3\n");
    const auto here = std::filesystem::relative(file);
    try {
        loadProfile(here);
        ADD_FAILURE() << "was read";
    } catch (const ProfileError& e) {
        EXPECT_EQ(e.what(), here.string() + ":1: title must be a string");
    }
    std::filesystem::remove(file);
}

TEST(LoadProfileErrors, GiveLineOfSyntaxErrorInOneLine) {
    for (const char* broken : {"title = \"Chip\"\nalpha_bits = = 8\n", "title = \"Chip\"\ntitle = \"Chip\"\n",
                               "title = \"Chip\"\nyear 1998\n"}) {
        const std::string error = errorOf(broken);
        EXPECT_THAT(error, testing::StartsWith(":2: ")) << broken;
        EXPECT_THAT(error, testing::Not(HasSubstr("\n"))) << broken;
    }
}

struct Fault {
    std::string name{};
    std::string lines{};  ///< after the two lines of kMinimal: the first is line 3
    std::string error{};
};
void PrintTo(const Fault& fault, std::ostream* out) {
    *out << fault.lines;
}

class FaultyProfile : public testing::TestWithParam<Fault> {};

TEST_P(FaultyProfile, IsRefusedWithLineAndReason) {
    EXPECT_EQ(errorOf(kMinimal + GetParam().lines), GetParam().error);
}

auto nameOfFault(const testing::TestParamInfo<Fault>& test) {
    return test.param.name;
}

const std::string kFactors =
    "zero, one, src_color, one_minus_src_color, dst_color, one_minus_dst_color, src_alpha, "
    "one_minus_src_alpha, dst_alpha, one_minus_dst_alpha, src_alpha_saturate, constant_color, "
    "one_minus_constant_color, constant_alpha, one_minus_constant_alpha";

INSTANTIATE_TEST_SUITE_P(
    Keys, FaultyProfile,
    testing::Values(
        Fault{"Unknown", "stencil_bit = 8\n",
              ":3: unknown key \"stencil_bit\"; did you mean \"stencil_bits\"?"},
        Fault{"American", "color_formats = 8\n",
              ":3: unknown key \"color_formats\"; did you mean \"colour_formats\"?"},
        Fault{"UnknownInTable", "culling = { value = true, sorce = \"M\" }\n",
              ":3: unknown key \"sorce\"; did you mean \"source\"?"},
        Fault{"UnknownInSection", "[culling]\nvalue = true\nalsol = \"N\"\n",
              ":5: unknown key \"alsol\"; did you mean \"also\"?"},
        Fault{"UnknownGrade", "culling = { value = true, grade = \"rumour\" }\n",
              ":3: unknown word \"rumour\" in culling's grade (known: recorded, document, "
              "emulator, driver, derived, guess)"},
        Fault{"GradeWithoutSource", "\nculling = { value = true, grade = \"document\" }\n",
              ":4: culling is unsourced: its grade is guess, not document"},
        Fault{"UnknownSource",
              "sources = [\"M [document]: a manual\"]\nculling = { value = true, source = \"N p. 3\" }\n",
              ":4: \"N p. 3\", a source of culling, is not in sources"},
        Fault{"UnknownSourceAmongKnown",
              "sources = [\"M [document]: a manual\"]\n[culling]\nvalue = true\nsource = \"M; Mx\"\n",
              ":6: \"Mx\", a source of culling, is not in sources"},
        Fault{"DerivedFromUnknownSource", "culling = { value = true, source = \"derived: M p. 3\" }\n",
              ":3: \"M p. 3\", a source of culling, is not in sources"},
        Fault{"SourceWithoutGrade", "sources = [\n\"M [document]: a\",\n\"N: b\"]\n",
              ":5: \"N: b\" in sources must be \"KEY [grade]: document\""},
        Fault{"SourceWithoutKey", "sources = [\" [document]: a\"]\n",
              ":3: \" [document]: a\" in sources must be \"KEY [grade]: document\""},
        Fault{"SourceWithUnknownGrade", "sources = [\n\"M [rumour]: a\"]\n",
              ":4: unknown word \"rumour\" in the grade of a source (known: recorded, document, "
              "emulator, driver, derived, guess)"},
        Fault{"SourceKeyTwice", "sources = [\"M [document]: a\", \"M [guess]: b\"]\n",
              ":3: sources has M twice"},
        Fault{"UnitWithoutBlending", "blend_units = [\"gs\"]\n", ":3: blend_units needs blend_equations"},
        Fault{"NoValue", "\nculling = { source = \"M\" }\n", ":4: culling has no value"},
        Fault{"UnknownSection", "[texture_unit]\nvalue = 1\n",
              ":3: unknown key \"texture_unit\"; did you mean \"texture_units\"?"}),
    nameOfFault);

INSTANTIATE_TEST_SUITE_P(
    Types, FaultyProfile,
    testing::Values(
        Fault{"TextForNumber", "alpha_bits = \"8\"\n", ":3: alpha_bits must be a whole number"},
        Fault{"FractionForNumber", "alpha_bits = 8.0\n", ":3: alpha_bits must be a whole number"},
        Fault{"InTable", "\n\nalpha_bits = { value = true, source = \"M\" }\n",
              ":5: alpha_bits must be a whole number"},
        Fault{"NumberForYesOrNo", "culling = 1\n", ":3: culling must be true or false"},
        Fault{"NumberForWord", "write_mask = 1\n", ":3: write_mask must be a string"},
        Fault{"TextForRate", "gigabytes_per_second = \"2\"\n", ":3: gigabytes_per_second must be a number"},
        Fault{"NumberForArray", "depth_bits = 16\n", ":3: depth_bits must be an array"},
        Fault{"TextInArray", "depth_bits = [\n  24,\n  \"16\"\n]\n", ":5: depth_bits must be a whole number"},
        Fault{"ArrayInArray", "depth_bits = [[24]]\n", ":3: depth_bits must be a whole number"},
        Fault{"NumberForFormat", "depth_functions = [565]\n", ":3: depth_functions must be a string"},
        Fault{"NumberForSource", "culling = { value = true, source = 3 }\n",
              ":3: culling's source must be a string"},
        Fault{"NumberForAlso", "culling = { value = true, also = 3 }\n",
              ":3: culling's also must be a string"},
        Fault{"TextForSources", "sources = \"M\"\n", ":3: sources must be an array"},
        Fault{"TextForYear", "year = \"1998\"\n", ":3: year must be a whole number"}),
    nameOfFault);

INSTANTIATE_TEST_SUITE_P(
    Words, FaultyProfile,
    testing::Values(
        Fault{"Mask", "write_mask = \"bit\"\n",
              ":3: unknown word \"bit\" in write_mask (known: fixed, group, channel)"},
        Fault{"FrameTexture", "frame_texture = \"bus\"\n",
              ":3: unknown word \"bus\" in frame_texture (known: none, host, copy, direct)"},
        Fault{"EmptySource", "culling = { value = true, source = \"\" }\n", ":3: culling's source is empty"},
        Fault{"DeepestFirst", "depth_bits = [32]\ndepth_functions = [\"less\"]\n",
              ":3: depth_bits: gnomon renders into the first, and has 24 bits at most"},
        Fault{"RateOfNearlyNothing", "megapixels_per_second = 1e-300\n",
              ":3: megapixels_per_second = 1e-300 is neither 0 nor 0.001 to 1000000"},
        Fault{"StencilOf16Bits", "stencil_bits = 16\n", ":3: stencil_bits = 16 is outside 0 to 8"},
        Fault{"Equation", "blend_equations = [\n\"add\",\n\"sub\"]\n",
              ":5: unknown word \"sub\" in blend_equations (known: add, subtract, reverse_subtract, min, "
              "max, add_wrap, signed_add, signed_reverse_subtract)"},
        Fault{"Compare", "depth_functions = [\"lesser\"]\n",
              ":3: unknown word \"lesser\" in depth_functions (known: never, less, equal, lequal, greater, "
              "notequal, gequal, always)"},
        Fault{"Factor", "source_factors = [\"dst_colour\"]\n",
              ":3: unknown word \"dst_colour\" in source_factors (known: " + kFactors + ")"},
        Fault{"FactorOfPair", "blend_pairs = [\"one\ttwo\", \"one two\"]\n",
              ":3: \"one\ttwo\" in blend_pairs must be two blend factors, \"source destination\""},
        Fault{"SecondFactorOfPair", "blend_pairs = [\"one two\"]\n",
              ":3: unknown word \"two\" in blend_pairs (known: " + kFactors + ")"},
        Fault{"HalfAPair", "constant_source_pairs = [\"one\"]\n",
              ":3: \"one\" in constant_source_pairs must be two blend factors, \"source destination\""}),
    nameOfFault);

INSTANTIATE_TEST_SUITE_P(
    Numbers, FaultyProfile,
    testing::Values(
        Fault{"Negative", "alpha_bits = -8\n", ":3: alpha_bits = -8 is outside 0 to 16"},
        Fault{"Absurd", "stencil_bits = 256\n", ":3: stencil_bits = 256 is outside 0 to 8"},
        Fault{"BeyondInt", "max_width = 5000000000\n", ":3: max_width = 5000000000 is outside 0 to 65536"},
        Fault{"DepthOfZeroBits", "depth_bits = [16,\n0]\n", ":4: depth_bits = 0 is outside 1 to 32"},
        Fault{"NegativeRate", "gigabytes_per_second = -0.5\n",
              ":3: gigabytes_per_second = -0.5 is neither 0 nor 0.001 to 100000"},
        Fault{"NoNumberAsRate", "megapixels_per_second = nan\n",
              ":3: megapixels_per_second = nan is neither 0 nor 0.001 to 1000000"},
        Fault{"PixelsForMegapixels", "megapixels_per_second = 50000000\n",
              ":3: megapixels_per_second = 50000000 is neither 0 nor 0.001 to 1000000"},
        Fault{"FutureYear", "year = 20000\n", ":3: year = 20000 is outside 1950 to 2100"},
        Fault{"NotAPowerOfTwo", "texture_units = 1\nmax_texture_size = 1000\n",
              ":4: max_texture_size = 1000 is not a power of two"}),
    nameOfFault);

INSTANTIATE_TEST_SUITE_P(
    Arrays, FaultyProfile,
    testing::Values(
        Fault{"NumberTwice", "depth_bits = [24,\n16,\n24]\n", ":5: depth_bits has 24 twice"},
        Fault{"WordTwice", "blend_equations = [\"add\", \"add\"]\n", ":3: blend_equations has add twice"},
        Fault{"PairTwice", "blend_pairs = [\"one one\", \"one one\"]\n", ":3: blend_pairs has one one twice"},
        Fault{"Empty", "depth_bits = []\n",
              ":3: depth_bits is empty: leave it out if the chip has none, or say where that is from"}),
    nameOfFault);

const std::string kBlend =
    "source_factors = [\"one\"]\ndestination_factors = [\"one\"]\nblend_equations = [\"add\"]\n";  // lines 3
                                                                                                   // to 5
const std::string kDepth = "depth_bits = [16]\ndepth_functions = [\"less\"]\n";  // lines 3 and 4
const std::string kAlpha =  // lines 3 to 5: alpha, but in a buffer of its own, as 565 has none
    kDepth + "alpha_excludes_depth = true\n";

INSTANTIATE_TEST_SUITE_P(
    ImpossibleFrames, FaultyProfile,
    testing::Values(
        Fault{"WrapWithoutStencil", "stencil_wrap = true\n", ":3: stencil_wrap needs stencil_bits"},
        Fault{"WrapWithZeroStencil", "stencil_wrap = true\nstencil_bits = 0\n",
              ":3: stencil_wrap needs stencil_bits"},
        Fault{"TwoSidesWithoutStencil", "\ntwo_sided_stencil = true\n",
              ":4: two_sided_stencil needs stencil_bits"},
        Fault{"AlphaInNoFormat", "alpha_bits = 8\n",
              ":3: alpha_bits = 8, but no colour format has that many, and no auxiliary buffer "
              "(alpha_excludes_depth) does"},
        Fault{"ExclusionWithoutAlpha", kAlpha, ":5: alpha_excludes_depth needs alpha_bits"},
        Fault{"ExclusionWithoutDepth", "alpha_bits = 8\nalpha_excludes_depth = true\n",
              ":4: alpha_excludes_depth needs depth_bits"},
        Fault{"DepthWithoutFunctions", "depth_bits = [16]\n", ":3: depth_bits needs depth_functions"},
        Fault{"FunctionsWithoutDepth", "depth_functions = [\"less\"]\n",
              ":3: depth_functions needs depth_bits"},
        Fault{"UnitsWithoutDepth", "polygon_offset_units = true\n",
              ":3: polygon_offset_units needs depth_bits"},
        Fault{"EncodingWithoutDepth", "depth_encodings = [\"n64\"]\n",
              ":3: depth_encodings needs depth_bits"},
        Fault{"FunctionsBesideSourcedAbsenceOfDepth",
              "depth_functions = [\"less\"]\nsources = [\"M [document]: a\"]\n"
              "depth_bits = { value = [], source = \"M\" }\n",
              ":3: depth_functions needs depth_bits"},
        Fault{"SlopeWithoutDepth", "polygon_offset_factor = true\n",
              ":3: polygon_offset_factor needs depth_bits"},
        Fault{"WidthWithoutHeight", "max_width = 640\n", ":3: max_width needs max_height"},
        Fault{"HeightWithoutWidth", "max_height = 480\n", ":3: max_height needs max_width"}),
    nameOfFault);

INSTANTIATE_TEST_SUITE_P(
    ImpossibleBlending, FaultyProfile,
    testing::Values(
        Fault{"EquationsWithoutPair", "blend_equations = [\"add\"]\n",
              ":3: blend_equations needs source_factors and destination_factors, or blend_pairs"},
        Fault{"OneSide", "source_factors = [\"one\"]\n", ":3: source_factors needs destination_factors"},
        Fault{"OtherSide", "destination_factors = [\"one\"]\n",
              ":3: destination_factors needs source_factors"},
        Fault{"FactorsWithoutEquation", "source_factors = [\"one\"]\ndestination_factors = [\"one\"]\n",
              ":3: source_factors needs blend_equations"},
        Fault{"PairsWithoutEquation", "blend_pairs = [\"one one\"]\n",
              ":3: blend_pairs needs blend_equations"},
        Fault{"ConstantPairsWithoutEquation", "constant_source_pairs = [\"one one\"]\n",
              ":3: constant_source_pairs needs blend_equations"},
        Fault{"ConstantPairThatIsAFactorPair", kBlend + "constant_source_pairs = [\"one one\"]\n",
              ":6: constant_source_pairs has \"one one\", which any source colour may use"},
        Fault{"ConstantPairThatIsAPair",
              "constant_source_pairs = [\"zero one\"]\nblend_pairs = [\"zero one\"]\n"
              "blend_equations = [\"add\"]\n",
              ":3: constant_source_pairs has \"zero one\", which any source colour may use"},
        Fault{"SourceReadsMissingAlpha",
              "blend_equations = [\"add\"]\ndestination_factors = [\"one\"]\nsource_factors = "
              "[\"dst_alpha\"]\n",
              ":5: source_factors reads destination alpha and needs alpha_bits"},
        Fault{"SaturationReadsMissingAlpha",
              "blend_equations = [\"add\"]\ndestination_factors = [\"one\"]\n"
              "source_factors = [\"src_alpha_saturate\"]\n",
              ":5: source_factors reads destination alpha and needs alpha_bits"},
        Fault{"DestinationReadsMissingAlpha",
              "destination_factors = [\"one_minus_dst_alpha\"]\nsource_factors = [\"one\"]\n"
              "blend_equations = [\"add\"]\n",
              ":3: destination_factors reads destination alpha and needs alpha_bits"},
        Fault{"PairReadsMissingAlpha", kBlend + "blend_pairs = [\"zero dst_alpha\"]\n",
              ":6: blend_pairs reads destination alpha and needs alpha_bits"},
        Fault{"ConstantPairReadsMissingAlpha", kBlend + "constant_source_pairs = [\"dst_alpha zero\"]\n",
              ":6: constant_source_pairs reads destination alpha and needs alpha_bits"}),
    nameOfFault);

INSTANTIATE_TEST_SUITE_P(
    ImpossibleAlphaBlending, FaultyProfile,
    testing::Values(
        Fault{"WritesWithoutAlpha", "blend_writes_alpha = true\n", ":3: blend_writes_alpha needs alpha_bits"},
        Fault{"WritesWithoutFactors", kAlpha + "alpha_bits = 8\nblend_writes_alpha = true\n",
              ":7: blend_writes_alpha needs alpha_source_factors and alpha_destination_factors"},
        Fault{"SourceFactorsWithoutAlpha", "alpha_source_factors = [\"one\"]\n",
              ":3: alpha_source_factors needs alpha_bits"},
        Fault{"DestinationFactorsWithoutAlpha", "alpha_destination_factors = [\"one\"]\n",
              ":3: alpha_destination_factors needs alpha_bits"},
        Fault{"SourceFactorsNeverWritten", kAlpha + "alpha_bits = 8\nalpha_source_factors = [\"one\"]\n",
              ":7: alpha_source_factors needs blend_writes_alpha"},
        Fault{"DestinationFactorsNeverWritten",
              kAlpha + "alpha_bits = 8\nalpha_destination_factors = [\"one\"]\n",
              ":7: alpha_destination_factors needs blend_writes_alpha"},
        Fault{"SeparateFactorsWithoutAlpha", "separate_alpha_factors = true\n",
              ":3: separate_alpha_factors needs alpha_bits"},
        Fault{"SeparateFactorsNeverWritten", kAlpha + "alpha_bits = 8\nseparate_alpha_factors = true\n",
              ":7: separate_alpha_factors needs blend_writes_alpha"}),
    nameOfFault);

INSTANTIATE_TEST_SUITE_P(
    ImpossibleTextures, FaultyProfile,
    testing::Values(
        Fault{"UnitsWithoutSize", "texture_units = 1\n", ":3: texture_units needs max_texture_size"},
        Fault{"SizeWithoutUnits", "max_texture_size = 256\n", ":3: max_texture_size needs texture_units"},
        Fault{"AspectWithoutUnits", "max_texture_aspect = 8\n", ":3: max_texture_aspect needs texture_units"},
        Fault{"AnySizeWithoutUnits", "texture_non_power_of_two = true\n",
              ":3: texture_non_power_of_two needs texture_units"},
        Fault{"FrameWithoutUnits", "frame_texture = \"host\"\n", ":3: frame_texture needs texture_units"}),
    nameOfFault);

TEST(LoadProfileErrors, MissTitleAndColourFormats) {
    EXPECT_EQ(errorOf(""), ":1: title is missing");
    EXPECT_EQ(errorOf("\ncolour_formats = [\"565\"]\n"), ":1: title is missing");
    EXPECT_EQ(errorOf("\ntitle = \"\"\n"), ":2: title is missing");
    EXPECT_EQ(errorOf("\ntitle = \"Chip\"\n"), ":1: colour_formats is missing");
    EXPECT_EQ(errorOf("title = \"Chip\"\ncolour_formats = []\n"),
              ":2: colour_formats is empty: leave it out if the chip has none, or say where that is from");
    EXPECT_EQ(errorOf("title = \"Chip\"\ncolour_formats = [\"565\", \"565\"]\n"),
              ":2: colour_formats has 565 twice");
    EXPECT_EQ(errorOf("title = \"Chip\"\ncolour_formats = [\"rgb\"]\n"),
              ":2: unknown word \"rgb\" in colour_formats (known: 565, 555, 1555, 5551, 4444, 6666, 6665, "
              "888, 8888)");
}

TEST(ProfileIds, AreSortedStemsOfTomlFiles) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "profile_ids_test";
    std::filesystem::create_directory(folder);
    for (const char* file : {"b.toml", "a.toml", "readme.md"}) std::ofstream(folder / file) << "";
    EXPECT_THAT(profileIds(folder), ElementsAre("a", "b"));
    std::filesystem::remove_all(folder);
    EXPECT_THROW(profileIds(folder), ProfileError);
}

TEST(ProfileLimit, OfBytesIsSaid) {
    const auto file = fileWith("");
    std::filesystem::resize_file(file, 107'374'182'400);  // of which none is written
    try {
        loadProfile(file);
        ADD_FAILURE() << "loaded";
    } catch (const ProfileError& error) {
        EXPECT_EQ(error.what(),
                  file.string() + ": 107374182400 bytes, more than the 262144 that gnomon reads");
    }
    std::filesystem::remove(file);
}

TEST(ProfileLimit, OfDepthHoldsForValuesAndKeys) {
    EXPECT_THAT(errorOf("x = " + std::string(200'000, '[')), testing::StartsWith(":1: "));
    std::string key = "a";
    for (int i = 0; i < 100'000; ++i) key += ".a";
    for (const std::string& content : {key + " = 1\n", "[" + key + "]\n", "x = { " + key + " = 1 }\n"})
        EXPECT_EQ(errorOf(content), ":1: a key of more than 16 parts");
}

TEST(ProfileLimit, OfATextIsALine) {
    EXPECT_EQ(errorOf("title = \"a\\nb\"\n"), ":1: title must be one line");
    EXPECT_EQ(errorOf("title = \"a\"\nsources = [\"M\\r [guess]: b\"]\n"), ":2: sources must be one line");
    EXPECT_THAT(errorOf("title = \"a\"\n\"b\\nc\" = 1\n"),
                testing::StartsWith(":2: unknown key \"b c\"; did you mean"));
}

}  // namespace load_test
}  // namespace gnomon
