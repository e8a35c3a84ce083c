/// Answers a host's questions about the scene.
#pragma once

#include <optional>
#include <vector>

#include "host_link/survey.h"
#include "ig_core/scene_query.h"

namespace quadrig::appliance {

class SceneSurvey {
  public:
    explicit SceneSurvey(const Scene& scene);

    /// The first surface on the line. Its material is 1 more than its texture's place in the scene file, 0 without one.
    /// Safe in several threads at once.
    [[nodiscard]] std::optional<host::SurveyHit> answer(const host::SurveyLine& line) const;

  private:
    SceneQuery query_;
    std::vector<std::uint32_t> materials_;  ///< by object
    std::uint32_t ground_material_ = 0;
};

}  // namespace quadrig::appliance
