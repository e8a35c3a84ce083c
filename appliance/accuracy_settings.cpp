#include "appliance/accuracy_settings.h"

#include <algorithm>

namespace quadrig::appliance {

std::vector<Quality> accuracy_settings() {
    std::vector<Quality> settings{{}};
    const auto add = [&](const Quality& quality) {
        if (std::find(settings.begin(), settings.end(), quality) == settings.end()) settings.push_back(quality);
    };
    for (const int lines : {0, 1, 4, 8}) add({.sub_scan_lines = lines});
    for (const SetUp set_up : {SetUp::textbook, SetUp::textbook_single}) add({.set_up = set_up});
    add({.distance = DistanceRule::interpolated});
    for (const SineMethod sine : {SineMethod::polynomial, SineMethod::table, SineMethod::library}) add({.sine = sine});
    for (const int terms : {1, 2}) add({.terms_left_out = terms});
    add({.smooth_stretches = false});
    for (const ShadingRate rate : {ShadingRate::half, ShadingRate::four}) add({.shading = rate});
    for (const double pixels : {1.0, 3.0}) add({.smallest_feature = pixels});

    for (const int lines : {0, 1, 2, 4, 8}) {
        for (const ShadingRate rate : {ShadingRate::half, ShadingRate::one, ShadingRate::four}) {
            Quality quality;
            quality.sub_scan_lines = lines;
            quality.shading = rate;
            add(quality);
            quality.terms_left_out = 1;
            if (rate == ShadingRate::half) add(quality);
        }
    }
    // What is drawn half as fine is there to be fast.
    for (const int lines : {0, 2})
        for (const ShadingRate rate : {ShadingRate::eighth, ShadingRate::quarter})
            for (const int terms : {0, 1}) add({.sub_scan_lines = lines, .terms_left_out = terms, .shading = rate});
    return settings;
}

}  // namespace quadrig::appliance
