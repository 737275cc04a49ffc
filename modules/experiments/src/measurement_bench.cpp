#include "measurement_bench.h"

#include <cmath>

#include "movis/calibration/correction_calibration.h"
#include "movis/calibration/rig_calibration.h"
#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/sim/scene.h"
#include "systems.h"

namespace movis::experiments {
namespace {

using Eigen::Vector2d;

// Streams of an experiment: make_stream(seed, purpose + number).
constexpr std::uint64_t kRigStream = std::uint64_t{1} << 32;          // + draw
constexpr std::uint64_t kCalibrationStream = std::uint64_t{2} << 32;  // + draw
constexpr std::uint64_t kNoiseStream = std::uint64_t{1} << 48;        // + draw · kPlaces + place
constexpr std::uint64_t kPlaces = std::uint64_t{1} << 24;
constexpr std::uint64_t kFirstCalibrationPlace = std::uint64_t{1} << 20;  // before it: the lattice's points

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

// Balls at known places: evenly over the lattice's square, beside the robot.
std::vector<Vector2d> calibration_places(const MeasurementSettings& settings, RandomStream& random) {
  std::uniform_real_distribution<double> along(-settings.half_width, settings.half_width);
  const auto wanted = static_cast<std::size_t>(settings.calibration_points);
  constexpr std::size_t kTries = 1000;  // for each; of a robot within the square one in five is beside it
  std::vector<Vector2d> places;
  for (std::size_t i = 0; i < kTries * wanted && places.size() < wanted; ++i) {
    const double x = along(random);
    const Vector2d place(x, along(random));
    if (place.norm() > clearance_of(settings)) places.push_back(place);
  }
  if (places.size() == wanted) return places;
  throw Error("the robot, {} m in radius, covers the lattice of half width {} m: no place is left for a ball",
              settings.robot.radius, settings.half_width);
}

}  // namespace

double clearance_of(const MeasurementSettings& settings) {
  return settings.robot.radius + sim::kBallRadius;
}

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
      if (point.norm() < clearance_of(settings)) {
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
      seed_(seed),
      block_(block),
      lattice_(lattice_of(settings, block.differences)),
      nominal_(settings.rigs[block.rig]) {
  RandomStream random = make_stream(seed, kRigStream + static_cast<std::uint64_t>(block.draw));
  const omni::Rig truth = omni::draw_rig(nominal_, only(block.differences, settings.differences), random);
  eyes_ = block.level == Level::bearings ? make_bearing_eyes(settings, truth) : make_image_eyes(settings, truth);
  beliefs_.push_back({Knowledge::nominal, eyes_->believe(nominal_), nominal_, {}});
  if (block.differences != Differences::all) return;
  const calibration::Sightings sightings = sightings_by(beliefs_[0].eyes, nominal_);
  beliefs_.push_back(corrected(sightings));
  beliefs_.push_back(calibrated(sightings));
  beliefs_.push_back({Knowledge::true_rig, eyes_->believe(truth), truth, {}});
}

std::uint64_t MeasurementBench::noise_seed(std::uint64_t place) const {
  return make_stream(seed_, kNoiseStream + static_cast<std::uint64_t>(block_.draw) * kPlaces + place)();
}

calibration::Sightings MeasurementBench::sightings_by(int believed, const omni::Rig& rig) {
  RandomStream random = make_stream(seed_, kCalibrationStream + static_cast<std::uint64_t>(block_.draw));
  calibration::Sightings sightings{rig, {}};
  std::uint64_t place = kFirstCalibrationPlace;
  for (const Vector2d& ball : calibration_places(settings_, random)) {
    calibration::Sighting sighting;
    sighting.frame = static_cast<std::int64_t>(place - kFirstCalibrationPlace);
    sighting.ball_in_robot = Eigen::Vector3d(ball.x(), ball.y(), sim::kBallRadius);
    eyes_->look_at(ball, noise_seed(place++));
    eyes_->bearings(believed, sighting.bearings);
    sightings.frames.push_back(std::move(sighting));
  }
  return sightings;
}

MeasurementBench::Belief MeasurementBench::corrected(const calibration::Sightings& sightings) const {
  Belief belief{Knowledge::corrected, beliefs_[0].eyes, nominal_, {}};
  try {
    belief.correction = calibration::fit_correction(sightings).correction;
  } catch (const Error&) {  // the data cannot carry it: that is a result
    belief.known = false;
  }
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
  eyes_->look_at(ball, noise_seed(static_cast<std::uint64_t>(point)));
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
