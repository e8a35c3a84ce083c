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
    return {turned < 0.0 ? turned + 360.0 : turned};
}

// FNV-1a (Fowler, Noll, Vo), 64 bits.
std::uint64_t fingerprint(std::span<const std::byte> bytes) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const std::byte b : bytes) hash = (hash ^ std::to_integer<std::uint64_t>(b)) * 0x100000001b3U;
    return hash;
}

cigi::IgMode ig_mode(Mode mode) {
    switch (mode) {
        case Mode::standby:
            return cigi::IgMode::standby;
        case Mode::operate:
            return cigi::IgMode::operate;
        case Mode::debug:
            return cigi::IgMode::debug;
    }
    return cigi::IgMode::standby;
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
    options.canaerospace = url.canaerospace;
    options.modbus = url.modbus;
    options.can_node = url.can_node.value_or(kDefaultCanNode);
    return options;
}

std::size_t start_of_frame(const ReplyContext& host, std::uint32_t ig_frame, Time time,
                           std::span<std::byte, cigi::StartOfFrame::kSize> out) {
    cigi::StartOfFrame packet;
    packet.minor_version = host.minor_version;
    packet.database = host.database;
    packet.mode = ig_mode(host.mode);
    packet.timestamp_valid = true;
    packet.ig_frame = ig_frame;
    packet.timestamp = static_cast<std::uint32_t>(time / std::chrono::microseconds(10));
    packet.last_host_frame.reset();
    if (host.separate_counters) packet.last_host_frame = host.host_frame;
    return cigi::encode(packet, host.order, out);
}

Session::Session(const SessionOptions& options)
    : options_(options), scene_frame_(options.scene_origin), can_pose_(options.canaerospace), view_(options.view) {
    statistics_.protocol = options.protocol;
    if (const auto& window = options.default_window)
        window_ = {window->left, window->right, window->top, window->bottom};
}

Verdict Session::accept(std::span<const std::byte> datagram, Time arrival, std::uint32_t source) {
    ++statistics_.datagrams;
    statistics_.bytes += datagram.size();
    answer_size_ = 0;
    response_count_ = 0;
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
    standing_count_ = 0;
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

Arrival Session::order(const cigi::Message& message, std::span<const std::byte> datagram) {
    // Before 3.2 a host that runs in step sends back the image generator's own counter, which says nothing about its
    // messages.
    if (!message.ig_control.last_ig_frame) return Arrival::next;
    const Arrival arrival = frame_order_.arrive(message.ig_control.host_frame, fingerprint(datagram));
    statistics_.lost = frame_order_.lost();
    if (arrival == Arrival::duplicate) ++statistics_.duplicate;
    if (arrival == Arrival::late) ++statistics_.reordered;
    if (arrival == Arrival::restart) restart();
    return arrival;
}

Verdict Session::accept_cigi(std::span<const std::byte> datagram, Time arrival) {
    const auto opened = cigi::open_message(datagram);
    if (const auto* reason = std::get_if<Reject>(&opened)) return reject(*reason);
    const auto& message = std::get<cigi::Message>(opened);
    for (auto rest = message.packets; !rest.empty();) ++statistics_.packets[cigi::next_packet(rest).id];

    const Arrival place = order(message, datagram);
    if (place == Arrival::duplicate) return Verdict::duplicate;
    if (place == Arrival::late) return Verdict::reordered;

    const cigi::IgControl& ig_control = message.ig_control;
    apply(ig_control);
    reply_ =
        ReplyContext{message.order, ig_control.minor_version, ig_control.last_ig_frame.has_value(), ig_control.database,
                     state_.mode,   ig_control.host_frame};
    std::optional<GeodeticPose> pose;
    bool asks = false;
    for (auto rest = message.packets; !rest.empty();) {
        const cigi::Packet packet = cigi::next_packet(rest);
        const auto as = [&]<class P>(P) { return cigi::decode<P>(packet.bytes, message.order); };
        switch (packet.id) {
            case cigi::EntityControl::kId: {
                const auto control = as(cigi::EntityControl{});
                // Smoothing is on only where both the message and the entity ask for it; before 3.3 neither could.
                if (control.entity == options_.ownship && ig_control.minor_version >= 3)
                    state_.smoothing = ig_control.smoothing && control.smoothing;
                if (const auto candidate = apply(control)) pose = candidate;
                break;
            }
            case cigi::ViewControl::kId:
                apply(as(cigi::ViewControl{}));
                break;
            case cigi::ViewDefinition::kId:
                apply(as(cigi::ViewDefinition{}));
                break;
            case cigi::CelestialSphereControl::kId:
                apply(as(cigi::CelestialSphereControl{}), arrival);
                break;
            case cigi::AtmosphereControl::kId:
                apply(as(cigi::AtmosphereControl{}));
                break;
            case cigi::HatHotRequest::kId:
            case cigi::LosSegmentRequest::kId:
            case cigi::LosVectorRequest::kId:
                asks = true;
                break;
            default:
                break;
        }
    }
    const auto source_time = ig_control.timestamp_valid ? cigi_clock_.read(ig_control.timestamp) : std::nullopt;
    const Verdict verdict = take(arrival, pose, source_time);
    // After the message's own pose: questions in the ownship's axes are about where it is now.
    answer_standing(message);
    for (auto rest = message.packets; asks && !rest.empty();) {
        const cigi::Packet packet = cigi::next_packet(rest);
        if (packet.id >= cigi::HatHotRequest::kId && packet.id <= cigi::LosVectorRequest::kId)
            answer_request(packet, message);
    }
    return verdict;
}

}  // namespace quadrig::host
