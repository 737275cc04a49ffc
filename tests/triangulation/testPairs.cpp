#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "movis/triangulation/pairs.h"
#include "movis_rig.h"
#include "support/temporary_folder.h"

namespace movis::triangulation {
namespace {

constexpr double kPaperBaseline = 1.7320508075688772 * kL;  // √3 L, the side of the triangle

PointEstimate triangulate_ball(const omni::Rig& rig, const std::vector<Bearing>& bearings) {
  return triangulate_pairs(rig, bearings, ObjectClass::ball);
}

std::vector<Bearing> ball_at_azimuths(std::initializer_list<double> azimuths_deg) {
  std::vector<Bearing> bearings;
  for (const double azimuth_deg : azimuths_deg) {
    Bearing bearing;
    bearing.camera = static_cast<int>(bearings.size());
    bearing.azimuth = radians(azimuth_deg);
    bearing.covariance = 1e-6 * Eigen::Matrix2d::Identity();
    bearings.push_back(bearing);
  }
  return bearings;
}

// λ1 = 60° and λ2 = 120° close an equilateral triangle over the baseline √3 L, of height 3/2 L: the ball lies at
// (0, L/2 + 3/2 L) = (0, 2L), at the distance √3 L from both cameras; 14 cm below them it is 11 cm above the floor.
TEST(Pairs, EquilateralByHand) {
  auto bearings = ball_at_azimuths({60.0, 120.0});
  for (Bearing& bearing : bearings) bearing.elevation = std::atan(-0.14 / kPaperBaseline);
  const PointEstimate ball = triangulate_ball(paper_rig(), bearings);
  ASSERT_EQ(ball.status, PointStatus::ok);
  EXPECT_NEAR(ball.point.x(), 0.0, 1e-12);
  EXPECT_NEAR(ball.point.y(), 2.0 * kL, 1e-12);
  EXPECT_NEAR(ball.point.z(), 0.11, 1e-12);
}

// λ2 = 90°, where tan λ2 of (3)–(4) is infinite: straight ahead of M2 at x = √3/2 L; λ1 = 45° then gives the height of
// the right-angled triangle as its base, √3 L.
TEST(Pairs, RightAngleByHand) {
  const PointEstimate ball = triangulate_ball(paper_rig(), ball_at_azimuths({45.0, 90.0}));
  ASSERT_EQ(ball.status, PointStatus::ok);
  EXPECT_NEAR(ball.point.x(), 0.5 * kPaperBaseline, 1e-12);
  EXPECT_NEAR(ball.point.y(), 0.5 * kL + kPaperBaseline, 1e-12);
}

// Both cameras stand r = √3 L from the ball. tan e1 = 0 says z1 = h with ∂z1/∂e1 = r; tan e2 = 1 says z2 = h + r with
// ∂z2/∂e2 = 2r. Equal variances of the elevations weight z1 : z2 as 4 : 1; four times the variance for e1 evens them.
TEST(Pairs, HeightsAreWeightedByTheirVariances) {
  auto bearings = ball_at_azimuths({60.0, 120.0});
  bearings[1].elevation = radians(45.0);
  EXPECT_NEAR(triangulate_ball(paper_rig(), bearings).point.z(), kHeight + kPaperBaseline / 5.0, 1e-12);
  bearings[0].covariance(1, 1) *= 4.0;
  EXPECT_NEAR(triangulate_ball(paper_rig(), bearings).point.z(), kHeight + kPaperBaseline / 2.0, 1e-12);
}

// (3)–(4) as printed, in the frame in which the area's two cameras stand as M1 and M2 do: turned by −120° for area B
// (M2, M3) and by −240° for C (M3, M1). θ is a camera's own azimuth, zero towards the centroid.
TEST(Pairs, AgreesWithTheTangentsOfThePaper) {
  const omni::Rig rig = paper_rig();
  int compared = 0;
  for (int area = 0; area < 3; ++area) {
    const Eigen::Rotation2Dd robot_from_area(radians(-120.0 * area));
    const omni::Camera& first = rig.cameras[area];
    const omni::Camera& second = rig.cameras[(area + 1) % 3];
    for (double azimuth_deg = 32.0; azimuth_deg < 149.0; azimuth_deg += 4.0) {
      for (double range = 0.3; range < 6.0; range *= 1.3) {
        const Vector2d point = robot_from_area * (range * direction(radians(azimuth_deg)));
        const double theta1 = azimuth_of(point - first.position.head<2>()) - first.yaw;
        const double theta2 = azimuth_of(point - second.position.head<2>()) - second.yaw;
        const double tan1 = std::tan(theta1 - kPi / 6.0);
        const double tan2 = std::tan(theta2 - 5.0 * kPi / 6.0);
        if (std::abs(tan1) > 50.0 || std::abs(tan2) > 50.0 || std::abs(tan2 - tan1) < 1e-2) continue;
        const double sqrt3 = std::sqrt(3.0);
        const Vector2d by_paper(sqrt3 / 2.0 * kL * (tan2 + tan1) / (tan2 - tan1),
                                kL / 2.0 + sqrt3 * kL * (tan2 * tan1) / (tan2 - tan1));
        const PointEstimate ball = triangulate_ball(rig, exact_bearings(rig, {point.x(), point.y(), kBall}));
        ASSERT_EQ(ball.status, PointStatus::ok);
        EXPECT_LT((ball.point.head<2>() - robot_from_area * by_paper).norm(), 1e-9) << area << " " << azimuth_deg;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 900);
}

// M1 and M2 own the directions within 30° of their baseline's normals, 90° and 270° about the centroid: there a wrong
// bearing of M3 changes nothing. The other pairs' sectors are these turned by 120° at a time.
TEST(Pairs, SectorsBelongToTheirCameras) {
  const omni::Rig rig = paper_rig();
  for (int area = 0; area < 3; ++area) {
    const int stranger = (area + 2) % 3;
    std::string influenced_deg;  // azimuths, turned into area A
    for (double azimuth_deg = 66.0; azimuth_deg < 115.0; azimuth_deg += 4.0) {
      for (const double range : {0.5, 2.0, 5.0}) {
        const Vector2d at = range * direction(radians(azimuth_deg - 120.0 * area));
        const Vector3d point(at.x(), at.y(), kBall);
        auto bearings = exact_bearings(rig, point);
        bearings[stranger].azimuth += radians(0.2);
        const PointEstimate ball = triangulate_ball(rig, bearings);
        ASSERT_EQ(ball.status, PointStatus::ok);
        if ((ball.point - point).norm() > 1e-9) influenced_deg += " " + std::to_string(std::lround(azimuth_deg));
      }
    }
    EXPECT_EQ(influenced_deg, "") << "area "
                                  << "ABC"[area];
  }
}

// Onto the pixels of tilted, turned and shifted cameras of unequal heights and back, over 8 m × 8 m.
TEST(Pairs, RoundTripThroughTheCameras) {
  omni::Rig rig = paper_rig();
  rig.cameras[0].position += Vector3d(0.01, -0.005, 0.02);
  rig.cameras[0].tilt_x = radians(2.0);
  rig.cameras[1].tilt_y = radians(-3.0);
  rig.cameras[2].yaw += radians(5.0);
  int measured = 0;
  for (double x = -4.0; x <= 4.0; x += 0.5) {
    for (double y = -4.0; y <= 4.0; y += 0.5) {
      const Vector3d point(x, y, kBall);
      std::vector<Bearing> bearings;
      for (int k = 0; k < 3; ++k) {
        const auto pixel = project(rig.cameras[k], point);
        if (!pixel) continue;
        const auto ray = unproject(rig.cameras[k], *pixel);
        ASSERT_TRUE(ray);
        Bearing bearing;
        bearing.camera = k;
        bearing.azimuth = std::atan2(ray->y(), ray->x());
        bearing.elevation = std::asin(ray->z());
        bearing.covariance = 1e-6 * Eigen::Matrix2d::Identity();
        bearings.push_back(bearing);
      }
      if (bearings.size() < 2) continue;
      const PointEstimate ball = triangulate_ball(rig, bearings);
      ASSERT_EQ(ball.status, PointStatus::ok) << x << " " << y;
      EXPECT_LT((ball.point - point).norm(), 1e-8) << x << " " << y;
      ++measured;
    }
  }
  EXPECT_GE(measured, 288);  // all 289 but the one under the robot
}

TEST(Pairs, NotSeen) {
  EXPECT_EQ(triangulate_ball(paper_rig(), {}).status, PointStatus::not_seen);
  auto goal = ball_at_azimuths({60.0, 120.0});
  for (Bearing& bearing : goal) bearing.object = ObjectClass::yellow_goal;
  EXPECT_EQ(triangulate_ball(paper_rig(), goal).status, PointStatus::not_seen);
}

TEST(Pairs, OneCamera) {
  auto bearings = ball_at_azimuths({60.0});
  EXPECT_EQ(triangulate_ball(paper_rig(), bearings).status, PointStatus::one_camera);
  bearings.push_back(bearings[0]);  // twice by the same camera
  bearings[1].azimuth = radians(70.0);
  EXPECT_EQ(triangulate_ball(paper_rig(), bearings).status, PointStatus::one_camera);
}

TEST(Pairs, ParallelRays) {
  const omni::Rig rig = paper_rig();
  EXPECT_EQ(triangulate_ball(rig, ball_at_azimuths({90.0, 90.0})).status, PointStatus::parallel_rays);
  EXPECT_EQ(triangulate_ball(rig, ball_at_azimuths({90.0, -90.0})).status, PointStatus::parallel_rays);  // antiparallel
  EXPECT_EQ(triangulate_ball(rig, ball_at_azimuths({40.0, 40.0, 40.0})).status, PointStatus::parallel_rays);
  // The limit, by default 0.2°: of the parallax, not of the azimuths' numbers, which wrap here.
  EXPECT_EQ(triangulate_ball(rig, ball_at_azimuths({90.0, 90.19})).status, PointStatus::parallel_rays);
  EXPECT_EQ(triangulate_ball(rig, ball_at_azimuths({90.0, 450.21})).status, PointStatus::ok);
  PairsOptions options;
  options.min_parallax_deg = 5.0;
  EXPECT_EQ(triangulate_pairs(rig, ball_at_azimuths({90.0, 94.9}), ObjectClass::ball, options).status,
            PointStatus::parallel_rays);
  EXPECT_EQ(triangulate_pairs(rig, ball_at_azimuths({90.0, 95.1}), ObjectClass::ball, options).status, PointStatus::ok);
}

// The rays part in front of M1 (at the left) and M2; or they meet before one camera and behind the other.
TEST(Pairs, BehindCamera) {
  EXPECT_EQ(triangulate_ball(paper_rig(), ball_at_azimuths({100.0, 80.0})).status, PointStatus::behind_camera);
  EXPECT_EQ(triangulate_ball(paper_rig(), ball_at_azimuths({60.0, -60.0})).status, PointStatus::behind_camera);
}

TEST(Pairs, RigOfOneCameraThrows) {
  omni::Rig one_camera = paper_rig();
  one_camera.cameras.resize(1);
  test::expect_error([&] { triangulate_ball(one_camera, {}); }, {"two or more cameras", "1"});
}

TEST(Pairs, BearingOfAnUnknownCameraThrows) {
  auto bearings = ball_at_azimuths({60.0, 120.0});
  bearings[1].camera = 3;
  EXPECT_ANY_THROW(triangulate_ball(paper_rig(), bearings));
  bearings[1].camera = -1;
  EXPECT_ANY_THROW(triangulate_ball(paper_rig(), bearings));
  bearings.erase(bearings.begin());
  EXPECT_ANY_THROW(triangulate_ball(paper_rig(), bearings)) << "a lone bearing";
}

// A rig of two is one pair, before and behind its baseline; on the baseline it has no answer.
TEST(Pairs, RigOfTwoCameras) {
  const omni::Rig rig = regular_rig(2);  // at (±L, 0)
  for (const double y : {-2.0, -0.3, 0.3, 2.0}) {
    const Vector3d point(0.7, y, kBall);
    const PointEstimate ball = triangulate_ball(rig, exact_bearings(rig, point));
    ASSERT_EQ(ball.status, PointStatus::ok);
    EXPECT_LT((ball.point - point).norm(), 1e-10);
  }
  EXPECT_EQ(triangulate_ball(rig, exact_bearings(rig, {2.0, 0.0, kBall})).status, PointStatus::parallel_rays);
  EXPECT_EQ(triangulate_ball(rig, exact_bearings(rig, {0.0, 0.0, kBall})).status, PointStatus::parallel_rays);
}

// Four and five cameras leave no direction in which every baseline points at the object.
TEST(Pairs, RigsOfFourAndFiveCameras) {
  for (const int cameras : {4, 5}) {
    const omni::Rig rig = regular_rig(cameras);
    for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 7.5) {
      const Vector2d at = 3.0 * direction(radians(azimuth_deg));
      const Vector3d point(at.x(), at.y(), kBall);
      const PointEstimate ball = triangulate_ball(rig, exact_bearings(rig, point));
      ASSERT_EQ(ball.status, PointStatus::ok) << cameras << " " << azimuth_deg;
      EXPECT_LT((ball.point - point).norm(), 1e-9);
    }
  }
}

// The bearings of M1 and M2 are clean and M3's is not: they serve beyond their own sector, which ends at 60° and 120°,
// where M3 would take part.
TEST(Pairs, FlaggedBearingsLose) {
  const omni::Rig rig = paper_rig();
  for (const double azimuth_deg : {28.5, 40.0, 90.0, 140.0, 151.5}) {
    const Vector2d at = 5.0 * direction(radians(azimuth_deg));
    const Vector3d point(at.x(), at.y(), kBall);
    auto bearings = exact_bearings(rig, point);
    bearings[2].azimuth += radians(0.3);
    if (azimuth_deg < 60.0 || azimuth_deg > 120.0) {  // without the flag M3's error counts
      EXPECT_GT((triangulate_ball(rig, bearings).point - point).norm(), 0.1);
    }
    bearings[2].flags = kCutByBody;
    EXPECT_LT((triangulate_ball(rig, bearings).point - point).norm(), 1e-9) << azimuth_deg;
  }
}

// Straight ahead M1 and M2 are the best pair, but not with a bearing ten times worse than M3's.
TEST(Pairs, UncertainBearingsLose) {
  const omni::Rig rig = paper_rig();
  const Vector3d point(0.0, 2.0, kBall);
  for (const int uncertain : {0, 1}) {
    auto bearings = exact_bearings(rig, point);
    bearings[uncertain].azimuth += radians(0.3);
    bearings[uncertain].covariance *= 100.0;
    EXPECT_LT((triangulate_ball(rig, bearings).point - point).norm(), 1e-9) << uncertain;
  }
}

// A camera that sees the ball elsewhere spoils its own pairs only.
TEST(Pairs, PairThatDoesNotMeetGivesWayToOneThatDoes) {
  const omni::Rig rig = paper_rig();
  const Vector3d point(0.0, 2.0, kBall);
  auto bearings = exact_bearings(rig, point);
  bearings[1].azimuth = radians(60.0);  // M2 looks away from M1's ray: behind both
  const PointEstimate ball = triangulate_ball(rig, {bearings[1], bearings[0], bearings[2]});  // the good pair last
  ASSERT_EQ(ball.status, PointStatus::ok);
  EXPECT_LT((ball.point - point).norm(), 1e-9);
}

// Whatever the bearings are, the answer is finite or not ok.
TEST(Pairs, NeverNaN) {
  const omni::Rig rig = paper_rig();
  RandomStream stream = make_stream(1, 1);
  for (int i = 0; i < 20000; ++i) {
    auto bearings = ball_at_azimuths({0.0, 0.0, 0.0});
    for (Bearing& bearing : bearings) {
      bearing.azimuth = radians(15.0 * std::round(uniform(stream, -12.0, 12.0)));  // often exactly degenerate
      bearing.elevation = uniform(stream, -1.5, 1.5);
      if (i % 3 == 0) bearing.covariance.setZero();
    }
    const PointEstimate ball = triangulate_ball(rig, bearings);
    if (ball.status != PointStatus::ok) continue;
    ASSERT_TRUE(ball.point.allFinite() && ball.covariance.allFinite()) << i;
  }
}

TEST(PairsOptions, AreReadStrictly) {
  const test::TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    return read_pairs_options(YamlMap::read(folder.write("options.yaml", text)));
  };
  EXPECT_DOUBLE_EQ(read("min_parallax_deg: 1.5\n").min_parallax_deg, 1.5);
  EXPECT_DOUBLE_EQ(read("{}\n").min_parallax_deg, PairsOptions{}.min_parallax_deg);
  test::expect_error([&] { read("min_parallax: 1.5\n"); }, {"options.yaml:1", "min_parallax", "min_parallax_deg"});
  test::expect_error([&] { read("min_parallax_deg: 0\n"); }, {"options.yaml:1", "min_parallax_deg", "range"});
  test::expect_error([&] { read("min_parallax_deg: narrow\n"); }, {"options.yaml:1", "min_parallax_deg", "number"});
}

}  // namespace
}  // namespace movis::triangulation
