#include "movis/core/paths.h"
#include "movis/servo/position_based.h"
#include "support/temporary_folder.h"

namespace movis::servo {
namespace {

using test::expect_error;
using test::TemporaryFolder;

constexpr const char* kOptions =
    "gain: {at_zero: 4.0, at_infinity: 1.5, slope: 8.0}\ngap: -0.02\nclearance: 0.12\nlead_deg: 45\n";

std::string with(const char* what, const char* by) {
  std::string text = kOptions;
  text.replace(text.find(what), std::string(what).size(), by);
  return text;
}

TEST(PbvsOptions, ReadsEveryValue) {
  const TemporaryFolder folder;
  const PbvsOptions options = read_pbvs_options(folder.write("pbvs.yaml", kOptions));
  EXPECT_DOUBLE_EQ(options.gain_at_zero, 4.0);
  EXPECT_DOUBLE_EQ(options.gain_at_infinity, 1.5);
  EXPECT_DOUBLE_EQ(options.gain_slope, 8.0);
  EXPECT_DOUBLE_EQ(options.gap, -0.02);
  EXPECT_DOUBLE_EQ(options.clearance, 0.12);
  EXPECT_DOUBLE_EQ(options.lead, kPi / 4.0);
}

TEST(PbvsOptions, TheFileOfTheRobotIsReadable) {
  EXPECT_NO_THROW(read_pbvs_options(data_file("servo/pbvs.yaml")));
}

TEST(PbvsOptions, BadFilesAreRefusedByKey) {
  const TemporaryFolder folder;
  const auto expect_refused = [&](const std::string& text, std::initializer_list<const char*> parts) {
    const auto file = folder.write("pbvs.yaml", text);
    expect_error([&] { read_pbvs_options(file); }, parts);
  };
  expect_refused(with("lead_deg: 45\n", ""), {"pbvs.yaml", "lead_deg", "missing"});
  expect_refused(with("lead_deg", "lead_rad"), {"pbvs.yaml:4", "lead_rad"});
  expect_refused(with("45", "90"), {"pbvs.yaml:4", "lead_deg", "out of range"});
  expect_refused(with("slope: 8.0", "slope: .nan"), {"pbvs.yaml:1", "slope", "out of range"});
  expect_refused(with("1.5", "4.0"), {"pbvs.yaml:1", "at_infinity", "less than at_zero"});
  expect_refused(with("0.12", "-0.05"), {"pbvs.yaml:3", "clearance", "out of range"});
  expect_refused(with("-0.02", "0.2"), {"pbvs.yaml:3", "clearance", "at least gap"});
}

}  // namespace
}  // namespace movis::servo
