/// \file replay.cpp
/// A fuzz program without a fuzzer: feeds LLVMFuzzerTestOneInput the files of a folder, whole and damaged in ways that
/// are the same in every run.
///
/// fuzz_NAME_replay FOLDER. A file that breaks the reader is printed before it does so.
#include "renderer/base/image_io.h"
#include "renderer/base/rng.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace cellcut::fuzz {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int kDamagedCopies = 60;
constexpr std::uintmax_t kMostBytes = 1 << 20;

/// Cut somewhere, a stretch repeated, or up to eight bytes replaced.
Bytes damaged(Bytes bytes, Rng& rng) {
  const auto place = [&] { return rng.below(static_cast<std::uint32_t>(bytes.size())); };
  switch (rng.below(4)) {
    case 0:
      bytes.resize(place());
      break;
    case 1: {
      const auto from = bytes.begin() + place();
      const Bytes stretch(from, from + std::min<std::ptrdiff_t>(64, bytes.end() - from));
      bytes.insert(bytes.begin() + place(), stretch.begin(), stretch.end());
      break;
    }
    default:
      for (std::uint32_t count = 1 + rng.below(8); count > 0; --count)
        bytes[place()] = static_cast<std::uint8_t>(rng.below(3) == 0 ? 255 : rng.below(256));
  }
  return bytes;
}

void replay(const std::filesystem::path& file) {
  std::puts(file.c_str());
  std::fflush(stdout);
  Bytes whole;
  for (const std::byte byte : readFile(file, kMostBytes)) whole.push_back(static_cast<std::uint8_t>(byte));
  LLVMFuzzerTestOneInput(whole.data(), whole.size());
  Rng rng(whole.size());
  for (int copy = 0; copy < kDamagedCopies && !whole.empty(); ++copy) {
    const Bytes bytes = damaged(whole, rng);
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
}

}  // namespace
}  // namespace cellcut::fuzz

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) cellcut::fuzz::replay(file);
  return files.empty() ? 1 : 0;
}
