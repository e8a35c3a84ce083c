// Light and air, as a CIGI host has them.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "host_link/session.h"

namespace quadrig::host {

namespace {

// The haze model divides by the visibility: zero is shown as this.
constexpr double kLeastVisibility = 1.0;

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

}  // namespace quadrig::host
