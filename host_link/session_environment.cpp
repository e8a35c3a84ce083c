// Light and air, as a CIGI host has them.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "host_link/session.h"

namespace quadrig::host {

namespace {

// The haze model divides by the visibility: zero is shown as this.
constexpr double kLeastVisibility = 1.0;
// Metres about the ellipsoid where a layer of weather may begin.
constexpr double kLowestBase = -12e3, kHighestBase = 1e5;
// Of the system's class: what a host may switch on and off.
constexpr std::uint16_t kTestPatternComponent = 1, kOverlayComponent = 2;

std::chrono::year_month_day calendar_date(std::uint32_t mmddyyyy) {
    using namespace std::chrono;
    return year(static_cast<int>(mmddyyyy % 10000)) / month(mmddyyyy / 1000000) / day(mmddyyyy / 10000 % 100);
}

bool same_moment(const cigi::CelestialSphereControl& a, const cigi::CelestialSphereControl& b) {
    return a.date == b.date && a.hour == b.hour && a.minute == b.minute && a.seconds == b.seconds;
}

}  // namespace

void Session::apply(const cigi::CelestialSphereControl& packet, Time arrival) {
    if (!packet.date_time_valid) return;
    if (!calendar_date(packet.date).ok() || packet.hour > 23 || packet.minute > 59 ||
        !(packet.seconds >= 0.0F && packet.seconds < 60.0F)) {
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
    const sys_seconds now = sys_days(calendar_date(packet.date)) + hours(packet.hour) + minutes(packet.minute) +
                            seconds(static_cast<int>(packet.seconds)) + running;
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

void Session::apply(const cigi::WeatherControl& packet, const Asking& asking) {
    // Rain and its like, and weather in places of its own, are not in the image model.
    if (packet.layer >= state_.weather.size() || packet.scope != cigi::WeatherScope::global) return;
    const auto within = [](double value, double lowest, double highest) { return value >= lowest && value <= highest; };
    if (!within(packet.base, kLowestBase, kHighestBase) || !within(packet.thickness, 0.0, kHighestBase) ||
        !within(packet.coverage, 0.0, 100.0) || !(packet.visibility >= 0.0F) || !std::isfinite(packet.visibility)) {
        reject(Reject::out_of_range);
        return;
    }
    if (packet.layer > options_.cloud_decks)
        warn(Warning::no_such_deck, asking, "the scene has no cloud deck %d", int{packet.layer});
    const double base = packet.base + options_.altitude_offset - options_.scene_origin.altitude;
    state_.weather[packet.layer] = WeatherLayer{packet.enable, base, base + packet.thickness, 0.01 * packet.coverage,
                                                std::max<double>(packet.visibility, kLeastVisibility)};
}

void Session::apply(const cigi::ShortComponentControl& packet) {
    if (packet.component_class != cigi::ShortComponentControl::kSystem) return;
    if (packet.component == kTestPatternComponent) state_.test_pattern = packet.state != 0;
    if (packet.component == kOverlayComponent) state_.overlay = packet.state != 0;
}

}  // namespace quadrig::host
