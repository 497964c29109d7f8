/// \file depth.h
/// How much of a proof to run: a share on every change, all of it at night.
#pragma once

#include <cstddef>

namespace cellcut::test {

/// `always` on every change, `atNight` where nightly.h says so: the full counts of the statistical proofs.
std::size_t byDepth(std::size_t always, std::size_t atNight);

/// Whether the tests were compiled with ASan or TSan.
bool isSanitized();

/// Whether this is a sanitizer's run of the share that every change goes through: samples look for bugs of memory
/// there, not of mathematics.
bool isSixteenth();

/// A number of samples, cut to 1/16 (and at least 1) where isSixteenth(). The test's tolerance must follow from the
/// number that it gets, or its comparison be left out there.
std::size_t sampleShare(std::size_t samples);

}  // namespace cellcut::test
