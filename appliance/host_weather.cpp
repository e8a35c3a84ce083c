#include "appliance/host_weather.h"

#include <algorithm>
#include <limits>

namespace quadrig::appliance {

HostWeather::HostWeather(const Scene& scene)
    : visibility_(scene.haze ? std::optional(scene.haze->visibility) : std::nullopt) {
    for (const CloudDeck& deck : scene.cloud_decks) {
        if (decks_.size() == host::kCloudLayers) break;
        Deck& own = decks_.emplace_back(Deck{deck.altitude, 0.0, std::nullopt});
        const Paint& paint = deck.paint;
        if (!paint.translucence || !paint.texture) continue;
        own.threshold = paint.translucence->threshold;
        own.coverage.emplace(scene.textures[*paint.texture], *paint.translucence);
    }
}

HostWeather::Layer HostWeather::layer_of(const host::WeatherLayer& layer, const Deck* deck) {
    const double covered = layer.enabled ? layer.coverage : 0.0;
    const bool there = covered > 0.0;
    return {there ? 1.0 : 0.0, layer.base, layer.top,
            deck != nullptr && deck->coverage ? deck->coverage->threshold(covered) : 0.0,
            there ? 1.0 / layer.visibility : 0.0};
}

HostWeather::Layer HostWeather::mixed(const Layer& from, const Layer& to, double share) {
    if (share >= 1.0) return to;
    const auto mix = [share](double a, double b) { return a + share * (b - a); };
    Layer at{mix(from.presence, to.presence), mix(from.base, to.base), mix(from.top, to.top),
             mix(from.threshold, to.threshold), mix(from.extinction, to.extinction)};
    // What comes out of nothing is where it will be.
    if (from.presence == 0.0) at.base = to.base, at.top = to.top;
    if (to.presence == 0.0) at.base = from.base, at.top = from.top;
    return at;
}

void HostWeather::add(const host::HostState& state, const ScenePoint& eye, Environment& environment) {
    states_.fill(std::nullopt);
    const double height = eye.metres.z;
    for (std::size_t slot = 0; slot < host::kWeatherLayers; ++slot) {
        const bool cloud = slot >= 1 && slot - 1 < decks_.size();
        const Deck* deck = cloud ? &decks_[slot - 1] : nullptr;
        const auto& everywhere = state.weather[slot];
        Layer layer;
        if (everywhere)
            layer = layer_of(*everywhere, deck);
        else if (deck != nullptr)
            layer = {1.0, deck->altitude, deck->altitude, deck->threshold, 0.0};
        bool told = everywhere.has_value();
        for (const host::WeatherRegion& region : state.regions) {
            if (!region.active || !region.layers[slot]) continue;
            const double share = region.share_at(eye);
            if (share == 0.0) continue;
            layer = mixed(layer, layer_of(*region.layers[slot], deck), share);
            told = true;
        }
        if (!told) continue;
        const bool inside = layer.presence > 0.0 && height >= layer.base && height <= layer.top;
        if (inside && layer.extinction > 0.0) {
            const auto clear = environment.visibility ? environment.visibility : visibility_;
            environment.visibility =
                std::min(1.0 / layer.extinction, clear.value_or(std::numeric_limits<double>::infinity()));
        }
        if (deck == nullptr) continue;
        // One without holes cannot thin out: it is there from the middle of a transition on.
        const bool there = deck->coverage ? layer.presence > 0.0 : layer.presence >= 0.5;
        states_[slot - 1] = DeckState{there && !inside, height > layer.top ? layer.top : layer.base, layer.threshold};
    }
    environment.decks = states_;
}

}  // namespace quadrig::appliance
