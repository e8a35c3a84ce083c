/// Writes what a live link hears to a file, while it hears it, and beside it what each frame had heard by then.
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

#include "host_link/live_link.h"
#include "host_link/recorded_frames.h"
#include "host_link/recording.h"
#include "host_link/sockets.h"

namespace quadrig::host {

/// A thread of its own hands everything to the operating system ten times a second: what a killed process loses is the
/// last tenth. Neither the link's thread nor the frame loop waits for the disk: if it stalls for longer than
/// kMostPending bytes or kMostMarks frames last, what comes then is left out and counted.
class Recorder {
  public:
    static constexpr std::size_t kMostPending = std::size_t{64} << 20;
    static constexpr std::size_t kMostMarks = 8192;
    static constexpr Time kInterval = std::chrono::milliseconds(100);

    struct Settings {
        std::filesystem::path file;            ///< .log: candump's text, which only CAN can have; all else: pcapng
        std::optional<FrameNumbering> frames;  ///< present: frames are told too, in recorded_frames_file(file)
    };
    /// Makes the files and takes `link`, which has not started. Throws std::runtime_error with the file's name.
    Recorder(LiveLink& link, const Settings& settings);
    /// Writes what is left.
    ~Recorder();
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// The frame loop's, once a frame: its number, its deadline by CLOCK_MONOTONIC, how much the link had heard
    /// when the frame took its newest state, and the step of the quality ladder. Neither waits nor allocates.
    void frame(const RecordedFrame& frame);

    /// Writes what is left, and ends. Throws std::runtime_error where a file could not be written to its end.
    void finish();
    [[nodiscard]] std::uint64_t recorded() const { return recorded_.load(std::memory_order_relaxed); }
    [[nodiscard]] std::uint64_t left_out() const { return left_out_.load(std::memory_order_relaxed); }

  private:
    void hear(const Heard& heard);
    void write_from_time_to_time();
    void write_pending();
    void write_all(int file, const std::string& text, const std::filesystem::path& name);

    std::filesystem::path file_, frames_file_;
    RecordingText text_;
    Time since_1970_;  ///< whole seconds between the clocks
    Descriptor out_, frames_out_;
    std::mutex mutex_;
    std::string pending_, pending_changes_;
    std::string error_;
    std::condition_variable wake_;
    bool ending_ = false;
    std::array<RecordedFrame, kMostMarks> marks_{};
    std::atomic<std::uint64_t> marked_{0}, written_{0};
    std::atomic<std::uint64_t> recorded_{0}, left_out_{0};
    std::thread thread_;
};

}  // namespace quadrig::host
