#include "tests/fuzz/fuzzing.h"

/// The bytes are the material library beside a triangle that uses it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cellcut;
  static const test::TemporaryDirectory folder;
  std::ofstream(folder / "a.mtl", std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  std::ofstream(folder / "a.obj") << "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
  return fuzz::read([] { loadScene(folder / "a.obj"); });
}
