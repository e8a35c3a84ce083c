#include "frame_scheduler/host_view.h"

#include <glm/matrix.hpp>

namespace quadrig::scheduler {

View host_view(const ScenePose& body, const std::optional<host::ViewMount>& mount, const ImagePlane& image) {
    if (!mount) return {body.position, body.eye_from_scene, image};
    const glm::dmat3& body_from_scene = body.eye_from_scene;
    const glm::dmat3 eye_from_body = eye_from_scene_rotation(mount->attitude);
    const glm::dvec3 offset = glm::transpose(body_from_scene) * mount->offset;
    return {{body.position.metres + offset}, eye_from_body * body_from_scene, image};
}

ImagePlane host_image_plane(const std::optional<host::ViewWindow>& window, const ImagePlane& channel) {
    if (!window) return channel;
    return ImagePlane::window(channel.width, channel.height, window->left, window->right, window->top, window->bottom);
}

}  // namespace quadrig::scheduler
