#include "appliance/camera_view.h"

namespace quadrig::appliance {

View view_from(const config::Camera& camera, const config::ImageSize& size) {
    return {camera.eye, eye_from_scene_rotation(camera.attitude),
            ImagePlane::symmetric(size.width, size.height, camera.horizontal_fov)};
}

}  // namespace quadrig::appliance
