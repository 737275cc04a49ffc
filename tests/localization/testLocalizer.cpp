#include "goal_scene.h"
#include "movis/localization/composed.h"
#include "movis/localization/localizer.h"
#include "movis/localization/method1.h"
#include "movis/localization/method2.h"

namespace movis::localization {
namespace {

TEST(Localizer, IsFoundByItsName) {
  EXPECT_EQ(find_localizer("method1"), &method1);
  EXPECT_EQ(find_localizer("method2"), &method2);
  EXPECT_EQ(find_localizer("composed"), &composed);
}

TEST(Localizer, UnknownNameFindsNone) {
  EXPECT_EQ(find_localizer(""), nullptr);
  EXPECT_EQ(find_localizer("method"), nullptr);
  EXPECT_EQ(find_localizer("Method1"), nullptr);
}

TEST(Localizer, EveryNameThatIsListedIsFound) {
  const std::vector<std::string_view> names = localizer_names();
  EXPECT_GE(names.size(), 3U);
  for (const std::string_view name : names) EXPECT_NE(find_localizer(name), nullptr) << name;
}

// Whatever points are handed in, over forty orders of magnitude, no number that is not finite comes out.
TEST(Localizer, NoNanFromAnyLandmarks) {
  RandomStream stream = make_stream(7, 0);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-20.0, 20.0);
  const auto number = [&] { return normal(stream) * std::pow(10.0, exponent(stream)); };
  int solved = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    GoalLandmarks landmarks = landmarks_from({0.5, 0.3, 0.4});
    for (GoalPoints* goal : goals(landmarks)) {
      Eigen::Matrix<double, 6, 1> points;
      for (double& value : points) value = draw % 2 == 0 ? number() : 2.0 * normal(stream);
      set_stacked(*goal, points);
    }
    landmarks = with_covariance(landmarks, std::abs(number()));
    for (const std::string_view name : localizer_names()) {
      const Fix fix = find_localizer(name)(landmarks, paper_field());
      ASSERT_TRUE(is_finite(fix)) << name << " at draw " << draw;
      solved += fix.status == FixStatus::ok ? 1 : 0;
    }
  }
  EXPECT_GT(solved, 1000);  // otherwise every draw was refused at the door
}

}  // namespace
}  // namespace movis::localization
