/// A sink: a writer on a thread of its own behind a ring of frame slots, so that nothing it does can hold up the frame
/// loop.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "display/frame_writer.h"
#include "display/picture.h"
#include "display/semaphore.h"
#include "ig_core/view.h"

namespace quadrig::display {

/// What became of the frames that were handed over: frames + dropped + failed is their number once the sink is closed.
struct SinkStatus {
    std::string url;
    std::uint64_t frames = 0;   ///< written
    std::uint64_t dropped = 0;  ///< found no free slot: the sink was too slow
    std::uint64_t failed = 0;   ///< lost to an error
    std::string error;          ///< the first one; empty: none
};

/// What to do with a frame that finds no free slot.
enum class WhenFull {
    drop,  ///< in real time: lose it and count it
    wait,  ///< where no frame may be lost and nothing is due: wait for the sink
};

/// One producer hands frames over. Slots are allocated here; handing over neither allocates, locks nor blocks (`drop`).
class Sink {
  public:
    static constexpr std::size_t kDefaultSlots = 6;

    /// Throws std::runtime_error as open_writer does. `give_up` ends a wait under WhenFull::wait; it is asked every
    /// millisecond.
    Sink(const std::string& url, const VideoFormat& format, WhenFull when_full, std::size_t slots = kDefaultSlots,
         std::function<bool()> give_up = {});
    /// The same for a writer made elsewhere; null discards every frame.
    Sink(const std::string& url, std::unique_ptr<FrameWriter> writer, const VideoFormat& format, WhenFull when_full,
         std::size_t slots = kDefaultSlots, std::function<bool()> give_up = {});
    ~Sink();
    Sink(const Sink&) = delete;
    Sink& operator=(const Sink&) = delete;

    /// Copies a picture of the format's size into a slot. False: it was dropped.
    bool hand_over(const FrameImage& image, std::uint64_t number);
    /// An error has come up; once true it stays so.
    [[nodiscard]] bool has_error() const { return has_error_.load(std::memory_order_relaxed); }
    /// Writes what is waiting, ends the thread, says what became of everything. May be called again.
    SinkStatus close();

  private:
    struct Slot {
        Picture picture;
        std::uint64_t number = 0;
    };
    void run(const std::stop_token& closing);
    bool take_free_slot();

    std::unique_ptr<FrameWriter> writer_;
    WhenFull when_full_;
    std::function<bool()> give_up_;
    std::vector<Slot> slots_;
    Semaphore free_, filled_{0};
    std::uint64_t handed_over_ = 0;            // the producer's
    std::atomic<std::uint64_t> published_{0};  // frames the thread may take, for it to know when it has them all
    std::atomic<bool> has_error_{false};
    SinkStatus status_;  // dropped: the producer's; the rest: the thread's until it is joined
    std::jthread thread_;
};

}  // namespace quadrig::display
