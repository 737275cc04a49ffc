// fuzzylite 6 reads the same rule bases and is asked the same questions.
#include <fl/Headers.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string>

#include "movis/core/paths.h"
#include "movis/core/random.h"
#include "movis/fuzzy/fll.h"
#include "movis/fuzzy/inference.h"

namespace movis::fuzzy {
namespace {

// Draws rule bases that use all of the supported language.
class RandomRuleBase {
 public:
  explicit RandomRuleBase(std::uint64_t seed) : stream_(make_stream(seed, 0)) {}

  std::string draw() {
    inputs_ = 1 + below(3);
    outputs_ = 1 + below(2);
    std::string text = "Engine: drawn\n";
    for (int i = 0; i < inputs_; ++i) text += input(i);
    for (int i = 0; i < outputs_; ++i) text += output(i);
    const int blocks = 1 + below(2);
    for (int i = 0; i < blocks; ++i) text += block(i == 0);
    return text;
  }

  std::vector<double> draw_inputs() {
    std::vector<double> values;
    for (int i = 0; i < inputs_; ++i) values.push_back(number(-6.0, 6.0));
    return values;
  }

 private:
  static constexpr int kTerms = 5;

  int below(int count) { return static_cast<int>(stream_() % static_cast<std::uint64_t>(count)); }
  bool chance(double probability) { return number(0.0, 1.0) < probability; }
  double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(stream_); }

  std::string numbers(int count) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(number(-5.0, 5.0));
    std::sort(values.begin(), values.end());
    std::string text;
    for (const double value : values) text += fmt::format(" {:.3f}", value);
    return text;
  }

  std::string input(int i) {
    std::string text =
        fmt::format("InputVariable: x{}\n enabled: {}\n range: -4 4\n lock-range: {}\n", i, !chance(0.05), chance(0.3));
    text += " term: t0 Triangle" + numbers(3) + "\n term: t1 Trapezoid" + numbers(4) + "\n term: t2 Rectangle" +
            numbers(2) + "\n";
    const double start = number(-4.0, 4.0);
    text += fmt::format(" term: t3 Ramp {:.3f} {:.3f}\n", start, start + (chance(0.5) ? 1.5 : -2.5));
    text += fmt::format(" term: t4 {}\n", chance(0.5) ? fmt::format("Gaussian {:.3f} {:.3f}", start, number(0.8, 3.0))
                                                      : "Trapezoid -inf -inf -1.000 1.000");
    return text;
  }

  std::string output(int i) {
    std::string text = fmt::format(
        "OutputVariable: y{}\n enabled: true\n range: -2 2\n lock-range: {}\n aggregation: none\n"
        " defuzzifier: WeightedAverage TakagiSugeno\n default: {}\n lock-previous: {}\n",
        i, chance(0.3), chance(0.5) ? "nan" : "1.500", chance(0.3));
    for (int t = 0; t < kTerms; ++t) text += fmt::format(" term: c{} Constant {:.3f}\n", t, number(-3.0, 3.0));
    return text;
  }

  std::string block(bool enabled) {
    std::string text = fmt::format(
        "RuleBlock: \n enabled: {}\n conjunction: {}\n disjunction: {}\n implication: {}\n activation: General\n",
        enabled || chance(0.8), chance(0.5) ? "Minimum" : "AlgebraicProduct", chance(0.5) ? "Maximum" : "AlgebraicSum",
        chance(0.5) ? "none" : "AlgebraicProduct");
    for (int o = 0; o < outputs_; ++o) {
      std::set<std::string> rules;  // none twice
      const int count = 1 + below(8);
      for (int r = 0; r < count; ++r) {
        rules.insert(fmt::format(" rule: if {} then y{} is c{}{}\n", antecedent(3), o, below(kTerms),
                                 chance(0.3) ? fmt::format(" with {:.3f}", number(0.1, 0.999)) : ""));
      }
      for (const std::string& rule : rules) text += rule;
    }
    return text;
  }

  std::string antecedent(int depth) {
    if (depth == 0 || chance(0.4)) return proposition();
    const std::string joined = antecedent(depth - 1) + (chance(0.6) ? " and " : " or ") + antecedent(depth - 1);
    return chance(0.5) ? "( " + joined + " )" : joined;
  }

  std::string proposition() {
    static constexpr const char* kHedges[] = {"not", "very", "somewhat", "extremely", "seldom"};
    std::string text = fmt::format("x{} is", below(inputs_));
    while (chance(0.25)) text += std::string(" ") + kHedges[below(5)];
    return chance(0.05) ? text + " any" : text + fmt::format(" t{}", below(kTerms));
  }

  RandomStream stream_;
  int inputs_ = 0, outputs_ = 0;
};

// Differences smaller than macheps (1e-6 unless told) count as none to fuzzylite, so that weakly firing rules and
// points near a vertex would differ: it is told 0.
class AgainstFuzzylite : public testing::Test {
 protected:
  void SetUp() override { fl::fuzzylite::setMachEps(0.0); }

  void compare(Inference& ours, fl::Engine& peer, const std::vector<double>& inputs) {
    for (std::size_t i = 0; i < inputs.size(); ++i) peer.getInputVariable(i)->setValue(inputs[i]);
    peer.process();
    ours.evaluate(inputs);
    for (std::size_t i = 0; i < ours.outputs().size(); ++i) {
      const double expected = peer.getOutputVariable(i)->getValue();
      const double value = ours.outputs()[i];
      ASSERT_EQ(std::isnan(value), std::isnan(expected)) << "output " << i;
      (std::isnan(value) ? without_value_ : with_value_) += 1;
      if (std::isnan(value)) continue;
      ASSERT_NEAR(value, expected, 1e-9) << "output " << i;
      largest_ = std::max(largest_, std::abs(value - expected));
    }
  }

  void TearDown() override {
    fmt::print("{} outputs compared, {} without value; largest difference {:.2g}\n", with_value_, without_value_,
               largest_);
  }

  int with_value_ = 0, without_value_ = 0;
  double largest_ = 0.0;
};

TEST_F(AgainstFuzzylite, RandomRuleBases) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    RandomRuleBase drawn(seed);
    const std::string text = drawn.draw();
    SCOPED_TRACE(fmt::format("seed {}\n{}", seed, text));
    const std::unique_ptr<fl::Engine> peer(fl::FllImporter().fromString(text));
    Inference ours(parse_fll(text, "drawn.fll"));
    for (int draw = 0; draw < 100; ++draw) {
      compare(ours, *peer, drawn.draw_inputs());
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(with_value_, 30000);
  EXPECT_GT(without_value_, 100);  // both kinds of end were reached
}

// The project's own rule bases, over their variables' ranges.
TEST_F(AgainstFuzzylite, ApproachAndShoot) {
  for (const char* name : {"select", "approach", "turn", "shoot"}) {
    const std::filesystem::path file = data_file(fmt::format("fuzzy/approach-and-shoot/{}.fll", name));
    const std::unique_ptr<fl::Engine> peer(fl::FllImporter().fromFile(file.string()));
    Inference ours(read_fll(file));
    RandomStream stream = make_stream(11, 0);
    for (int draw = 0; draw < 2000; ++draw) {
      std::vector<double> inputs;
      for (const InputVariable& input : ours.rules().inputs) {
        inputs.push_back(std::uniform_real_distribution<double>(input.range.min, input.range.max)(stream));
      }
      compare(ours, *peer, inputs);
    }
  }
}

}  // namespace
}  // namespace movis::fuzzy
