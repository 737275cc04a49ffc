#include "layer.h"

#include <algorithm>
#include <array>

#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/core/names.h"
#include "movis/fuzzy/fll.h"

namespace movis::fuzzy {
namespace {

struct NamedPercept {
  const char* name;
  double (*value)(const Situation&);
};

constexpr std::array kPercepts{
    NamedPercept{"ball_distance", [](const Situation& s) { return s.percepts.ball_distance; }},
    NamedPercept{"ball_gap", [](const Situation& s) { return s.percepts.ball_gap; }},
    NamedPercept{"ball_direction_deg", [](const Situation& s) { return degrees(s.percepts.ball_direction); }},
    NamedPercept{"target_distance", [](const Situation& s) { return s.percepts.target_distance; }},
    NamedPercept{"target_direction_deg", [](const Situation& s) { return degrees(s.percepts.target_direction); }},
    NamedPercept{"shot_direction_deg",
                 [](const Situation& s) { return degrees(wrap_angle(s.percepts.ball_direction + s.percepts.detour)); }},
    NamedPercept{"detour_deg", [](const Situation& s) { return degrees(s.percepts.detour); }},
    NamedPercept{"post_gap", [](const Situation& s) { return s.post_gap; }},
};

template <typename List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const auto& item : list) names.emplace_back(item.name);
  return names;
}

}  // namespace

Layer::Layer(const std::filesystem::path& file) : inference_(read_fll(file)) {
  for (const InputVariable& input : rules().inputs) {
    const auto found = std::find_if(kPercepts.begin(), kPercepts.end(),
                                    [&](const NamedPercept& percept) { return percept.name == input.name; });
    if (found == kPercepts.end()) {
      throw Error("{}: the input '{}' is no percept{}", file.string(), input.name,
                  suggestion(input.name, names_of(kPercepts)));
    }
    percepts_.push_back(found->value);
  }
  inputs_.resize(percepts_.size());
}

bool Layer::evaluate(const Situation& situation) {
  for (std::size_t i = 0; i < inputs_.size(); ++i) inputs_[i] = percepts_[i](situation);
  return inference_.evaluate(inputs_) == InferenceStatus::ok;
}

std::vector<std::size_t> Layer::require_outputs(const std::vector<std::string>& names) const {
  const std::vector<std::string> there = names_of(rules().outputs);
  for (const std::string& name : there) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      throw Error("{}: the output '{}' has no meaning here{}", rules().file.string(), name, suggestion(name, names));
    }
  }
  std::vector<std::size_t> places;
  for (const std::string& name : names) {
    const auto found = std::find(there.begin(), there.end(), name);
    if (found == there.end()) {
      throw Error("{}: the output '{}' is missing; there must be: {}", rules().file.string(), name, joined(names));
    }
    places.push_back(static_cast<std::size_t>(found - there.begin()));
  }
  return places;
}

}  // namespace movis::fuzzy
