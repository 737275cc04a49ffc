#include "movis/fuzzy/hierarchy.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "layer.h"
#include "movis/core/angle.h"
#include "movis/core/yaml.h"

namespace movis::fuzzy {
namespace {

using control::Percepts;

// A behaviour's velocity: along and across the line of sight to the ball.
Twist2 in_robot(double toward, double around, double turn_rate_deg, double ball_direction) {
  const Eigen::Vector2d to_ball(-std::sin(ball_direction), std::cos(ball_direction));
  const Eigen::Vector2d to_its_left(-to_ball.y(), to_ball.x());
  const Eigen::Vector2d velocity = toward * to_ball + around * to_its_left;
  return {velocity.x(), velocity.y(), radians(turn_rate_deg)};
}

// From the robot's hull to the nearest post of either goal.
double post_gap(const world::World& world, const control::Task& task) {
  const Eigen::Vector2d one_quadrant = world.world_from_robot.translation().cwiseAbs();
  return (one_quadrant - Eigen::Vector2d(task.field.Fw, task.field.Fd)).norm() - task.robot.radius;
}

struct Behaviour {
  Layer layer;
  std::vector<std::size_t> outputs;  // the places of toward, around, turn_rate_deg

  explicit Behaviour(const std::filesystem::path& file)
      : layer(file), outputs(layer.require_outputs({"toward", "around", "turn_rate_deg"})) {}

  Twist2 velocity(double ball_direction) const {
    const std::vector<double>& v = layer.outputs();
    return in_robot(v[outputs[0]], v[outputs[1]], v[outputs[2]], ball_direction);
  }
};

// Σ w_b v_b / Σ w_b means what it should only for weights in 0…1.
void require_weights(const YamlMap& map, const RuleBase& selection) {
  const auto is_weight = [](double value) { return value >= 0.0 && value <= 1.0; };
  for (const OutputVariable& output : selection.outputs) {
    const bool all =
        std::all_of(output.terms.begin(), output.terms.end(), [&](const Constant& t) { return is_weight(t.value); });
    if (all && (std::isnan(output.standard) || is_weight(output.standard))) continue;
    map.fail("selection", fmt::format("{}: the terms and the default of '{}' must lie from 0 to 1",
                                      selection.file.string(), output.name));
  }
}

}  // namespace

struct Hierarchy::Layers {
  Layer selection;
  std::vector<Behaviour> behaviours;
  std::vector<std::size_t> weights;  // the behaviours' places among the selection's outputs
};

Hierarchy::Hierarchy(const std::filesystem::path& file, control::Task task) : task_(std::move(task)) {
  const YamlMap map = YamlMap::read(file);
  map.allow({"selection", "behaviours"});
  const std::filesystem::path folder = file.parent_path();
  layers_ = std::make_unique<Layers>(Layers{Layer(folder / map.text("selection")), {}, {}});

  std::vector<std::string> names;
  for (const YamlMap& behaviour : map.list_of_maps("behaviours")) {
    behaviour.allow({"name", "rules"});
    names.push_back(behaviour.text("name"));
    if (std::count(names.begin(), names.end(), names.back()) > 1) behaviour.fail("name", "stands twice");
    layers_->behaviours.emplace_back(folder / behaviour.text("rules"));
    signals_.push_back({names.back(), "", 0.0});
  }
  layers_->weights = layers_->selection.require_outputs(names);
  require_weights(map, layers_->selection.rules());
  signals_.push_back({"detour", "°", 0.0});
  signals_.push_back({"ball direction", "°", 0.0});
  signals_.push_back({"gap", "m", 0.0});
}

Hierarchy::~Hierarchy() = default;
Hierarchy::Hierarchy(Hierarchy&&) noexcept = default;
Hierarchy& Hierarchy::operator=(Hierarchy&&) noexcept = default;

void Hierarchy::start() {
  layers_->selection.start();
  for (Behaviour& behaviour : layers_->behaviours) behaviour.layer.start();
  for (control::Signal& signal : signals_) signal.value = 0.0;
}

control::Command Hierarchy::step(const control::Observation& observation) {
  const Percepts percepts = control::perceive(observation, task_);
  const std::size_t count = layers_->behaviours.size();
  signals_[count].value = degrees(percepts.detour);
  signals_[count + 1].value = degrees(percepts.ball_direction);
  signals_[count + 2].value = percepts.ball_gap;
  for (std::size_t i = 0; i < count; ++i) signals_[i].value = 0.0;
  return {combined({percepts, post_gap(observation.world, task_)}), control::should_kick(observation, task_)};
}

Twist2 Hierarchy::combined(const Situation& situation) {
  std::vector<Behaviour>& behaviours = layers_->behaviours;
  bool all = layers_->selection.evaluate(situation);
  for (Behaviour& behaviour : behaviours) all = behaviour.layer.evaluate(situation) && all;
  if (!all) return {};

  const std::vector<double>& selected = layers_->selection.outputs();
  double sum = 0.0;
  for (const std::size_t i : layers_->weights) sum += selected[i];
  if (sum <= 0.0) return {};

  Twist2 mean;
  for (std::size_t i = 0; i < behaviours.size(); ++i) {
    const double weight = selected[layers_->weights[i]] / sum;
    const Twist2 velocity = behaviours[i].velocity(situation.percepts.ball_direction);
    mean.vx += weight * velocity.vx;
    mean.vy += weight * velocity.vy;
    mean.omega += weight * velocity.omega;
    signals_[i].value = weight;
  }
  return mean;
}

}  // namespace movis::fuzzy
