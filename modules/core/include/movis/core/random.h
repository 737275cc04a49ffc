#pragma once

#include <cstdint>
#include <random>

namespace movis {

// A random stream is passed in, never global and never seeded from the clock: a seed and a name replay it.
using RandomStream = std::mt19937_64;

inline RandomStream make_stream(std::uint64_t seed, std::uint64_t purpose) {
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                         static_cast<std::uint32_t>(purpose), static_cast<std::uint32_t>(purpose >> 32)};
  return RandomStream(sequence);
}

}  // namespace movis
