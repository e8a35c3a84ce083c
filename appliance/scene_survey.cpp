#include "appliance/scene_survey.h"

namespace quadrig::appliance {
namespace {

std::uint32_t material_of(const Paint& paint) { return paint.texture ? *paint.texture + 1 : 0; }

}  // namespace

SceneSurvey::SceneSurvey(const Scene& scene) : query_(scene) {
    for (const Object& object : scene.objects) materials_.push_back(material_of(object.paint));
    if (scene.ground) ground_material_ = material_of(scene.ground->paint);
}

std::optional<host::SurveyHit> SceneSurvey::answer(const host::SurveyLine& line) const {
    const auto hit = query_.nearest(line.from, line.direction, line.least, line.most);
    if (!hit) return std::nullopt;
    const std::uint32_t material =
        hit->object < 0 ? ground_material_ : materials_[static_cast<std::size_t>(hit->object)];
    return host::SurveyHit{hit->distance, hit->point, hit->normal, material};
}

}  // namespace quadrig::appliance
