#include "movis/fuzzy/fll.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "fll_rule.h"
#include "fll_text.h"
#include "movis/core/error.h"
#include "movis/core/names.h"

namespace movis::fuzzy {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The words of a term's line after its name and kind, as `count` numbers without NaN.
std::vector<double> parameters(const FllBlock& block, const FllLine& line, std::size_t count) {
  const std::vector<std::string> words = words_of(line.value);
  if (words.size() != 2 + count) {
    block.fail(line, fmt::format("a {} takes {} numbers; it has {}", words[1], count, words.size() - 2));
  }
  std::vector<double> numbers(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (!read_number(words[2 + i], numbers[i]) || std::isnan(numbers[i])) {
      block.fail(line, fmt::format("'{}' is no number", words[2 + i]));
    }
  }
  return numbers;
}

// `plateau_is_reached`: the membership is 1 somewhere; outer vertices may lie at infinity.
void require_order(const FllBlock& block, const FllLine& line, const std::vector<double>& vertices,
                   bool plateau_is_reached) {
  if (!std::is_sorted(vertices.begin(), vertices.end())) block.fail(line, "the vertices must ascend");
  if (vertices.front() == vertices.back()) block.fail(line, "the vertices coincide");
  if (!plateau_is_reached) block.fail(line, "infinity is for the outer vertices: the membership would be 0 everywhere");
}

MembershipFunction read_function(const FllBlock& block, const FllLine& line, const std::string& kind) {
  if (kind == "Triangle") {
    const std::vector<double> v = parameters(block, line, 3);
    require_order(block, line, v, std::isfinite(v[1]));
    return Triangle{v[0], v[1], v[2]};
  }
  if (kind == "Trapezoid") {
    const std::vector<double> v = parameters(block, line, 4);
    require_order(block, line, v, v[1] < kInfinity && v[2] > -kInfinity);
    return Trapezoid{v[0], v[1], v[2], v[3]};
  }
  if (kind == "Ramp") {
    const std::vector<double> v = parameters(block, line, 2);
    if (v[0] == v[1] || !std::isfinite(v[0]) || !std::isfinite(v[1])) {
      block.fail(line, "a Ramp needs two different, finite ends; a step is a Rectangle");
    }
    return Ramp{v[0], v[1]};
  }
  if (kind == "Rectangle") {
    const std::vector<double> v = parameters(block, line, 2);
    require_order(block, line, v, true);
    return Rectangle{v[0], v[1]};
  }
  if (kind == "Gaussian") {
    const std::vector<double> v = parameters(block, line, 2);
    if (!std::isfinite(v[0]) || !std::isfinite(v[1]) || v[1] <= 0.0) {
      block.fail(line, "a Gaussian needs a finite mean and a positive sigma");
    }
    return Gaussian{v[0], v[1]};
  }
  block.fail(line, fmt::format("'{}' is no kind of term of an input{}", kind,
                               suggestion(kind, {"Triangle", "Trapezoid", "Ramp", "Rectangle", "Gaussian"})));
}

// Calls read(line, name, kind) for every term.
template <typename Read>
void for_each_term(const FllBlock& block, const Read& read) {
  std::vector<std::string> names;
  for (const FllLine* line : block.all("term")) {
    const std::vector<std::string> words = words_of(line->value);
    if (words.size() < 2) block.fail(*line, "a term is 'term: NAME KIND NUMBERS'");
    if (!is_name(words[0])) block.fail(*line, fmt::format("'{}' cannot be a name", words[0]));
    if (std::find(names.begin(), names.end(), words[0]) != names.end()) {
      block.fail(*line, fmt::format("'{}' has two terms '{}'", block.head.value, words[0]));
    }
    names.push_back(words[0]);
    read(*line, words[0], words[1]);
  }
}

Range read_range(const FllBlock& block) {
  const FllLine& line = block.require("range");
  const std::vector<std::string> words = words_of(line.value);
  Range range{};
  if (words.size() != 2 || !read_number(words[0], range.min) || !read_number(words[1], range.max) ||
      !(range.min < range.max)) {
    block.fail(line, fmt::format("'range' is '{}'; it must be two numbers, the smaller one first", line.value));
  }
  return range;
}

// What inputs and outputs have in common.
template <typename Variable>
Variable read_variable(const FllBlock& block, const RuleBase& rules) {
  const std::string& name = block.head.value;
  if (!is_name(name)) block.fail(block.head, fmt::format("'{}' cannot be the name of a variable", name));
  const auto is_namesake = [&](const auto& other) { return other.name == name; };
  if (std::any_of(rules.inputs.begin(), rules.inputs.end(), is_namesake) ||
      std::any_of(rules.outputs.begin(), rules.outputs.end(), is_namesake)) {
    block.fail(block.head, fmt::format("there are two variables '{}'", name));
  }
  Variable variable;
  variable.name = name;
  variable.description = block.text("description");
  variable.enabled = block.flag("enabled", true);
  variable.range = read_range(block);
  variable.lock_range = block.flag("lock-range", false);
  return variable;
}

InputVariable read_input(const FllBlock& block, const RuleBase& rules) {
  block.allow({"description", "enabled", "range", "lock-range"}, {"term"});
  auto input = read_variable<InputVariable>(block, rules);
  for_each_term(block, [&](const FllLine& line, const std::string& name, const std::string& kind) {
    input.terms.push_back({name, read_function(block, line, kind)});
  });
  return input;
}

OutputVariable read_output(const FllBlock& block, const RuleBase& rules) {
  block.allow(
      {"description", "enabled", "range", "lock-range", "aggregation", "defuzzifier", "default", "lock-previous"},
      {"term"});
  auto output = read_variable<OutputVariable>(block, rules);
  block.one_of("aggregation", {"none"}, 0);
  block.require("defuzzifier");
  block.one_of("defuzzifier", {"WeightedAverage", "WeightedAverage TakagiSugeno", "WeightedAverage Automatic"}, 0);
  output.standard = block.number("default");
  output.lock_previous = block.flag("lock-previous", false);
  for_each_term(block, [&](const FllLine& line, const std::string& name, const std::string& kind) {
    if (kind != "Constant") block.fail(line, fmt::format("'{}': the terms of an output must be Constant", kind));
    const double value = parameters(block, line, 1)[0];
    if (!std::isfinite(value)) block.fail(line, "a Constant must be finite");
    output.terms.push_back({name, value});
  });
  return output;
}

RuleBlock read_rule_block(const FllBlock& block, const RuleBase& rules) {
  block.allow({"description", "enabled", "conjunction", "disjunction", "implication", "activation"}, {"rule"});
  RuleBlock read;
  read.name = block.head.value;
  read.description = block.text("description");
  read.enabled = block.flag("enabled", true);
  if (block.one_of("conjunction", {"none", "AlgebraicProduct", "Minimum"}, 0) == 2) {
    read.conjunction = RuleBlock::Conjunction::minimum;
  }
  if (block.one_of("disjunction", {"none", "AlgebraicSum", "Maximum"}, 0) == 2) {
    read.disjunction = RuleBlock::Disjunction::maximum;
  }
  block.one_of("implication", {"none", "AlgebraicProduct"}, 0);
  block.one_of("activation", {"General"}, 0);
  for (const FllLine* line : block.all("rule")) {
    Rule rule = read_rule(*line, block, rules);
    for (const Rule& other : read.rules) {
      if (other.text == rule.text) block.fail(*line, fmt::format("the rule stands in line {} already", other.line));
    }
    read.rules.push_back(std::move(rule));
  }
  return read;
}

// An output that no rule concludes on would be its default for ever.
void require_conclusions(const RuleBase& rules, const std::vector<FllBlock>& blocks) {
  std::vector<bool> concluded(rules.outputs.size(), false);
  for (const RuleBlock& block : rules.blocks) {
    for (const Rule& rule : block.rules) {
      for (const Conclusion& conclusion : rule.consequent)
        concluded[conclusion.output] = concluded[conclusion.output] || block.enabled;
    }
  }
  for (std::size_t i = 0; i < concluded.size(); ++i) {
    const OutputVariable& output = rules.outputs[i];
    if (concluded[i] || !output.enabled) continue;
    for (const FllBlock& block : blocks) {
      if (block.head.key == "OutputVariable" && block.head.value == output.name) {
        block.fail(block.head, fmt::format("no rule of an enabled block concludes on the output '{}'", output.name));
      }
    }
  }
}

}  // namespace

RuleBase parse_fll(std::string_view text, const std::filesystem::path& file) {
  const std::vector<FllBlock> blocks = split_fll(text, file);
  if (blocks.empty() || blocks.front().head.key != "Engine") {
    throw Error("{}: is no rule base; one begins with 'Engine: NAME'", file.string());
  }
  RuleBase rules;
  rules.file = file;
  rules.name = blocks.front().head.value;
  rules.description = blocks.front().text("description");
  blocks.front().allow({"description"}, {});
  for (const FllBlock& block : blocks) {
    if (block.head.key == "Engine" && &block != &blocks.front()) block.fail(block.head, "a file holds one Engine");
    if (block.head.key == "InputVariable") rules.inputs.push_back(read_input(block, rules));
    if (block.head.key == "OutputVariable") rules.outputs.push_back(read_output(block, rules));
  }
  for (const FllBlock& block : blocks) {
    if (block.head.key == "RuleBlock") rules.blocks.push_back(read_rule_block(block, rules));
  }
  for (const auto& [there_is_none, kind] :
       {std::pair{rules.inputs.empty(), "InputVariable"}, std::pair{rules.outputs.empty(), "OutputVariable"},
        std::pair{rules.blocks.empty(), "RuleBlock"}}) {
    if (there_is_none) throw Error("{}: has no {}", file.string(), kind);
  }
  require_conclusions(rules, blocks);
  return rules;
}

RuleBase read_fll(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) throw Error("{}: is a folder; name an FLL file", file.string());
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error("{}: cannot be opened; check that it exists and may be read", file.string());
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) throw Error("{}: cannot be read", file.string());
  return parse_fll(text, file);
}

}  // namespace movis::fuzzy
