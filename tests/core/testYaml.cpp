#include <gtest/gtest.h>

#include "movis/core/field.h"
#include "movis/core/yaml.h"
#include "support/temporary_folder.h"

namespace movis {
namespace {

using test::expect_error;
using test::TemporaryFolder;

constexpr const char* kField =
    "half_width: 1.75\nhalf_length: 2.0\ncircle: 0.5\nline: 0.05\nFd: 2.0\nFw: 0.5\n"
    "goal_height: 0.5\ngoal_depth: 0.25\ngoal_thickness: 0.01\n";

TEST(Yaml, ReadsAField) {
  const TemporaryFolder folder;
  const Field field = read_field(folder.write("field.yaml", kField));
  EXPECT_DOUBLE_EQ(field.half_width, 1.75);
  EXPECT_DOUBLE_EQ(field.goal_thickness, 0.01);
  EXPECT_EQ(field.goals, Field::Goals::coloured);
  EXPECT_DOUBLE_EQ(field.penalty_area.depth, 0.0);
}

TEST(Yaml, ReadsTheOptionalPartsOfAField) {
  const TemporaryFolder folder;
  const Field field = read_field(folder.write(
      "field.yaml", std::string(kField) + "goals: white\npenalty_area: {depth: 0.6, width: 2.0}\ncorner_arc: 0.2\n"));
  EXPECT_EQ(field.goals, Field::Goals::white);
  EXPECT_DOUBLE_EQ(field.penalty_area.width, 2.0);
  EXPECT_DOUBLE_EQ(field.corner_arc, 0.2);
}

TEST(Yaml, UnknownKeyNamesFileLineKeyAndSuggestion) {
  const TemporaryFolder folder;
  const auto file = folder.write("field.yaml", std::string(kField) + "goal_hight: 0.5\n");
  expect_error([&] { read_field(file); }, {"field.yaml:10", "goal_hight", "did you mean 'goal_height'"});
}

TEST(Yaml, MissingKey) {
  const TemporaryFolder folder;
  expect_error([&] { read_field(folder.write("field.yaml", "half_width: 1.75\n")); },
               {"field.yaml:1", "half_length", "missing"});
}

TEST(Yaml, ValueOutOfRange) {
  const TemporaryFolder folder;
  std::string text = kField;
  text.replace(text.find("1.75"), 4, "1750");  // millimetres
  expect_error([&] { read_field(folder.write("field.yaml", text)); }, {"field.yaml:1", "half_width", "out of range"});
  text.replace(text.find("1750"), 4, ".nan");
  expect_error([&] { read_field(folder.write("field.yaml", text)); }, {"half_width", "out of range"});
  text.replace(text.find(".nan"), 4, "wide");
  expect_error([&] { read_field(folder.write("field.yaml", text)); }, {"half_width", "must be a number"});
}

TEST(Yaml, KeyThatStandsTwice) {
  const TemporaryFolder folder;
  expect_error([&] { read_field(folder.write("field.yaml", std::string(kField) + "Fd: 3.0\n")); },
               {"field.yaml:10", "Fd", "twice"});
}

TEST(Yaml, KeyWithoutValueAndSecondDocument) {
  const TemporaryFolder folder;
  std::string text = kField;
  expect_error([&] { read_field(folder.write("field.yaml", text + "---\nFd: 3\n")); }, {"2 YAML documents"});
  text.replace(text.find(": 1.75"), 6, ":");
  expect_error([&] { read_field(folder.write("field.yaml", text)); }, {"field.yaml:", "half_width", "no value"});
}

TEST(Yaml, NoYamlAtAll) {
  const TemporaryFolder folder;
  expect_error([&] { read_field(folder.write("field.yaml", "a: [1, 2\n")); }, {"field.yaml", "not valid YAML"});
  expect_error([&] { read_field(folder.write("field.yaml", "")); }, {"field.yaml", "must be a map"});
  expect_error([&] { read_field(folder.path() / "absent.yaml"); }, {"absent.yaml", "cannot be opened"});
  expect_error([&] { read_field(folder.path()); }, {"is a folder"});
}

}  // namespace
}  // namespace movis
