#include "config/camera_path.h"

#include <catch2/catch.hpp>
#include <tuple>
#include <vector>

#include "tests/config/temporary_file.h"

using namespace quadrig;
using tests::TemporaryFile;

namespace {

std::string complaint_about(std::string_view text, const std::string& key) {
    const TemporaryFile file(text, ".json");
    try {
        config::read_camera_path(file.path());
    } catch (const config::FileError& error) {
        CHECK(error.key() == key);
        CHECK_THAT(error.what(), Catch::StartsWith(file.path().string() + ":"));
        return error.what();
    }
    FAIL("the file was accepted");
    return {};
}

}  // namespace

TEST_CASE("a camera path is a list of eyes, attitudes and fields of view") {
    const TemporaryFile file(R"([
        {"eye": [1, 2.5, -3], "attitude": [350, -10, 5], "fov": 60},
        {"eye": [0, 0, 8], "attitude": [0, 0, 0], "fov": 45.5}])",
                             ".json");
    const auto cameras = config::read_camera_path(file.path());
    REQUIRE(cameras.size() == 2);
    CHECK(cameras[0].eye.metres == glm::dvec3(1.0, 2.5, -3.0));
    CHECK(cameras[0].attitude.heading.value == 350.0);
    CHECK(cameras[0].attitude.pitch.value == -10.0);
    CHECK(cameras[0].attitude.roll.value == 5.0);
    CHECK(cameras[1].horizontal_fov.value == 45.5);
}

TEST_CASE("mistakes in a camera path are refused with the camera's index and the key") {
    const std::string good = R"({"eye": [0, 0, 8], "attitude": [0, 0, 0], "fov": 60})";
    CHECK_THAT(complaint_about("[" + good + R"(, {"eye": [0, 0], "attitude": [0, 0, 0], "fov": 60}])", "[1].eye"),
               Catch::Contains("expected an array of 3 numbers, found [0,0]"));
    CHECK_THAT(complaint_about(R"([{"eye": [0, "x", 0], "attitude": [0, 0, 0], "fov": 60}])", "[0].eye[1]"),
               Catch::Contains("found \"x\""));
    CHECK_THAT(complaint_about(R"([{"eye": [0, 0, 0], "attitude": [0, 0, 361], "fov": 60}])", "[0].attitude[2]"),
               Catch::Contains("expected degrees in -360..360, found 361"));
    CHECK_THAT(complaint_about(R"([{"eye": [0, 0, 0], "attitude": [0, 0, 0], "fov": 0}])", "[0].fov"),
               Catch::Contains("expected degrees in 1..170, found 0"));
    CHECK_THAT(complaint_about(R"([{"eye": [0, 0, 0], "attitude": [0, 0, 0]}])", "[0].fov"),
               Catch::Contains("expected this key, found none"));
    CHECK_THAT(complaint_about(R"([{"eye": [0, 0, 0], "attitude": [0, 0, 0], "fov": 60, "roll": 1}])", "[0].roll"),
               Catch::Contains("unknown key"));
    const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
    CHECK_THAT(complaint_about(deep, "[0]"), Catch::Contains("expected an object of eye, attitude and fov"));
    CHECK_THAT(complaint_about(R"([{"eye": )" + deep + R"(, "attitude": [0, 0, 0], "fov": 60}])", "[0].eye"),
               Catch::Contains("expected an array of 3 numbers, found [[[]]]"));
    CHECK_THAT(complaint_about("[3]", "[0]"), Catch::Contains("found 3"));
    CHECK_THAT(complaint_about("[]", ""), Catch::Contains("at least one camera"));
    CHECK_THAT(complaint_about("{}", ""), Catch::Contains("at least one camera, found object"));
}

TEST_CASE("a mistake in a camera path is told with the line that it stands on") {
    const std::string start = "[\n  {\"eye\": [0, 0, 8], \"attitude\": [0, 0, 0], \"fov\": 60},\n  {\n";
    const std::vector<std::tuple<std::string, std::string, int>> cases{
        {"\"eye\": [0,\n0,\n\"x\"], \"attitude\": [0, 0, 0], \"fov\": 60}\n]", "[1].eye[2]", 6},
        {"\"eye\": [0,\n2e9\n,\n0], \"attitude\": [0, 0, 0], \"fov\": 60}\n]", "[1].eye[1]", 5},
        {"\"eye\": [0, 0, 8],\r\n\"attitude\": [0, 0, 0],\r\n\r\n\"fov\": 0\r\n}]", "[1].fov", 7},
        {"\"eye\": [0, 0, 8],\n\"attitude\": [0, 0, 0],\n\"fov\": 60,\n\"eye\": [0, 0, 9]}]", "[1].eye", 7},
        {"\"eye\": [0, 0, 8],\n\"attitude\": [0, 0, 0]\n}]", "[1].fov", 3},
        {"\"eye\": [0, 0, 8],\n\"attitude\": [0, 0, 0],\n\"fov\": 60,\n\"roll\": 1}]", "[1].roll", 7},
        {"\"eye\": [0, 0, 8],\n\"attitude\": [0, 0, 0],\n\"fov\": 60}\n,\n3\n]", "[2]", 8},
        {"\"eye\": [1e999,\n0, 8]}]", "[1].eye[0]", 4},
    };
    for (const auto& [text, key, line] : cases) {
        INFO(text);
        CHECK_THAT(complaint_about(start + text, key), Catch::Contains(".json:" + std::to_string(line) + ": "));
    }
}

TEST_CASE("a camera path that is not JSON is refused with its line, and with the key where there is one") {
    CHECK_THAT(complaint_about("[\n\n{\"eye\": nan}]", "[0].eye"),
               Catch::Contains(".json:3: key '[0].eye': not JSON: "));
    CHECK_THAT(complaint_about("[{\"eye\": [0, 0, 8]; \"fov\": 60}]", "[0]"), Catch::Contains("not JSON: "));
    CHECK_THAT(complaint_about("[;]", ""), Catch::Contains("not JSON: "));
    CHECK_THAT(complaint_about("", ""), Catch::Contains("not JSON: "));
    CHECK_THAT(complaint_about("[{\"\xC3", "[0]"), Catch::Contains("\\xC3"));
    const std::string good = R"({"eye": [0, 0, 8], "attitude": [0, 0, 0], "fov": 60})";
    CHECK_THAT(complaint_about("[\n" + good + "]" + '\0' + "]", ""), Catch::Contains(".json:2: not JSON: "));
}

TEST_CASE("numbers that are not finite are refused in a camera path as other numbers out of range: by line and key") {
    for (const std::string number : {"NaN", "Infinity", "-Infinity", "1e999", "-1e999"}) {
        INFO(number);
        CHECK_THAT(complaint_about("[{\"eye\": [0, 0, 8],\n\"attitude\": [0, " + number + ", 0], \"fov\": 60}]",
                                   "[0].attitude[1]"),
                   Catch::Contains(".json:2: "));
        CHECK_THAT(
            complaint_about("[{\"eye\": [0, 0, 8], \"attitude\": [0, 0, 0],\n\"fov\": " + number + "}]", "[0].fov"),
            Catch::Contains(".json:2: "));
    }
}
