/// What a host's weather comes to where the eye is: cloud decks, and how far one sees.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "host_link/host_state.h"
#include "ig_core/scene/deck_coverage.h"
#include "ig_core/view.h"

namespace quadrig::appliance {

/// Over one scene. Within a layer the visibility is the layer's, where that is less; a cloud's deck is at the layer's
/// base, seen from above at its top, and from within not there. What falls from clouds, and sand and dust, are such
/// layers without a deck. A region's layers take the place of those elsewhere by WeatherRegion::share_at: heights,
/// thresholds and extinctions (visibilities inverted) are mixed evenly, region after region.
class HostWeather {
  public:
    /// Measures the coverage of the scene's cloud decks: takes milliseconds.
    explicit HostWeather(const Scene& scene);

    /// Puts the weather at `eye` into an environment that has the state's visibility already. Decks are good until the
    /// next call. Allocates nothing.
    void add(const host::HostState& state, const ScenePoint& eye, Environment& environment);

  private:
    struct Deck {
        double altitude = 0.0;
        double threshold = 0.0;
        std::optional<DeckCoverage> coverage;  ///< absent: it is whole
    };
    /// A layer, or a deck of the scene, as it is at the eye.
    struct Layer {
        double presence = 0.0;         ///< 0 not there, 1 there
        double base = 0.0, top = 0.0;  ///< m
        double threshold = 0.0;        ///< the deck's
        double extinction = 0.0;       ///< 1/m, the visibility inverted
    };
    static Layer layer_of(const host::WeatherLayer& layer, const Deck* deck);
    static Layer mixed(const Layer& from, const Layer& to, double share);

    std::vector<Deck> decks_;
    std::optional<double> visibility_;  ///< m, the scene's
    std::array<std::optional<DeckState>, host::kCloudLayers> states_;
};

}  // namespace quadrig::appliance
