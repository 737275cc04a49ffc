#include "movis/fuzzy/inference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "movis/core/error.h"

namespace movis::fuzzy {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeastStrength = 1e-290;

double into(const Range& range, double value) {
  return std::min(std::max(value, range.min), range.max);
}

}  // namespace

const char* word(InferenceStatus status) {
  switch (status) {
    case InferenceStatus::ok:
      return "ok";
    case InferenceStatus::nan_input:
      return "nan_input";
    case InferenceStatus::no_conclusion:
      return "no_conclusion";
  }
  return "?";
}

Inference::Inference(RuleBase rules) : rules_(std::move(rules)) {
  conclusions_.resize(rules_.outputs.size());
  for (const RuleBlock& block : rules_.blocks) {
    for (const Rule& rule : block.rules) {
      const std::size_t degree = compile(rule, block);
      for (const Conclusion& conclusion : rule.consequent) {
        const OutputVariable& output = rules_.outputs[conclusion.output];
        if (!output.enabled) continue;
        conclusions_[conclusion.output].push_back({firings_.size(), output.terms[conclusion.term].value});
      }
      firings_.push_back({block.enabled ? rule.weight : 0.0, degree});
    }
  }
  inputs_.resize(rules_.inputs.size());
  strengths_.resize(firings_.size());
  outputs_.assign(rules_.outputs.size(), kNone);
  start();
}

void Inference::start() {
  previous_.assign(rules_.outputs.size(), kNone);
}

std::size_t Inference::compile(const Rule& rule, const RuleBlock& block) {
  const bool product = block.conjunction == RuleBlock::Conjunction::algebraic_product;
  const bool sum = block.disjunction == RuleBlock::Disjunction::algebraic_sum;
  std::vector<std::size_t> stack;
  for (const auto& item : rule.antecedent) {
    if (const auto* proposition = std::get_if<Proposition>(&item)) {
      stack.push_back(compile(*proposition));
      continue;
    }
    const Join::Norm norm = std::get<Connective>(item) == Connective::conjunction
                                ? (product ? Join::Norm::product : Join::Norm::minimum)
                                : (sum ? Join::Norm::sum : Join::Norm::maximum);
    const std::size_t right = stack.back();
    stack.pop_back();
    joins_.push_back({norm, stack.back(), right, degrees_.size()});
    stack.back() = degrees_.size();
    degrees_.push_back(0.0);
  }
  return stack.back();
}

std::size_t Inference::compile(const Proposition& proposition) {
  for (std::size_t i = 0; i < propositions_.size(); ++i) {
    const Proposition& known = propositions_[i];
    if (known.input == proposition.input && known.term == proposition.term && known.hedges == proposition.hedges) {
      return proposition_degrees_[i];
    }
  }
  propositions_.push_back(proposition);
  proposition_degrees_.push_back(degrees_.size());
  const InputVariable& input = rules_.inputs[proposition.input];
  const std::vector<Hedge> hedges(proposition.hedges.rbegin(), proposition.hedges.rend());
  double constant = 0.0;
  if (input.enabled && proposition.term == kAny) {
    constant = 1.0;
    for (const Hedge hedge : hedges) constant = hedged(hedge, constant);
  } else if (input.enabled) {
    memberships_.push_back({proposition.input, input.terms[proposition.term].function, hedges, degrees_.size()});
  }
  degrees_.push_back(constant);
  return degrees_.size() - 1;
}

InferenceStatus Inference::evaluate(const std::vector<double>& inputs) {
  if (inputs.size() != inputs_.size()) {
    throw Error("{}: was given {} inputs; it has {}", rules_.file.string(), inputs.size(), inputs_.size());
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (std::isnan(inputs[i])) {
      std::fill(outputs_.begin(), outputs_.end(), kNone);
      return InferenceStatus::nan_input;
    }
    inputs_[i] = rules_.inputs[i].lock_range ? into(rules_.inputs[i].range, inputs[i]) : inputs[i];
  }

  for (const Membership& term : memberships_) {
    double degree = membership(term.function, inputs_[term.input]);
    for (const Hedge hedge : term.hedges) degree = hedged(hedge, degree);
    degrees_[term.degree] = degree;
  }
  for (const Join& join : joins_) {
    degrees_[join.degree] = joined(join.norm, degrees_[join.left], degrees_[join.right]);
  }
  for (std::size_t i = 0; i < firings_.size(); ++i) strengths_[i] = firings_[i].weight * degrees_[firings_[i].degree];

  InferenceStatus status = InferenceStatus::ok;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    outputs_[i] = concluded(i);
    if (std::isnan(outputs_[i])) status = InferenceStatus::no_conclusion;
  }
  return status;
}

double Inference::joined(Join::Norm norm, double a, double b) {
  switch (norm) {
    case Join::Norm::product:
      return a * b;
    case Join::Norm::minimum:
      return std::min(a, b);
    case Join::Norm::sum:
      return a + b - a * b;
    case Join::Norm::maximum:
      return std::max(a, b);
  }
  return 0.0;
}

double Inference::concluded(std::size_t i) {
  double weighted = 0.0;
  double strength = 0.0;
  for (const Concluded& conclusion : conclusions_[i]) {
    weighted += strengths_[conclusion.rule] * conclusion.constant;
    strength += strengths_[conclusion.rule];
  }
  const OutputVariable& output = rules_.outputs[i];
  const bool fires = strength >= kLeastStrength;
  double value = fires ? weighted / strength : output.standard;
  if (!fires && output.lock_previous && !std::isnan(previous_[i])) value = previous_[i];
  if (output.lock_range && !std::isnan(value)) value = into(output.range, value);
  if (fires) previous_[i] = value;
  return value;
}

}  // namespace movis::fuzzy
