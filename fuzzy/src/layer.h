#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "movis/control/percepts.h"
#include "movis/fuzzy/inference.h"

namespace movis::fuzzy {

// What inputs may be about.
struct Situation {
  control::Percepts percepts;
  double post_gap;
};

// A rule base whose inputs are parts of the situation, by name (hierarchy.h).
class Layer {
 public:
  // An Error where an input is no percept.
  explicit Layer(const std::filesystem::path& file);

  void start() { inference_.start(); }
  bool evaluate(const Situation& situation);  // false: there is no value

  // Of the last evaluation, in the rule base's order.
  const std::vector<double>& outputs() const { return inference_.outputs(); }

  // The outputs' places in that order; an Error unless there are exactly these, in any order.
  std::vector<std::size_t> require_outputs(const std::vector<std::string>& names) const;

  const RuleBase& rules() const { return inference_.rules(); }

 private:
  using Percept = double (*)(const Situation&);

  Inference inference_;
  std::vector<Percept> percepts_;
  std::vector<double> inputs_;
};

}  // namespace movis::fuzzy
