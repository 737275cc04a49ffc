#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "movis/core/error.h"
#include "movis/core/random.h"
#include "movis/fuzzy/fll.h"
#include "movis/fuzzy/inference.h"

namespace movis::fuzzy {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Two inputs with terms low and high that cross over 0…10, two outputs.
std::string rule_base(const std::string& rules, const std::string& norms = "AlgebraicProduct AlgebraicSum",
                      const std::string& output = "default: -1") {
  const std::size_t blank = norms.find(' ');
  std::string text = "Engine: test\n";
  for (const char* name : {"a", "b"}) {
    text += std::string("InputVariable: ") + name + "\n range: 0 10\n term: low Ramp 10 0\n term: high Ramp 0 10\n";
  }
  text += "OutputVariable: y\n range: -100 100\n defuzzifier: WeightedAverage\n " + output +
          "\n term: one Constant 1\n term: five Constant 5\n term: forty Constant 40\n";
  return text + "RuleBlock:\n conjunction: " + norms.substr(0, blank) + "\n disjunction: " + norms.substr(blank + 1) +
         "\n" + rules;
}

double value(const std::string& text, double a, double b) {
  Inference inference(parse_fll(text, "test.fll"));
  EXPECT_EQ(inference.evaluate({a, b}), InferenceStatus::ok);
  return inference.outputs()[0];
}

// By hand at a = 3, b = 6: low(a) = 0.7, high(a) = 0.3, low(b) = 0.4, high(b) = 0.6.
//   rule 1: low(a)·low(b)         = 0.28 → 1
//   rule 2: 0.5·high(a)           = 0.15 → 5
//   rule 3: high(a)·high(b)       = 0.18 → 40
//   y = (0.28·1 + 0.15·5 + 0.18·40) / (0.28 + 0.15 + 0.18) = 8.23/0.61
constexpr const char* kThreeRules =
    "rule: if a is low and b is low then y is one\n"
    "rule: if a is high then y is five with 0.5\n"
    "rule: if a is high and b is high then y is forty\n";

TEST(Inference, KnownAnswer) {
  Inference inference(parse_fll(rule_base(kThreeRules), "test.fll"));
  ASSERT_EQ(inference.evaluate({3.0, 6.0}), InferenceStatus::ok);
  EXPECT_NEAR(inference.outputs()[0], 8.23 / 0.61, 1e-12);
  ASSERT_EQ(inference.strengths().size(), 3u);
  EXPECT_NEAR(inference.strengths()[0], 0.28, 1e-12);
  EXPECT_NEAR(inference.strengths()[1], 0.15, 1e-12);
  EXPECT_NEAR(inference.strengths()[2], 0.18, 1e-12);
}

// The same with the minimum: 0.4, 0.15, 0.3; y = (0.4 + 0.75 + 12)/0.85.
TEST(Inference, KnownAnswerWithTheMinimum) {
  EXPECT_NEAR(value(rule_base(kThreeRules, "Minimum Maximum"), 3.0, 6.0), 13.15 / 0.85, 1e-12);
}

// By hand, a = 3, b = 6, degree d of the first rule → 1, its negation 1 − d → 5 by parentheses and De Morgan.
// `and` binds more tightly than `or`: low(a) or (high(a) and high(b)) = 0.7 + 0.18 − 0.126 = 0.754 (sum, product), and
// max(0.7, min(0.3, 0.6)) = 0.7. With the parentheses moved: (0.7 + 0.3 − 0.21)·0.6 = 0.474, and min(0.7, 0.6) = 0.6.
TEST(Inference, NormsPrecedenceAndParentheses) {
  const auto blended = [](const std::string& antecedent, const std::string& norms) {
    // the second rule has strength 1: y = (d + 5)/(d + 1)
    const double y = value(
        rule_base("rule: if " + antecedent + " then y is one\nrule: if a is any then y is five\n", norms), 3.0, 6.0);
    return (5.0 - y) / (y - 1.0);
  };
  const std::string smooth = "AlgebraicProduct AlgebraicSum";
  const std::string sharp = "Minimum Maximum";
  EXPECT_NEAR(blended("a is low or a is high and b is high", smooth), 0.754, 1e-12);
  EXPECT_NEAR(blended("a is low or a is high and b is high", sharp), 0.7, 1e-12);
  EXPECT_NEAR(blended("(a is low or a is high) and b is high", smooth), 0.474, 1e-12);
  EXPECT_NEAR(blended("(a is low or a is high) and b is high", sharp), 0.6, 1e-12);
  EXPECT_NEAR(blended("((a is low)or(a is high))and(b is high)", sharp), 0.6, 1e-12);
}

// By hand from their definitions at 0.3 and 0.7; "not very low" is 1 − 0.7², "very not low" is (1 − 0.7)².
TEST(Inference, HedgesApplyFromTheRight) {
  const auto degree = [](const std::string& proposition) {
    Inference inference(parse_fll(rule_base("rule: if a is " + proposition + " then y is one\n"), "test.fll"));
    inference.evaluate({3.0, 6.0});
    return inference.strengths()[0];
  };
  EXPECT_NEAR(degree("not low"), 0.3, 1e-12);
  EXPECT_NEAR(degree("very low"), 0.49, 1e-12);
  EXPECT_NEAR(degree("somewhat low"), std::sqrt(0.7), 1e-12);
  EXPECT_NEAR(degree("extremely high"), 0.18, 1e-12);          // 2·0.3²
  EXPECT_NEAR(degree("extremely low"), 0.82, 1e-12);           // 1 − 2·0.3²
  EXPECT_NEAR(degree("seldom high"), std::sqrt(0.15), 1e-12);  // √(0.3/2)
  EXPECT_NEAR(degree("seldom low"), 1.0 - std::sqrt(0.15), 1e-12);
  EXPECT_NEAR(degree("not very low"), 0.51, 1e-12);
  EXPECT_NEAR(degree("very not low"), 0.09, 1e-12);
  EXPECT_NEAR(degree("any"), 1.0, 1e-12);
  EXPECT_NEAR(degree("not any"), 0.0, 1e-12);
}

TEST(Inference, MembershipFunctions) {
  const MembershipFunction triangle = Triangle{1.0, 2.0, 4.0};
  const MembershipFunction trapezoid = Trapezoid{0.0, 1.0, 2.0, 4.0};
  const MembershipFunction gaussian = Gaussian{1.0, 2.0};
  for (const auto& [x, expected] : {std::pair{0.9, 0.0}, {1.0, 0.0}, {1.5, 0.5}, {2.0, 1.0}, {3.0, 0.5}, {4.1, 0.0}}) {
    EXPECT_NEAR(membership(triangle, x), expected, 1e-15) << x;
  }
  for (const auto& [x, expected] :
       {std::pair{-1.0, 0.0}, {0.25, 0.25}, {1.0, 1.0}, {2.0, 1.0}, {3.5, 0.25}, {5.0, 0.0}}) {
    EXPECT_NEAR(membership(trapezoid, x), expected, 1e-15) << x;
  }
  EXPECT_NEAR(membership(gaussian, 3.0), std::exp(-0.5), 1e-15);
  EXPECT_NEAR(membership(gaussian, kInfinity), 0.0, 0.0);
  EXPECT_NEAR(membership(Ramp{2.0, 4.0}, 2.5), 0.25, 1e-15);
  EXPECT_NEAR(membership(Ramp{4.0, 2.0}, 2.5), 0.75, 1e-15);
  EXPECT_NEAR(membership(Rectangle{2.0, 4.0}, 4.0), 1.0, 0.0);
  EXPECT_NEAR(membership(Rectangle{2.0, 4.0}, 4.0001), 0.0, 0.0);
}

TEST(Inference, VerticalEdgesAndShoulders) {
  EXPECT_EQ(membership(Triangle{1.0, 1.0, 2.0}, 1.0), 1.0);
  EXPECT_EQ(membership(Triangle{1.0, 1.0, 2.0}, 0.999), 0.0);
  EXPECT_EQ(membership(Trapezoid{-kInfinity, 1.0, 2.0, 4.0}, -1e300), 1.0);
  EXPECT_EQ(membership(Trapezoid{-kInfinity, -kInfinity, 2.0, 4.0}, -kInfinity), 1.0);
  EXPECT_EQ(membership(Trapezoid{0.0, 1.0, 2.0, kInfinity}, kInfinity), 1.0);
  EXPECT_EQ(membership(Trapezoid{0.0, 1.0, 2.0, 3.0}, kInfinity), 0.0);
  EXPECT_EQ(membership(Triangle{-kInfinity, 0.0, kInfinity}, 7.0), 1.0);
}

// Between the rules' constants and nowhere else, whatever the input: also far outside the range and at infinity.
TEST(Inference, OutputLiesBetweenTheConstants) {
  const std::string always = "rule: if a is any then y is five with 0.1\n";
  Inference inference(parse_fll(rule_base(kThreeRules + always), "test.fll"));
  RandomStream stream = make_stream(1, 0);
  std::uniform_real_distribution<double> anywhere(-5.0, 15.0);
  for (int draw = 0; draw < 1000; ++draw) {
    ASSERT_EQ(inference.evaluate({anywhere(stream), draw == 0 ? kInfinity : anywhere(stream)}), InferenceStatus::ok);
    EXPECT_GE(inference.outputs()[0], 1.0 - 1e-12);
    EXPECT_LE(inference.outputs()[0], 40.0 + 1e-12);
  }
}

TEST(Inference, NaNIsAStatus) {
  Inference inference(parse_fll(rule_base(kThreeRules), "test.fll"));
  for (const auto& inputs : {std::vector<double>{kNaN, 1.0}, {1.0, kNaN}}) {
    EXPECT_EQ(inference.evaluate(inputs), InferenceStatus::nan_input);
    EXPECT_TRUE(std::isnan(inference.outputs()[0]));
  }
  EXPECT_EQ(inference.evaluate({1.0, 1.0}), InferenceStatus::ok);  // nothing of it stays
}

TEST(Inference, WrongNumberOfInputs) {
  Inference inference(parse_fll(rule_base(kThreeRules), "test.fll"));
  EXPECT_THROW(inference.evaluate({1.0}), Error);
}

constexpr const char* kOnlyHigh = "rule: if a is high and b is high then y is forty\n";
constexpr const char* kProduct = "AlgebraicProduct none";

TEST(Inference, NoRuleFires) {
  EXPECT_EQ(value(rule_base(kOnlyHigh, kProduct, "default: 7"), 0.0, 6.0), 7.0);
  Inference inference(parse_fll(rule_base(kOnlyHigh, kProduct, "default: nan"), "test.fll"));
  EXPECT_EQ(inference.evaluate({0.0, 6.0}), InferenceStatus::no_conclusion);
  EXPECT_TRUE(std::isnan(inference.outputs()[0]));
}

// However weakly a rule fires, it is heard: 1e-12 · 1e-12.
TEST(Inference, WeakFiringIsHeard) {
  EXPECT_NEAR(value(rule_base(kOnlyHigh), 1e-11, 1e-11), 40.0, 1e-9);
  EXPECT_NEAR(value(rule_base(kOnlyHigh), 1e-300, 10.0), -1.0, 0.0);  // but not where products underflow
}

TEST(Inference, PreviousValueIsKept) {
  Inference inference(parse_fll(rule_base(kOnlyHigh, kProduct, "default: 7\n lock-previous: true"), "test.fll"));
  inference.evaluate({0.0, 6.0});
  EXPECT_EQ(inference.outputs()[0], 7.0);
  inference.evaluate({3.0, 6.0});
  EXPECT_NEAR(inference.outputs()[0], 40.0, 1e-12);
  inference.evaluate({kNaN, 6.0});
  inference.evaluate({0.0, 6.0});
  EXPECT_NEAR(inference.outputs()[0], 40.0, 1e-12);
  inference.start();
  inference.evaluate({0.0, 6.0});
  EXPECT_EQ(inference.outputs()[0], 7.0);
}

TEST(Inference, RangesAreLocked) {
  std::string text = rule_base(kThreeRules, "AlgebraicProduct none", "lock-range: true\n default: 500");
  text.replace(text.find("range: -100 100"), 15, "range: 2 20    ");
  EXPECT_EQ(value(text, 0.0, 0.0), 2.0);     // 1
  EXPECT_EQ(value(text, 10.0, 10.0), 20.0);  // (2.5 + 40)/1.5
  // Below 0 the triangle ends, the locked input stays at 0.
  std::string peak = rule_base("rule: if a is peak then y is forty\n");
  peak.insert(peak.find("term: low"), "term: peak Triangle -1 0 1\n ");
  EXPECT_EQ(value(peak, -3.0, 0.0), -1.0);
  peak.insert(peak.find("term: peak"), "lock-range: true\n ");
  EXPECT_EQ(value(peak, -3.0, 0.0), 40.0);
}

TEST(Inference, DisabledPartsDoNotCount) {
  std::string input = rule_base(kThreeRules);
  input.insert(input.find("range"), "enabled: false\n ");
  EXPECT_EQ(value(input, 3.0, 6.0), -1.0);
  std::string output = rule_base(kThreeRules);
  output.insert(output.find("range: -100"), "enabled: false\n ");
  EXPECT_EQ(value(output, 3.0, 6.0), -1.0);
  const std::string block =
      rule_base(kThreeRules) + "RuleBlock: off\n enabled: false\n rule: if a is any then y is one\n";
  EXPECT_NEAR(value(block, 3.0, 6.0), 8.23 / 0.61, 1e-12);
}

// Two blocks with different norms add their rules: by hand 0.28 → 1, min(0.3, 0.6) → 40.
TEST(Inference, BlocksAddTheirRules) {
  const std::string text =
      rule_base("rule: if a is low and b is low then y is one\n") +
      "RuleBlock: second\n conjunction: Minimum\n rule: if a is high and b is high then y is forty\n";
  EXPECT_NEAR(value(text, 3.0, 6.0), (0.28 + 12.0) / 0.58, 1e-12);
}

}  // namespace
}  // namespace movis::fuzzy
