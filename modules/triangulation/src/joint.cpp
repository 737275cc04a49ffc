#include "movis/triangulation/joint.h"

#include <algorithm>
#include <bitset>
#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/chi2.h"
#include "sights.h"

namespace movis::triangulation {
namespace {

struct Candidate {
  Reading reading;
  JointSolution solution;
};

bool solved(const Candidate& candidate) {
  return candidate.solution.status == PointStatus::ok;
}

bool passes(const Candidate& candidate, const JointOptions& options) {
  const JointSolution& solution = candidate.solution;
  return solved(candidate) && std::abs(solution.floor_score) <= options.air_sigmas &&
         (solution.dof == 0 || solution.chi2 <= chi2_limit(solution.dof, options.test_sigmas));
}

PointEstimate estimate_of(const Candidate& candidate, double scale) {
  PointEstimate estimate;
  estimate.status = PointStatus::ok;
  estimate.point = candidate.solution.point;
  estimate.covariance = scale * candidate.solution.covariance;
  estimate.on_floor = candidate.reading.on_floor;
  return estimate;
}

// Readings that pass and are as simple as each other share the estimate by their likelihood.
class Mixture {
 public:
  void enter(const Candidate& candidate, const JointOptions& options) {
    if (!passes(candidate, options)) return;
    const JointSolution& solution = candidate.solution;
    const double weight = std::exp(-0.5 * (solution.chi2 - solution.dof));
    if (weight > heaviest_) {
      heaviest_ = weight;
      on_floor_ = candidate.reading.on_floor;
    }
    if (weight_ == 0.0) origin_ = solution.point;
    const Eigen::Vector3d offset = solution.point - origin_;
    weight_ += weight;
    offset_ += weight * offset;
    second_moment_ += weight * (solution.covariance + offset * offset.transpose());
  }

  bool empty() const { return weight_ == 0.0; }

  PointEstimate estimate() const {
    const Eigen::Vector3d mean = offset_ / weight_;
    PointEstimate estimate;
    estimate.status = PointStatus::ok;
    estimate.point = origin_ + mean;
    estimate.covariance = second_moment_ / weight_ - mean * mean.transpose();
    estimate.on_floor = on_floor_;
    return estimate;
  }

 private:
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();  // moments are taken about it
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second_moment_ = Eigen::Matrix3d::Zero();
  double weight_ = 0.0, heaviest_ = 0.0;
  bool on_floor_ = false;
};

// What is read where not all cameras agree on the first reading.
class Dispute {
 public:
  Dispute(const Sights& sights, const Candidate& first, const JointOptions& options)
      : sights_(sights), options_(options), first_(first) {}

  PointEstimate settle() const;

 private:
  Candidate read(unsigned cameras, bool on_floor) const;
  // Enters the readings by every choice of so many cameras.
  void enter_all(int cameras, bool on_floor, Mixture& mixture) const;
  PointEstimate with_small_residuals(const Candidate& in_air) const;

  const Sights& sights_;
  const JointOptions& options_;
  const Candidate& first_;
};

Candidate Dispute::read(unsigned cameras, bool on_floor) const {
  Candidate candidate{{cameras, on_floor}, {}};
  candidate.solution = solve(sights_, candidate.reading, options_);
  const bool under_floor = first_.reading.on_floor && !on_floor && !(candidate.solution.point.z() > 0.0);
  if (under_floor && solved(candidate)) candidate.solution.status = PointStatus::contradiction;
  return candidate;
}

void Dispute::enter_all(int cameras, bool on_floor, Mixture& mixture) const {
  constexpr int kEnoughToTell = 2;  // degrees of freedom that tell which camera is wrong
  for (unsigned choice = 0; choice < 1U << sights_.count; ++choice) {
    if (static_cast<int>(std::bitset<kMostCameras>(choice).count()) != cameras) continue;
    const Candidate candidate = read(choice, on_floor);
    if (candidate.solution.dof >= kEnoughToTell) mixture.enter(candidate, options_);
  }
}

PointEstimate Dispute::settle() const {
  const bool has_floor = first_.reading.on_floor;
  const int all = sights_.count;
  const Candidate in_air = has_floor ? read(first_.reading.cameras, false) : Candidate{};
  for (int left_out = 1; left_out < all; ++left_out) {
    Mixture mixture;
    if (has_floor && left_out == 1) mixture.enter(in_air, options_);
    if (has_floor && left_out > 1) enter_all(all - left_out + 1, false, mixture);
    if (all - left_out >= 2) enter_all(all - left_out, has_floor, mixture);
    if (!mixture.empty()) return mixture.estimate();
  }
  return with_small_residuals(in_air);
}

PointEstimate Dispute::with_small_residuals(const Candidate& in_air) const {
  for (const Candidate* candidate : {&first_, &in_air}) {
    const JointSolution& solution = candidate->solution;
    if (!solved(*candidate) || solution.largest_residual > radians(options_.contradiction_deg)) continue;
    return estimate_of(*candidate, std::max(1.0, solution.chi2 / std::max(solution.dof, 1)));
  }
  PointEstimate estimate;
  const bool any = solved(first_) || solved(in_air);
  estimate.status = any ? PointStatus::contradiction : first_.solution.status;
  return estimate;
}

}  // namespace

JointOptions read_joint_options(const YamlMap& map) {
  map.allow({"ball_radius", "floor", "diameter", "floor_sigma", "elevation_bias_deg", "radius_bias_deg",
             "edge_bias_deg", "flagged_factor", "test_sigmas", "air_sigmas", "contradiction_deg"});
  JointOptions options;
  const auto read_flag = [&](const char* key, bool& target) {
    if (map.has(key)) target = map.one_of(key, {"true", "false"}) == "true";
  };
  map.read_number("ball_radius", {0.01, 1.0}, options.ball_radius);
  read_flag("floor", options.floor);
  read_flag("diameter", options.diameter);
  map.read_number("floor_sigma", {1e-5, 1.0}, options.floor_sigma);
  map.read_number("elevation_bias_deg", {0.0, 10.0}, options.elevation_bias_deg);
  map.read_number("radius_bias_deg", {0.0, 10.0}, options.radius_bias_deg);
  map.read_number("edge_bias_deg", {0.0, 10.0}, options.edge_bias_deg);
  map.read_number("flagged_factor", {1.0, 100.0}, options.flagged_factor);
  map.read_number("test_sigmas", {1.0, 100.0}, options.test_sigmas);
  map.read_number("air_sigmas", {1.0, 100.0}, options.air_sigmas);
  map.read_number("contradiction_deg", {0.01, 90.0}, options.contradiction_deg);
  return options;
}

PointEstimate triangulate_joint(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass object,
                                const JointOptions& options) {
  require_joint_rig(rig);
  const Sights sights = sights_of(rig, bearings, object, options);
  if (sights.count < 2) {
    PointEstimate estimate;
    estimate.status = sights.count == 0 ? PointStatus::not_seen : PointStatus::one_camera;
    return estimate;
  }
  const bool has_floor = options.floor && object == ObjectClass::ball;
  Candidate first{{(1U << sights.count) - 1U, has_floor}, {}};
  first.solution = solve(sights, first.reading, options);
  if (passes(first, options)) return estimate_of(first, 1.0);
  return Dispute(sights, first, options).settle();
}

}  // namespace movis::triangulation
