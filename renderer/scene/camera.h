/// \file camera.h
/// What cameras see.
#pragma once

#include "renderer/base/ray.h"
#include "renderer/scene/scene.h"

namespace cellcut {

/// Ray with unit direction through a point of the film.
/// \param film  in pixels, (0, 0) the top left corner of the picture, (width, height) the bottom right
/// \param size  width and height in pixels; the vertical angle (or height) is the camera's, the horizontal follows
///              from the aspect
Ray cameraRay(const Camera& camera, Vec2 film, glm::ivec2 size);

/// A view of the whole box from its front, a little above: for files that have no camera.
Camera defaultCamera(const Bounds& bounds);

/// Whether both show the same; names aside.
bool isSameView(const Camera& a, const Camera& b);

}  // namespace cellcut
