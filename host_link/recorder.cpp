#include "host_link/recorder.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <system_error>

namespace quadrig::host {

namespace {

RecordingFormat format_of(const LiveLink& link, const std::filesystem::path& file) {
    if (file.extension() != ".log") return RecordingFormat::pcapng;
    if (link.url().protocol != Protocol::canaerospace)
        throw std::runtime_error(file.string() + ": only CAN can be recorded as a log; say .pcapng");
    return RecordingFormat::candump;
}

std::string why() { return std::system_category().message(errno); }

int create(const std::filesystem::path& file) {
    const int out = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (out < 0) throw std::runtime_error(file.string() + ": cannot be written: " + why());
    return out;
}

/// Whole seconds, so that nothing that is counted in parts of a second moves; the calendar's time to half a second.
Time seconds_between_clocks() {
    return round<std::chrono::seconds>(clock_time(CLOCK_REALTIME) - clock_time(CLOCK_MONOTONIC));
}

}  // namespace

Recorder::Recorder(LiveLink& link, const Settings& settings)
    : file_(settings.file),
      frames_file_(recorded_frames_file(settings.file)),
      text_(link.url().protocol, format_of(link, settings.file), link.url().address),
      since_1970_(seconds_between_clocks()),
      out_(create(file_)),
      frames_out_(settings.frames ? create(frames_file_) : -1) {
    // Frames of another recording of that name would be wrong.
    if (!settings.frames) std::filesystem::remove(frames_file_);
    write_all(out_.fd, text_.begin(), file_);
    if (settings.frames) write_all(frames_out_.fd, first_line(*settings.frames), frames_file_);
    if (!error_.empty()) throw std::runtime_error(error_);
    link.record_to([this](const Heard& heard) { hear(heard); });
    thread_ = std::thread([this] { write_from_time_to_time(); });
}

Recorder::~Recorder() {
    try {
        finish();
    } catch (const std::runtime_error&) {  // said where finish is called by name
    }
}

void Recorder::hear(const Heard& heard) {
    const std::lock_guard lock(mutex_);
    const HostChange now{recorded_.load(std::memory_order_relaxed)};
    for (std::uint32_t change = 0; change < heard.changes; ++change) pending_changes_ += line_of(now);
    if (pending_.size() > kMostPending && !heard.closes) {
        left_out_.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    pending_ += text_.piece(heard, heard.arrival + since_1970_);
    if (heard.closes) return;
    recorded_.fetch_add(1, std::memory_order_relaxed);
}

void Recorder::frame(const RecordedFrame& frame) {
    const std::uint64_t next = marked_.load(std::memory_order_relaxed);
    if (next - written_.load(std::memory_order_acquire) == kMostMarks) {
        left_out_.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    marks_[next % kMostMarks] = frame;
    marks_[next % kMostMarks].due += since_1970_;
    marked_.store(next + 1, std::memory_order_release);
}

void Recorder::write_from_time_to_time() {
    std::unique_lock lock(mutex_);
    while (!ending_) {
        wake_.wait_for(lock, kInterval, [this] { return ending_; });
        lock.unlock();
        write_pending();
        lock.lock();
    }
}

void Recorder::write_pending() {
    // A frame is gathered before its datagrams and written after them: whenever the process is killed, the file never
    // tells of a frame whose datagrams it lacks.
    std::string frames;
    const std::uint64_t marked = marked_.load(std::memory_order_acquire);
    std::uint64_t next = written_.load(std::memory_order_relaxed);
    for (; next != marked; ++next) frames += line_of(marks_[next % kMostMarks]);
    written_.store(next, std::memory_order_release);
    std::string datagrams, changes;
    {
        const std::lock_guard lock(mutex_);
        datagrams.swap(pending_);
        changes.swap(pending_changes_);
    }
    write_all(out_.fd, datagrams, file_);
    if (frames_out_.fd >= 0) write_all(frames_out_.fd, changes + frames, frames_file_);
}

void Recorder::write_all(int file, const std::string& text, const std::filesystem::path& name) {
    for (std::size_t done = 0; done < text.size() && error_.empty();) {
        const auto written = write(file, text.data() + done, text.size() - done);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) error_ = name.string() + ": cannot be written: " + why();
        done += static_cast<std::size_t>(std::max<ssize_t>(written, 0));
    }
}

void Recorder::finish() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    wake_.notify_one();
    thread_.join();
    write_pending();
    if (!error_.empty()) throw std::runtime_error(error_);
}

}  // namespace quadrig::host
