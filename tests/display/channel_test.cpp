#include "display/channel.h"

#include <GL/gl.h>
#include <GL/osmesa.h>

#include <catch2/catch.hpp>
#include <cstdint>
#include <stdexcept>

using quadrig::FrameImage;
using quadrig::display::Channel;

TEST_CASE("A channel's picture is the very memory of the OSMesa frame buffer, rows aligned to 64 bytes") {
    Channel channel(101, 37);
    const FrameImage image = channel.image();
    GLint width = 0, height = 0, format = 0;
    void* memory = nullptr;
    REQUIRE(OSMesaGetColorBuffer(OSMesaGetCurrentContext(), &width, &height, &format, &memory));
    CHECK(memory == image.top_row);
    CHECK(width == 101);
    CHECK(height == 37);
    CHECK(image.width == 101);
    CHECK(image.height == 37);
    CHECK(image.row_bytes == 448);
    for (int r = 0; r < image.height; ++r) CHECK(reinterpret_cast<std::uintptr_t>(image.row(r)) % 64 == 0);
}

TEST_CASE("Row 0 of a channel's picture is where GL draws the top") {
    Channel channel(64, 48);
    glViewport(0, 0, 64, 48);
    glClearColor(0, 0, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 44, 8, 4);  // GL counts rows from the bottom
    glClearColor(1, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glFinish();
    const FrameImage image = channel.image();
    for (int r = 0; r < 48; ++r)
        for (int c = 0; c < 64; ++c) {
            const bool corner = r < 4 && c < 8;
            const std::uint8_t* p = image.row(r) + 4 * c;
            REQUIRE(p[0] == (corner ? 255 : 0));
            REQUIRE(p[1] == 0);
            REQUIRE(p[2] == (corner ? 0 : 255));
            REQUIRE(p[3] == 255);
        }
}

TEST_CASE("What is written into a channel stays when its context changes hands") {
    Channel channel(40, 30);
    const FrameImage image = channel.image();
    for (int r = 0; r < 30; ++r)
        for (int b = 0; b < 160; ++b) image.row(r)[b] = static_cast<std::uint8_t>(7 * r + b);
    {
        Channel other(40, 30);
        glClearColor(1, 1, 1, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        glFinish();
    }
    channel.make_current();
    glFinish();
    for (int r = 0; r < 30; ++r)
        for (int b = 0; b < 160; ++b) REQUIRE(image.row(r)[b] == static_cast<std::uint8_t>(7 * r + b));
}

TEST_CASE("A channel refuses sizes that are none") {
    CHECK_THROWS_AS(Channel(0, 10), std::runtime_error);
    CHECK_THROWS_AS(Channel(10, -1), std::runtime_error);
    CHECK_THROWS_WITH(Channel(20000, 10), Catch::Contains("20000x10"));
}
