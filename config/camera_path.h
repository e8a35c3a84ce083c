/// Camera paths for benchmarks: a JSON array of eyes, [{"eye": [X, Y, Z], "attitude": [H, P, R], "fov": DEG}, …].
#pragma once

#include <filesystem>
#include <vector>

#include "config/file_error.h"
#include "ig_core/geometry/space.h"

namespace quadrig::config {

struct Camera {
    ScenePoint eye;
    Attitude attitude;
    Degrees horizontal_fov{60.0};  ///< 1..170
};

/// Reads a camera path of at least one camera; all three keys are required. Throws FileError at the first mistake, with
/// its line and key ("[12].eye[2]"; a syntax error has no key). A key that is there twice is a mistake.
std::vector<Camera> read_camera_path(const std::filesystem::path& file);

}  // namespace quadrig::config
