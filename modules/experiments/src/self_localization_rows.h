#pragma once

#include <optional>
#include <string>
#include <vector>

#include "movis/experiments/self_localization.h"
#include "row_file.h"

namespace movis::experiments {

// Which row has which number.
class SelfLocalizationPlan {
 public:
  explicit SelfLocalizationPlan(const SelfLocalizationSettings& settings);

  const std::vector<SelfLocalizationBlock>& blocks() const { return blocks_; }
  std::vector<RowBlock> row_blocks() const;
  SelfLocalizationRow row(std::int64_t number) const;  // one of the experiment's, without an answer

  const SelfLocalizationSettings& settings() const { return settings_; }

 private:
  const SelfLocalizationSettings& settings_;
  std::vector<SelfLocalizationBlock> blocks_;
  std::vector<std::string_view> coloured_, white_;  // localizers
};

// rows.csv of this experiment. The plan must outlive the format.
RowFormat format_of(const SelfLocalizationPlan& plan);

// A row as a line, without its end, and back.
std::string line_of(const SelfLocalizationRow& row, const SelfLocalizationSettings& settings, std::uint64_t seed);
SelfLocalizationRow row_of(const std::string& line, const SelfLocalizationPlan& plan);

}  // namespace movis::experiments
