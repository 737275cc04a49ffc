// The tick allocates nothing after its first run. malloc itself is interposed, as Eigen and OpenCV do not go through
// operator new.
#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>

#include "pipeline/tracked.h"

#if !defined(__SANITIZE_ADDRESS__)

namespace {
std::atomic<bool> counting{false};        // NOLINT: malloc has no other way to be told
std::atomic<int> allocations_counted{0};  // NOLINT

void count() {
  if (counting.load(std::memory_order_relaxed)) allocations_counted.fetch_add(1, std::memory_order_relaxed);
}
}  // namespace

// NOLINTBEGIN: the names are glibc's own
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t number, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  count();
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  count();
  return __libc_calloc(number, size);
}
void* realloc(void* memory, std::size_t size) {
  count();
  return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  count();
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

namespace movis {
namespace {

int allocations_in(const std::function<void()>& work) {
  allocations_counted = 0;
  counting = true;
  work();
  counting = false;
  return allocations_counted;
}

TEST(NoAllocation, TheCounterCounts) {
  void* volatile memory = nullptr;  // volatile: or the compiler leaves the pair out
  EXPECT_EQ(allocations_in([&] { memory = std::malloc(1); }), 1);
  std::free(memory);
  EXPECT_EQ(allocations_in([&] { memory = operator new(1); }), 1);
  operator delete(memory);
}

TEST(NoAllocation, InTheTickAfterTheFirst) {
  for (const char* set : {"field", "near", "open", "field-obstacles"}) {
    grab::DatasetSource source(grab::read_dataset(data_file(std::string("images/") + set)));
    std::vector<grab::FrameSet> sets;
    source.open();
    for (grab::FrameSet images; source.acquire(images);) sets.push_back(std::move(images));
    source.close();
    for (const auto name : localization::localizer_names()) {
      pipeline::Pipeline pipeline = test::make_pipeline(source.dataset(), std::string(name).c_str());
      step(pipeline, sets.front());
      for (const grab::FrameSet& images : sets) {
        EXPECT_EQ(allocations_in([&] { step(pipeline, images); }), 0) << set << " " << images.index << " " << name;
      }
    }
  }
}

}  // namespace
}  // namespace movis

#else

TEST(NoAllocation, InTheTickAfterTheFirst) {
  GTEST_SKIP() << "the sanitizer owns malloc; the release and dev presets run this test";
}

#endif
