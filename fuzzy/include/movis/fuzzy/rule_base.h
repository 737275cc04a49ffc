#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "movis/core/yaml.h"

// Simplified fuzzy reasoning: rules whose conclusions are constants (T. Takagi, M. Sugeno, Fuzzy identification of
// systems and its applications to modeling and control, IEEE Trans. SMC 15(1), 1985, with consequents of order zero).
namespace movis::fuzzy {

// Membership functions, by their FuzzyLite names. Vertices ascend; edges may be vertical, and then the vertex itself
// belongs to the set. An outer vertex at infinity means full membership on that side.
struct Triangle {
  double a, b, c;  // 0 at a and c, 1 at b
};
struct Trapezoid {
  double a, b, c, d;  // 1 from b to c
};
struct Ramp {
  double start, end;  // 0 at the start and before it, 1 at the end and beyond; falls where end < start
};
struct Rectangle {
  double start, end;  // both included
};
struct Gaussian {
  double mean, sigma;  // exp(−(x − mean)² / (2 sigma²))
};
using MembershipFunction = std::variant<Triangle, Trapezoid, Ramp, Rectangle, Gaussian>;

// In 0…1, for any x but NaN; an infinite x is far away.
double membership(const MembershipFunction& function, double x);

// Words that change a membership m: not 1 − m, very m², somewhat √m; extremely and seldom push away from and towards
// 1/2 (with k = m up to 1/2 and k = 1 − m above: 2k² and √(k/2), mirrored above 1/2).
enum class Hedge : std::uint8_t { negation, very, somewhat, extremely, seldom };
double hedged(Hedge hedge, double membership);

struct Term {
  std::string name;
  MembershipFunction function;
};

struct Constant {
  std::string name;
  double value;
};

struct InputVariable {
  std::string name;
  std::string description;
  bool enabled = true;  // propositions about a disabled input have degree 0
  Range range{};
  bool lock_range = false;  // values are taken into the range first
  std::vector<Term> terms;
};

struct OutputVariable {
  std::string name;
  std::string description;
  bool enabled = true;  // a disabled output always has its default
  Range range{};
  bool lock_range = false;  // the output is taken into the range
  bool lock_previous =
      false;              // where no rule fires: the last value that rules gave, and `standard` before there was one
  double standard = 0.0;  // FLL's `default`: the value where no rule fires; NaN: then there is none
  std::vector<Constant> terms;
};

// "ball_gap is not very near": an input, a term of it, and hedges as they are written, so that the last applies first.
// Without a term: "is any", of degree 1.
struct Proposition {
  std::size_t input;
  int term;  // kAny: none
  std::vector<Hedge> hedges;
};
inline constexpr int kAny = -1;

enum class Connective : std::uint8_t { conjunction, disjunction };

struct Conclusion {
  std::size_t output;
  std::size_t term;
};

struct Rule {
  std::string text;                                               // as written, with single spaces
  int line = 0;                                                   // of its file
  std::vector<std::variant<Proposition, Connective>> antecedent;  // in postfix order
  std::vector<Conclusion> consequent;
  double weight = 1.0;  // the firing strength is weight · degree of the antecedent
};

struct RuleBlock {
  enum class Conjunction : std::uint8_t { algebraic_product, minimum };  // of degrees a, b: a·b, min(a, b)
  enum class Disjunction : std::uint8_t { algebraic_sum, maximum };      // a + b − a·b, max(a, b)

  std::string name;
  std::string description;
  bool enabled = true;
  Conjunction conjunction = Conjunction::algebraic_product;
  Disjunction disjunction = Disjunction::algebraic_sum;
  std::vector<Rule> rules;
};

struct RuleBase {
  std::filesystem::path file;
  std::string name;
  std::string description;
  std::vector<InputVariable> inputs;
  std::vector<OutputVariable> outputs;
  std::vector<RuleBlock> blocks;
};

}  // namespace movis::fuzzy
