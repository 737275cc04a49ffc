#pragma once

#include "movis/core/error.h"

namespace movis::app {

// Thrown for options that are each in their range but make no sense together. The program ends as for any other wrong
// argument.
class WrongArguments : public Error {
 public:
  using Error::Error;
};

}  // namespace movis::app
