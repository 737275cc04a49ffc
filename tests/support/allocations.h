#pragma once

// Counts what is allocated, by malloc itself: Eigen and OpenCV do not go through operator new. To be included by one
// file of a program. Under the address sanitizer, which owns malloc, MOVIS_COUNTS_ALLOCATIONS is not defined and
// nothing else is here.
#if !defined(__SANITIZE_ADDRESS__)
#define MOVIS_COUNTS_ALLOCATIONS

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <functional>

namespace movis::test {

inline std::atomic<bool> counting{false};        // NOLINT: malloc has no other way to be told
inline std::atomic<int> allocations_counted{0};  // NOLINT

inline void count_allocation() {
  if (counting.load(std::memory_order_relaxed)) allocations_counted.fetch_add(1, std::memory_order_relaxed);
}

inline int allocations_in(const std::function<void()>& work) {
  allocations_counted = 0;
  counting = true;
  work();
  counting = false;
  return allocations_counted;
}

}  // namespace movis::test

// NOLINTBEGIN: the names are glibc's own
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t number, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  movis::test::count_allocation();
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  movis::test::count_allocation();
  return __libc_calloc(number, size);
}
void* realloc(void* memory, std::size_t size) {
  movis::test::count_allocation();
  return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  movis::test::count_allocation();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = memalign(alignment, size);
  return *memory != nullptr ? 0 : ENOMEM;
}
}
// NOLINTEND

#endif
