// A CIGI message taken as a whole, and what its packets about views do to the session's state.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>

#include "host_link/session.h"

namespace quadrig::host {

namespace {

// Half angles of a window whose tangents still make a picture.
constexpr double kWidestHalfAngle = 89.0;
// Metres from an entity's reference point to an eye that still belongs to it.
constexpr double kFarthestMount = 1e5;
// What Start Of Frame says of a database that is not there.
constexpr std::int8_t kNoDatabase = -128;

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

bool is_question(cigi::Kind kind) { return kind >= cigi::HatHotRequest::kId && kind <= cigi::LosVectorRequest::kId; }

}  // namespace

std::size_t start_of_frame(const ReplyContext& host, std::uint32_t ig_frame, Time time, bool overframing,
                           std::span<std::byte, cigi::StartOfFrame::kSize> out) {
    cigi::StartOfFrame packet;
    packet.minor_version = host.minor_version;
    // Readers take the packet's size from its minor version: 24 bytes from 3.2 on.
    if (host.format.version == cigi::Version::three)
        packet.minor_version = host.separate_counters ? std::max<std::uint8_t>(packet.minor_version, 2)
                                                      : std::min<std::uint8_t>(packet.minor_version, 1);
    packet.database = host.database;
    packet.mode = ig_mode(host.mode);
    packet.timestamp_valid = true;
    packet.ig_frame = ig_frame;
    packet.timestamp = static_cast<std::uint32_t>(time / std::chrono::microseconds(10));
    if (overframing) packet.conditions = cigi::StartOfFrame::kOverframing;
    packet.last_host_frame.reset();
    if (host.separate_counters) packet.last_host_frame = host.host_frame;
    return cigi::encode(packet, host.format, out);
}

Arrival Session::order(const cigi::Message& message, std::span<const std::byte> datagram, Time arrival) {
    // Before 3.2 a host that runs in step sends back the image generator's own counter, which says nothing about its
    // messages.
    if (!message.ig_control.last_ig_frame) return Arrival::next;
    const Arrival place = frame_order_.arrive(message.ig_control.host_frame, fingerprint(datagram), arrival);
    statistics_.lost = frame_order_.lost();
    if (place == Arrival::duplicate) ++statistics_.duplicate;
    if (place == Arrival::late) ++statistics_.reordered;
    if (place == Arrival::restart) restart();
    return place;
}

Verdict Session::accept_cigi(std::span<const std::byte> datagram, Time arrival) {
    const auto opened = cigi::open_message(datagram);
    if (const auto* reason = std::get_if<Reject>(&opened)) return reject(*reason);
    const auto& message = std::get<cigi::Message>(opened);
    if (message.format.version != options_.cigi_version.value_or(message.format.version))
        return reject(Reject::unknown_version);
    for (auto rest = message.packets; !rest.empty();) ++statistics_.packets[next_packet(rest, message.format).id];

    const Arrival place = order(message, datagram, arrival);
    if (place == Arrival::duplicate) return Verdict::duplicate;
    if (place == Arrival::late) return Verdict::reordered;

    const cigi::IgControl& ig_control = message.ig_control;
    apply(ig_control);
    reply_ =
        ReplyContext{message.format, ig_control.minor_version, ig_control.last_ig_frame.has_value(), told_database_,
                     state_.mode,    ig_control.host_frame};
    ownship_pose_.reset();
    bool asks = false;
    for (auto rest = message.packets; !rest.empty();) {
        const cigi::Packet packet = next_packet(rest, message.format);
        asks = asks || is_question(packet.id);
        apply(packet, message, arrival);
    }
    const auto source_time = ig_control.timestamp_valid ? cigi_clock_.read(ig_control.timestamp) : std::nullopt;
    const Verdict verdict = take(arrival, ownship_pose_, source_time);
    // After the message's own pose: questions in the ownship's axes are about where it is now.
    const Asking asking = asking_of(message, arrival);
    look_around(asking);
    tell_collisions(asking);
    tell_sensors(asking);
    answer_standing(message, arrival);
    for (auto rest = message.packets; asks && !rest.empty();) {
        const cigi::Packet packet = next_packet(rest, message.format);
        if (is_question(packet.id)) answer_request(packet, message, arrival);
    }
    return verdict;
}

void Session::apply(const cigi::Packet& packet, const cigi::Message& message, Time arrival) {
    const auto as = [&]<class P>(P) { return cigi::decode<P>(packet.bytes, message.format); };
    const Asking asking = asking_of(message, arrival);
    switch (packet.id) {
        case cigi::EntityControl::kId:
            return apply(as(cigi::EntityControl{}), message, asking);
        case cigi::EntityPosition::kId:
            return apply(as(cigi::EntityPosition{}), asking);
        case cigi::RateControl::kId:
            return apply(as(cigi::RateControl{}), arrival);
        case cigi::ViewControl::kId:
            return apply(as(cigi::ViewControl{}), asking);
        case cigi::ViewDefinition::kId:
            return apply(as(cigi::ViewDefinition{}));
        case cigi::CelestialSphereControl::kId:
            return apply(as(cigi::CelestialSphereControl{}), arrival);
        case cigi::AtmosphereControl::kId:
            return apply(as(cigi::AtmosphereControl{}));
        case cigi::EnvironmentalRegionControl::kId:
            return apply(as(cigi::EnvironmentalRegionControl{}), asking);
        case cigi::WeatherControl::kId:
            return apply(as(cigi::WeatherControl{}), asking);
        case cigi::ShortComponentControl::kId:
            return apply(as(cigi::ShortComponentControl{}));
        case cigi::SensorControl::kId:
            return apply(as(cigi::SensorControl{}), asking);
        case cigi::CollisionSegmentDefinition::kId:
            return apply(as(cigi::CollisionSegmentDefinition{}));
        default:
            return;
    }
}

// A database that is asked for is told as loading until the host's next message, which is to take notice of that, and
// as loaded from then on: the scene is there before the first frame is.
void Session::load_database(std::int8_t wanted) {
    if (wanted < 0) {
        reject(Reject::out_of_range);
        return;
    }
    if (told_database_ < 0 && told_database_ != kNoDatabase)
        loaded_database_ = static_cast<std::int8_t>(-told_database_);
    told_database_ = loaded_database_;
    if (wanted == 0 || wanted == loaded_database_) return;
    const bool available = options_.database.value_or(wanted) == wanted;
    told_database_ = available ? static_cast<std::int8_t>(-wanted) : kNoDatabase;
}

/// What the host has put there goes; the ownship stays where it was.
void Session::reset_scene() {
    state_.entities = {};
    state_.view_entity.reset();
    state_.mount.reset();
    state_.window.reset();
    state_.visibility.reset();
    state_.utc.reset();
    state_.weather = {};
    state_.regions = {};
    state_.test_pattern = false;
    state_.overlay.reset();
    view_ = options_.view;
    view_group_ = 0;
    window_ = default_window();
    ephemeris_.reset();
    segments_.clear(), sensors_.clear(), standing_.clear();
}

Session::Window Session::default_window() const {
    const auto& window = options_.default_window;
    return window ? Window{window->left, window->right, window->top, window->bottom} : Window{};
}

void Session::apply(const cigi::IgControl& packet) {
    state_.host_frame = packet.host_frame;
    load_database(packet.database);
    if (packet.mode == cigi::IgMode::standby && state_.mode != Mode::standby && reply_) reset_scene();
    switch (packet.mode) {
        case cigi::IgMode::standby:
            state_.mode = Mode::standby;
            break;
        case cigi::IgMode::operate:
            state_.mode = Mode::operate;
            break;
        case cigi::IgMode::debug:
            state_.mode = Mode::debug;
            break;
        case cigi::IgMode::offline_maintenance:
            reject(Reject::out_of_range);
            break;
    }
}

bool Session::is_our_view(std::uint16_t view) {
    if (!view_) view_ = view;
    return *view_ == view;
}

void Session::apply(const cigi::ViewControl& packet, const Asking& asking) {
    if (packet.group != 0 ? packet.group != view_group_ : !is_our_view(packet.view)) return;
    if (packet.entity != options_.ownship && state_.entities.find(packet.entity) == nullptr) {
        reject(Reject::view_of_unknown_entity);
        warn(Warning::unknown_view_entity, asking, "view %d is on entity %d, which is unknown", int{packet.view},
             int{packet.entity});
        return;
    }
    ViewMount mount = state_.mount.value_or(ViewMount{});
    const auto set = [](bool enabled, double& value, double wire) {
        if (enabled) value = wire;
    };
    // Body axes of the wire: X forward, Y right, Z down. Ours: right, forward, up.
    set(packet.y_enable, mount.offset.x, packet.y);
    set(packet.x_enable, mount.offset.y, packet.x);
    set(packet.z_enable, mount.offset.z, -packet.z);
    set(packet.yaw_enable, mount.attitude.heading.value, packet.yaw);
    set(packet.pitch_enable, mount.attitude.pitch.value, packet.pitch);
    set(packet.roll_enable, mount.attitude.roll.value, packet.roll);
    const auto far = [](double metres) { return !(std::abs(metres) <= kFarthestMount); };
    const auto beyond = [](Degrees angle, double limit) { return !(std::abs(angle.value) <= limit); };
    const Attitude& turn = mount.attitude;
    if (far(mount.offset.x) || far(mount.offset.y) || far(mount.offset.z) || beyond(turn.heading, 360.0) ||
        beyond(turn.pitch, 90.0) || beyond(turn.roll, 360.0)) {
        reject(Reject::out_of_range);
        return;
    }
    state_.mount = mount;
    state_.view_entity = packet.entity;
}

void Session::apply(const cigi::ViewDefinition& packet) {
    if (!is_our_view(packet.view)) return;
    view_group_ = packet.group;
    Window window = window_;
    bool sound = true;
    const auto set = [&sound](bool enabled, std::optional<Degrees>& angle, float wire) {
        if (!enabled) return;
        angle = Degrees{wire};
        sound = sound && std::abs(wire) <= kWidestHalfAngle;
    };
    set(packet.left_enable, window.left, packet.left);
    set(packet.right_enable, window.right, packet.right);
    set(packet.top_enable, window.top, packet.top);
    set(packet.bottom_enable, window.bottom, packet.bottom);
    const auto crossed = [](const auto& low, const auto& high) { return low && high && !(low->value < high->value); };
    if (!sound || crossed(window.left, window.right) || crossed(window.bottom, window.top)) {
        reject(Reject::out_of_range);
        return;
    }
    window_ = window;
    const bool defines = packet.left_enable || packet.right_enable || packet.top_enable || packet.bottom_enable;
    if (defines && window.left && window.right && window.top && window.bottom)
        state_.window = ViewWindow{*window.left, *window.right, *window.top, *window.bottom};
}

}  // namespace quadrig::host
