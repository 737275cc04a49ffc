#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "correction_limits.h"
#include "correction_points.h"
#include "movis/core/angle.h"
#include "movis/core/chi2.h"
#include "movis/core/error.h"
#include "movis/core/median.h"
#include "movis/core/random.h"

namespace movis::calibration {
namespace {

// The first-order bases: they are what a few frames can carry.
constexpr int kAzimuthOrder = 5, kElevationOrder = 6;
constexpr double kSigmas = 5.0;          // beyond which a point contradicts the others
constexpr double kSigmasOfOthers = 3.0;  // beyond which the other cameras agree with one that does
// An honest point is never further off, however much the others scatter, but for what its place's error explains.
constexpr double kMostAzimuth = radians(0.5);
constexpr double kMostElevation = radians(1.0);
constexpr int kDraws = 200;
constexpr std::size_t kMostNamed = 12;  // frames in one message

struct CameraFit {
  Eigen::VectorXd in_azimuth, in_elevation;
  Eigen::MatrixXd azimuth_covariance, elevation_covariance;
};

// What a fit leaves of a point, radians, and the sigma of that where the point is honest.
struct Misfit {
  double azimuth = 0.0, elevation = 0.0;
  double azimuth_sigma = 0.0, elevation_sigma = 0.0;
  double most_azimuth = 0.0, most_elevation = 0.0;

  double squares() const {  // in sigmas
    const double a = azimuth / azimuth_sigma, e = elevation / elevation_sigma;
    return a * a + e * e;
  }
};

std::vector<CameraFit> fit_cameras(const std::vector<CorrectionPoint>& points, const std::vector<bool>& used,
                                   int cameras) {
  std::vector<CameraFit> fits;
  for (int camera = 0; camera < cameras; ++camera) {
    std::vector<SmoothSample> in_azimuth, in_elevation;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!used[i] || points[i].camera != camera) continue;
      in_azimuth.push_back(points[i].in_azimuth);
      in_elevation.push_back(points[i].in_elevation);
    }
    fits.push_back({fit_smooth(in_azimuth, kAzimuthOrder, kAzimuthOrder, kAzimuthFloor),
                    fit_smooth(in_elevation, kElevationOrder, kElevationOrder, kElevationFloor),
                    smooth_covariance(in_azimuth, kAzimuthOrder, kAzimuthOrder, kAzimuthFloor),
                    smooth_covariance(in_elevation, kElevationOrder, kElevationOrder, kElevationFloor)});
  }
  return fits;
}

double variance_of(const SmoothSample& sample, double floor) {
  return sample.variance + floor * floor;
}

double prediction_variance(const SmoothSample& sample, const Eigen::MatrixXd& covariance) {
  const auto basis = sample.basis.head(covariance.rows());
  return basis.dot(covariance * basis);
}

std::vector<Misfit> misfits_of(const std::vector<CorrectionPoint>& points, const std::vector<CameraFit>& fits) {
  std::vector<Misfit> result;
  result.reserve(points.size());
  for (const CorrectionPoint& point : points) {
    const CameraFit& fit = fits[point.camera];
    result.push_back({point.in_azimuth.value - predict(point.in_azimuth, fit.in_azimuth),
                      point.in_elevation.value - predict(point.in_elevation, fit.in_elevation),
                      std::sqrt(variance_of(point.in_azimuth, kAzimuthFloor)),
                      std::sqrt(variance_of(point.in_elevation, kElevationFloor)),
                      std::hypot(kMostAzimuth, kSigmas * point.azimuth_of_place),
                      std::hypot(kMostElevation, kSigmas * point.elevation_of_place)});
  }
  return result;
}

// To judge single points by: what the fit did not use, it also knows less well.
std::vector<Misfit> fair_misfits(const std::vector<CorrectionPoint>& points, const std::vector<bool>& used,
                                 int cameras) {
  const std::vector<CameraFit> fits = fit_cameras(points, used, cameras);
  std::vector<Misfit> misfits = misfits_of(points, fits);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (used[i]) continue;
    const CameraFit& fit = fits[points[i].camera];
    misfits[i].azimuth_sigma = std::sqrt(variance_of(points[i].in_azimuth, kAzimuthFloor) +
                                         prediction_variance(points[i].in_azimuth, fit.azimuth_covariance));
    misfits[i].elevation_sigma = std::sqrt(variance_of(points[i].in_elevation, kElevationFloor) +
                                           prediction_variance(points[i].in_elevation, fit.elevation_covariance));
  }
  return misfits;
}

std::vector<bool> points_of(const std::vector<CorrectionPoint>& points, const std::set<int>& frames) {
  std::vector<bool> used;
  used.reserve(points.size());
  for (const CorrectionPoint& point : points) used.push_back(frames.count(point.frame) > 0);
  return used;
}

// The frames with the least misfit, root mean square over their points, and the largest of those.
struct BestFrames {
  std::set<int> frames;
  double worst = 0.0;
};

BestFrames best_frames(const std::vector<CorrectionPoint>& points, const std::vector<Misfit>& misfits,
                       std::size_t count) {
  std::map<int, std::pair<double, double>> sums;  // of squares, of ones
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto& [squares, ones] = sums[points[i].frame];
    squares += misfits[i].squares();
    ones += 2.0;
  }
  std::vector<std::pair<double, int>> sorted;
  sorted.reserve(sums.size());
  for (const auto& [frame, sum] : sums) sorted.emplace_back(std::sqrt(sum.first / sum.second), frame);
  std::sort(sorted.begin(), sorted.end());
  BestFrames best;
  for (std::size_t i = 0; i < count; ++i) best.frames.insert(sorted[i].second);
  best.worst = sorted[count - 1].first;
  return best;
}

// The half of the frames that agree best with each other: from the best of many draws of a few frames, each
// concentrated on the frames that fit it.
std::set<int> agreeing_half(const std::vector<CorrectionPoint>& points, const std::vector<int>& frames, int cameras) {
  constexpr int kConcentrations = 2;
  const std::size_t few = std::min<std::size_t>(frames.size(), kElevationOrder + 1);
  const std::size_t half = std::min(frames.size(), (frames.size() + few) / 2);
  RandomStream random = make_stream(1, 0x6f75746cU);
  BestFrames best;
  best.worst = std::numeric_limits<double>::infinity();
  for (int draw = 0; draw < kDraws; ++draw) {
    BestFrames found;
    while (found.frames.size() < few) found.frames.insert(frames[random() % frames.size()]);
    for (int step = 0; step < kConcentrations; ++step) {
      found =
          best_frames(points, misfits_of(points, fit_cameras(points, points_of(points, found.frames), cameras)), half);
    }
    if (found.worst < best.worst) best = found;
  }
  return best.frames;
}

// By how much the points scatter more than their sigmas say, at least 1.
struct Scatter {
  double azimuth = 1.0, elevation = 1.0;
};

Scatter scatter_of(const std::vector<Misfit>& misfits) {
  std::vector<double> azimuths, elevations;
  for (const Misfit& misfit : misfits) {
    azimuths.push_back(std::abs(misfit.azimuth) / misfit.azimuth_sigma);
    elevations.push_back(std::abs(misfit.elevation) / misfit.elevation_sigma);
  }
  return {std::max(1.0, kNormalMedian * median(azimuths)), std::max(1.0, kNormalMedian * median(elevations))};
}

// Which points contradict the others.
std::vector<bool> contradicting(const std::vector<Misfit>& misfits, const Scatter& scatter) {
  std::vector<bool> result;
  result.reserve(misfits.size());
  for (const Misfit& misfit : misfits) {
    const double most_azimuth = std::min(kSigmas * scatter.azimuth * misfit.azimuth_sigma, misfit.most_azimuth);
    const double most_elevation = std::min(kSigmas * scatter.elevation * misfit.elevation_sigma, misfit.most_elevation);
    result.push_back(std::abs(misfit.azimuth) > most_azimuth || std::abs(misfit.elevation) > most_elevation);
  }
  return result;
}

// Frames of which two cameras contradict, or all that see the ball, or the others taken together.
std::set<int> contradicting_frames(const std::vector<CorrectionPoint>& points, const std::vector<Misfit>& misfits,
                                   const Scatter& scatter, const std::vector<bool>& bad) {
  struct Frame {
    int bad = 0, good = 0;
    double chi_square = 0.0;  // of the good ones
  };
  std::map<int, Frame> frames;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Frame& frame = frames[points[i].frame];
    if (bad[i]) {
      ++frame.bad;
      continue;
    }
    ++frame.good;
    Misfit scaled = misfits[i];
    scaled.azimuth_sigma *= scatter.azimuth;
    scaled.elevation_sigma *= scatter.elevation;
    frame.chi_square += scaled.squares();
  }
  std::set<int> result;
  for (const auto& [index, frame] : frames) {
    const double sigmas = frame.bad > 0 ? kSigmasOfOthers : kSigmas;
    if (frame.bad >= 2 || frame.good == 0 || frame.chi_square > chi2_limit(2 * frame.good, sigmas)) {
      result.insert(index);
    }
  }
  return result;
}

std::string amount(const Misfit& misfit) {
  return fmt::format("azimuth {:+.2f}°, elevation {:+.2f}° off", -degrees(misfit.azimuth), -degrees(misfit.elevation));
}

// Of the camera that contradicts most.
const Misfit& largest(const std::vector<CorrectionPoint>& points, const std::vector<Misfit>& misfits, int frame) {
  const Misfit* most = nullptr;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].frame != frame) continue;
    if (most == nullptr || misfits[i].squares() > most->squares()) most = &misfits[i];
  }
  return *most;
}

void refuse_many(const Sightings& sightings, const std::vector<CorrectionPoint>& points, const std::vector<bool>& bad,
                 const std::set<int>& bad_frames, std::size_t frames) {
  if (3 * bad_frames.size() > frames) {
    std::string names;
    std::size_t named = 0;
    for (const int frame : bad_frames) {
      if (++named > kMostNamed) break;
      names += fmt::format(" {}", sightings.frames[frame].frame);
    }
    if (named > kMostNamed) names += " …";
    throw Error(
        "in {} of {} frames the ball is not where it is said to stand, more than a third: nothing can be fitted to "
        "that. Check that each row of the truth belongs to its images (frames{})",
        bad_frames.size(), frames, names);
  }
  for (int camera = 0; camera < static_cast<int>(sightings.rig.cameras.size()); ++camera) {
    std::size_t bad_ones = 0, all = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i].camera != camera || bad_frames.count(points[i].frame) > 0) continue;
      ++all;
      bad_ones += bad[i] ? 1 : 0;
    }
    if (3 * bad_ones <= all) continue;
    throw Error(
        "{} contradicts the known places in {} of {} frames, more than a third: look at its images, was it moved?",
        sightings.rig.cameras[camera].name, bad_ones, all);
  }
}

}  // namespace

std::vector<RejectedSighting> reject_outliers(const Sightings& sightings, std::vector<CorrectionPoint>& points) {
  const auto cameras = static_cast<int>(sightings.rig.cameras.size());
  std::set<int> distinct;
  for (const CorrectionPoint& point : points) distinct.insert(point.frame);
  const std::vector<int> frames(distinct.begin(), distinct.end());
  std::vector<bool> used = points_of(points, agreeing_half(points, frames, cameras));
  std::vector<Misfit> misfits;
  std::vector<bool> bad;
  std::set<int> bad_frames;
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    misfits = fair_misfits(points, used, cameras);
    const Scatter scatter = scatter_of(misfits);
    bad = contradicting(misfits, scatter);
    bad_frames = contradicting_frames(points, misfits, scatter, bad);
    refuse_many(sightings, points, bad, bad_frames, frames.size());
    for (std::size_t i = 0; i < points.size(); ++i) used[i] = !bad[i] && bad_frames.count(points[i].frame) == 0;
  }

  std::vector<RejectedSighting> rejected;
  std::set<int> named;
  std::vector<CorrectionPoint> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const CorrectionPoint& point = points[i];
    if (used[i]) {
      kept.push_back(point);
      continue;
    }
    const std::int64_t frame = sightings.frames[point.frame].frame;
    if (bad_frames.count(point.frame) == 0) {
      rejected.push_back({frame, point.camera, "this camera alone contradicts: " + amount(misfits[i])});
    } else if (named.insert(point.frame).second) {
      rejected.push_back(
          {frame, -1, "the ball is not where it is said to stand: " + amount(largest(points, misfits, point.frame))});
    }
  }
  points = std::move(kept);
  return rejected;
}

}  // namespace movis::calibration
