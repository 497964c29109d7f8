/// \file depth.h
/// How much of a proof to run: a share on every change, all of it at night.
#pragma once

#include <cstddef>

namespace cellcut::test {

/// `always` on every change, `atNight` where nightly.h says so: the full counts of the statistical proofs.
std::size_t byDepth(std::size_t always, std::size_t atNight);

/// A number of samples, cut to 1/16 (and at least 1) under a sanitizer: they look for bugs of memory there, not of
/// mathematics. Only for counts whose test holds at any of them.
std::size_t sampleShare(std::size_t samples);

}  // namespace cellcut::test
