#include "movis/core/version.h"

namespace movis {

const char* version() {
  return MOVIS_VERSION;
}

}  // namespace movis
