#include "drawn_rig.h"

#include "movis/calibration/correction_calibration.h"
#include "movis/core/error.h"
#include "movis/sim/scene.h"

namespace movis::experiments {
namespace {

using Eigen::Vector2d;

// Streams of an experiment: make_stream(seed, purpose + number).
constexpr std::uint64_t kRigStream = std::uint64_t{1} << 32;          // + draw
constexpr std::uint64_t kCalibrationStream = std::uint64_t{2} << 32;  // + draw
constexpr std::uint64_t kNoiseStream = std::uint64_t{1} << 48;        // + draw · kPlaces + place
constexpr std::uint64_t kPlaces = std::uint64_t{1} << 24;

std::vector<Vector2d> calibration_places(const CalibrationBalls& balls, RandomStream& random) {
  std::uniform_real_distribution<double> along(-balls.half_width, balls.half_width);
  const auto wanted = static_cast<std::size_t>(balls.count);
  constexpr std::size_t kTries = 1000;  // for each; of a robot within the square one in five is beside it
  std::vector<Vector2d> places;
  for (std::size_t i = 0; i < kTries * wanted && places.size() < wanted; ++i) {
    const double x = along(random);
    const Vector2d place(x, along(random));
    if (place.norm() > clearance_of(balls.robot_radius)) places.push_back(place);
  }
  if (places.size() == wanted) return places;
  throw Error("the robot, {} m in radius, covers the lattice of half width {} m: no place is left for a ball",
              balls.robot_radius, balls.half_width);
}

}  // namespace

omni::Rig true_rig_of(const RigDraw& draw, const omni::Rig& nominal, const omni::Deviation& sigma) {
  RandomStream random = make_stream(draw.seed, kRigStream + static_cast<std::uint64_t>(draw.draw));
  return omni::draw_rig(nominal, sigma, random);
}

std::uint64_t noise_seed(const RigDraw& draw, std::uint64_t place) {
  return make_stream(draw.seed, kNoiseStream + static_cast<std::uint64_t>(draw.draw) * kPlaces + place)();
}

double clearance_of(double robot_radius) {
  return robot_radius + sim::kBallRadius;
}

calibration::Sightings sightings_of(const RigDraw& draw, const CalibrationBalls& balls, const omni::Rig& believed,
                                    int number, Eyes& eyes) {
  RandomStream random = make_stream(draw.seed, kCalibrationStream + static_cast<std::uint64_t>(draw.draw));
  calibration::Sightings sightings{believed, {}};
  std::uint64_t place = kFirstCalibrationPlace;
  for (const Vector2d& ball : calibration_places(balls, random)) {
    calibration::Sighting sighting;
    sighting.frame = static_cast<std::int64_t>(place - kFirstCalibrationPlace);
    sighting.ball_in_robot = Eigen::Vector3d(ball.x(), ball.y(), sim::kBallRadius);
    eyes.look_at(ball, noise_seed(draw, place++));
    eyes.bearings(number, sighting.bearings);
    sightings.frames.push_back(std::move(sighting));
  }
  return sightings;
}

std::optional<triangulation::Correction> correction_of(const calibration::Sightings& sightings) {
  try {
    return calibration::fit_correction(sightings).correction;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace movis::experiments
