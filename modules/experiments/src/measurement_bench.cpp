#include "measurement_bench.h"

#include <cmath>

#include "movis/calibration/rig_calibration.h"
#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/sim/scene.h"
#include "systems.h"

namespace movis::experiments {
namespace {

using Eigen::Vector2d;

omni::Deviation only(Differences differences, const omni::Deviation& sigma) {
  struct Part {
    int first, count;
  };
  constexpr std::array<Part, kDifferences.size()> kParts{{{0, 9}, {0, 0}, {0, 3}, {3, 1}, {4, 2}, {6, 1}, {7, 2}}};
  const Part part = kParts.at(static_cast<std::size_t>(differences));
  omni::Deviation kept = omni::Deviation::Zero();
  kept.segment(part.first, part.count) = sigma.segment(part.first, part.count);
  return kept;
}

}  // namespace

std::vector<Knowledge> knowledges_of(Differences differences) {
  if (differences != Differences::all) return {Knowledge::nominal};
  return {kKnowledges.begin(), kKnowledges.end()};
}

std::vector<int> systems_of(RigIndex rig) {
  std::vector<int> systems;
  for (int i = 0; i < static_cast<int>(kSystems.size()); ++i) {
    if (kSystems[static_cast<std::size_t>(i)].rig == rig) systems.push_back(i);
  }
  return systems;
}

Lattice lattice_of(const MeasurementSettings& settings, Differences differences) {
  const double step = differences == Differences::all ? settings.step : settings.alone_step;
  const int half = static_cast<int>(std::lround(settings.half_width / step));
  Lattice lattice;
  for (int row = -half; row <= half; ++row) {
    for (int column = -half; column <= half; ++column) {
      const Vector2d point(step * column, step * row);
      if (point.norm() < clearance_of(settings.robot.radius)) {
        ++lattice.under_robot;
      } else {
        lattice.points.push_back(point);
      }
    }
  }
  return lattice;
}

MeasurementBench::MeasurementBench(const MeasurementSettings& settings, std::uint64_t seed,
                                   const MeasurementBlock& block)
    : settings_(settings),
      draw_{seed, block.draw},
      block_(block),
      lattice_(lattice_of(settings, block.differences)),
      nominal_(settings.rigs[block.rig]) {
  const omni::Rig truth = true_rig_of(draw_, nominal_, only(block.differences, settings.differences));
  eyes_ = block.level == Level::bearings ? make_bearing_eyes(settings, truth)
                                         : make_image_eyes(truth, settings.robot, settings.look, settings.colours);
  beliefs_.push_back({Knowledge::nominal, eyes_->believe(nominal_), nominal_, {}});
  if (block.differences != Differences::all) return;
  const calibration::Sightings sightings = sightings_by(beliefs_[0].eyes, nominal_);
  beliefs_.push_back(corrected(sightings));
  beliefs_.push_back(calibrated(sightings));
  beliefs_.push_back({Knowledge::true_rig, eyes_->believe(truth), truth, {}});
}

calibration::Sightings MeasurementBench::sightings_by(int believed, const omni::Rig& rig) {
  const CalibrationBalls balls{settings_.calibration_points, settings_.half_width, settings_.robot.radius};
  return sightings_of(draw_, balls, rig, believed, *eyes_);
}

MeasurementBench::Belief MeasurementBench::corrected(const calibration::Sightings& sightings) const {
  Belief belief{Knowledge::corrected, beliefs_[0].eyes, nominal_, correction_of(sightings)};
  belief.known = belief.correction.has_value();
  return belief;
}

// What the scan finds depends slightly on the rig with which it looks: once more with the first result.
MeasurementBench::Belief MeasurementBench::calibrated(const calibration::Sightings& sightings) {
  Belief belief{Knowledge::calibrated, beliefs_[0].eyes, nominal_, {}};
  try {
    belief.rig = calibration::calibrate_rig(nominal_, sightings).rig;
    belief.eyes = eyes_->believe(belief.rig);
    if (block_.level == Level::images) {
      belief.rig = calibration::calibrate_rig(nominal_, sightings_by(belief.eyes, belief.rig)).rig;
      belief.eyes = eyes_->believe(belief.rig);
    }
  } catch (const Error&) {
    belief.known = false;
  }
  return belief;
}

void MeasurementBench::measure(int point, std::vector<MeasurementRow>& rows) {
  const Vector2d& ball = lattice_.points.at(static_cast<std::size_t>(point));
  const std::vector<int> systems = systems_of(block_.rig);
  eyes_->look_at(ball, noise_seed(draw_, static_cast<std::uint64_t>(point)));
  const auto rows_a_point = static_cast<std::int64_t>(beliefs_.size() * systems.size());
  std::int64_t number = block_.first_row + point * rows_a_point;
  for (const Belief& belief : beliefs_) {
    bearings_.clear();
    eyes_->bearings(belief.eyes, bearings_);
    if (belief.correction) triangulation::correct(*belief.correction, bearings_);
    for (const int system : systems) {
      MeasurementRow row{number++,         block_.level, block_.differences, block_.draw, point, system,
                         belief.knowledge, ball,         kNotCalibrated};
      if (belief.known) {
        const PointEstimate measured = estimator_of(system)(belief.rig, bearings_);
        row.status = movis::word(measured.status);
        if (measured.status == PointStatus::ok) {
          const Vector2d at = measured.point.head<2>();
          row.distance_error = at.norm() - ball.norm();
          row.direction_error = turn(std::atan2(ball.y(), ball.x()), std::atan2(at.y(), at.x()));
        }
      }
      rows.push_back(std::move(row));
    }
  }
}

}  // namespace movis::experiments
