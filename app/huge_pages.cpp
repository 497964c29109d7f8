/// \file huge_pages.cpp
/// Large blocks of memory lie on huge pages: a scene of a million lights asks for hundreds of megabytes, and the first touch
/// of each 4 KB page goes through the system, one after another. Part of the program and not of its libraries.
#include <cstddef>
#include <cstdlib>
#include <new>
#include <sys/mman.h>

#ifdef MADV_HUGEPAGE

namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21;

void* allocate(std::size_t size) {
  if (size < 2 * kHugePage) return std::malloc(size > 0 ? size : 1);
  void* block = nullptr;
  if (posix_memalign(&block, kHugePage, size) != 0) return nullptr;
  madvise(block, size, MADV_HUGEPAGE);  // a wish: where it is not granted the pages are small
  return block;
}

}  // namespace

// The other forms without an alignment call this one, and those of delete call std::free.
void* operator new(std::size_t size) {
  for (;;) {
    if (void* const block = allocate(size)) return block;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* block) noexcept {
  std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
  std::free(block);
}

#endif
