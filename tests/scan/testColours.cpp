#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/random.h"
#include "movis/scan/classify.h"
#include "movis/scan/colours.h"
#include "support/temporary_folder.h"

namespace movis::scan {
namespace {

using test::expect_error;
using test::TemporaryFolder;

Colours colours_of(const std::string& text) {
  const TemporaryFolder folder;
  return read_colours(folder.write("colours.yaml", text));
}

std::string ball_with(const std::string& hue, const std::string& chroma = "[0.2, 1.0]",
                      const std::string& brightness = "[0.2, 1.0]") {
  return "ball: {hue_deg: " + hue + ", chroma: " + chroma + ", brightness: " + brightness + "}\n";
}

int random_byte(RandomStream& stream, int max = 255) {
  return std::uniform_int_distribution<int>(0, max)(stream);
}

bool is_in(const IntegerClass& colour, int r, int g, int b) {
  return belongs(colour, static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(b));
}

bool is_ball(const Colours& colours, int r, int g, int b) {
  return is_in(to_integers(colours.classes.at(0)), r, g, b);
}

TEST(ColoursFile, ReadsWhatStandsInIt) {
  const Colours colours = colours_of("blue_goal: {hue_deg: [205, 250], chroma: [0.3, 0.9], brightness: [0.1, 0.8]}\n" +
                                     ball_with("[5, 38]"));
  ASSERT_EQ(colours.classes.size(), 2U);
  EXPECT_EQ(colours.classes[0].object, ObjectClass::ball);  // in the order of the classes, not of the file
  const ColourClass& blue = colours.classes[1];
  EXPECT_EQ(blue.object, ObjectClass::blue_goal);
  EXPECT_NEAR(blue.hue_from, radians(205.0), 1e-12);
  EXPECT_NEAR(blue.hue_width, radians(45.0), 1e-12);
  EXPECT_DOUBLE_EQ(blue.chroma_min, 0.3);
  EXPECT_DOUBLE_EQ(blue.chroma_max, 0.9);
  EXPECT_DOUBLE_EQ(blue.brightness_min, 0.1);
  EXPECT_DOUBLE_EQ(blue.brightness_max, 0.8);
}

TEST(ColoursFile, TypicalColoursOfCarpetAndLines) {
  const std::string bounds = "hue_deg: [0, 360], chroma: [0.1, 1.0], brightness: [0.1, 1.0]";
  const std::string white = "hue_deg: [0, 360], chroma: [0.0, 0.1], brightness: [0.7, 1.0]";
  EXPECT_FALSE(colours_of(ball_with("[5, 38]")).typical.field);
  EXPECT_FALSE(colours_of(ball_with("[5, 38]") + "field: {" + bounds + "}\n").typical.field);
  const Colours colours = colours_of(ball_with("[5, 38]") + "field: {" + bounds + ", typical: [50, 128, 70]}\nline: {" +
                                     white + ", typical: [228, 228, 225.5]}\n");
  ASSERT_TRUE(colours.typical.field && colours.typical.line);
  EXPECT_EQ(*colours.typical.field, Eigen::Vector3d(50, 128, 70));
  EXPECT_EQ(*colours.typical.line, Eigen::Vector3d(228, 228, 225.5));
  expect_error([&] { colours_of("ball: {" + bounds + ", typical: [1, 2, 3]}\n"); }, {"colours.yaml:1", "'typical'"});
  expect_error([&] { colours_of("field: {" + bounds + ", typical: [1, 2]}\n"); }, {"colours.yaml:1", "field.typical"});
  expect_error([&] { colours_of("field: {" + bounds + ", typical: [0, 2, 3]}\n"); },
               {"colours.yaml:1", "field.typical", "range"});
}

// By hand, of [50, 128, 70]: α = 50 − 99 = −49, β = √3/2 · 58 = 50.2, so a hue of 134.3°; brightness 128/255 = 0.502,
// chroma 78/255 = 0.306. With red and green swapped, [128, 50, 70]: α = 68, β = −17.3, 345.7°.
TEST(ColoursFile, TypicalColourIsOfItsClass) {
  const auto field = [](const std::string& rgb, const std::string& hue = "[90, 170]",
                        const std::string& chroma = "[0.1, 0.5]", const std::string& brightness = "[0.1, 0.9]") {
    return colours_of(ball_with("[5, 38]") + "\nfield: {hue_deg: " + hue + ", chroma: " + chroma +
                      ", brightness: " + brightness + ", typical: " + rgb + "}\n");
  };
  const auto refused = [](auto statement, const char* what) {
    expect_error(statement, {"colours.yaml:3", "field.typical", "its own class", what});
  };
  for (const char* hue : {"[90, 170]", "[134, 135]", "[-230, -220]", "[0, 360]"}) {
    EXPECT_TRUE(field("[50, 128, 70]", hue).typical.field) << hue;
  }
  EXPECT_TRUE(field("[128, 50, 70]", "[340, 10]").typical.field);
  EXPECT_TRUE(field("[128, 70, 50]", "[340, 20]").typical.field);  // 14.3°: beyond 0
  refused([&] { field("[128, 50, 70]"); }, "hue 345.7°, outside [90, 170]");
  refused([&] { field("[128, 50, 70]", "[10, 30]"); }, "hue 345.7°");
  refused([&] { field("[50, 128, 70]", "[340, 10]"); }, "hue 134.3°, outside [340, 10]");
  refused([&] { field("[255, 255, 255]"); }, "brightness 1.000, outside [0.1, 0.9]");
  refused([&] { field("[20, 25, 22]"); }, "brightness 0.098");
  refused([&] { field("[200, 200, 200]"); }, "chroma 0.000, outside [0.1, 0.5]");
  refused([&] { field("[50, 200, 70]"); }, "chroma 0.588");
}

TEST(ColoursFile, EveryHueAndWrappedHues) {
  EXPECT_NEAR(colours_of(ball_with("[0, 360]")).classes[0].hue_width, 2.0 * kPi, 1e-12);
  for (const char* hue : {"[350, 20]", "[-10, 20]", "[350, -340]"}) {
    const ColourClass ball = colours_of(ball_with(hue)).classes[0];
    EXPECT_NEAR(ball.hue_from, radians(350.0), 1e-12) << hue;
    EXPECT_NEAR(ball.hue_width, radians(30.0), 1e-12) << hue;
  }
}

TEST(ColoursFile, UnknownNamesAreErrors) {
  expect_error([] { colours_of("bal: {hue_deg: [5, 38], chroma: [0.2, 1], brightness: [0.2, 1]}\n"); },
               {"colours.yaml:1", "'bal'", "did you mean 'ball'"});
  expect_error([] { colours_of("ball: {hue: [5, 38], chroma: [0.2, 1], brightness: [0.2, 1]}\n"); },
               {"colours.yaml:1", "'hue'", "hue_deg"});
  expect_error([] { colours_of(ball_with("[5, 38]") + ball_with("[5, 38]")); }, {"colours.yaml:2", "'ball'", "twice"});
}

TEST(ColoursFile, MissingBoundsAreErrors) {
  expect_error([] { colours_of("ball: {chroma: [0.2, 1], brightness: [0.2, 1]}\n"); }, {"ball.hue_deg", "missing"});
  expect_error([] { colours_of("ball: {hue_deg: [5, 38], brightness: [0.2, 1]}\n"); }, {"ball.chroma", "missing"});
  expect_error([] { colours_of("ball: {hue_deg: [5, 38], chroma: [0.2, 1]}\n"); }, {"ball.brightness", "missing"});
  expect_error([] { colours_of("ball:\n"); }, {"ball"});
}

TEST(ColoursFile, HueMustSpanLessThanHalfACircle) {
  for (const char* hue : {"[0, 180]", "[0, 270]", "[38, 5]", "[20, 20]", "[180, 0]", "[360, 0]", "[-360, 360]"}) {
    expect_error([&] { colours_of(ball_with(hue)); }, {"colours.yaml:1", "ball.hue_deg", "180°"});
  }
  EXPECT_NO_THROW(colours_of(ball_with("[0, 179.9]")));
}

// No byte may lie between the bounds, no hue be told from its neighbours.
TEST(ColoursFile, SectorsAndBoundsTooNarrowForBytesAreErrors) {
  expect_error([] { colours_of(ball_with("[20, 20.5]")); }, {"colours.yaml:1", "ball.hue_deg", "1°"});
  expect_error([] { colours_of(ball_with("[5, 38]", "[0.2, 0.201]")); }, {"colours.yaml:1", "ball.chroma", "1/255"});
}

TEST(ColoursFile, BoundsMustBeOrderedFractions) {
  expect_error([] { colours_of(ball_with("[5, 38]", "[0.9, 0.2]")); }, {"colours.yaml:1", "ball.chroma", "smaller"});
  expect_error([] { colours_of(ball_with("[5, 38]", "[0.2, 0.2]")); }, {"ball.chroma", "smaller"});
  expect_error([] { colours_of(ball_with("[5, 38]", "[0, 1]", "[1, 0]")); }, {"ball.brightness", "smaller"});
  expect_error([] { colours_of(ball_with("[5, 38]", "[-0.1, 1]")); }, {"ball.chroma", "range"});
  expect_error([] { colours_of(ball_with("[5, 38]", "[0, 255]")); }, {"ball.chroma", "range"});
  expect_error([] { colours_of(ball_with("[5, 38]", "[0, 1]", "[0, 1.01]")); }, {"ball.brightness", "range"});
  expect_error([] { colours_of(ball_with("[5, 400]")); }, {"ball.hue_deg", "range"});
  expect_error([] { colours_of(ball_with("[5]")); }, {"ball.hue_deg", "2 numbers"});
  expect_error([] { colours_of(ball_with("[5, 38]", "[0.2, .nan]")); }, {"ball.chroma", "range"});
  expect_error([] { colours_of(ball_with("[orange, 38]")); }, {"ball.hue_deg", "number"});
}

TEST(ColoursFile, EmptyIsAnError) {
  expect_error([] { colours_of(""); }, {"colours.yaml"});
  expect_error([] { colours_of("{}\n"); }, {"colours.yaml", "class"});
  expect_error([] { read_colours("/nowhere/colours.yaml"); }, {"/nowhere/colours.yaml"});
}

// Such a file reads well and the robot sees nothing.
TEST(ColoursFile, NothingToDetectIsAnError) {
  expect_error([] { colours_of("field: {hue_deg: [90, 170], chroma: [0.1, 1.0], brightness: [0.1, 1.0]}\n"); },
               {"colours.yaml", "ball", "yellow_goal", "blue_goal"});
}

// Hue by hand: of a pure colour with α = R − (G + B)/2 and β = √3/2 (G − B), (255, 0, 0) lies at (255, 0): 0°;
// (255, 255, 0) at 255 (1/2, √3/2): 60°; (0, 255, 0) at 255 (−1/2, √3/2): 120°; blue is green's mirror image: 240°.
TEST(Hue, PureColours) {
  struct Pure {
    double hue_deg;
    int r, g, b;
  };
  const Pure pure_colours[] = {{0.0, 255, 0, 0},     {60.0, 255, 255, 0}, {120.0, 0, 255, 0},
                               {180.0, 0, 255, 255}, {240.0, 0, 0, 255},  {300.0, 255, 0, 255}};
  for (const Pure& centre : pure_colours) {
    const Colours colours = colours_of(
        ball_with("[" + std::to_string(centre.hue_deg - 10.0) + ", " + std::to_string(centre.hue_deg + 10.0) + "]"));
    for (const Pure& pure : pure_colours) {
      EXPECT_EQ(is_ball(colours, pure.r, pure.g, pure.b), pure.hue_deg == centre.hue_deg)
          << centre.hue_deg << "° against " << pure.hue_deg << "°";
    }
  }
}

// 30° is orange: (255, g, 0) has α = 255 − g/2 and β = √3/2 g, and tan 30° = 1/√3 makes 3/2 g = 255 − g/2, g = 127.5.
TEST(Hue, BorderAtOrange) {
  const Colours redder = colours_of(ball_with("[0, 30]"));
  const Colours yellower = colours_of(ball_with("[30, 60]"));
  EXPECT_TRUE(is_ball(redder, 255, 124, 0));
  EXPECT_FALSE(is_ball(yellower, 255, 124, 0));
  EXPECT_FALSE(is_ball(redder, 255, 131, 0));
  EXPECT_TRUE(is_ball(yellower, 255, 131, 0));
}

// The sector 350° to 20° holds 352°, (255, 0, 34) by hand: β/α = −√3/2·34/(255 − 17) = tan −7.1°; it does not hold
// 330°, (255, 0, 127.5), nor 30°, nor cyan on the other side.
TEST(Hue, SectorAcrossRed) {
  const Colours colours = colours_of(ball_with("[350, 20]"));
  EXPECT_TRUE(is_ball(colours, 255, 0, 0));
  EXPECT_TRUE(is_ball(colours, 255, 0, 34));
  EXPECT_TRUE(is_ball(colours, 255, 50, 0));
  EXPECT_FALSE(is_ball(colours, 255, 0, 127));
  EXPECT_FALSE(is_ball(colours, 255, 128, 0));
  EXPECT_FALSE(is_ball(colours, 0, 255, 255));
}

// Against the definition in double precision: of random classes and colours, those whose hue lies farther than half a
// degree from the sector's borders are decided alike.
TEST(Hue, KeepsBordersToHalfADegree) {
  constexpr double kTolerance = 0.5;  // degrees
  RandomStream stream = make_stream(4, 1);
  int inside = 0;
  int near = 0;
  for (int round = 0; round < 2000; ++round) {
    const double from_deg = std::uniform_real_distribution<double>(0.0, 360.0)(stream);
    const double width_deg = std::uniform_real_distribution<double>(2.0, 178.0)(stream);
    const IntegerClass colour =
        to_integers({ObjectClass::ball, radians(from_deg), radians(width_deg), 0.0, 1.0, 0.0, 1.0});
    for (int i = 0; i < 500; ++i) {
      const int r = random_byte(stream);
      const int g = random_byte(stream);
      const int b = random_byte(stream);
      if (r == g && g == b) continue;  // no hue
      const double hue_deg = degrees(std::atan2(std::sqrt(3.0) / 2.0 * (g - b), r - 0.5 * (g + b)));
      const double beyond_from = degrees(wrap_angle(radians(hue_deg - from_deg)));
      const double beyond_to = degrees(wrap_angle(radians(hue_deg - from_deg - width_deg)));
      if (std::min(std::abs(beyond_from), std::abs(beyond_to)) < kTolerance) {
        ++near;
        continue;
      }
      const bool expected = std::fmod(hue_deg - from_deg + 720.0, 360.0) < width_deg;
      inside += expected ? 1 : 0;
      ASSERT_EQ(is_in(colour, r, g, b), expected)
          << r << " " << g << " " << b << ": " << hue_deg << "° of " << from_deg << "° + " << width_deg << "°";
    }
  }
  EXPECT_GT(inside, 100000);
  EXPECT_LT(near, 20000);
}

// Fractions of 255 that are whole: 0.2 is 51 and 0.8 is 204, both within the bounds.
TEST(Bounds, IncludeTheirEnds) {
  const Colours colours = colours_of(ball_with("[0, 360]", "[0.2, 0.8]", "[0.4, 0.8]"));
  EXPECT_TRUE(is_ball(colours, 151, 100, 100));   // chroma 51
  EXPECT_FALSE(is_ball(colours, 150, 100, 100));  // chroma 50
  EXPECT_TRUE(is_ball(colours, 204, 0, 0));       // chroma and brightness 204
  EXPECT_FALSE(is_ball(colours, 205, 1, 0));      // brightness 205
  EXPECT_TRUE(is_ball(colours, 102, 0, 0));       // brightness 102
  EXPECT_FALSE(is_ball(colours, 101, 0, 0));      // brightness 101
}

// Chroma and brightness as they are defined, with bounds that no byte hits exactly.
TEST(Bounds, AreThoseOfTheDefinition) {
  RandomStream stream = make_stream(5, 1);
  for (int round = 0; round < 200; ++round) {
    const auto bound = [&] { return (random_byte(stream, 127) + 0.5) / 255.0; };
    const ColourClass definition{ObjectClass::ball, 0.0, 2.0 * kPi, bound(), bound() + 0.49, bound(), bound() + 0.49};
    const IntegerClass colour = to_integers(definition);
    for (int i = 0; i < 200; ++i) {
      const int r = random_byte(stream);
      const int g = random_byte(stream);
      const int b = random_byte(stream);
      const double brightness = std::max({r, g, b}) / 255.0;
      const double chroma = brightness - std::min({r, g, b}) / 255.0;
      const bool expected = chroma >= definition.chroma_min && chroma <= definition.chroma_max &&
                            brightness >= definition.brightness_min && brightness <= definition.brightness_max;
      ASSERT_EQ(is_in(colour, r, g, b), expected) << r << " " << g << " " << b;
    }
  }
}

}  // namespace
}  // namespace movis::scan
