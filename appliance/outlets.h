/// Where a run's finished frames go: sinks, a contact sheet, and hashes of their pixels.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "display/sink.h"
#include "frame_scheduler/frame_report.h"

namespace quadrig::appliance {

class Outlets {
  public:
    /// Longer runs are not hashed: what is kept of each frame has to be there before the run begins.
    static constexpr std::uint64_t kMostHashes = std::uint64_t{1} << 20;

    struct Settings {
        std::vector<std::string> sinks;
        display::VideoFormat format;
        display::WhenFull when_full = display::WhenFull::drop;
        std::function<bool()> give_up;        ///< ends a wait for a slow sink
        std::optional<std::uint64_t> frames;  ///< how many there will be, where that is known
        std::filesystem::path contact_sheet;  ///< empty: none
    };
    /// Opens all sinks. Throws std::runtime_error where one cannot be opened.
    explicit Outlets(const Settings& settings);

    /// Never waits for a sink that may drop frames; allocates nothing.
    void hand_over(const FrameImage& image, std::uint64_t number);
    [[nodiscard]] bool has_error() const;
    /// Closes the sinks and says in the report what became of all frames.
    void finish(scheduler::FrameReport& report);

  private:
    bool hashing_;
    std::vector<std::uint64_t> hashes_;
    std::vector<std::unique_ptr<display::Sink>> sinks_;
};

}  // namespace quadrig::appliance
