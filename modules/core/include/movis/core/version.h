#pragma once

namespace movis {

const char* version();  // of MOVIS, e.g. "0.1.0"

}  // namespace movis
