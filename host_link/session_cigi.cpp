// What each CIGI packet does to the session's state.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "host_link/session.h"

namespace quadrig::host {

namespace {

// Half angles of a window whose tangents still make a picture.
constexpr double kWidestHalfAngle = 89.0;
// Metres from the ownship's reference point to an eye that still belongs to it.
constexpr double kFarthestMount = 1e5;
// The haze model divides by the visibility: zero is shown as this.
constexpr double kLeastVisibility = 1.0;

std::chrono::year_month_day calendar_date(std::uint32_t mmddyyyy) {
    using namespace std::chrono;
    return year(static_cast<int>(mmddyyyy % 10000)) / month(mmddyyyy / 1000000) / day(mmddyyyy / 10000 % 100);
}

bool same_moment(const cigi::CelestialSphereControl& a, const cigi::CelestialSphereControl& b) {
    return a.date == b.date && a.hour == b.hour && a.minute == b.minute;
}

}  // namespace

void Session::apply(const cigi::IgControl& packet) {
    state_.host_frame = packet.host_frame;
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

std::optional<GeodeticPose> Session::apply(const cigi::EntityControl& packet) {
    if (packet.entity == options_.ownship) {
        if (packet.state == cigi::EntityState::destroyed) return std::nullopt;
        if (packet.attached) {
            reject(Reject::attached_ownship);
            return std::nullopt;
        }
        return GeodeticPose{{{packet.latitude}, {packet.longitude}, packet.altitude},
                            {{packet.yaw}, {packet.pitch}, {packet.roll}}};
    }
    show(packet);
    return std::nullopt;
}

void Session::show(const cigi::EntityControl& packet) {
    const GeodeticPosition position{{packet.latitude}, {packet.longitude}, packet.altitude + options_.altitude_offset};
    const Attitude attitude{{packet.yaw}, {packet.pitch}, {packet.roll}};
    const auto first = state_.entities.begin(), end = first + static_cast<std::ptrdiff_t>(state_.entity_count);
    const auto known = std::find_if(first, end, [&](const Entity& e) { return e.id == packet.entity; });
    const bool sound = in_range(position, attitude);
    if (!sound && !packet.attached) reject(Reject::out_of_range);
    if (packet.state != cigi::EntityState::active || packet.attached || !sound) {
        if (known == end) return;
        std::move(known + 1, end, known);
        --state_.entity_count;
    } else if (known != end || state_.entity_count < kMostShownEntities) {
        if (known == end) ++state_.entity_count;
        *known = {packet.entity, packet.type, scene_frame_.pose(position, attitude)};
        statistics_.other_entities = std::max<std::uint64_t>(statistics_.other_entities, state_.entity_count);
    } else {
        ++statistics_.entities_dropped;
    }
}

bool Session::is_our_view(std::uint16_t view, std::uint8_t group) {
    if (group != 0) return false;
    if (!view_) view_ = view;
    return *view_ == view;
}

void Session::apply(const cigi::ViewControl& packet) {
    if (!is_our_view(packet.view, packet.group)) return;
    if (packet.entity != options_.ownship) {
        reject(Reject::view_of_other_entity);
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
}

void Session::apply(const cigi::ViewDefinition& packet) {
    if (!is_our_view(packet.view, packet.group)) return;
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

void Session::apply(const cigi::CelestialSphereControl& packet, Time arrival) {
    if (!packet.date_time_valid) return;
    if (!calendar_date(packet.date).ok() || packet.hour > 23 || packet.minute > 59) {
        reject(Reject::out_of_range);
        return;
    }
    // A host that repeats the packet every so often does not set its clock back to the full minute each time.
    const bool repeated =
        packet.ephemeris && ephemeris_ && ephemeris_->packet.ephemeris && same_moment(packet, ephemeris_->packet);
    if (!repeated) ephemeris_ = Ephemeris{packet, arrival};
}

void Session::run_ephemeris(Time arrival) {
    if (!ephemeris_) return;
    using namespace std::chrono;
    const auto& packet = ephemeris_->packet;
    const auto running = packet.ephemeris ? floor<seconds>(std::max(arrival - ephemeris_->since, Time(0))) : seconds(0);
    const sys_seconds now =
        sys_days(calendar_date(packet.date)) + hours(packet.hour) + minutes(packet.minute) + running;
    const auto midnight = floor<days>(now);
    const year_month_day date(midnight);
    const hh_mm_ss time(now - midnight);
    state_.utc = CivilTime{int(date.year()),
                           static_cast<int>(unsigned(date.month())),
                           static_cast<int>(unsigned(date.day())),
                           static_cast<int>(time.hours().count()),
                           static_cast<int>(time.minutes().count()),
                           static_cast<double>(time.seconds().count())};
}

void Session::apply(const cigi::AtmosphereControl& packet) {
    if (!std::isfinite(packet.visibility) || packet.visibility < 0.0F) {
        reject(Reject::out_of_range);
        return;
    }
    state_.visibility = std::max<double>(packet.visibility, kLeastVisibility);
}

}  // namespace quadrig::host
