#include "config/quality_ladder.h"

#include <catch2/catch.hpp>
#include <sstream>

#include "config/file_error.h"
#include "tests/config/temporary_file.h"

using namespace quadrig;
using namespace quadrig::config;
using tests::replaced;
using tests::TemporaryFile;

namespace {

constexpr const char* kTwoSteps =
    "[[quality]]\nname = \"rough\"\ncost = 0.5\npsnr = 30\nsub_scan_lines = 0\nset_up = \"textbook-single\"\n"
    "distance = \"interpolated\"\nsine = \"table\"\nterms_left_out = 2\nsmooth_stretches = false\nshading = \"half\"\n"
    "smallest_feature = 1.5\n"
    "[[quality]]\nname = \"default\"\ncost = 1\npsnr = 45\n";

}  // namespace

TEST_CASE(
    "the ladder that ships rises in cost and in PSNR, from draft and what is coarser over the default to the best") {
    const QualityLadder& ladder = shipped_ladder();
    REQUIRE(ladder.size() >= 4);
    const auto draft = step_named(ladder, "draft");
    REQUIRE(draft);
    CHECK(ladder.back().name == "best");
    CHECK(ladder[default_step(ladder)].quality == Quality{});
    CHECK(ladder[default_step(ladder)].cost == 1.0);
    CHECK(step_named(ladder, "fine") == default_step(ladder) + 1);
    CHECK_FALSE(step_named(ladder, "auto"));
    for (std::size_t i = 1; i < ladder.size(); ++i) {
        CHECK(ladder[i].cost > ladder[i - 1].cost);
        CHECK(ladder[i].psnr > ladder[i - 1].psnr);
    }
    for (std::size_t i = 0; i < ladder.size(); ++i)
        CHECK((pixels_across(ladder[i].quality.shading) > 1.0) == (i < *draft));
}

TEST_CASE("every key of a quality is read") {
    const QualityLadder ladder = read_quality_ladder(TemporaryFile(kTwoSteps).path());
    REQUIRE(ladder.size() == 2);
    const Quality expected{.sub_scan_lines = 0,
                           .set_up = SetUp::textbook_single,
                           .distance = DistanceRule::interpolated,
                           .sine = SineMethod::table,
                           .terms_left_out = 2,
                           .smooth_stretches = false,
                           .shading = ShadingRate::half,
                           .smallest_feature = 1.5};
    CHECK(ladder[0].quality == expected);
    CHECK(ladder[0].name == "rough");
    CHECK(ladder[0].cost == 0.5);
    CHECK(ladder[0].psnr == 30);
    CHECK(ladder[1].quality == Quality{});
}

TEST_CASE("a ladder that is written reads as it was") {
    for (const QualityLadder& ladder : {shipped_ladder(), read_quality_ladder(TemporaryFile(kTwoSteps).path())}) {
        std::ostringstream text;
        write_quality_ladder(ladder, text);
        const QualityLadder again = read_quality_ladder(TemporaryFile(text.str()).path());
        REQUIRE(again.size() == ladder.size());
        for (std::size_t i = 0; i < ladder.size(); ++i) {
            CHECK(again[i].name == ladder[i].name);
            CHECK(again[i].quality == ladder[i].quality);
            CHECK(again[i].cost == ladder[i].cost);
            CHECK(again[i].psnr == ladder[i].psnr);
        }
    }
}

TEST_CASE("every shading rate has a name that is read and written") {
    constexpr std::array kNames{std::pair{ShadingRate::eighth, "eighth"}, std::pair{ShadingRate::quarter, "quarter"},
                                std::pair{ShadingRate::half, "half"}, std::pair{ShadingRate::one, "one"},
                                std::pair{ShadingRate::four, "four"}};
    for (const auto& [rate, name] : kNames) {
        CAPTURE(name);
        const TemporaryFile file(replaced(kTwoSteps, "\"half\"", '"' + std::string(name) + '"'));
        const QualityLadder ladder = read_quality_ladder(file.path());
        CHECK(ladder[0].quality.shading == rate);
        std::ostringstream text;
        write_quality_ladder(ladder, text);
        CHECK(read_quality_ladder(TemporaryFile(text.str()).path())[0].quality == ladder[0].quality);
    }
}

TEST_CASE("a ladder's mistakes are refused with file, line, key and what was expected") {
    struct Mistake {
        const char *what, *by, *complaint;
    };
    for (const auto& [what, by, complaint] : std::vector<Mistake>{
             {"sub_scan_lines = 0", "sub_scan_lines = 3",
              ":5: key 'quality[0].sub_scan_lines': expected 0, 1, 2, 4 or 8"},
             {"\"table\"", "\"cosine\"", "key 'quality[0].sine': expected parabola or polynomial or table or library"},
             {"false", "0", "key 'quality[0].smooth_stretches': expected true or false"},
             {"\"half\"", "\"none\"", "key 'quality[0].shading': expected one or half or quarter or eighth or four"},
             {"1.5", "-1", "key 'quality[0].smallest_feature': expected pixels in 0..64"},
             {"\"rough\"", "\"default\"", "key 'quality[1].name': expected a name of its own"},
             {"\"rough\"", "\"auto\"", "key 'quality[0].name'"},
             {"\"default\"", "\"usual\"", "needs a [[quality]] named \"default\""},
             {"cost = 1\n", "cost = 0.4\n", "key 'quality[1].cost'"},
             {"psnr = 30", "snr = 30", "key 'quality[0].snr': expected one of"}}) {
        const TemporaryFile file(replaced(kTwoSteps, what, by));
        CHECK_THROWS_WITH(read_quality_ladder(file.path()),
                          Catch::Contains(complaint) && Catch::Contains(file.path().string()));
    }
}

TEST_CASE("a quality is told in words by what sets it apart") {
    CHECK(words_for({}) == "2 sub-scan lines");
    Quality quality;
    quality.sub_scan_lines = 0, quality.sine = SineMethod::polynomial, quality.terms_left_out = 1,
    quality.smallest_feature = 1.5;
    CHECK(words_for(quality) == "no antialiasing, polynomial sine, one sine fewer, nothing below 1.5 pixels");
    CHECK(words_for({.shading = ShadingRate::quarter}) == "2 sub-scan lines, drawn half as fine");
    CHECK(words_for({.shading = ShadingRate::eighth}) ==
          "2 sub-scan lines, drawn half as fine, every second pixel shaded");
}
