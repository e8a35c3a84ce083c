// Every reader of what others write, fed with the corpora of this folder and with changed copies of them: what the
// fuzzer does, in a second or two and without its compiler.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/fuzz/mutation.h"
#include "tests/fuzz/seeds.h"
#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::fuzz;

namespace {

const std::filesystem::path kCorpora = std::filesystem::path(QUADRIG_SOURCE_DIR) / "tests" / "fuzz" / "corpus";

std::vector<Bytes> corpus_of(const Target& target) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(kCorpora / target.name)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<Bytes> corpus;
    for (const auto& file : files) {
        std::ifstream stream(file, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        const auto bytes = std::as_bytes(std::span(text));
        corpus.emplace_back(bytes.begin(), bytes.end());
    }
    return corpus;
}

std::string hex_of(const Bytes& bytes) {
    constexpr std::string_view kDigits("0123456789abcdef");
    std::string text;
    for (const std::byte byte : bytes) {
        text += kDigits[std::to_integer<std::size_t>(byte >> 4)];
        text += kDigits[std::to_integer<std::size_t>(byte & std::byte{15})];
    }
    return text;
}

/// Reads the corpus, and as many changed copies.
void read_all(std::string_view name, int copies) {
    CAPTURE(test::seed());
    const auto target = std::ranges::find(targets(), name, &Target::name);
    REQUIRE(target != targets().end());
    const std::vector<Bytes> corpus = corpus_of(*target);
    REQUIRE_FALSE(corpus.empty());
    std::mt19937_64 random(test::seed());
    const auto read = [&](const Bytes& input) {
        try {
            target->read(input);
        } catch (const std::exception& error) {
            FAIL(error.what() << "\n" << hex_of(input));
        }
    };
    for (const Bytes& input : corpus) read(input);
    for (int copy = 0; copy < test::trials(copies, copies / 5); ++copy)
        read(mutated(corpus, target->most_bytes, random));
}

}  // namespace

TEST_CASE("no CIGI conversation breaks its session") { read_all("cigi", 150000); }
TEST_CASE("no FlightGear datagrams break their session") { read_all("fdm", 150000); }
TEST_CASE("no stream of FlightGear packets breaks its reader, in whatever pieces") { read_all("fdm_stream", 40000); }
TEST_CASE("no frames of a CAN bus break their session") { read_all("canaerospace", 150000); }
TEST_CASE("no streams of Modbus clients break their session") { read_all("modbus", 300000); }
TEST_CASE("no conversation of any protocol breaks the monitor") { read_all("monitor", 40000); }
TEST_CASE("no line breaks the reader of candump's text") { read_all("candump", 500000); }
TEST_CASE("no file breaks the reader of recordings") { read_all("capture", 20000); }
TEST_CASE("no file breaks the reader of recorded frames") { read_all("recorded_frames", 20000); }
TEST_CASE("no text breaks the reader of links' URLs") { read_all("link_url", 100000); }
TEST_CASE("no text breaks the reader of scenes, and what is read survives being written") { read_all("scene", 3000); }
TEST_CASE("no text breaks the reader of appliance files") { read_all("appliance", 10000); }
TEST_CASE("no text breaks the reader of camera paths") { read_all("camera_path", 15000); }
TEST_CASE("no text breaks the reader of quality ladders, and what is read survives being written") {
    read_all("quality_ladder", 6000);
}

TEST_CASE("a fuzzer's broken law is an error here") { CHECK_THROWS_AS(law(false, "the moon is cheese"), LawBroken); }

// Run by hand where encoders or files have changed: test_fuzz "[.seeds]".
TEST_CASE("the corpora's seeds are written", "[.seeds]") {
    for (const Seed& seed : seeds()) {
        std::filesystem::create_directories(kCorpora / seed.target);
        std::ofstream file(kCorpora / seed.target / seed.name, std::ios::binary);
        file.write(reinterpret_cast<const char*>(seed.bytes.data()), static_cast<std::streamsize>(seed.bytes.size()));
        REQUIRE(file.flush());
    }
}
