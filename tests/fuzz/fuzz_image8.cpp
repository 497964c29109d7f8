#include "renderer/base/image_io.h"
#include "tests/fuzz/fuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return cellcut::fuzz::read([=] { cellcut::decodeImage8(cellcut::fuzz::bytes(data, size), "fuzz"); });
}
