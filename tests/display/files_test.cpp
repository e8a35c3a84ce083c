#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "display/atomic_file.h"
#include "display/contact_sheet.h"
#include "display/frame_hash.h"
#include "display/npy_file.h"
#include "display/png_file.h"
#include "tests/display/pictures.h"

using namespace quadrig;
using namespace quadrig::display;

namespace {

/// What a command prints; throws where it cannot be run or fails.
std::string output_of(const std::string& command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::string text;
    std::vector<char> block(1 << 16);
    while (const std::size_t n = std::fread(block.data(), 1, block.size(), pipe.get())) text.append(block.data(), n);
    return text;
}

}  // namespace

TEST_CASE("A picture written as PNG is read back bit for bit, padded and bottom-up memory included") {
    const test::TemporaryDirectory directory;
    Picture picture = test::random_picture(61, 43, 1);
    const FrameImage part{picture.image().row(42) + 4 * 5, 50, 40, -picture.image().row_bytes};
    for (const PngCompression compression : {PngCompression::fast, PngCompression::small}) {
        const auto path = directory.path() / "picture.png";
        write_png(path, part, compression);
        Picture back = read_png(path);
        REQUIRE(back.width == 50);
        REQUIRE(back.height == 40);
        for (int r = 0; r < 40; ++r) REQUIRE(std::equal(part.row(r), part.row(r) + 200, back.image().row(r)));
    }
    CHECK(std::distance(std::filesystem::directory_iterator(directory.path()), {}) == 1);
}

TEST_CASE("ffmpeg reads our PNG as the same pixels") {
    const test::TemporaryDirectory directory;
    Picture picture = test::random_picture(64, 48, 2);
    const auto path = directory.path() / "picture.png";
    write_png(path, picture.image());
    const std::string raw = output_of("ffmpeg -v error -i " + path.string() + " -f rawvideo -pix_fmt rgba -");
    REQUIRE(raw.size() == picture.pixels.size());
    CHECK(std::equal(raw.begin(), raw.end(), picture.pixels.begin(),
                     [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }));
}

TEST_CASE("A PNG that cannot be written says which and why, and leaves nothing behind") {
    const test::TemporaryDirectory directory;
    Picture picture = test::random_picture(8, 8, 3);
    CHECK_THROWS_WITH(write_png(directory.path() / "no" / "such.png", picture.image()),
                      Catch::Contains("such.png") && Catch::Contains("No such file or directory"));
    CHECK_THROWS_WITH(read_png(directory.path() / "missing.png"), Catch::Contains("missing.png"));
    std::ofstream(directory.path() / "text.png") << "not a picture";
    CHECK_THROWS_WITH(read_png(directory.path() / "text.png"), Catch::Contains("text.png"));
    std::filesystem::create_directory(directory.path() / "taken.png");
    CHECK_THROWS_WITH(write_png(directory.path() / "taken.png", picture.image()), Catch::Contains("taken.png"));
    CHECK(std::distance(std::filesystem::directory_iterator(directory.path()), {}) == 2);
}

TEST_CASE("A pipe, a device or a symbolic link that is written to is still there afterwards") {
    const test::TemporaryDirectory directory;
    const auto file = directory.path() / "real.txt", link = directory.path() / "link.txt",
               pipe = directory.path() / "pipe", full = directory.path() / "full";
    std::filesystem::create_symlink("real.txt", link);
    for (const char* text : {"made through the link", "written through it again"}) {
        write_whole(link, text);
        CHECK(std::filesystem::is_symlink(link));
        CHECK(output_of("cat " + file.string()) == text);
    }
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    expect_writable(pipe);  // would wait for a reader if it tried
    const std::unique_ptr<FILE, int (*)(FILE*)> reader(popen(("cat " + pipe.string()).c_str(), "r"), pclose);
    write_whole(pipe, "through a pipe");
    std::string text(64, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), reader.get()));
    CHECK(text == "through a pipe");
    CHECK(std::filesystem::is_fifo(pipe));
    // A link stands for the device, lest a mistake here takes it from the machine.
    std::filesystem::create_symlink("/dev/full", full);
    CHECK_THROWS_WITH(write_whole(full, "no room"), Catch::Contains("full") && Catch::Contains("No space left"));
    CHECK_THROWS_WITH(write_png(full, test::random_picture(200, 100, 4).image()), Catch::Contains("No space left"));
    CHECK(std::filesystem::is_symlink(full));
    CHECK(std::distance(std::filesystem::directory_iterator(directory.path()), {}) == 4);
}

TEST_CASE("A file has no name until it is whole, takes the place of another then, and has a new file's permissions") {
    const test::TemporaryDirectory directory;
    const int nameless = open(directory.path().c_str(), O_TMPFILE | O_WRONLY, 0666);
    if (nameless < 0) {
        WARN("this file system has no files without a name");
        return;
    }
    close(nameless);
    const auto file = directory.path() / "text", usual = directory.path() / "usual";
    const auto entries = [&] { return std::distance(std::filesystem::directory_iterator(directory.path()), {}); };
    std::ofstream(usual) << "made by somebody else";
    for (const std::string text : {"once", "once more"}) {
        const auto before = entries();
        AtomicFile atomic(file);
        atomic.write(text.data(), text.size());
        CHECK(entries() == before);
        atomic.commit();
        CHECK(output_of("cat " + file.string()) == text);
    }
    CHECK(std::filesystem::status(file).permissions() == std::filesystem::status(usual).permissions());
    { AtomicFile given_up(directory.path() / "never"); }
    CHECK(entries() == 2);
    CHECK_THROWS_WITH(expect_writable(directory.path()), Catch::Contains("Is a directory"));
}

TEST_CASE("Names of one file lead to one place, however they are spelt") {
    const test::TemporaryDirectory directory;
    std::filesystem::create_directory(directory.path() / "sub");
    std::filesystem::create_symlink("not-there-yet", directory.path() / "link");
    std::filesystem::create_symlink("sub", directory.path() / "other");
    const auto place = [&](const char* name) { return written_to(directory.path() / name); };
    CHECK(place("a") == place("./a"));
    CHECK(place("a") == place("sub/../a"));
    CHECK(place("a") == written_to(std::filesystem::relative(directory.path() / "a")));
    CHECK(place("link") == place("not-there-yet"));
    CHECK(place("other/b") == place("sub/b"));
    CHECK(place("a") != place("sub/a"));
}

TEST_CASE("NumPy reads the arrays that are written for it, type, shape and every value") {
    const test::TemporaryDirectory directory;
    const auto ids = directory.path() / "ids.npy", depth = directory.path() / "depth.npy";
    std::vector<std::int32_t> integers;
    std::vector<double> numbers;
    for (int i = 0; i < 15; ++i) {
        integers.push_back(i % 2 ? -i : 1 << 2 * i);
        numbers.push_back(i == 7 ? std::numeric_limits<double>::infinity() : std::sqrt(i) * 1e-3);
    }
    write_npy(ids, integers, 3, 5);
    write_npy(depth, numbers, 5, 3);
    const std::string text = output_of("/usr/bin/python3 -c \"import numpy, math; a = numpy.load('" + ids.string() +
                                       "'); b = numpy.load('" + depth.string() +
                                       "'); print(a.dtype, a.shape, a.flags['C_CONTIGUOUS'], all(int(a[i//5, i%5]) == "
                                       "(-i if i % 2 else 1 << 2*i) for i in range(15)),"
                                       " b.dtype, b.shape, all(float(b[i//3, i%3]) == (math.inf if i == 7 else "
                                       "math.sqrt(i)*1e-3) for i in range(15)))\"");
    CHECK(text == "int32 (3, 5) True True float64 (5, 3) True\n");
    CHECK(std::filesystem::file_size(ids) == 128 + 15 * 4);
    CHECK_THROWS_AS(write_npy(ids, integers, 4, 4), std::invalid_argument);
}

TEST_CASE("A frame's hash depends on every visible byte and on nothing else") {
    Picture picture = test::random_picture(33, 21, 4);
    const std::uint64_t hash = frame_hash(picture.image());
    // The same pixels in padded and in bottom-up memory.
    std::vector<std::uint8_t> padded(160 * 21, 77);
    const FrameImage down{padded.data(), 33, 21, 160}, up{padded.data() + 160 * 20, 33, 21, -160};
    copy_pixels(picture.image(), down);
    CHECK(frame_hash(down) == hash);
    copy_pixels(picture.image(), up);
    CHECK(frame_hash(up) == hash);
    for (std::size_t i = 0; i < picture.pixels.size(); i += 97) {
        picture.pixels[i] ^= 1;
        CHECK(frame_hash(picture.image()) != hash);
        picture.pixels[i] ^= 1;
    }
    const std::uint64_t ab[]{1, 2}, ba[]{2, 1};
    CHECK(sequence_hash(ab) != sequence_hash(ba));
    CHECK(hex(0xAB) == "00000000000000ab");
}

TEST_CASE("A frame's hash is the XXH3-64 of its bytes that the xxhsum tool gives") {
    Picture ramp(64, 48);
    for (std::size_t i = 0; i < ramp.pixels.size(); ++i) ramp.pixels[i] = static_cast<std::uint8_t>(7 * i + i / 256);
    CHECK(hex(frame_hash(ramp.image())) == "0ccc8c1fbc321f02");  // xxhsum -H3, version 0.8.1
    CHECK(hex(sequence_hash({})) == "2d06800538d394c2");         // the specification's own test vector, no bytes
}

TEST_CASE("Scaling down takes the mean in linear light by covered area") {
    Picture black_and_white(4, 2), out(2, 1);
    test::fill(black_and_white.image(), 0, 0, 0);
    for (const int pixel : {0, 3, 4, 7})
        for (std::size_t i = 0; i < 3; ++i) black_and_white.pixels[4 * static_cast<std::size_t>(pixel) + i] = 255;
    scale_down(black_and_white.image(), out.image());
    // Half the light of white is sRGB 187.5 (IEC 61966-2-1).
    for (const std::size_t i : {0U, 1U, 2U, 4U, 5U, 6U}) CHECK(out.pixels[i] == 188);
    CHECK(out.pixels[3] == 255);

    Picture thirds(3, 1), one(2, 1);
    test::fill(thirds.image(), 0, 0, 0);
    thirds.pixels[4] = 255;  // the middle pixel belongs half to either cell: a third of a cell's light, sRGB 156
    scale_down(thirds.image(), one.image());
    CHECK(one.pixels[0] == 156);
    CHECK(one.pixels[4] == 156);

    Picture random = test::random_picture(7, 5, 6), same(7, 5);
    scale_down(random.image(), same.image());
    CHECK(same.pixels == random.pixels);
}

TEST_CASE("A contact sheet holds its pictures in reading order and takes no more than it has room for") {
    ContactSheet sheet(2, 2, 8, 6, 3);
    Picture picture(16, 12);
    for (int i = 0; i < 4; ++i) {
        test::fill(picture.image(), static_cast<std::uint8_t>(50 * i + 60), 0, 0);
        CHECK(sheet.add(picture.image()));
    }
    CHECK_FALSE(sheet.add(picture.image()));
    CHECK(sheet.count() == 4);
    const FrameImage page = sheet.image();
    CHECK(page.width == 2 * 11 + 3);
    CHECK(page.height == 2 * 9 + 3);
    for (int i = 0; i < 4; ++i) CHECK(page.row(3 + 9 * (i / 2) + 3)[4 * (3 + 11 * (i % 2) + 4)] == 50 * i + 60);
    CHECK(page.row(1)[4] == 24);
}
