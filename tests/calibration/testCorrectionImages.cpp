// The error correction on rendered images of rigs with individual differences: as good as 3 cm over 8 m × 8 m. By
// default one draw of a rig, with few places; MOVIS_DRAWS=10 in the environment makes it the evaluation, ten draws with
// 40 places to calibrate and 30 to test. It prints a table.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "movis/calibration/correction_calibration.h"
#include "movis/core/angle.h"
#include "movis/core/paths.h"
#include "movis/triangulation/joint.h"
#include "movis/triangulation/pairs.h"
#include "sim/render_scene.h"

namespace movis::calibration {
namespace {

using Eigen::Vector3d;

struct Extent {
  int draws, places, tests;
};

Extent extent() {
  const char* asked = std::getenv("MOVIS_DRAWS");
  return asked != nullptr ? Extent{std::max(1, std::atoi(asked)), 40, 30} : Extent{1, 24, 12};
}

// Balls anywhere on the floor of 8 m × 8 m but beside the robot, which stands at its centre.
std::vector<Vector3d> draw_places(int count, RandomStream& random) {
  std::uniform_real_distribution<double> along(-4.0, 4.0);
  std::vector<Vector3d> places;
  while (static_cast<int>(places.size()) < count) {
    const double x = along(random), y = along(random);
    if (std::hypot(x, y) > 0.45) places.push_back({x, y, sim::kBallRadius});
  }
  return places;
}

// What the renderer's cameras see of balls, scanned once for every rig that is believed.
std::vector<Sightings> see(const std::vector<omni::Rig>& believed, sim::Renderer& renderer,
                           const std::vector<Vector3d>& places, std::uint64_t noise_seed) {
  const scan::Colours colours = scan::read_colours(data_file("colours/default.yaml"));
  std::vector<SightingScanner> scanners;
  std::vector<Sightings> sightings;
  for (const omni::Rig& rig : believed) {
    scanners.emplace_back(rig, colours, scan::ScanOptions{});
    sightings.push_back({rig, {}});
  }
  grab::FrameSet images;
  for (std::size_t i = 0; i < places.size(); ++i) {
    images.index = static_cast<std::int64_t>(i);
    renderer.render({0.0, {}, places[i]}, noise_seed + i, images);
    for (std::size_t k = 0; k < believed.size(); ++k) {
      sightings[k].frames.push_back(scanners[k].scan(images));
      sightings[k].frames.back().ball_in_robot = places[i];
    }
  }
  return sightings;
}

struct Errors {
  double distance = 0.0, direction = 0.0;  // mean magnitudes, metres and radians
  double normalized = 0.0;  // mean of eᵀ C⁻¹ e / 2 on the floor plane: 1 where covariances are honest
  int missing = 0;
};

template <typename Triangulate>
Errors errors_of(const Sightings& sightings, const triangulation::Correction& correction, Triangulate triangulate) {
  Errors errors;
  int count = 0;
  for (const Sighting& sighting : sightings.frames) {
    std::vector<Bearing> bearings = sighting.bearings;
    triangulation::correct(correction, bearings);
    const PointEstimate ball = triangulate(sightings.rig, bearings);
    if (ball.status != PointStatus::ok) {
      ++errors.missing;
      continue;
    }
    const Eigen::Vector2d truth = sighting.ball_in_robot->head<2>(), found = ball.point.head<2>();
    errors.distance += std::abs(found.norm() - truth.norm());
    errors.direction += std::abs(turn(std::atan2(truth.y(), truth.x()), std::atan2(found.y(), found.x())));
    const Eigen::Vector2d off = found - truth;
    errors.normalized += 0.5 * off.dot(ball.covariance.topLeftCorner<2, 2>().inverse() * off);
    ++count;
  }
  errors.distance /= count;
  errors.direction /= count;
  errors.normalized /= count;
  return errors;
}

const auto kPairs = [](const omni::Rig& rig, const std::vector<Bearing>& bearings) {
  return triangulation::triangulate_pairs(rig, bearings, ObjectClass::ball);
};
const auto kJoint = [](const omni::Rig& rig, const std::vector<Bearing>& bearings) {
  return triangulation::triangulate_joint(rig, bearings, ObjectClass::ball);
};

struct Draw {
  CorrectionFit fit;
  Errors nominal_pairs, corrected_pairs, true_pairs;
  Errors nominal_joint, corrected_joint, true_joint;
};

Draw run(std::uint64_t seed, const Extent& extent) {
  const omni::Rig nominal = omni::read_rig(data_file("rigs/movis.yaml"));
  RandomStream random = make_stream(seed, 1);
  const omni::Rig built = omni::draw_rig(nominal, omni::individual_differences(), random);
  sim::Renderer renderer(built, {}, control::read_robot(data_file("robots/miniature.yaml")),
                         sim::read_look(data_file("looks/hall.yaml")));
  const std::vector<Vector3d> places = draw_places(extent.places, random);
  const std::vector<Vector3d> tests = draw_places(extent.tests, random);
  Draw draw;
  draw.fit = fit_correction(see({nominal}, renderer, places, 1000 * seed).front());
  const std::vector<Sightings> seen = see({nominal, built}, renderer, tests, 1000 * seed + 500);
  const Sightings& believed = seen[0];
  const Sightings& known = seen[1];
  draw.nominal_pairs = errors_of(believed, {}, kPairs);
  draw.nominal_joint = errors_of(believed, {}, kJoint);
  draw.corrected_pairs = errors_of(believed, draw.fit.correction, kPairs);
  draw.corrected_joint = errors_of(believed, draw.fit.correction, kJoint);
  draw.true_pairs = errors_of(known, {}, kPairs);
  draw.true_joint = errors_of(known, {}, kJoint);
  return draw;
}

void print(const char* what, const Errors& errors) {
  std::printf("  %-18s %7.2f cm %8.4f°  normalized %8.2f  missing %d\n", what, 100.0 * errors.distance,
              degrees(errors.direction), errors.normalized, errors.missing);
}

void print(std::uint64_t seed, const Draw& draw) {
  std::printf("draw %d, rejected %zu\n", static_cast<int>(seed), draw.fit.rejected.size());
  for (std::size_t i = 0; i < draw.fit.azimuth_rms.size(); ++i) {
    const triangulation::CameraCorrection& camera = draw.fit.correction.cameras[i];
    std::printf("  %s azimuth %.3f° -> %.4f° (%zu, beyond %.4f°)  elevation %.3f° -> %.4f° (%zu, beyond %.4f°)\n",
                camera.camera.c_str(), degrees(draw.fit.azimuth_rms_before[i]), degrees(draw.fit.azimuth_rms[i]),
                camera.azimuth.size(), degrees(camera.azimuth_sigma), degrees(draw.fit.elevation_rms_before[i]),
                degrees(draw.fit.elevation_rms[i]), camera.elevation.size(), degrees(camera.elevation_sigma));
  }
  for (const RejectedSighting& r : draw.fit.rejected) {
    std::printf("  frame %d camera %d: %s\n", static_cast<int>(r.frame), r.camera, r.reason.c_str());
  }
  print("nominal, pairs", draw.nominal_pairs);
  print("nominal, joint", draw.nominal_joint);
  print("corrected, pairs", draw.corrected_pairs);
  print("corrected, joint", draw.corrected_joint);
  print("true rig, pairs", draw.true_pairs);
  print("true rig, joint", draw.true_joint);
}

Errors mean(const std::vector<Draw>& draws, Errors Draw::*of) {
  Errors mean;
  const auto count = static_cast<double>(draws.size());
  for (const Draw& draw : draws) {
    mean.distance += (draw.*of).distance / count;
    mean.direction += (draw.*of).direction / count;
    mean.normalized += (draw.*of).normalized / count;
    mean.missing += (draw.*of).missing;
  }
  return mean;
}

TEST(CorrectionImages, WithinThreeCentimetres) {
  const Extent size = extent();
  std::vector<Draw> draws;
  for (int seed = 1; seed <= size.draws; ++seed) {
    draws.push_back(run(seed, size));
    print(seed, draws.back());
  }
  std::printf("mean of %d draws\n", size.draws);
  print("nominal, pairs", mean(draws, &Draw::nominal_pairs));
  print("nominal, joint", mean(draws, &Draw::nominal_joint));
  print("corrected, pairs", mean(draws, &Draw::corrected_pairs));
  print("corrected, joint", mean(draws, &Draw::corrected_joint));
  print("true rig, pairs", mean(draws, &Draw::true_pairs));
  print("true rig, joint", mean(draws, &Draw::true_joint));
  for (const Errors& errors : {mean(draws, &Draw::corrected_pairs), mean(draws, &Draw::corrected_joint)}) {
    EXPECT_LE(errors.distance, 0.03);
    EXPECT_EQ(errors.missing, 0);
  }
  EXPECT_GT(mean(draws, &Draw::nominal_joint).distance, 0.1);  // there is something to correct
}

}  // namespace
}  // namespace movis::calibration
