#include <gtest/gtest.h>

#include "movis/core/paths.h"
#include "movis/experiments/contender.h"
#include "support/temporary_folder.h"

namespace movis::experiments {
namespace {

control::Task task() {
  return {read_field(data_file("fields/paper.yaml")), control::read_robot(data_file("robots/miniature.yaml"))};
}

TEST(MakeController, EveryNameWithItsDefaultFile) {
  for (const std::string& name : controller_names()) EXPECT_NE(make_controller(name, task()), nullptr) << name;
}

TEST(MakeController, FileAfterAColon) {
  EXPECT_NE(make_controller("pbvs:" + data_file("servo/pbvs.yaml").string(), task()), nullptr);
  test::expect_error([] { make_controller("pbvs:/absent/pbvs.yaml", task()); }, {"/absent/pbvs.yaml"});
}

TEST(MakeController, UnknownNameListsTheKnownOnes) {
  test::expect_error([] { make_controller("fuzy", task()); }, {"'fuzy'", "fuzzy[:FILE]", "pbvs[:FILE]"});
}

}  // namespace
}  // namespace movis::experiments
