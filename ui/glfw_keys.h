/// \file glfw_keys.h
/// GLFW's numbers for keys and buttons → ours.
#pragma once

#include "ui/input_event.h"

#include <optional>

namespace cellcut {

/// Nothing for keys that we do not know.
std::optional<Key> keyFromGlfw(int key);
std::optional<MouseButton> buttonFromGlfw(int button);

}  // namespace cellcut
