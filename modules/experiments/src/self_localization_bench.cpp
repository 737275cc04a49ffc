#include "self_localization_bench.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "movis/core/angle.h"
#include "resampling.h"

namespace movis::experiments {
namespace {

// The ball is no part of this experiment: high above the field no camera sees it.
const Eigen::Vector3d kBallAway(0.0, 0.0, 1000.0);

Field painted(Field field, Field::Goals goals) {
  field.goals = goals;
  return field;
}

Fix no_fix(const localization::Instant& /*instant*/, const localization::FieldMap& /*map*/,
           const localization::Options& /*options*/) {
  return {};
}

}  // namespace

void judge(const Fix& fix, const Pose2& truth, SelfLocalizationRow& row) {
  row.status = movis::word(fix.status);
  if (fix.status != FixStatus::ok) return;
  row.symmetric = fix.symmetric;
  const Fix nearer = nearer_half(fix, truth);
  const Pose2& pose = nearer.world_from_robot;
  row.error << pose.translation() - truth.translation(), turn(truth.beta, pose.beta);
  row.sigma = nearer.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  const Eigen::LLT<Eigen::Matrix3d> factor(nearer.covariance);
  row.nees = factor.info() == Eigen::Success ? row.error.dot(factor.solve(row.error)) : kUnknown;
}

SelfLocalizationBench::SelfLocalizationBench(const SelfLocalizationSettings& settings, std::uint64_t seed,
                                             const SelfLocalizationBlock& block)
    : settings_(settings),
      draw_{seed, block.draw},
      block_(block),
      field_(painted(settings.field, block.goals)),
      renderer_(true_rig_of(draw_, settings.rig, settings.differences), {field_, {}, {}}, settings.robot,
                settings.look) {
  for (const std::string_view name : localizers_for(settings, block.goals)) {
    contenders_.push_back({name, localization::find_localizer(name)});
  }
  believe(true_rig_of(draw_, settings.rig, settings.differences));
}

pipeline::Pipeline SelfLocalizationBench::make_pipeline(const omni::Rig& rig) const {
  return {rig, field_, settings_.colours, {}, {no_fix}, triangulation::find_triangulator(settings_.triangulation)};
}

void SelfLocalizationBench::believe(const omni::Rig& truth) {
  const auto eyes = make_image_eyes(truth, settings_.robot, settings_.look, settings_.colours);
  const CalibrationBalls balls{settings_.calibration_points, settings_.calibration_half_width, settings_.robot.radius};
  const auto correction = correction_of(sightings_of(draw_, balls, settings_.rig, eyes->believe(settings_.rig), *eyes));
  beliefs_.push_back({Knowledge::nominal, make_pipeline(settings_.rig)});
  beliefs_.push_back({Knowledge::corrected, make_pipeline(settings_.rig), correction.has_value()});
  if (correction) beliefs_.back().pipeline.correction = *correction;
  beliefs_.push_back({Knowledge::true_rig, make_pipeline(truth)});
}

std::int64_t SelfLocalizationBench::rows_a_pose(const SelfLocalizationSettings& settings, Field::Goals goals) {
  return static_cast<std::int64_t>(kLocalizationKnowledges.size() * localizers_for(settings, goals).size());
}

void SelfLocalizationBench::measure(int spot, int heading, std::vector<SelfLocalizationRow>& rows) {
  const Eigen::Vector2d& place = settings_.spots.at(static_cast<std::size_t>(spot)).place;
  const int heading_deg = heading * settings_.heading_step_deg;
  const Pose2 truth{place.x(), place.y(), wrap_angle(radians(heading_deg))};
  // The same noise whatever the goals and however many headings there are.
  renderer_.render({0.0, truth, kBallAway}, noise_seed(draw_, static_cast<std::uint64_t>(360 * spot + heading_deg)),
                   images_);
  SelfLocalizationRow row;
  row.row = block_.first_row + (static_cast<std::int64_t>(spot) * settings_.headings() + heading) *
                                   static_cast<std::int64_t>(beliefs_.size() * contenders_.size());
  row.goals = block_.goals;
  row.draw = block_.draw;
  row.spot = spot;
  row.heading = heading;
  for (Belief& belief : beliefs_) {
    const pipeline::Pipeline& p = belief.pipeline;
    const pipeline::Estimate& seen = pipeline::step(belief.pipeline, images_);
    for (const Contender& contender : contenders_) {
      SelfLocalizationRow answer = row;
      ++row.row;
      answer.knowledge = belief.knowledge;
      answer.localizer = contender.name;
      answer.status = kNotCalibrated;
      if (belief.known) {
        judge(contender.localizer.fix({p.rig, seen.bearings, seen.goals, seen.lines}, *p.map, p.options.localization),
              truth, answer);
      }
      rows.push_back(std::move(answer));
    }
  }
}

}  // namespace movis::experiments
