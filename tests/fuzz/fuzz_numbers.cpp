#include "app/numbers.h"
#include "tests/fuzz/fuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  cellcut::fuzz::read([&] { cellcut::parseWhole("--n", text, {}); });
  return cellcut::fuzz::read([&] { cellcut::parseReal("--x", text, {}); });
}
