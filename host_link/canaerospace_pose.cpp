#include "host_link/canaerospace_pose.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "host_link/wire.h"

namespace quadrig::host::canaerospace {

namespace {

std::size_t place_in(Role role) { return static_cast<std::size_t>(role); }
bool is_part(Role role) { return role >= Role::pitch && role <= Role::height; }
bool is_position(Role role) { return role >= Role::latitude && role <= Role::height; }

bool same_contents(const Message& a, const Message& b) {
    return a.node == b.node && a.type == b.type && a.service == b.service && a.data == b.data;
}

double joined(const Message& high, const Message& low) {
    const std::uint64_t upper = load<std::uint32_t>(high.data, 0, ByteOrder::big);
    return std::bit_cast<double>(upper << 32 | load<std::uint32_t>(low.data, 0, ByteOrder::big));
}

}  // namespace

PoseAssembler::PoseAssembler(const PoseSettings& settings) : settings_(settings) {
    if (!settings_.commit) settings_.commit = id_of(Role::height, settings_.position);
}

PoseAssembler::Channel* PoseAssembler::channel_of(std::uint8_t number) {
    const auto known = std::ranges::find(channels_, number, &Channel::number);
    if (known != channels_.end()) return known;
    if (channels_.full()) return nullptr;
    Channel& channel = channels_.push_back({});
    channel.number = number;
    return &channel;
}

PoseAssembler::Place PoseAssembler::place_of(Counter& counter, const Message& message, Time arrival) {
    if (counter.newest) {
        const auto ahead = static_cast<std::uint8_t>(message.code - counter.newest->code);
        const auto behind = static_cast<std::uint8_t>(-ahead);
        // A host whose code stands still repeats itself on purpose.
        if (ahead == 0 && counter.counts && same_contents(message, *counter.newest)) return Place::duplicate;
        if (ahead != 0 && behind <= kWindow && arrival - counter.arrival < kLate) return Place::late;
        const bool restarted = ahead >= 128;
        if (restarted && message.id == settings_.commit) ++restarts_;
        if (!restarted && ahead > 1) lost_ += ahead - 1U;
        counter.counts = counter.counts || ahead != 0;
    }
    counter.newest = message;
    counter.arrival = arrival;
    return Place::next;
}

std::optional<Reject> PoseAssembler::store(Channel& channel, const Message& message, Time arrival) const {
    const Parameter& parameter = parameter_at(parameter_index(message.id));
    if (!is_part(parameter.role) || (is_position(parameter.role) && parameter.source != settings_.position))
        return std::nullopt;
    const std::size_t place = place_in(parameter.role);
    std::optional<UpperHalf>& upper = channel.upper_halves[place];
    std::optional<double> value = number_of(message);
    if (message.type == DataType::double_high) {
        return std::exchange(upper, UpperHalf{message, arrival}) ? std::optional(Reject::lone_half) : std::nullopt;
    }
    if (message.type == DataType::double_low) {
        const bool pair = upper && upper->message.node == message.node &&
                          static_cast<std::uint8_t>(upper->message.code + 1) == message.code &&
                          arrival - upper->arrival <= settings_.timeout;
        if (pair) value = joined(upper->message, message);
        upper.reset();
        if (!pair) return Reject::lone_half;
    }
    if (!value) return Reject::bad_data_type;
    if (!std::isfinite(*value)) return Reject::out_of_range;
    channel.parts[place] = {*value, arrival};
    return std::nullopt;
}

std::optional<GeodeticPose> PoseAssembler::pose_of(const Channel& channel, Time now) const {
    const auto part = [&](Role role) -> const Part& { return channel.parts[place_in(role)]; };
    const auto fresh = [&](Role role) {
        const auto& arrival = part(role).arrival;
        return arrival && now - *arrival <= settings_.timeout;
    };
    const Role heading = fresh(Role::true_heading) ? Role::true_heading : Role::heading;
    for (const Role role : {Role::pitch, Role::roll, heading, Role::latitude, Role::longitude, Role::height})
        if (!fresh(role)) return std::nullopt;
    return GeodeticPose{{{part(Role::latitude).value}, {part(Role::longitude).value}, part(Role::height).value},
                        {{part(heading).value}, {part(Role::pitch).value}, {part(Role::roll).value}}};
}

bool PoseAssembler::drives(Channel& channel, Time now) {
    const bool unbroken = channel.last_pose && now - *channel.last_pose <= settings_.timeout;
    if (!unbroken) channel.steady_since = now;
    channel.last_pose = now;
    if (settings_.channel) return channel.number == *settings_.channel;
    const auto index = static_cast<std::size_t>(&channel - channels_.begin());
    const bool alone = !driving_ || *driving_ == index;
    const bool silent = !alone && now - *channels_[*driving_].last_pose > settings_.timeout;
    const bool better = !alone && channel.number < channels_[*driving_].number && now - channel.steady_since >= kSteady;
    if (alone || silent || better) driving_ = index;
    return driving_ == index;
}

PoseAssembler::Outcome PoseAssembler::accept(const Message& message, Time arrival) {
    Outcome outcome;
    Channel* channel = channel_of(message.channel);
    if (channel == nullptr) {
        outcome.reject = Reject::unknown_channel;
        return outcome;
    }
    outcome.drives =
        settings_.channel ? message.channel == *settings_.channel : !driving_ || &channels_[*driving_] == channel;
    const std::size_t index = parameter_index(message.id);
    const bool counted = parameter_at(index).role != Role::none && parameter_at(index).role != Role::service_request;
    if (counted) outcome.place = place_of(channel->counters[index], message, arrival);
    if (outcome.place != Place::next) return outcome;
    outcome.reject = store(*channel, message, arrival);
    const bool half = message.type == DataType::double_high;
    if (outcome.reject || half || message.id != settings_.commit) return outcome;
    const auto pose = pose_of(*channel, arrival);
    if (!pose) {
        outcome.reject = Reject::incomplete_pose;
        return outcome;
    }
    outcome.drives = drives(*channel, arrival);
    if (outcome.drives) outcome.pose = pose;
    return outcome;
}

}  // namespace quadrig::host::canaerospace
