/// \file cluster_importance-inl.h
/// What clusters send to a point, several at a time: compiled once per instruction set, in the manner of Highway.
///
/// The same formulas as localCluster() and receiverCosine(), for a region that is a point.

#if defined(CELLCUT_CLUSTER_IMPORTANCE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCUT_CLUSTER_IMPORTANCE_INL_H
#undef CELLCUT_CLUSTER_IMPORTANCE_INL_H
#else
#define CELLCUT_CLUSTER_IMPORTANCE_INL_H
#endif

#include "renderer/sampling/cut_weights.h"

#include <limits>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cellcut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Vectors of arm64's SVE have no size, so they are no members of a struct: an argument each.
template <class V>
V dot(V ax, V ay, V az, V bx, V by, V bz) {
  return hn::MulAdd(ax, bx, hn::MulAdd(ay, by, hn::Mul(az, bz)));
}

/// √(1 − c²).
template <class V>
V sinesOf(V cosine) {
  const hn::DFromV<V> d;
  return hn::Sqrt(hn::Max(hn::Zero(d), hn::NegMulAdd(cosine, cosine, hn::Set(d, 1.0f))));
}

/// sineAbove() of cut_weights.h.
template <class V>
V sinesAbove(V cosine) {
  const hn::DFromV<V> d;
  const auto squared = hn::Max(hn::Zero(d), hn::NegMulAdd(cosine, cosine, hn::Set(d, 1.0f)));
  return hn::Sqrt(hn::Add(squared, hn::Set(d, kSineSquaredMargin)));
}

/// receiverCosine() of cut_weights.h.
template <class V>
V receiverCosines(V cosTheta, V cosU, V sinU) {
  const hn::DFromV<V> d;
  const auto bound = hn::MulAdd(cosTheta, cosU, hn::MulAdd(sinesAbove(cosTheta), sinU, hn::Set(d, kCosineMargin)));
  return hn::IfThenElse(hn::Ge(cosTheta, cosU), hn::Set(d, 1.0f), hn::Max(hn::Zero(d), bound));
}

/// The cone in which a sphere is seen. One around the point itself is all around it: θu = π.
/// \param toX  from the point to the centre, with toY and toZ; out: unit
/// \return the distance to the centre
template <class V>
V coneTo(V& toX, V& toY, V& toZ, V radius, V& cosU, V& sinU) {
  const hn::DFromV<V> d;
  const auto one = hn::Set(d, 1.0f), zero = hn::Zero(d);
  const auto distance = hn::Sqrt(dot(toX, toY, toZ, toX, toY, toZ));
  const auto reach = hn::Mul(radius, hn::Set(d, kReachMargin));
  const auto inside = hn::Ge(reach, distance);
  const auto perDistance = hn::Div(one, hn::IfThenElse(inside, one, distance));
  toX = hn::IfThenElse(inside, zero, hn::Mul(toX, perDistance));
  toY = hn::IfThenElse(inside, zero, hn::Mul(toY, perDistance));
  toZ = hn::IfThenElse(inside, one, hn::Mul(toZ, perDistance));
  sinU = hn::IfThenElse(inside, zero, hn::Mul(reach, perDistance));
  cosU = hn::IfThenElse(inside, hn::Neg(one), sinesOf(sinU));
  return distance;
}

/// localCluster()'s estimate for a region of radius 0; 0 only where no light of the cluster can reach the point.
/// \param cosTheta  between the emission axis and the direction from the cluster to the point
/// \param twoSided  a mask
template <class V, class M>
V localEstimates(V intensity, V radius, V distance, V cosTheta, M twoSided, V cosO, V sinO, V cosE, V cosU, V sinU) {
  const hn::DFromV<V> d;
  const auto one = hn::Set(d, 1.0f), zero = hn::Zero(d), margin = hn::Set(d, kCosineMargin);
  // Of no meaning but > 0: it makes a quotient of 0 / 0 be 0, and an estimate that underflows not say "cannot reach".
  const auto smallest = hn::Set(d, std::numeric_limits<float>::min());
  cosTheta = hn::IfThenElse(twoSided, hn::Abs(cosTheta), cosTheta);
  const auto sinTheta = sinesAbove(cosTheta);
  const auto withinAxes = hn::Ge(cosTheta, cosO);
  const auto cosPast = hn::IfThenElse(withinAxes, one, hn::MulAdd(cosTheta, cosO, hn::Mul(sinTheta, sinO)));
  const auto sinPast = hn::IfThenElse(withinAxes, zero, hn::NegMulAdd(cosTheta, sinO, hn::Mul(sinTheta, cosO)));
  const auto cosEmit = hn::IfThenElse(hn::Ge(cosPast, cosU), one, hn::MulAdd(cosPast, cosU, hn::Mul(sinPast, sinU)));
  const auto reaches = hn::Ge(cosEmit, hn::Sub(cosE, margin));
  // meanDistance(); of a light at the point itself, that has none, the intensity.
  const auto q = hn::Div(radius, hn::Max(hn::MulAdd(hn::Set(d, 1.1547f), radius, distance), smallest));
  const auto mean = hn::MulAdd(hn::Mul(radius, q), q, distance);
  const auto scale = hn::IfThenElse(hn::Gt(mean, zero), mean, one);
  const auto estimate = hn::Div(hn::Div(hn::Mul(intensity, hn::Max(cosEmit, margin)), scale), scale);
  return hn::IfThenElseZero(
      reaches, hn::IfThenElse(hn::Gt(estimate, zero), hn::Min(estimate, hn::Set(d, kMaxWeight)), smallest));
}

}  // namespace cellcut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
