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
// Metres: more is garbled.
constexpr double kLargestRegion = 1e7;
// Of the system's class: what a host may switch on and off.
constexpr std::uint16_t kTestPatternComponent = 1, kOverlayComponent = 2;

bool within(double value, double lowest, double highest) { return value >= lowest && value <= highest; }

/// Not ok() where there is no such day.
std::chrono::year_month_day calendar_date(std::uint32_t mmddyyyy) {
    using namespace std::chrono;
    // A month of std::chrono's holds eight bits.
    if (mmddyyyy / 1000000 > 12) return {};
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

WeatherRegion* Session::region_for(std::uint16_t id, const Asking& asking) {
    WeatherRegions& list = state_.regions;
    const auto known = std::ranges::find(list, id, &WeatherRegion::id);
    if (known != list.end()) return known;
    if (list.full()) {
        ++statistics_.regions_dropped;
        warn(Warning::too_many_regions, asking, "no room for weather region %d", int{id});
        return nullptr;
    }
    WeatherRegion& region = list.push_back({});
    region.id = id;
    return &region;
}

void Session::apply(const cigi::EnvironmentalRegionControl& packet, const Asking& asking) {
    if (packet.state == cigi::RegionState::destroyed) {
        const auto gone = std::ranges::find(state_.regions, packet.region, &WeatherRegion::id);
        if (gone != state_.regions.end()) state_.regions.erase(gone);
        return;
    }
    const GeodeticPosition middle{{packet.latitude}, {packet.longitude}, 0.0};
    const Attitude rotation{{packet.rotation}, {}, {}};
    const float shorter = std::min(packet.size_x, packet.size_y);
    if (packet.state == cigi::RegionState::reserved || !in_range(middle, rotation) ||
        !within(packet.size_x, 0.0, kLargestRegion) || !within(packet.size_y, 0.0, kLargestRegion) ||
        !within(packet.corner_radius, 0.0, shorter / 2.0) ||
        !within(packet.transition_perimeter, 0.0, kLargestRegion)) {
        reject(Reject::out_of_range);
        return;
    }
    WeatherRegion* region = region_for(packet.region, asking);
    if (region == nullptr) return;
    region->active = packet.state == cigi::RegionState::active;
    region->middle = scene_frame_.pose(middle, rotation);
    region->length = packet.size_x;
    region->width = packet.size_y;
    region->corner_radius = packet.corner_radius;
    region->transition_perimeter = packet.transition_perimeter;
}

void Session::apply(const cigi::WeatherControl& packet, const Asking& asking) {
    const bool regional = packet.scope == cigi::WeatherScope::regional;
    // Weather that goes with an entity is not in the image model, nor what a layer's number does not tell.
    if (packet.layer >= kWeatherLayers || (!regional && packet.scope != cigi::WeatherScope::global)) return;
    if (!within(packet.base, kLowestBase, kHighestBase) || !within(packet.thickness, 0.0, kHighestBase) ||
        !within(packet.coverage, 0.0, 100.0) || !(packet.visibility >= 0.0F) || !std::isfinite(packet.visibility)) {
        reject(Reject::out_of_range);
        return;
    }
    if (packet.layer <= kCloudLayers && packet.layer > options_.cloud_decks)
        warn(Warning::no_such_deck, asking, "the scene has no cloud deck %d", int{packet.layer});
    WeatherLayers* layers = &state_.weather;
    if (regional) {
        WeatherRegion* region = region_for(packet.region, asking);
        if (region == nullptr) return;
        layers = &region->layers;
    }
    const double base = packet.base + options_.altitude_offset - options_.scene_origin.altitude;
    (*layers)[packet.layer] = WeatherLayer{packet.enable, base, base + packet.thickness, 0.01 * packet.coverage,
                                           std::max<double>(packet.visibility, kLeastVisibility)};
}

void Session::apply(const cigi::ShortComponentControl& packet) {
    if (packet.component_class != cigi::ShortComponentControl::kSystem) return;
    if (packet.component == kTestPatternComponent) state_.test_pattern = packet.state != 0;
    if (packet.component == kOverlayComponent) state_.overlay = packet.state != 0;
}

}  // namespace quadrig::host
