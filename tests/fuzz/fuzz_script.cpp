#include "tests/fuzz/fuzzing.h"
#include "ui/viewer/script.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cellcut;
  static const test::TemporaryDirectory folder;
  std::ofstream(folder / "a.txt", std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return fuzz::read([] { readScript(folder / "a.txt"); });
}
