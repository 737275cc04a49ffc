// Consistency of triangulated points: their covariance against derivatives and against what many draws really do.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "movis/triangulation/pairs.h"
#include "movis_rig.h"

namespace movis::triangulation {
namespace {

double& angle(std::vector<Bearing>& bearings, int index) {
  Bearing& bearing = bearings[static_cast<std::size_t>(index) / 2];
  return index % 2 == 0 ? bearing.azimuth : bearing.elevation;
}

TEST(Intersect, AnalyticDerivativeIsTheNumericOne) {
  const Vector2d position1(-0.2, 0.1);
  const Vector2d position2(0.15, -0.05);
  constexpr double kStep = 1e-6;
  int compared = 0;
  for (double azimuth1 = -3.0; azimuth1 < 3.1; azimuth1 += 0.35) {
    for (double azimuth2 = -3.1; azimuth2 < 3.1; azimuth2 += 0.37) {
      const Intersection found = intersect(position1, azimuth1, position2, azimuth2);
      if (found.status != PointStatus::ok || found.range1 > 10.0) continue;
      const auto point = [&](double step1, double step2) {
        return intersect(position1, azimuth1 + step1, position2, azimuth2 + step2).point;
      };
      Eigen::Matrix2d numeric;
      numeric << point(kStep, 0.0) - point(-kStep, 0.0), point(0.0, kStep) - point(0.0, -kStep);
      numeric /= 2.0 * kStep;
      EXPECT_LT((found.point_by_azimuths - numeric).norm(), 1e-6 * (1.0 + numeric.norm()));
      ++compared;
    }
  }
  EXPECT_GT(compared, 20);
}

// By hand: at the tip of the equilateral triangle both rays are r = √3 L long and cross at 60°. Turning ray 1 by ε
// moves the tip along ray 2 by r ε / sin 60° = 2L ε, that is by 2L ε (cos 120°, sin 120°); ray 2 moves it by its mirror
// image. With σ² for both azimuths: var x = 2 (2L)² cos² 60° σ² = 2 L² σ² and var y = 2 (2L)² sin² 60° σ² = 6 L² σ².
TEST(PairsCovariance, EquilateralByHand) {
  const omni::Rig rig = paper_rig();
  auto bearings = exact_bearings(rig, {0.0, 2.0 * kL, kHeight}, 0.01);
  bearings.pop_back();
  const PointEstimate ball = triangulate_pairs(rig, bearings, ObjectClass::ball);
  ASSERT_EQ(ball.status, PointStatus::ok);
  EXPECT_NEAR(ball.covariance(0, 0), 2.0 * kL * kL * 1e-4, 1e-12);
  EXPECT_NEAR(ball.covariance(1, 1), 6.0 * kL * kL * 1e-4, 1e-12);
  EXPECT_NEAR(ball.covariance(0, 1), 0.0, 1e-12);
  // Level with the viewpoints the height is the mean of two r·e, each with the variance r² σ² = 3 L² σ².
  EXPECT_NEAR(ball.covariance(2, 2), 1.5 * kL * kL * 1e-4, 1e-12);
}

// J Σ Jᵀ with J by central differences, for unequal bearings whose azimuth and elevation are correlated.
TEST(PairsCovariance, IsThatOfTheNumericJacobian) {
  const omni::Rig rig = paper_rig();
  constexpr double kStep = 1e-6;
  for (double azimuth_deg = 5.0; azimuth_deg < 360.0; azimuth_deg += 20.0) {
    for (const double range : {0.4, 1.0, 3.0}) {
      const Vector2d at = range * direction(radians(azimuth_deg));
      auto bearings = exact_bearings(rig, {at.x(), at.y(), kBall});
      Eigen::Matrix<double, 6, 6> angles = Eigen::Matrix<double, 6, 6>::Zero();
      for (int k = 0; k < 3; ++k) {
        bearings[k].covariance << 1.0 + 0.1 * k, 0.4, 0.4, 2.0 - 0.3 * k;
        bearings[k].covariance *= 1e-6;
        angles.block<2, 2>(2 * k, 2 * k) = bearings[k].covariance;
      }
      Eigen::Matrix<double, 3, 6> numeric;
      for (int i = 0; i < 6; ++i) {
        auto plus = bearings;
        auto minus = bearings;
        angle(plus, i) += kStep;
        angle(minus, i) -= kStep;
        numeric.col(i) = (triangulate_pairs(rig, plus, ObjectClass::ball).point -
                          triangulate_pairs(rig, minus, ObjectClass::ball).point) /
                         (2.0 * kStep);
      }
      const Eigen::Matrix3d expected = numeric * angles * numeric.transpose();
      const Eigen::Matrix3d covariance = triangulate_pairs(rig, bearings, ObjectClass::ball).covariance;
      EXPECT_LT((covariance - expected).norm(), 1e-4 * expected.norm()) << azimuth_deg << "° " << range << " m";
    }
  }
}

struct Nees {
  double point = 0.0, floor = 0.0;  // normalized by their degrees of freedom, 3 and 2
};

// Draws places in a square ring, half widths in metres, and noise of the stated covariance at each.
Nees mean_nees(double inner, double outer, int draws, std::uint64_t seed) {
  // Small, as the distance is not linear in the parallax: at 5 m the parallax of 0.35 m is 4°, of which 0.02° is half a
  // per cent, and the covariance, which grows with the parallax's fourth power, is then known to 2 %.
  const double azimuth_sigma = radians(0.02);
  const double elevation_sigma = radians(0.05);
  constexpr double kCorrelation = 0.5;
  const omni::Rig rig = paper_rig();
  RandomStream stream = make_stream(seed, 2);
  Nees sum;
  for (int draw = 0; draw < draws;) {
    const Vector3d truth(uniform(stream, -outer, outer), uniform(stream, -outer, outer), kBall);
    if (truth.head<2>().lpNorm<Eigen::Infinity>() < inner) continue;
    auto bearings = exact_bearings(rig, truth);
    for (Bearing& bearing : bearings) {
      const double shared = normal(stream, 1.0);
      const double own = normal(stream, 1.0);
      bearing.azimuth += azimuth_sigma * shared;
      bearing.elevation +=
          elevation_sigma * (kCorrelation * shared + std::sqrt(1.0 - kCorrelation * kCorrelation) * own);
      const double product = kCorrelation * azimuth_sigma * elevation_sigma;
      bearing.covariance << azimuth_sigma * azimuth_sigma, product, product, elevation_sigma * elevation_sigma;
    }
    const PointEstimate ball = triangulate_pairs(rig, bearings, ObjectClass::ball);
    EXPECT_EQ(ball.status, PointStatus::ok);
    const Vector3d error = ball.point - truth;
    const Vector2d floor_error = error.head<2>();
    sum.point += error.dot(ball.covariance.inverse() * error) / 3.0;
    sum.floor += floor_error.dot(ball.covariance.topLeftCorner<2, 2>().inverse() * floor_error) / 2.0;
    ++draw;
  }
  return {sum.point / draws, sum.floor / draws};
}

// The mean of N draws of χ²/dof scatters by √(2/(dof N)): 0.0041 for the point and 0.005 for its floor part, N = 40000.
// Measured: 0.993 and 0.994.
TEST(PairsCovariance, NeesAllOverTheFloor) {
  const Nees nees = mean_nees(0.5, 4.0, 40000, 1);
  EXPECT_GT(nees.point, 0.97);
  EXPECT_LT(nees.point, 1.03);
  EXPECT_GT(nees.floor, 0.97);
  EXPECT_LT(nees.floor, 1.03);
}

// Neither near nor far is made up for by the other. Measured: 0.999 to 1.000 and 0.993 to 1.001.
TEST(PairsCovariance, NeesNearAndFar) {
  for (const auto& [inner, outer] : {std::pair{0.5, 1.0}, {1.0, 2.0}, {2.0, 3.0}, {3.0, 4.0}}) {
    const Nees nees = mean_nees(inner, outer, 20000, 2);
    EXPECT_NEAR(nees.point, 1.0, 0.04) << inner << " to " << outer << " m";
    EXPECT_NEAR(nees.floor, 1.0, 0.04) << inner << " to " << outer << " m";
  }
}

}  // namespace
}  // namespace movis::triangulation
