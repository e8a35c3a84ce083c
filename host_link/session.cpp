#include "host_link/session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <variant>

namespace quadrig::host {

namespace {

// Wider than the earth's surface needs, narrow enough to tell a garbled number from a position.
constexpr double kLowestAltitude = -12e3;
constexpr double kHighestAltitude = 1e8;
// Binary floats in radians or degrees may pass the end of a range by their rounding.
constexpr double kAngleRounding = 1e-4;

bool within(double value, double lowest, double highest) { return value >= lowest && value <= highest; }
bool is_angle(double degrees, double limit) { return within(degrees, -limit - kAngleRounding, limit + kAngleRounding); }

Degrees heading_in_circle(Degrees heading) {
    const double turned = std::fmod(heading.value, 360.0);
    const double positive = turned < 0.0 ? turned + 360.0 : turned;
    // A hair below north is 360 when it is rounded, and a turn to the left may end on -0: both are 0.
    return {positive > 0.0 && positive < 360.0 ? positive : 0.0};
}

}  // namespace

bool in_range(const GeodeticPosition& position, const Attitude& attitude) {
    return within(position.latitude.value, -90.0, 90.0) &&
           within(position.longitude.value, -180.0 - 1e-9, 180.0 + 1e-9) &&
           within(position.altitude, kLowestAltitude, kHighestAltitude) && is_angle(attitude.heading.value, 360.0) &&
           is_angle(attitude.pitch.value, 90.0) && is_angle(attitude.roll.value, 360.0);
}

SessionOptions session_options(const LinkUrl& url, const GeodeticPosition& scene_origin) {
    SessionOptions options;
    options.protocol = url.protocol;
    options.scene_origin = scene_origin;
    options.altitude_offset = url.altitude_offset.value_or(0.0);
    options.ownship = url.ownship.value_or(0);
    options.view = url.view;
    options.cigi_version = url.cigi_version;
    options.canaerospace = url.canaerospace;
    options.modbus = url.modbus;
    options.silence = url.trust.silence;
    options.database = url.database;
    options.synchronous = url.synchronous;
    options.can_node = url.can_node.value_or(kDefaultCanNode);
    return options;
}

Session::Session(const SessionOptions& options)
    : options_(options), scene_frame_(options.scene_origin), can_pose_(options.canaerospace), view_(options.view) {
    statistics_.protocol = options.protocol;
    state_.ownship = options.ownship;
    state_.silence = options.silence;
    state_.smoothing = !options.synchronous;
    window_ = default_window();
}

Verdict Session::accept(std::span<const std::byte> datagram, Time arrival, std::uint32_t source) {
    ++statistics_.datagrams;
    statistics_.bytes += datagram.size();
    answer_size_ = 0;
    responses_.clear();
    switch (options_.protocol) {
        case Protocol::cigi:
            return accept_cigi(datagram, arrival);
        case Protocol::flightgear_fdm:
            return accept_fdm(datagram, arrival);
        case Protocol::canaerospace:
            return accept_can(datagram, arrival);
        case Protocol::modbus:
            return accept_modbus(datagram, arrival, source);
    }
    return Verdict::rejected;
}

Verdict Session::reject(Reject reason) {
    ++statistics_.rejected[static_cast<std::size_t>(reason)];
    return Verdict::rejected;
}

Verdict Session::take(Time arrival, const std::optional<GeodeticPose>& pose, std::optional<Time> source_time) {
    state_.newest_arrival = arrival;
    run_ephemeris(arrival);
    if (!pose) return Verdict::no_pose;
    if (!in_range(pose->position, pose->attitude)) {
        reject(Reject::out_of_range);
        return Verdict::no_pose;
    }
    commit_pose(*pose, arrival, source_time);
    return Verdict::pose;
}

void Session::restart() {
    ++statistics_.restarts;
    cigi_clock_.restart();
    modbus_clock_.restart();
    standing_.clear();
    comparable_ = false;
}

void Session::host_changes() {
    restart();
    frame_order_.forget();
    fdm_clock_ = {};
}

void Session::commit_pose(const GeodeticPose& pose, Time arrival, std::optional<Time> source_time) {
    PoseSample sample;
    sample.position = pose.position;
    sample.position.altitude += options_.altitude_offset;
    sample.attitude = pose.attitude;
    sample.attitude.heading = heading_in_circle(pose.attitude.heading);
    sample.pose = scene_frame_.pose(sample.position, sample.attitude);
    sample.source_time = source_time;
    sample.arrival = arrival;
    sample.sequence = ++statistics_.frames;
    if (const auto& last = statistics_.last_pose) {
        const Time interval = arrival - last->arrival;
        if (interval > options_.gap_threshold) ++statistics_.gaps.count;
        statistics_.gaps.longest = std::max(statistics_.gaps.longest, interval);
    } else {
        statistics_.first_pose = sample;
    }
    statistics_.last_pose = sample;
    const bool went_back = state_.pose && source_time && state_.pose->source_time >= source_time;
    state_.earlier = comparable_ && !went_back ? state_.pose : std::nullopt;
    state_.pose = sample;
    comparable_ = true;
    if (options_.protocol == Protocol::cigi) place_ownship(sample);
}

Verdict Session::accept_fdm(std::span<const std::byte> datagram, Time arrival) {
    const auto decoded = flightgear::decode(datagram);
    if (const auto* reason = std::get_if<Reject>(&decoded)) return reject(*reason);
    const auto& packet = std::get<flightgear::NetFdm>(decoded);
    ++statistics_.packets[packet.version];
    const GeodeticPose pose{
        {Degrees::from_radians(packet.latitude), Degrees::from_radians(packet.longitude), packet.altitude},
        {Degrees::from_radians(packet.psi), Degrees::from_radians(packet.theta), Degrees::from_radians(packet.phi)}};
    if (!in_range(pose.position, pose.attitude)) return reject(Reject::out_of_range);
    const auto reading = fdm_clock_.read(packet.cur_time, arrival);
    if (reading.backwards) {
        ++statistics_.reordered;
        return Verdict::reordered;
    }
    return take(arrival, pose, reading.time);
}

}  // namespace quadrig::host
