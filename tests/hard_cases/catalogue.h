/// The catalogue of hard cases: scene files whose first two lines say why they are hard and where the camera stands.
///
///     # The reason, in one line.
///     # camera: --eye X,Y,Z --attitude H,P,R --size WxH --fov DEG        (as `quadrig render` takes it)
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ig_core/view.h"

namespace quadrig::test {

struct HardCase {
    std::string name;  ///< the file's, without its ending
    std::string reason;
    Scene scene;
    View view;
};

/// Throws std::runtime_error, naming the file, where one of the two lines is missing or the scene is refused.
HardCase read_hard_case(const std::filesystem::path& file);

/// Files of the catalogue whose names begin so, in alphabetical order; all of them by default.
std::vector<std::filesystem::path> hard_case_files(const std::string& beginning = "");

}  // namespace quadrig::test
