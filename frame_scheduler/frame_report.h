/// The report at the end of every run: as JSON for programs, as a page for people.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "frame_scheduler/frame_loop.h"
#include "frame_scheduler/machine.h"
#include "frame_scheduler/real_time.h"
#include "frame_scheduler/statistics.h"

namespace quadrig::scheduler {

struct SinkReport {
    std::string url;
    std::uint64_t frames = 0, dropped = 0, failed = 0;
    std::string error;  ///< empty: none
};

/// Everything of the report, as values. What each figure is measured from and to is said at FrameRecord.
struct FrameReport {
    std::string version;
    Machine machine;
    int width = 0, height = 0;
    double rate_hz = 0.0;
    bool real_time = false;                ///< by deadlines; false: as fast as frames could be drawn
    std::optional<RealTimeGrants> grants;  ///< of the frame thread, where they were asked for

    std::uint64_t frames = 0, deadline_misses = 0, repeated_frames = 0;
    Percentiles frame, hand_over, latency, wake_late, timer_late;
    std::array<Percentiles, kStageCount> stages{};
    std::map<std::string, std::uint64_t> quality;  ///< frames drawn at each setting, by its name

    nlohmann::ordered_json links = nlohmann::ordered_json::array();  ///< one object per link, as the links tell it
    std::vector<SinkReport> sinks;
    std::string hash;                       ///< of all frames; empty: none was taken
    std::vector<std::string> frame_hashes;  ///< in order
};

/// Copies what a frame loop recorded.
void add_record(FrameReport& report, const FrameRecord& record);

/// Report schema 1. Times are milliseconds.
nlohmann::ordered_json to_json(const FrameReport& report);

/// The JSON as text with a newline at the end; what is not UTF-8 (file names may be
/// anything) is replaced.
std::string json_text(const FrameReport& report);

/// A page of at most 80 columns, but for long names.
std::string summary(const FrameReport& report);

}  // namespace quadrig::scheduler
