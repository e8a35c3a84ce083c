#include "frame_scheduler/host_view.h"

namespace quadrig::scheduler {

View host_view(const ScenePose& body, const std::optional<host::ViewMount>& mount, const ImagePlane& image) {
    if (!mount) return {body.position, body.eye_from_scene, image};
    const ScenePose eye = pose_on(body, {{mount->offset}, eye_from_scene_rotation(mount->attitude)});
    return {eye.position, eye.eye_from_scene, image};
}

ImagePlane host_image_plane(const std::optional<host::ViewWindow>& window, const ImagePlane& channel) {
    if (!window) return channel;
    return ImagePlane::window(channel.width, channel.height, window->left, window->right, window->top, window->bottom);
}

}  // namespace quadrig::scheduler
