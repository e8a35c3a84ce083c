/// What hosts send, for tests of the program: messages, and recordings of them.
#pragma once

#include <chrono>
#include <filesystem>
#include <vector>

#include "ig_core/geometry/space.h"
#include "tests/host_link/support.h"

namespace quadrig::tests {

using Bytes = host::test::Bytes;

/// A pose above the origin of small_scene(), where scene axes and local level axes are the same.
struct Pose {
    double height = 14.0;  ///< m above the scene's Z = 0
    Attitude attitude;
};
Bytes fdm_message(const Pose& pose, std::uint32_t cur_time = 1234567890);
/// IG Control and the ownship's Entity Control (of 4.0 with its Entity Position), without smoothing, and `more` packets
/// behind them.
Bytes cigi_message(std::uint32_t host_frame, const Pose& pose, const Bytes& more = {},
                   host::cigi::Format format = host::ByteOrder::big);

/// A capture of datagrams at a steady period.
std::filesystem::path recording(const std::vector<Bytes>& datagrams, std::uint16_t port,
                                std::chrono::microseconds period = std::chrono::microseconds(16667));

/// A climb from 14 m, turning left and rolling, `count` samples at 60 Hz.
std::filesystem::path fdm_climb(int count);

}  // namespace quadrig::tests
