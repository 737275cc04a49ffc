#pragma once

#include "fll_text.h"
#include "movis/fuzzy/rule_base.h"

namespace movis::fuzzy {

// Reads a line `rule: if … then …` of a block with the variables that the rule base has already.
Rule read_rule(const FllLine& line, const FllBlock& block, const RuleBase& rules);

}  // namespace movis::fuzzy
