#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <vector>

#include "movis/core/output_file.h"
#include "movis/grab/dataset.h"

namespace movis::app {

// A file that a command writes, if asked for, and the option that names it.
struct Output {
  const char* option;
  std::optional<std::filesystem::path> file;
};

// All that a rig, or a data set, is read from.
std::vector<std::filesystem::path> files_of(const omni::Rig& rig, const std::filesystem::path& rig_file);
std::vector<std::filesystem::path> files_of(const grab::Dataset& dataset);

// What is read is worth more than what is made of it: an Error where an output is one of the inputs, or of the inputs
// that options name, or another output.
void refuse_to_overwrite(std::initializer_list<Output> outputs, const std::vector<std::filesystem::path>& inputs,
                         std::initializer_list<std::optional<std::filesystem::path>> named_inputs = {});

// Throws where the disk is full: to be called before another file is written that must not stand alone.
void flush(OutputFile& file);

}  // namespace movis::app
