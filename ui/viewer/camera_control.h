/// \file camera_control.h
/// A camera that a person moves: around a target, and through the scene.
///
/// The horizon stays level: +Y is up. Lengths: metres; angles: radians.
#pragma once

#include "renderer/scene/scene.h"

#include <optional>
#include <string>

namespace cellcut {

/// A camera and how far before it lies what it looks at.
struct CameraPose {
  Camera camera;
  float focus = 1;  ///< > 0

  Vec3 target() const { return camera.position - focus * camera.back; }
};

/// Whether its numbers are finite, with a lens that is open and a focus before it.
bool isUsable(const CameraPose& pose);

/// A camera as the scene has it; it looks at the middle of what the scene holds, as far as that lies before it.
CameraPose poseOf(const Camera& camera, const Bounds& scene);
/// Turns around the target: angles.x to the right, angles.y upwards; never over the poles.
CameraPose orbited(CameraPose pose, Vec2 angles);
/// Turns on the spot.
CameraPose turned(CameraPose pose, Vec2 angles);
/// Moves across what is looked at, so that it follows the pointer. \param heights  shares of the picture's height
CameraPose panned(CameraPose pose, Vec2 heights);
/// Towards the target by a factor per notch; an orthographic camera shows less. \param notches  of the wheel, > 0 nearer
CameraPose dollied(CameraPose pose, float notches);
/// Along its own axes: right, up, forward, metres.
CameraPose flown(CameraPose pose, const Vec3& step);

/// Where a point of the scene appears: film pixels, as cameraRay() takes them; nothing behind the camera.
std::optional<Vec2> projectToFilm(const Camera& camera, const Vec3& p, glm::ivec2 size);

/// {"position": […], "back": […], "up": […], "half_height": …, "focus": …, "orthographic": …}, as copied to the clipboard.
std::string poseToJson(const CameraPose& pose);
/// Without "focus" it is that of poseOf().
/// \throws InputError if the text is no such object or its axes cannot be made orthogonal
CameraPose poseFromJson(const std::string& text, const Bounds& scene);

}  // namespace cellcut
