/// A scene's paint, textures and light as one frame sees them.
#pragma once

#include <vector>

#include "ig_core/shading/shade_job.h"

namespace quadrig {

/// Paints of objects, markings, ground and decks; pointers lead into `textures`.
struct FramePaints {
    std::vector<FrameTexture> textures;
    std::vector<std::vector<TextureTerm>>
        terms;  ///< the scene's, by rising frequency: filtering drops them from the end
    std::vector<FramePaint> objects, markings, decks;
    std::vector<std::vector<FramePaint>> models;  ///< by model and object
    FramePaint ground;
};

/// Sets up what does not change from frame to frame, sorting each texture's terms by frequency.
FramePaints make_frame_paints(const Scene& scene);

/// Brings texture phases to an eye point and a time (drift), and terms to a quality.
void move_textures(const Scene& scene, const ScenePoint& eye, double seconds, const Quality& quality,
                   FramePaints& paints);

/// Unit vector to the sun in scene axes.
glm::dvec3 direction_to_sun(const Sun& sun);

FrameLight make_frame_light(const Scene& scene, const Environment& environment);

/// 5 % contrast at the meteorological optical range: -ln 0.05, rounded as the image model has it.
inline constexpr double kContrastAtVisibility = 2.996;

}  // namespace quadrig
