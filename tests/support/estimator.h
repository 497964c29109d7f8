/// \file estimator.h
/// The integrator's direct light at chosen points, sample by sample, and the answer it should have.
#pragma once

#include "renderer/trace/integrator.h"
#include "tests/support/statistics.h"

#include <vector>

namespace cellcut::test {

/// A place and the surface there.
struct Receiver {
  Vec3 p;
  Vec3 n;
};

/// Random places within 0.3 of the origin that face random directions.
std::vector<Receiver> randomReceivers(std::size_t count, std::uint64_t seed);

/// Adds a white Lambertian facet of 10⁻² at each receiver: large enough for a normal that floats hold to 10⁻⁵.
void addFacets(Scene& scene, const std::vector<Receiver>& receivers);

/// A scene with everything that a path needs.
class PointEstimator {
 public:
  /// The scene must outlive the estimator.
  PointEstimator(const Scene& scene, Strategy strategy, const SamplerSettings& settings = {});
  const Lights& lights() const { return lights_; }
  /// Luminance of direct light that a receiver reflects along its normal, W/(m² sr): E/π of a white facet.
  /// \param from  metres before the receiver where the camera rays start
  Moments reflected(const Receiver& receiver, std::size_t samples, std::uint64_t seed, float from = 1e-3f) const;

 private:
  const Scene& scene_;
  Accel accel_;
  Lights lights_;
  std::unique_ptr<LightSampler> sampler_;
};

/// Relative error of referenceReflected: its quadrature, the facets' normals and the floats of a path.
inline constexpr double kReferenceError = 1e-4;
/// The same by quadrature over all lights, each as far as the scene's triangles do not hide it. Luminance, W/(m² sr).
double referenceReflected(const Scene& scene, const Receiver& receiver);

}  // namespace cellcut::test
