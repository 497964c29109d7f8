/// \file capabilities.h
/// What a scene may have and many do not. Every program can render all of it; bench_capabilities compiles the path of a
/// sample once more without one of them (CELLCUT_WITHOUT), to measure what a scene pays for what it lacks.
///
/// The constants stand beside the question whether the scene has it. They have internal linkage: a program links
/// sources that answer differently, and on a scene that lacks it they do the same.
#pragma once

#include <cstdint>

#ifndef CELLCUT_WITHOUT
#define CELLCUT_WITHOUT kNothing
#endif

namespace cellcut {

enum class Capability : std::uint8_t { kNothing, kEnvironment, kTextures, kSpots, kDistantLights, kAlpha, kGgx };

constexpr bool kCanHaveDistantLights = Capability::CELLCUT_WITHOUT != Capability::kDistantLights;
constexpr bool kCanHaveEnvironment = kCanHaveDistantLights && Capability::CELLCUT_WITHOUT != Capability::kEnvironment;
constexpr bool kCanHaveTextures = Capability::CELLCUT_WITHOUT != Capability::kTextures;
constexpr bool kCanHaveSpots = Capability::CELLCUT_WITHOUT != Capability::kSpots;
constexpr bool kCanHaveAlpha = Capability::CELLCUT_WITHOUT != Capability::kAlpha;
constexpr bool kCanHaveGgx = Capability::CELLCUT_WITHOUT != Capability::kGgx;

}  // namespace cellcut
