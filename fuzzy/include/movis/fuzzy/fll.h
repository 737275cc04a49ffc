#pragma once

#include <filesystem>
#include <string_view>

#include "movis/fuzzy/rule_base.h"

namespace movis::fuzzy {

// Reads a rule base in the FuzzyLite Language, version 6, as far as it describes simplified reasoning:
//
//   Engine: NAME                            lines `key: value`; # begins a comment; blanks and tabs are alike
//     description: TEXT                     optional, in every block
//   InputVariable: NAME                     one or more
//     enabled: true | false                 optional, true
//     range: MIN MAX
//     lock-range: true | false              optional, false
//     term: NAME Triangle A B C | Trapezoid A B C D | Ramp START END | Rectangle START END | Gaussian MEAN SIGMA
//   OutputVariable: NAME                    one or more
//     enabled, range, lock-range            as above
//     aggregation: none                     optional
//     defuzzifier: WeightedAverage [TakagiSugeno | Automatic]
//     default: NUMBER | nan                 where no rule fires; nan: then there is no value
//     lock-previous: true | false           optional, false
//     term: NAME Constant VALUE
//   RuleBlock: [NAME]                       one or more
//     enabled: true | false                 optional, true
//     conjunction: AlgebraicProduct | Minimum | none       none, or left out: no rule says `and`
//     disjunction: AlgebraicSum | Maximum | none           none, or left out: no rule says `or`
//     implication: AlgebraicProduct | none  optional, without effect: conclusions are constants
//     activation: General                   optional
//     rule: if PROPOSITIONS then OUTPUT is TERM [and OUTPUT is TERM]... [with WEIGHT]
//
// PROPOSITIONS are `INPUT is [HEDGE]... TERM` or `INPUT is [HEDGE]... any`, joined by `and`, `or` and parentheses;
// `and` binds more tightly. Hedges are not, very, somewhat, extremely, seldom. A weight lies in 0…1. Names are letters,
// digits, underscores and points, not beginning with a digit, and none of the language's own words.
//
// Anything else is an Error that names file and line and says what was expected: unknown keys, words and names, a
// missing or repeated key, vertices out of order, numbers that are none, two variables or two terms of a variable with
// one name, a rule that stands twice, an output on which no rule concludes. Accepted are terms and inputs that no rule
// speaks of: a partition may be finer than its rules. Numbers are read alike in every locale.
RuleBase read_fll(const std::filesystem::path& file);

// The same from text; `file` stands in messages and in RuleBase::file.
RuleBase parse_fll(std::string_view text, const std::filesystem::path& file);

}  // namespace movis::fuzzy
