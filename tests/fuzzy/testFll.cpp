#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <locale>
#include <string>

#include "movis/fuzzy/fll.h"
#include "support/temporary_folder.h"

namespace movis::fuzzy {
namespace {

using test::expect_error;
using test::TemporaryFolder;

constexpr const char* kRules =
    "Engine: demo  # a comment\n"                                              // line 1
    "  description: all that a file may say\n"                                 // 2
    "InputVariable: distance\n"                                                // 3
    "  description: metres\n"                                                  // 4
    "  enabled: true\n"                                                        // 5
    "  range: 0.000 4.000\n"                                                   // 6
    "  lock-range: false\n"                                                    // 7
    "  term: near Triangle 0 0 1\n"                                            // 8
    "  term:\tmiddle   Trapezoid 0 1 2 3\r\n"                                  // 9
    "  term: far Ramp 2 3\n"                                                   // 10
    "  term: here Rectangle 0 0.1\n"                                           // 11
    "  term: about_one Gaussian 1 0.25\n"                                      // 12
    "\n"                                                                       // 13
    "OutputVariable: speed\n"                                                  // 14
    "  range: -1 1\n"                                                          // 15
    "  aggregation: none\n"                                                    // 16
    "  defuzzifier: WeightedAverage TakagiSugeno\n"                            // 17
    "  default: nan\n"                                                         // 18
    "  lock-previous: false\n"                                                 // 19
    "  term: stop Constant 0\n"                                                // 20
    "  term: go Constant 1e0\n"                                                // 21
    "RuleBlock: main\n"                                                        // 22
    "  conjunction: AlgebraicProduct\n"                                        // 23
    "  disjunction: none\n"                                                    // 24
    "  implication: AlgebraicProduct\n"                                        // 25
    "  activation: General\n"                                                  // 26
    "  rule: if distance is not very near then speed is go with 0.5\n"         // 27
    "  rule: if distance is near and (distance is any) then speed is stop\n";  // 28

// The rules with one line put in place of another.
std::string with(const std::string& line, const std::string& instead) {
  std::string text = kRules;
  const std::size_t at = text.find(line);
  EXPECT_NE(at, std::string::npos) << line;
  return text.replace(at, line.size(), instead);
}

void expect_refused(const std::string& line, const std::string& instead, std::initializer_list<const char*> parts) {
  expect_error([&] { parse_fll(with(line, instead), "demo.fll"); }, parts);
}

TEST(Fll, ReadsAllThatIsSupported) {
  const TemporaryFolder folder;
  const RuleBase rules = read_fll(folder.write("demo.fll", kRules));
  EXPECT_EQ(rules.name, "demo");
  EXPECT_EQ(rules.description, "all that a file may say");
  ASSERT_EQ(rules.inputs.size(), 1u);
  const InputVariable& input = rules.inputs[0];
  EXPECT_EQ(input.description, "metres");
  EXPECT_EQ(input.range.max, 4.0);
  ASSERT_EQ(input.terms.size(), 5u);
  EXPECT_EQ(std::get<Trapezoid>(input.terms[1].function).d, 3.0);
  EXPECT_EQ(std::get<Gaussian>(input.terms[4].function).sigma, 0.25);
  ASSERT_EQ(rules.outputs.size(), 1u);
  EXPECT_TRUE(std::isnan(rules.outputs[0].standard));
  EXPECT_EQ(rules.outputs[0].terms[1].value, 1.0);
  ASSERT_EQ(rules.blocks.size(), 1u);
  ASSERT_EQ(rules.blocks[0].rules.size(), 2u);
  const Rule& rule = rules.blocks[0].rules[0];
  EXPECT_EQ(rule.line, 27);
  EXPECT_EQ(rule.text, "if distance is not very near then speed is go with 0.5");
  EXPECT_EQ(rule.weight, 0.5);
  const auto& proposition = std::get<Proposition>(rule.antecedent.at(0));
  EXPECT_EQ(proposition.term, 0);
  EXPECT_EQ(proposition.hedges, (std::vector{Hedge::negation, Hedge::very}));
  EXPECT_EQ(rules.blocks[0].rules[1].antecedent.size(), 3u);
}

TEST(Fll, LastLineWithoutAnEnd) {
  const std::string text = kRules;
  EXPECT_NO_THROW(parse_fll(text.substr(0, text.size() - 1), "demo.fll"));
}

TEST(Fll, MisspeltTermNamesFileLineAndTheNearest) {
  expect_refused("very near then", "very naer then",
                 {"demo.fll:27", "'naer' is no term of 'distance'", "'near'", "far"});
  expect_refused("speed is stop", "speed is stpo", {"demo.fll:28", "'stpo' is no term of 'speed'", "'stop'"});
}

TEST(Fll, MisspeltVariable) {
  expect_refused("if distance is near", "if distanse is near", {"demo.fll:28", "'distanse' is no input", "'distance'"});
  expect_refused("then speed is stop", "then sped is stop", {"demo.fll:28", "'sped' is no output", "'speed'"});
  expect_refused("if distance is near", "if speed is stop", {"demo.fll:28", "'speed' is no input"});
}

TEST(Fll, UnknownKeysAndWords) {
  expect_refused("  lock-range: false", "  lock-rnage: false",
                 {"demo.fll:7", "lock-rnage", "did you mean 'lock-range'"});
  expect_refused("enabled: true", "enabled: yes", {"demo.fll:5", "'enabled' is 'yes'", "true"});
  expect_refused("conjunction: AlgebraicProduct", "conjunction: HamacherProduct",
                 {"demo.fll:23", "HamacherProduct", "Minimum"});
  expect_refused("activation: General", "activation: First", {"demo.fll:26", "First", "General"});
  expect_refused("aggregation: none", "aggregation: Maximum", {"demo.fll:16", "Maximum", "none"});
  expect_refused("WeightedAverage TakagiSugeno", "Centroid 100", {"demo.fll:17", "Centroid 100", "WeightedAverage"});
  expect_refused("middle   Trapezoid 0 1 2 3", "middle Trapezoide 0 1 2 3", {"demo.fll:9", "did you mean 'Trapezoid'"});
  expect_refused("stop Constant 0", "stop Triangle 0 1 2", {"demo.fll:20", "must be Constant"});
}

TEST(Fll, NumbersThatAreNone) {
  expect_refused("far Ramp 2 3", "far Ramp 2 3m", {"demo.fll:10", "'3m' is no number"});
  expect_refused("far Ramp 2 3", "far Ramp 2 nan", {"demo.fll:10", "'nan' is no number"});
  expect_refused("far Ramp 2 3", "far Ramp 2", {"demo.fll:10", "a Ramp takes 2 numbers; it has 1"});
  expect_refused("near Triangle 0 0 1", "near Triangle 0 0 1 0.5", {"demo.fll:8", "takes 3 numbers; it has 4"});
  expect_refused("go Constant 1e0", "go Constant 1,5", {"demo.fll:21", "'1,5' is no number"});
  expect_refused("go Constant 1e0", "go Constant inf", {"demo.fll:21", "finite"});
  expect_refused("default: nan", "default: none", {"demo.fll:18", "'none'", "number"});
  expect_refused("range: 0.000 4.000", "range: 4 0", {"demo.fll:6", "the smaller one first"});
  expect_refused("range: 0.000 4.000", "range: 0 nan", {"demo.fll:6", "the smaller one first"});
}

TEST(Fll, VerticesOutOfOrder) {
  expect_refused("middle   Trapezoid 0 1 2 3", "middle Trapezoid 0 2 1 3", {"demo.fll:9", "must ascend"});
  expect_refused("near Triangle 0 0 1", "near Triangle 1 1 1", {"demo.fll:8", "coincide"});
  expect_refused("near Triangle 0 0 1", "near Triangle -inf -inf 1", {"demo.fll:8", "infinity"});
  expect_refused("here Rectangle 0 0.1", "here Rectangle 0.1 0", {"demo.fll:11", "must ascend"});
  expect_refused("far Ramp 2 3", "far Ramp 2 2", {"demo.fll:10", "Rectangle"});
  expect_refused("Gaussian 1 0.25", "Gaussian 1 0", {"demo.fll:12", "positive sigma"});
}

TEST(Fll, WhatStandsTwice) {
  expect_refused("  enabled: true", "  range: 0 4", {"demo.fll:6", "'range' stands twice"});
  expect_refused("term: far Ramp", "term: near Ramp", {"demo.fll:10", "two terms 'near'"});
  expect_refused("OutputVariable: speed", "OutputVariable: distance", {"demo.fll:14", "two variables 'distance'"});
  const std::string rule = "  rule: if distance is far then speed is go\n";
  expect_error([&] { parse_fll(kRules + rule + "  rule:  if  distance is far then speed is go", "demo.fll"); },
               {"demo.fll:30", "stands in line 29"});
  expect_error([&] { parse_fll(kRules + std::string("Engine: again\n"), "demo.fll"); }, {"demo.fll:29", "one Engine"});
}

TEST(Fll, WhatIsMissing) {
  expect_refused("  range: 0.000 4.000\n", "", {"demo.fll:3", "'InputVariable: distance' has no line 'range:'"});
  expect_refused("  default: nan\n", "", {"demo.fll:14", "default"});
  expect_refused("  conjunction: AlgebraicProduct\n", "", {"demo.fll:27", "needs a conjunction", "line 22"});
  expect_refused("conjunction: AlgebraicProduct", "conjunction: none", {"demo.fll:28", "needs a conjunction"});
  expect_refused("RuleBlock: main", "RuleBlock: main\n  enabled: false", {"demo.fll:14", "no rule", "'speed'"});
  expect_refused("speed is stop\n",
                 "speed is stop\nOutputVariable: turn\n range: 0 1\n default: 0\n"
                 " defuzzifier: WeightedAverage\n term: x Constant 1\n",
                 {"demo.fll:29", "no rule", "'turn'"});
  expect_error([] { parse_fll("", "demo.fll"); }, {"demo.fll", "Engine: NAME"});
  expect_error([] { parse_fll("Engine: alone\n", "demo.fll"); }, {"demo.fll", "has no InputVariable"});
  expect_error([] { parse_fll("range: 0 1\n", "demo.fll"); }, {"demo.fll:1", "before any block"});
  expect_refused("  enabled: true", "  enabled true", {"demo.fll:5", "is no line 'key: value'"});
}

TEST(Fll, RulesThatAreNone) {
  const auto refused = [](const std::string& rule, std::initializer_list<const char*> parts) {
    expect_refused("if distance is near and (distance is any) then speed is stop", rule, parts);
  };
  refused("distance is near then speed is stop", {"demo.fll:28", "expected 'if', found 'distance'"});
  refused("if distance near then speed is stop", {"expected 'is' after 'distance', found 'near'"});
  refused("if distance is near speed is stop", {"expected 'then' after 'near', found 'speed'"});
  refused("if distance is near then speed is stop go", {"'go' stands after the end"});
  refused("if distance is near then speed is stop with 2", {"the weight is '2'", "from 0 to 1"});
  refused("if distance is near then speed is stop with nan", {"the weight is 'nan'"});
  refused("if distance is near then speed is stop with", {"expected a weight"});
  refused("if distance is near then speed is very stop", {"takes no hedge"});
  refused("if distance is near then speed is stop and speed is go", {"twice on 'speed'"});
  refused("if distance is near then speed is stop or speed is go", {"'or' stands after the end"});
  refused("if (distance is near then speed is stop", {"expected ')' after 'near', found 'then'"});
  refused("if distance is near) then speed is stop", {"expected 'then' after 'near', found ')'"});
  refused("if distance is near or distance is far then speed is stop", {"needs a disjunction"});
  refused("if distance is not then speed is stop", {"'then' is no term"});
  refused("if", {"expected an input after 'if', found the end of the rule"});
  refused("", {"expected 'if', found the end of the rule"});
  refused("if " + std::string(100000, '(') + "distance is near", {"parentheses"});
}

TEST(Fll, NamesThatAreNone) {
  expect_refused("term: far Ramp", "term: any Ramp", {"demo.fll:10", "'any' cannot be a name"});
  expect_refused("term: far Ramp", "term: 2far Ramp", {"demo.fll:10", "'2far' cannot be a name"});
  expect_refused("InputVariable: distance", "InputVariable: a b", {"demo.fll:3", "cannot be the name"});
  expect_refused("InputVariable: distance", "InputVariable:", {"demo.fll:3", "cannot be the name"});
}

TEST(Fll, TermsAndInputsWithoutRulesAreAccepted) {
  EXPECT_NO_THROW(parse_fll(with("OutputVariable: speed",
                                 "InputVariable: idle\n range: 0 1\n term: some Ramp 0 1\n"
                                 "OutputVariable: speed"),
                            "demo.fll"));
}

TEST(Fll, FilesThatCannotBeRead) {
  const TemporaryFolder folder;
  expect_error([&] { read_fll(folder.path() / "none.fll"); }, {"none.fll", "cannot be opened"});
  expect_error([&] { read_fll(folder.path()); }, {"is a folder"});
  expect_error([&] { read_fll(folder.write("noise.fll", std::string("\0\xff\x80:\n", 5))); }, {"noise.fll:1"});
}

// A decimal comma in the global locales, of C and of C++, changes nothing.
TEST(Fll, NumbersAreReadAlikeInEveryLocale) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const RuleBase rules = parse_fll(kRules, "demo.fll");
  std::locale::global(before);
  EXPECT_EQ(std::get<Gaussian>(rules.inputs[0].terms[4].function).sigma, 0.25);
  EXPECT_EQ(rules.blocks[0].rules[0].weight, 0.5);
}

}  // namespace
}  // namespace movis::fuzzy
