/// From a body's pose to what the eye on it sees.
#pragma once

#include <optional>

#include "host_link/host_state.h"
#include "ig_core/geometry/space.h"
#include "ig_core/view.h"

namespace quadrig::scheduler {

/// The view of an eye mounted on a body; without a mount the eye is the body's own origin and looks where it points.
View host_view(const ScenePose& body, const std::optional<host::ViewMount>& mount, const ImagePlane& image);

/// The image plane that the host asks for, at the channel's size; the channel's own where it asks for none.
ImagePlane host_image_plane(const std::optional<host::ViewWindow>& window, const ImagePlane& channel);

}  // namespace quadrig::scheduler
