#include "outputs.h"

#include "movis/core/error.h"

namespace movis::app {
namespace {

namespace fs = std::filesystem;

void refuse_input(const Output& output, const fs::path& input) {
  std::error_code ignored;
  if (input.empty() || !fs::equivalent(*output.file, input, ignored)) return;
  throw Error("{} {}: is the input file {}; name another file", output.option, output.file->string(), input.string());
}

// Also where neither exists yet. Both may go to one device.
bool same_file(const fs::path& one, const fs::path& other) {
  std::error_code ignored;
  if (fs::exists(one, ignored) && !fs::is_regular_file(one, ignored)) return false;
  return fs::weakly_canonical(one) == fs::weakly_canonical(other) || fs::equivalent(one, other, ignored);
}

}  // namespace

std::vector<fs::path> files_of(const omni::Rig& rig, const fs::path& rig_file) {
  std::vector<fs::path> files{rig_file};
  for (const omni::Camera& camera : rig.cameras) files.push_back(camera.mask);
  return files;
}

std::vector<fs::path> files_of(const grab::Dataset& dataset) {
  std::vector<fs::path> files = files_of(dataset.rig, dataset.rig_file);
  for (const char* table : {"rig.yaml", "frames.csv", "truth.csv", "field.yaml"}) {
    files.push_back(dataset.folder / table);
  }
  for (const grab::DatasetFrame& frame : dataset.frames) {
    for (const grab::DatasetImage& image : frame.images) files.push_back(image.file);
  }
  return files;
}

void refuse_to_overwrite(std::initializer_list<Output> outputs, const std::vector<fs::path>& inputs,
                         std::initializer_list<std::optional<fs::path>> named_inputs) {
  for (const Output* output = outputs.begin(); output != outputs.end(); ++output) {
    if (!output->file) continue;
    for (const fs::path& input : inputs) refuse_input(*output, input);
    for (const std::optional<fs::path>& input : named_inputs) {
      if (input) refuse_input(*output, *input);
    }
    for (const Output* other = outputs.begin(); other != output; ++other) {
      if (!other->file || !same_file(*output->file, *other->file)) continue;
      throw Error("{} {}: is the file of {}; name another file", output->option, output->file->string(), other->option);
    }
  }
}

void flush(OutputFile& file) {
  if (!file.stream().flush()) file.commit();  // of a stream that failed, it throws and tells why
}

}  // namespace movis::app
