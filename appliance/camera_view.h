/// What a camera of a camera path, or of the command line, sees.
#pragma once

#include "config/appliance_file.h"
#include "config/camera_path.h"
#include "ig_core/view.h"

namespace quadrig::appliance {

/// Square pixels, the look direction in the middle.
View view_from(const config::Camera& camera, const config::ImageSize& size);

}  // namespace quadrig::appliance
