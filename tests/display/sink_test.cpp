#include "display/sink.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "display/contact_sheet_sink.h"
#include "display/png_file.h"
#include "display/png_sink.h"
#include "display/y4m_sink.h"
#include "tests/display/pictures.h"

using namespace quadrig;
using namespace quadrig::display;
using namespace std::chrono_literals;

namespace {

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Takes its time, and fails from one frame on.
class SlowWriter : public FrameWriter {
  public:
    SlowWriter(std::vector<std::uint64_t>& seen, std::chrono::milliseconds pause, std::uint64_t fails_from = ~0ULL,
               bool recovers = false)
        : seen_(seen), pause_(pause), fails_from_(fails_from), recovers_(recovers) {}
    void write(const FrameImage& image, std::uint64_t number, const std::stop_token&) override {
        std::this_thread::sleep_for(pause_);
        if (number >= fails_from_) throw std::runtime_error("the disk is full at " + std::to_string(number));
        for (int r = 0; r < image.height; ++r)
            for (int c = 0; c < image.width; ++c)
                if (image.row(r)[4 * c] != number % 256) throw std::runtime_error("a torn frame");
        seen_.push_back(number);
    }
    [[nodiscard]] bool usable_after_error() const override { return recovers_; }

  private:
    std::vector<std::uint64_t>& seen_;
    std::chrono::milliseconds pause_;
    std::uint64_t fails_from_;
    bool recovers_;
};

}  // namespace

TEST_CASE("A slow sink in real time loses frames, counts them, never waits and never shows a torn picture") {
    std::vector<std::uint64_t> seen;
    Picture picture(320, 200);
    Sink sink("test:", std::make_unique<SlowWriter>(seen, 20ms), {320, 200}, WhenFull::drop, 3);
    std::uint64_t accepted = 0;
    int waited = 0;  // as long as the sink takes for half a frame
    for (std::uint64_t k = 0; k < 100; ++k) {
        test::fill(picture.image(), static_cast<std::uint8_t>(k), 0, 0);
        const auto start = std::chrono::steady_clock::now();
        accepted += sink.hand_over(picture.image(), k);
        waited += std::chrono::steady_clock::now() - start > 10ms;
        std::this_thread::sleep_for(1ms);
    }
    const SinkStatus status = sink.close();
    CHECK(status.error.empty());
    CHECK(status.frames == accepted);
    CHECK(status.frames == seen.size());
    CHECK(status.frames + status.dropped == 100);
    CHECK(status.dropped > 30);
    CHECK(status.failed == 0);
    CHECK(std::is_sorted(seen.begin(), seen.end()));
    CHECK(waited < 20);  // the machine may have other things to do now and then
}

TEST_CASE("Where no frame may be lost the producer waits for the sink, and gives up when asked to") {
    std::vector<std::uint64_t> seen;
    Picture picture(16, 16);
    {
        Sink sink("test:", std::make_unique<SlowWriter>(seen, 2ms), {16, 16}, WhenFull::wait, 2);
        for (std::uint64_t k = 0; k < 40; ++k) {
            test::fill(picture.image(), static_cast<std::uint8_t>(k), 0, 0);
            CHECK(sink.hand_over(picture.image(), k));
        }
        const SinkStatus status = sink.close();
        CHECK(status.frames == 40);
        CHECK(status.dropped == 0);
        CHECK(seen.size() == 40);
    }
    seen.clear();
    Sink stuck("test:", std::make_unique<SlowWriter>(seen, 400ms), {16, 16}, WhenFull::wait, 1, [] { return true; });
    test::fill(picture.image(), 0, 0, 0);
    stuck.hand_over(picture.image(), 0);
    CHECK_FALSE(stuck.hand_over(picture.image(), 1));
    CHECK(stuck.close().dropped == 1);
}

TEST_CASE("A failing sink keeps its first error, counts what was lost and blocks nobody") {
    Picture picture(16, 16);
    for (const bool recovers : {false, true}) {
        std::vector<std::uint64_t> seen;
        Sink sink("test:", std::make_unique<SlowWriter>(seen, 0ms, 5, recovers), {16, 16}, WhenFull::wait, 2);
        for (std::uint64_t k = 0; k < 20; ++k) {
            test::fill(picture.image(), static_cast<std::uint8_t>(k), 0, 0);
            CHECK(sink.hand_over(picture.image(), k));
        }
        const SinkStatus status = sink.close();
        CHECK(status.frames == 5);
        CHECK(status.failed == 15);
        CHECK(status.error == "the disk is full at 5");
        CHECK(sink.has_error());
    }
}

TEST_CASE("Sink URLs that are none are refused with what is accepted") {
    const VideoFormat format{16, 16};
    for (const char* url : {"", "png", "png:", "y4m:", "none", "none:x", "jpeg:out", "window:", "/tmp/x.png"}) {
        INFO(url);
        CHECK_THROWS_WITH(open_writer(url, format), Catch::Contains("\"" + std::string(url) + "\"") &&
                                                        Catch::Contains("png:DIRECTORY") &&
                                                        Catch::Contains("y4m:FILE") && Catch::Contains("none:"));
    }
    CHECK(open_writer("none:", format) == nullptr);
    Sink none("none:", format, WhenFull::drop);
    Picture picture(16, 16);
    CHECK(none.hand_over(picture.image(), 0));
    CHECK(none.close().frames == 1);
}

TEST_CASE("The png sink makes its directory, names frames by number and loses nothing when told to wait") {
    const test::TemporaryDirectory directory;
    const auto target = directory.path() / "a" / "b";
    std::vector<Picture> pictures;
    Sink sink("png:" + target.string(), {31, 17}, WhenFull::wait);
    for (std::uint32_t k = 0; k < 12; ++k) {
        pictures.push_back(test::random_picture(31, 17, k));
        sink.hand_over(pictures.back().image(), 3 * k);
    }
    CHECK(sink.close().frames == 12);
    for (std::uint32_t k = 0; k < 12; ++k) CHECK(read_png(target / png_frame_name(3 * k)).pixels == pictures[k].pixels);
    CHECK(std::filesystem::exists(target / "frame-000033.png"));
    CHECK(std::distance(std::filesystem::directory_iterator(target), {}) == 12);
}

TEST_CASE("A png sink says at once when its directory cannot be made") {
    const test::TemporaryDirectory directory;
    std::ofstream(directory.path() / "file") << "in the way";
    CHECK_THROWS_WITH(open_writer("png:" + (directory.path() / "file").string(), {8, 8}), Catch::Contains("file"));
    CHECK_THROWS_AS(open_writer("png:" + (directory.path() / "file" / "below").string(), {8, 8}), std::runtime_error);
    CHECK_THROWS_WITH(open_writer("png:/proc/nowhere", {8, 8}), Catch::Contains("/proc/nowhere"));
}

TEST_CASE("A full disk is counted and reported, not fatal") {
    Picture picture = test::random_picture(64, 64, 1);
    Sink sink("y4m:/dev/full", {64, 64}, WhenFull::wait);
    for (std::uint64_t k = 0; k < 10; ++k) sink.hand_over(picture.image(), k);
    const SinkStatus status = sink.close();
    CHECK(status.frames == 0);
    CHECK(status.failed == 10);
    CHECK_THAT(status.error, Catch::Contains("/dev/full") && Catch::Contains("No space left on device"));
    CHECK_THROWS_WITH(open_writer("y4m:/no/such/directory/x", {8, 8}), Catch::Contains("/no/such/directory/x"));
}

TEST_CASE("ffmpeg decodes the y4m sink's video to the same pictures within 2 of 255, at the rate given") {
    const test::TemporaryDirectory directory;
    const auto video = directory.path() / "video.y4m", raw = directory.path() / "raw.rgb";
    std::vector<Picture> pictures;
    Sink sink("y4m:" + video.string(), {65, 49, 60, 1}, WhenFull::wait);
    for (std::uint32_t k = 0; k < 20; ++k) {
        pictures.push_back(test::random_picture(65, 49, 100 + k));
        sink.hand_over(pictures.back().image(), k);
    }
    REQUIRE(sink.close().frames == 20);
    REQUIRE(std::system(
                ("ffmpeg -v error -i " + video.string() + " -f rawvideo -pix_fmt rgb24 " + raw.string()).c_str()) == 0);
    const std::string decoded = bytes_of(raw);
    REQUIRE(decoded.size() == 20 * 65 * 49 * 3);
    int worst = 0;
    double sum = 0.0;
    std::size_t i = 0;
    for (const Picture& picture : pictures)
        for (std::size_t p = 0; p < picture.pixels.size(); ++p) {
            if (p % 4 == 3) continue;
            const int difference = std::abs(static_cast<std::uint8_t>(decoded[i++]) - picture.pixels[p]);
            worst = std::max(worst, difference);
            sum += difference;
        }
    INFO("mean difference " << sum / static_cast<double>(i));
    CHECK(worst <= 2);
    const auto probe = directory.path() / "probe";
    REQUIRE(std::system(("ffprobe -v error -count_frames -show_entries "
                         "stream=width,height,r_frame_rate,nb_read_frames,pix_fmt,color_range -of csv=p=0 " +
                         video.string() + " > " + probe.string())
                            .c_str()) == 0);
    CHECK(bytes_of(probe) == "65,49,yuv444p,pc,60/1,20\n");
}

TEST_CASE("Colours become Y'CbCr by the equations of BT.601 in full range, each rounded to the nearest") {
    Picture picture = test::random_picture(64, 64, 9);
    const std::uint8_t extremes[][3]{{0, 0, 0},   {255, 255, 255}, {255, 0, 0},
                                     {0, 255, 0}, {0, 0, 255},     {128, 128, 128}};
    for (std::size_t e = 0; e < 6; ++e) std::copy_n(extremes[e], 3, picture.pixels.data() + 4 * e);
    std::vector<std::uint8_t> planes(3 * 64 * 64);
    ycbcr_from_rgb(picture.image(), planes);
    for (std::size_t i = 0; i < 64 * 64; ++i) {
        const double r = picture.pixels[4 * i], g = picture.pixels[4 * i + 1], b = picture.pixels[4 * i + 2];
        const double y = 0.299 * r + 0.587 * g + 0.114 * b;
        REQUIRE(planes[i] == Approx(y).margin(0.501));
        REQUIRE(planes[64 * 64 + i] == Approx(std::min(255.0, (b - y) / 1.772 + 128.0)).margin(0.501));
        REQUIRE(planes[2 * 64 * 64 + i] == Approx(std::min(255.0, (r - y) / 1.402 + 128.0)).margin(0.501));
    }
}

TEST_CASE("A y4m reader that goes away ends the sink with an error and without a signal") {
    const test::TemporaryDirectory directory;
    const auto fifo = directory.path() / "fifo";
    REQUIRE(mkfifo(fifo.c_str(), 0600) == 0);
    const int reader = open(fifo.c_str(), O_RDONLY | O_NONBLOCK);
    REQUIRE(reader >= 0);
    Picture picture = test::random_picture(64, 64, 1);
    Sink sink("y4m:" + fifo.string(), {64, 64}, WhenFull::wait);
    sink.hand_over(picture.image(), 0);
    std::this_thread::sleep_for(20ms);
    close(reader);
    for (std::uint64_t k = 1; k < 10; ++k) sink.hand_over(picture.image(), k);
    const SinkStatus status = sink.close();
    CHECK_THAT(status.error, Catch::Contains("reader has gone"));
    CHECK(status.frames + status.failed == 10);
    CHECK(status.failed > 0);
}

TEST_CASE("A y4m reader that stops reading cannot keep the sink from closing") {
    const test::TemporaryDirectory directory;
    const auto fifo = directory.path() / "fifo";
    REQUIRE(mkfifo(fifo.c_str(), 0600) == 0);
    const int reader = open(fifo.c_str(), O_RDONLY | O_NONBLOCK);
    REQUIRE(reader >= 0);
    Picture picture = test::random_picture(256, 256, 1);
    Sink sink("y4m:" + fifo.string(), {256, 256}, WhenFull::drop, 2);
    for (std::uint64_t k = 0; k < 10; ++k) {
        sink.hand_over(picture.image(), k);
        std::this_thread::sleep_for(5ms);
    }
    const auto start = std::chrono::steady_clock::now();
    const SinkStatus status = sink.close();
    CHECK(std::chrono::steady_clock::now() - start < 5s);
    CHECK_THAT(status.error, Catch::Contains("stopped reading"));
    CHECK(status.dropped > 0);
    close(reader);
}

TEST_CASE("A contact sheet of a run of any length shows frames evenly spaced from the first on") {
    const test::TemporaryDirectory directory;
    const auto path = directory.path() / "sheet.png";
    const VideoFormat format{40, 20};
    for (const int frames : {1, 5, 36, 37, 100, 250}) {
        Sink sink("sheet", std::make_unique<ContactSheetWriter>(path, format), format, WhenFull::wait);
        Picture picture(40, 20);
        for (int k = 0; k < frames; ++k) {
            test::fill(picture.image(), static_cast<std::uint8_t>(k), 100, 200);
            sink.hand_over(picture.image(), static_cast<std::uint64_t>(k));
        }
        REQUIRE(sink.close().error.empty());
        int stride = 1;
        while ((frames + stride - 1) / stride > ContactSheetWriter::kMost) stride *= 2;
        const int count = (frames + stride - 1) / stride;
        Picture page = read_png(path);
        INFO(frames << " frames, every " << stride);
        CHECK(page.width == std::min(6, count) * 44 + 4);
        CHECK(page.height == (count + 5) / 6 * 24 + 4);
        for (int i = 0; i < count; ++i)
            CHECK(pixel(page.image(), 4 + i / 6 * 24 + 10, 4 + i % 6 * 44 + 20)[0] == i * stride);
    }
    CHECK_THROWS_WITH(ContactSheetWriter(directory.path() / "no" / "sheet.png", format), Catch::Contains("sheet.png"));
}
