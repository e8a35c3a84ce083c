/// What the eye sees and how the answer is held: the values that go through the image generator's door.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "ig_core/geometry/space.h"
#include "ig_core/quality.h"
#include "ig_core/scene/scene.h"

namespace quadrig {

/// The image plane at distance 1: the centre of column c, row r (row 0 at the top) looks along
/// d = (left + (c + 0.5) column_step, 1, top - (r + 0.5) row_step) in eye space.
struct ImagePlane {
    int width = 0;
    int height = 0;
    double left = 0.0;
    double column_step = 0.0;
    double top = 0.0;
    double row_step = 0.0;

    /// Square pixels, the look direction in the middle, a horizontal field of view in 0..180 degrees exclusive.
    static ImagePlane symmetric(int width, int height, Degrees horizontal_fov);
    /// A window given by its half angles (left and bottom negative), each within -90..90 exclusive; pixels need not be
    /// square.
    static ImagePlane window(int width, int height, Degrees left, Degrees right, Degrees top, Degrees bottom);

    [[nodiscard]] double x(double column) const {
        return left + column * column_step;
    }  ///< column 0.5 is the first centre
    [[nodiscard]] double z(double row) const { return top - row * row_step; }
    friend bool operator==(const ImagePlane&, const ImagePlane&) = default;
};

struct View {
    ScenePoint eye;
    glm::dmat3 eye_from_scene{1.0};
    ImagePlane image;
};

/// A half-space n.p >= offset of the scene, n of unit length.
struct HalfSpace {
    glm::dvec3 normal;
    double offset = 0.0;  ///< m
};
/// What a view can show lies in all of these: beyond the near plane (kNearDepth), within the four sides of the window.
using ViewFrustum = std::array<HalfSpace, 5>;
ViewFrustum view_frustum(const View& view);

/// A model of the scene as the host has placed it.
struct PlacedModel {
    std::uint32_t model = 0;  ///< index in Scene::models
    ScenePose pose;
};

/// A cloud deck of the scene as the host has it.
struct DeckState {
    bool shown = true;
    double altitude = 0.0;   ///< m
    double threshold = 0.0;  ///< in place of its translucence's own; nothing to a deck without
};

/// What the host may change from frame to frame; absent values are the scene's own.
struct Environment {
    double seconds = 0.0;  ///< scene time, drives texture drift and objects that move
    std::optional<Sun> sun;
    std::optional<double>
        visibility;  ///< m, meteorological optical range; replaces the scene's, or adds haze where it has none
    std::span<const std::optional<DeckState>> decks{};  ///< the scene's, in its order; those left out are as they are
    std::span<const PlacedModel> bodies{};              ///< their objects are numbered after the scene's, in this order
};

/// A finished or growing picture in memory that somebody else owns: 8-bit sRGB, four bytes a pixel R, G, B, A = 255.
/// `row_bytes` may be negative: row 0 is always the top row.
struct FrameImage {
    std::uint8_t* top_row = nullptr;
    int width = 0;
    int height = 0;
    std::ptrdiff_t row_bytes = 0;
    [[nodiscard]] std::uint8_t* row(int r) const { return top_row + r * row_bytes; }
};

/// What is seen at every pixel centre, row 0 at the top, row-major.
struct GroundTruth {
    std::vector<std::int32_t> object_ids;   ///< index in the file, kSkyId or kGroundId
    std::vector<std::int32_t> surface_ids;  ///< 0 the quadric, j its j-th plane; 0 for ground and sky
    std::vector<double> depth;              ///< k, infinity for sky
    void resize(std::size_t pixels) {
        object_ids.assign(pixels, kSkyId);
        surface_ids.assign(pixels, 0);
        depth.assign(pixels, std::numeric_limits<double>::infinity());
    }
};

}  // namespace quadrig
