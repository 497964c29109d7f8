/// \file window_kinds.h
/// The windows behind window.h, for openWindow(). Each throws GlError if it cannot be had.
#pragma once

#include "ui/window.h"

#include <memory>

namespace cellcut {

std::unique_ptr<Window> openGlfwWindow(const WindowSettings& settings);
std::unique_ptr<Window> openEglWindow(const WindowSettings& settings);
std::unique_ptr<Window> openOsmesaWindow(const WindowSettings& settings);

}  // namespace cellcut
