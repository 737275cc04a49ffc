#include "movis/experiments/page.h"

#include <utility>

#include "movis/core/version.h"

namespace movis::experiments {

report::EpisodePage page_of(const sim::Scenario& scenario, std::vector<report::ContenderSummary> summaries,
                            std::vector<report::Episode> shown) {
  report::EpisodePage page;
  page.version = std::string("movis ") + version();
  page.field = scenario.arena.field.value();
  page.robot_radius = scenario.robot.radius;
  page.ball_radius = sim::kBallRadius;
  for (const sim::Obstacle& obstacle : scenario.arena.obstacles) {
    page.obstacles.push_back({obstacle.position, obstacle.radius});
  }
  for (const omni::Camera& camera : scenario.rig.cameras) page.camera_names.push_back(camera.name);
  page.summaries = std::move(summaries);
  page.episodes = std::move(shown);
  return page;
}

}  // namespace movis::experiments
