#include "goal_scene.h"
#include "movis/core/error.h"
#include "movis/localization/localizer.h"

namespace movis::localization {
namespace {

TEST(Localizer, UnknownNameNamesTheNearest) {
  for (const char* name : {"", "method", "Method1"}) {
    try {
      find_localizer(name);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("method1"), std::string::npos) << error.what();
    }
  }
}

TEST(Localizer, EveryNameThatIsListedIsFound) {
  const std::vector<std::string_view> names = localizer_names();
  EXPECT_GE(names.size(), 4U);
  for (const std::string_view name : names) EXPECT_NE(find_localizer(name).fix, nullptr) << name;
}

// The paper's methods know goals by their colour alone.
TEST(Localizer, WhiteGoalsAreRefusedByThePapersMethods) {
  Field field = paper_field();
  field.goals = Field::Goals::white;
  for (const char* name : {"method1", "method2", "composed"}) {
    EXPECT_THROW(find_localizer(name).require(field), Error) << name;
  }
}

// Whatever points are handed in, over forty orders of magnitude, no number that is not finite comes out.
TEST(Localizer, NoNanFromAnyLandmarks) {
  RandomStream stream = make_stream(7, 0);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-20.0, 20.0);
  const auto number = [&] { return normal(stream) * std::pow(10.0, exponent(stream)); };
  const omni::Rig rig;
  const FieldMap map(paper_field());
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
      const Fix fix = find_localizer(name).fix({rig, {}, landmarks, {}}, map, {});
      ASSERT_TRUE(is_finite(fix)) << name << " at draw " << draw;
      solved += fix.status == FixStatus::ok ? 1 : 0;
    }
  }
  EXPECT_GT(solved, 1000);  // otherwise every draw was refused at the door
}

}  // namespace
}  // namespace movis::localization
