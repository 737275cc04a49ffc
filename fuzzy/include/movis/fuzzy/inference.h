#pragma once

#include <cstdint>
#include <vector>

#include "movis/fuzzy/rule_base.h"

namespace movis::fuzzy {

enum class InferenceStatus : std::uint8_t {
  ok,
  nan_input,      // an input is NaN: no output has a value
  no_conclusion,  // for at least one output no rule fires, and it has no default
};

const char* word(InferenceStatus status);

// Evaluates a rule base, with the degree μ of every proposition:
//   strength     w_i = weight_i · (the μ's of rule i, joined by its block's norms)
//   output       y = Σ w_i c_i / Σ w_i       over the rules i that conclude on it, with constants c_i
// No rule fires for an output where Σ w_i < 1e-290: the products of smaller numbers underflow. All terms and rules are
// evaluated, in time proportional to their number, and nothing is allocated. One Inference belongs to one thread.
class Inference {
 public:
  explicit Inference(RuleBase rules);  // as read_fll gives them

  void start();  // forgets the values that lock-previous keeps

  // Inputs in the order of the rule base, and as many (else an Error).
  InferenceStatus evaluate(const std::vector<double>& inputs);

  // Of the last evaluation, in the order of the rule base; NaN where there is no value.
  const std::vector<double>& outputs() const { return outputs_; }

  // w_i of the last evaluation without a NaN: of every rule of every block, in the file's order; 0 in a disabled block.
  const std::vector<double>& strengths() const { return strengths_; }

  const RuleBase& rules() const { return rules_; }

 private:
  // The rule base as straight-line code on a row of degrees: first memberships, then joins of what is there already.
  struct Membership {
    std::size_t input;
    MembershipFunction function;
    std::vector<Hedge> hedges;  // in the order of application
    std::size_t degree;         // where the result goes
  };
  struct Join {
    enum class Norm : std::uint8_t { product, minimum, sum, maximum } norm;
    std::size_t left, right, degree;
  };
  struct Firing {
    double weight;
    std::size_t degree;
  };
  struct Concluded {
    std::size_t rule;
    double constant;
  };

  std::size_t compile(const Rule& rule, const RuleBlock& block);  // the degree of its antecedent
  std::size_t compile(const Proposition& proposition);
  static double joined(Join::Norm norm, double a, double b);
  double concluded(std::size_t i);  // of the output i

  RuleBase rules_;
  std::vector<Proposition> propositions_;  // whose degrees are degrees_[proposition_degrees_[i]]
  std::vector<std::size_t> proposition_degrees_;
  std::vector<Membership> memberships_;
  std::vector<Join> joins_;
  std::vector<Firing> firings_;                      // a rule each
  std::vector<std::vector<Concluded>> conclusions_;  // of every output

  std::vector<double> inputs_, degrees_, strengths_, outputs_, previous_;
};

}  // namespace movis::fuzzy
