// One evaluation of a full grid of rules with 2 inputs × 5 terms (25 rules) and 3 inputs × 5 terms (125 rules), and of
// the rule base that goes round the ball. The peer, fuzzylite 6, reads the same FLL text and is given the same inputs.
#include <benchmark/benchmark.h>
#include <fl/Headers.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "movis/core/paths.h"
#include "movis/core/random.h"
#include "movis/fuzzy/fll.h"
#include "movis/fuzzy/inference.h"
#include "ratio_table.h"

namespace {

using namespace movis;

constexpr int kTerms = 5;

std::string grid_of_rules(int inputs) {
  std::string text = "Engine: grid\n";
  for (int i = 0; i < inputs; ++i) {
    text += fmt::format("InputVariable: x{}\n enabled: true\n range: 0 4\n lock-range: false\n", i);
    for (int t = 0; t < kTerms; ++t) text += fmt::format(" term: t{} Triangle {} {} {}\n", t, t - 1, t, t + 1);
  }
  text +=
      "OutputVariable: y\n enabled: true\n range: -1 1\n lock-range: false\n aggregation: none\n"
      " defuzzifier: WeightedAverage TakagiSugeno\n default: 0\n lock-previous: false\n";
  const int rules = inputs == 2 ? 25 : 125;
  for (int r = 0; r < rules; ++r) text += fmt::format(" term: c{} Constant {:.6f}\n", r, std::sin(r));
  text +=
      "RuleBlock: \n enabled: true\n conjunction: AlgebraicProduct\n disjunction: none\n implication: none\n"
      " activation: General\n";
  for (int r = 0; r < rules; ++r) {
    text += fmt::format(" rule: if x0 is t{} and x1 is t{}", r % 5, r / 5 % 5);
    if (inputs == 3) text += fmt::format(" and x2 is t{}", r / 25);
    text += fmt::format(" then y is c{}\n", r);
  }
  return text;
}

std::string turn_rules() {
  std::ifstream file(data_file("fuzzy/approach-and-shoot/turn.fll"));
  return {std::istreambuf_iterator<char>(file), {}};
}

// Within the variables' ranges.
std::vector<std::vector<double>> draw_inputs(const fuzzy::RuleBase& rules) {
  RandomStream stream = make_stream(7, 0);
  std::vector<std::vector<double>> rows(1024);
  for (auto& row : rows) {
    for (const auto& input : rules.inputs) {
      row.push_back(std::uniform_real_distribution<double>(input.range.min, input.range.max)(stream));
    }
  }
  return rows;
}

double ask(fl::Engine& engine, const std::vector<double>& inputs) {
  for (std::size_t i = 0; i < inputs.size(); ++i) engine.getInputVariable(i)->setValue(inputs[i]);
  engine.process();
  return engine.getOutputVariable(0)->getValue();
}

void require_agreement(fuzzy::Inference& ours, fl::Engine& peer, const std::vector<std::vector<double>>& rows) {
  for (const auto& row : rows) {
    const bool ok = ours.evaluate(row) == fuzzy::InferenceStatus::ok;
    const double expected = ask(peer, row);
    if (ok && std::abs(ours.outputs()[0] - expected) < 1e-5) continue;  // it leaves out what fires below 1e-6
    std::fprintf(stderr, "bench-fuzzy: the contenders disagree: %.9g and %.9g\n", ours.outputs()[0], expected);
    std::exit(1);
  }
}

void run_ours(benchmark::State& state, const std::string& text) {
  fuzzy::Inference inference(fuzzy::parse_fll(text, "bench.fll"));
  const auto rows = draw_inputs(inference.rules());
  const std::unique_ptr<fl::Engine> peer(fl::FllImporter().fromString(text));
  require_agreement(inference, *peer, rows);
  std::size_t i = 0;
  for (auto _ : state) {
    inference.evaluate(rows[i++ % rows.size()]);
    benchmark::DoNotOptimize(inference.outputs()[0]);
  }
}

void run_peer(benchmark::State& state, const std::string& text) {
  const std::unique_ptr<fl::Engine> engine(fl::FllImporter().fromString(text));
  const auto rows = draw_inputs(fuzzy::parse_fll(text, "bench.fll"));
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(ask(*engine, rows[i++ % rows.size()]));
}

void rules_25(benchmark::State& state) {
  run_ours(state, grid_of_rules(2));
}
BENCHMARK(rules_25);

void fuzzylite_25(benchmark::State& state) {
  run_peer(state, grid_of_rules(2));
}
BENCHMARK(fuzzylite_25);

void rules_125(benchmark::State& state) {
  run_ours(state, grid_of_rules(3));
}
BENCHMARK(rules_125);

void fuzzylite_125(benchmark::State& state) {
  run_peer(state, grid_of_rules(3));
}
BENCHMARK(fuzzylite_125);

void rules_turn(benchmark::State& state) {
  run_ours(state, turn_rules());
}
BENCHMARK(rules_turn);

void fuzzylite_turn(benchmark::State& state) {
  run_peer(state, turn_rules());
}
BENCHMARK(fuzzylite_turn);

}  // namespace

int main(int argc, char** argv) {
  return movis::bench::run_and_compare(
      argc, argv, {{"rules_25", "fuzzylite_25"}, {"rules_125", "fuzzylite_125"}, {"rules_turn", "fuzzylite_turn"}});
}
