#include <catch2/catch.hpp>
#include <cstdlib>

#include "tests/appliance/files.h"
#include "tests/appliance/program.h"

using namespace quadrig::tests;
using Catch::Contains;
namespace fs = std::filesystem;

TEST_CASE("The installed program reads the files beside it, and none of the tree that it was built from") {
    const fs::path prefix = scratch_directory(), said = prefix / "said";
    const auto shell = [&](const std::string& command) {
        return std::system(("env -u QUADRIG_CONFIG_DIR " + command + " >" + said.string() + " 2>&1").c_str());
    };
    const std::string program = (prefix / "bin/quadrig").string();
    REQUIRE(shell("cmake --install " QUADRIG_BINARY_DIR " --prefix " + prefix.string()) == 0);
    REQUIRE(shell(program + " patterns") == 0);
    CHECK(text_of(said) == quadrig_program({"patterns"}).out);

    const fs::path files = prefix / "share/quadrig";
    for (const char* shipped : {"quality.toml", "models/x-29.toml", "scenes/takeoff.toml", "scenes/bench/dense.toml",
                                "traces/netfdm-c172-takeoff.pcap"})
        CHECK(text_of(files / shipped) == text_of(fs::path(QUADRIG_SOURCE_DIR "/config") / shipped));
    CHECK(shell(program + " render " + (files / "scenes/village.toml").string() +
                " --size 64x48 --eye 0,-200,60 --attitude 0,-9,0 --fov 60 -o " + (prefix / "village.png").string()) ==
          0);

    fs::remove(files / "patterns.toml");
    CHECK(shell(program + " patterns") != 0);
    CHECK_THAT(text_of(said), Contains("no patterns.toml in " + files.string()));
}
