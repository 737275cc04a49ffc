#include "fll_rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "movis/core/names.h"

namespace movis::fuzzy {
namespace {

constexpr int kDeepest = 50;  // of parentheses: deeper ones are no one's rule, and would exhaust the stack

constexpr std::array kHedges{std::pair{"not", Hedge::negation}, std::pair{"very", Hedge::very},
                             std::pair{"somewhat", Hedge::somewhat}, std::pair{"extremely", Hedge::extremely},
                             std::pair{"seldom", Hedge::seldom}};

std::optional<Hedge> hedge_of(const std::string& word) {
  for (const auto& [name, hedge] : kHedges) {
    if (word == name) return hedge;
  }
  return std::nullopt;
}

// Parentheses become words of their own.
std::vector<std::string> rule_words(const std::string& text) {
  std::string spaced;
  for (const char c : text) spaced += c == '(' || c == ')' ? fmt::format(" {} ", c) : std::string(1, c);
  return words_of(spaced);
}

// Recursive descent: or < and < a proposition or parentheses.
class RuleParser {
 public:
  RuleParser(const FllLine& line, const FllBlock& block, const RuleBase& rules)
      : line_(line), block_(block), rules_(rules), words_(rule_words(line.value)) {
    rule_.text = fmt::format("{}", fmt::join(words_, " "));
    rule_.line = line.number;
  }

  Rule parse() {
    expect("if");
    alternatives();
    expect("then");
    do conclusion();
    while (take("and"));
    if (take("with")) {
      const std::string number = next("a weight from 0 to 1");
      if (!read_number(number, rule_.weight) || !(rule_.weight >= 0.0 && rule_.weight <= 1.0)) {
        fail(fmt::format("the weight is '{}'; it must be a number from 0 to 1", number));
      }
    }
    if (at_ < words_.size()) fail(fmt::format("'{}' stands after the end of the rule", words_[at_]));
    return std::move(rule_);
  }

 private:
  void alternatives() {
    requirements();
    while (take("or")) {
      require_norm("disjunction");
      requirements();
      rule_.antecedent.emplace_back(Connective::disjunction);
    }
  }

  void requirements() {
    operand();
    while (take("and")) {
      require_norm("conjunction");
      operand();
      rule_.antecedent.emplace_back(Connective::conjunction);
    }
  }

  void operand() {
    if (!take("(")) return proposition();
    if (++depth_ > kDeepest) fail(fmt::format("more than {} parentheses are open", kDeepest));
    alternatives();
    expect(")");
    --depth_;
  }

  void proposition() {
    Proposition proposition{index(rules_.inputs, next("an input"), "input"), kAny, {}};
    expect("is");
    std::string word = next("a term");
    for (std::optional<Hedge> hedge; (hedge = hedge_of(word)); word = next("a term")) {
      proposition.hedges.push_back(*hedge);
    }
    const InputVariable& input = rules_.inputs[proposition.input];
    if (word != "any") proposition.term = static_cast<int>(index(input.terms, word, "term of '" + input.name + "'"));
    rule_.antecedent.emplace_back(std::move(proposition));
  }

  void conclusion() {
    const std::size_t output = index(rules_.outputs, next("an output"), "output");
    expect("is");
    const std::string word = next("a term");
    const std::string& name = rules_.outputs[output].name;
    if (hedge_of(word)) fail(fmt::format("'{}': a conclusion takes no hedge, it is a constant", word));
    for (const Conclusion& other : rule_.consequent) {
      if (other.output == output) fail(fmt::format("the rule concludes twice on '{}'", name));
    }
    rule_.consequent.push_back({output, index(rules_.outputs[output].terms, word, "term of '" + name + "'")});
  }

  template <typename Named>
  std::size_t index(const std::vector<Named>& list, const std::string& name, const std::string& kind) const {
    std::vector<std::string> known;
    for (const Named& item : list) {
      if (item.name == name) return known.size();
      known.push_back(item.name);
    }
    fail(fmt::format("'{}' is no {}{}", name, kind, suggestion(name, known)));
  }

  // Blocks without a norm have a line "none" or no line at all.
  void require_norm(const char* key) const {
    const FllLine* norm = block_.find(key);
    if (norm != nullptr && norm->value != "none") return;
    fail(fmt::format("the rule needs a {}, and its RuleBlock (line {}) has none", key, block_.head.number));
  }

  bool take(const char* word) {
    if (at_ >= words_.size() || words_[at_] != word) return false;
    ++at_;
    return true;
  }

  void expect(const char* word) {
    if (take(word)) return;
    const std::string found = at_ < words_.size() ? "'" + words_[at_] + "'" : "the end of the rule";
    fail(fmt::format("expected '{}'{}, found {}", word, at_ > 0 ? " after '" + words_[at_ - 1] + "'" : "", found));
  }

  std::string next(const char* what) {
    if (at_ >= words_.size())
      fail(fmt::format("expected {} after '{}', found the end of the rule", what, words_.back()));
    return words_[at_++];
  }

  [[noreturn]] void fail(const std::string& what) const { block_.fail(line_, what); }

  const FllLine& line_;
  const FllBlock& block_;
  const RuleBase& rules_;
  std::vector<std::string> words_;
  std::size_t at_ = 0;
  int depth_ = 0;
  Rule rule_;
};

}  // namespace

Rule read_rule(const FllLine& line, const FllBlock& block, const RuleBase& rules) {
  return RuleParser(line, block, rules).parse();
}

}  // namespace movis::fuzzy
