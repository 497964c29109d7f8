#include "renderer/base/image_codecs.h"
#include "tests/fuzz/fuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return cellcut::fuzz::read([=] { cellcut::decodeExr(cellcut::fuzz::bytes(data, size), "fuzz"); });
}
