#pragma once

#include <cmath>

namespace movis {

// The value that χ² of so many degrees of freedom exceeds as rarely as a normal variable exceeds `sigmas`, after Wilson
// and Hilferty, Proc. Nat. Acad. Sci. 17 (1931) 684: ∛(χ²/dof) is nearly normal.
inline double chi2_limit(int dof, double sigmas) {
  const double variance = 2.0 / (9.0 * dof);
  const double root = 1.0 - variance + sigmas * std::sqrt(variance);
  return dof * root * root * root;
}

}  // namespace movis
