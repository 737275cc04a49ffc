// Tracks one set of the installed images; exit code 0 where ball and pose were found.
#include <cstdio>

#include "movis/core/paths.h"
#include "movis/grab/dataset_source.h"
#include "movis/localization/localizer.h"
#include "movis/pipeline/pipeline.h"

int main() {
  using namespace movis;
  grab::DatasetSource source(grab::read_dataset(data_file("images/field")));
  pipeline::Pipeline pipeline(source.dataset().rig, read_field(*source.dataset().field_file),
                              scan::read_colours(data_file("colours/default.yaml")), {},
                              localization::find_localizer("composed"));
  source.open();
  grab::FrameSet images;
  source.acquire(images);
  const pipeline::Estimate& estimate = step(pipeline, images);
  std::printf("data: %s\nball %s, pose %s\n", data_directory().c_str(), word(estimate.ball_in_robot.status),
              word(estimate.fix.status));
  return estimate.ball_in_robot.status == PointStatus::ok && estimate.fix.status == FixStatus::ok ? 0 : 1;
}
