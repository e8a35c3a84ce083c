#include "display/sink.h"

#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>

#include <chrono>
#include <exception>
#include <utility>

namespace quadrig::display {

namespace {

/// Writing to a pipe whose reader has gone raises SIGPIPE in the writing thread; blocked there, it is only an error of
/// write(). Signals for the process go to threads that expect them.
void block_signals() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, nullptr);
}

/// On a machine with as many busy drawing threads as cores, sinks get what is left over.
void yield_to_drawing() {
    constexpr int kNice = 10;
    setpriority(PRIO_PROCESS, 0, kNice);  // on Linux: of the calling thread
}

}  // namespace

Sink::Sink(const std::string& url, const VideoFormat& format, WhenFull when_full, std::size_t slots,
           std::function<bool()> give_up)
    : Sink(url, open_writer(url, format), format, when_full, slots, std::move(give_up)) {}

Sink::Sink(const std::string& url, std::unique_ptr<FrameWriter> writer, const VideoFormat& format, WhenFull when_full,
           std::size_t slots, std::function<bool()> give_up)
    : writer_(std::move(writer)),
      when_full_(when_full),
      give_up_(std::move(give_up)),
      free_(static_cast<unsigned>(slots)) {
    status_.url = url;
    if (!writer_) return;
    slots_.resize(slots);
    for (Slot& slot : slots_) slot.picture = Picture(format.width, format.height);
    thread_ = std::jthread([this](const std::stop_token& closing) { run(closing); });
}

Sink::~Sink() { close(); }

bool Sink::take_free_slot() {
    constexpr auto kPause = std::chrono::milliseconds(1);
    while (!free_.try_take()) {
        if (when_full_ == WhenFull::drop || (give_up_ && give_up_())) return false;
        std::this_thread::sleep_for(kPause);
    }
    return true;
}

bool Sink::hand_over(const FrameImage& image, std::uint64_t number) {
    if (!writer_) {
        ++status_.frames;
        return true;
    }
    if (!take_free_slot()) {
        ++status_.dropped;
        return false;
    }
    Slot& slot = slots_[handed_over_ % slots_.size()];
    copy_pixels(image, slot.picture.image());
    slot.number = number;
    published_.store(++handed_over_, std::memory_order_release);
    filled_.post();
    return true;
}

void Sink::run(const std::stop_token& closing) {
    block_signals();
    if (when_full_ == WhenFull::drop) yield_to_drawing();
    const auto attempt = [this](auto&& action) {
        try {
            action();
            return true;
        } catch (const std::exception& error) {
            if (status_.error.empty()) status_.error = error.what();
            has_error_.store(true, std::memory_order_relaxed);
            return false;
        }
    };
    for (std::uint64_t taken = 0;; ++taken) {
        filled_.take();
        if (taken == published_.load(std::memory_order_acquire)) break;  // woken by close() only
        Slot& slot = slots_[taken % slots_.size()];
        const bool usable = status_.error.empty() || writer_->usable_after_error();
        const bool written = usable && attempt([&] { writer_->write(slot.picture.image(), slot.number, closing); });
        ++(written ? status_.frames : status_.failed);
        free_.post();
    }
    if (status_.error.empty()) attempt([this] { writer_->finish(); });
}

SinkStatus Sink::close() {
    if (thread_.joinable()) {
        thread_.request_stop();
        filled_.post();
        thread_.join();
    }
    return status_;
}

}  // namespace quadrig::display
