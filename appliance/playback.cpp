#include "appliance/playback.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace quadrig::appliance {

namespace {

host::Verdict play(const host::Capture& capture, std::size_t index, host::Session& session) {
    for (const auto& closing : capture.closed_before(index)) session.connection_closes(closing.source);
    const host::Capture::Datagram& datagram = capture.datagrams[index];
    return session.accept(capture.payload(datagram), datagram.captured, datagram.source);
}

}  // namespace

Playback::Playback(const host::Capture& capture, const host::SessionOptions& options)
    : capture_(capture), session_(options) {
    bool found = false;
    while (!found && next_ < capture.datagrams.size()) {
        begin_ = end_ = capture.datagrams[next_].captured;
        found = play_next() == host::Verdict::pose;
    }
    if (!found) {
        std::string reasons;
        for (const auto& [reason, count] : host::rejected_by_reason(session_.statistics()))
            reasons += (reasons.empty() ? "; refused: " : ", ") + std::string(reason) + " " + std::to_string(count);
        throw std::runtime_error("no pose of the ownship in " + std::to_string(capture.datagrams.size()) +
                                 " datagrams of " + text(capture.flow) + reasons);
    }
    for (std::size_t i = next_; i < capture.datagrams.size(); ++i) end_ = std::max(end_, capture.datagrams[i].captured);
}

host::Verdict Playback::play_next() { return play(capture_, next_++, session_); }

const host::HostState& Playback::state_at(host::Time time) {
    while (next_ < capture_.datagrams.size() && capture_.datagrams[next_].captured <= time) play_next();
    return session_.state();
}

RunAgain::RunAgain(const host::Capture& capture, const host::SessionOptions& options,
                   const host::RecordedFrames& frames)
    : capture_(capture), frames_(frames), session_(options) {
    const std::uint64_t heard = frames.frames.empty() ? 0 : frames.frames.back().heard;
    if (heard > capture.datagrams.size())
        throw std::runtime_error("the recorded frames have seen " + std::to_string(heard) +
                                 " datagrams, the recording has " + std::to_string(capture.datagrams.size()));
}

void RunAgain::play_to(std::uint64_t heard) {
    const auto& changes = frames_.host_changes;
    for (; next_ < heard; ++next_) {
        for (; next_change_ < changes.size() && changes[next_change_].heard <= next_; ++next_change_)
            session_.host_changes();
        play(capture_, next_, session_);
    }
}

const host::HostState& RunAgain::state_at(std::uint64_t index) {
    play_to(frames_.frames[index].heard);
    return session_.state();
}

}  // namespace quadrig::appliance
