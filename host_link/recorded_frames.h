/// Which of a recording's datagrams each frame of the live run had seen: with it the run is played again frame by
/// frame.
///
/// Text beside the recording: a first line that tells the rate, then a line "frame,due,heard,step" for each frame
/// drawn: its number, its deadline in nanoseconds since 1970 by the recording's clock, how many datagrams of the
/// recording had been taken in, and the step of the quality ladder that it was drawn with. Among them, wherever the
/// link passed to another host, a line "host,heard": after how many datagrams.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host_link/host_state.h"
#include "host_link/link_url.h"

namespace quadrig::host {

struct FrameNumbering {
    std::int64_t rate_numerator = 60, rate_denominator = 1;
    friend bool operator==(const FrameNumbering&, const FrameNumbering&) = default;
};

struct RecordedFrame {
    std::uint64_t number = 0;
    Time due{};
    std::uint64_t heard = 0;
    std::uint32_t step = 0;
};

/// The link passed to another host.
struct HostChange {
    std::uint64_t heard = 0;  ///< datagrams of the ones before
};

struct RecordedFrames {
    FrameNumbering numbering;
    std::vector<HostChange> host_changes;
    std::vector<RecordedFrame> frames;
};

/// RECORDING with ".frames" behind its name.
std::filesystem::path recorded_frames_file(const std::filesystem::path& recording);

/// Of a run with several links, where the one that drives entity `number` (from 1) is recorded, beside the driving
/// host's RECORDING: RECORDING with ".entity-N" before its extension, which is pcapng where a log would not do.
std::filesystem::path recording_of_entity(const std::filesystem::path& recording, std::size_t number,
                                          Protocol protocol);

std::string first_line(const FrameNumbering& numbering);
std::string line_of(const RecordedFrame& frame);
std::string line_of(const HostChange& change);

/// Absent where there is no such file. A last line that is cut is left out. Throws std::runtime_error with file and
/// line where it is something else, or its numbers go back.
std::optional<RecordedFrames> read_recorded_frames(const std::filesystem::path& recording);

}  // namespace quadrig::host
