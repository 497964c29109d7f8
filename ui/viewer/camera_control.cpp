#include "ui/viewer/camera_control.h"

#include "renderer/base/error.h"
#include "renderer/scene/gltf_container.h"

#include <nlohmann/json.hpp>

namespace cellcut {
namespace {

constexpr Vec3 kUp(0, 1, 0);
/// Sine of the steepest view: straight up or down the horizon is undefined.
constexpr float kSteepest = 0.999f;

/// The camera with another direction, level.
void look(Camera& camera, Vec3 back) {
  back = glm::normalize(back);
  back.y = std::clamp(back.y, -kSteepest, kSteepest);
  camera.back = glm::normalize(back);
  camera.right = glm::normalize(glm::cross(kUp, camera.back));
  camera.up = glm::cross(camera.back, camera.right);
}

/// `back` turned to the right about +Y and upwards.
Vec3 turnedBack(const Camera& camera, Vec2 angles) {
  const float elevation = std::asin(std::clamp(camera.back.y, -1.0f, 1.0f)) + angles.y;
  const float azimuth = std::atan2(camera.back.x, camera.back.z) + angles.x;
  const float limited = std::clamp(elevation, -std::asin(kSteepest), std::asin(kSteepest));
  return {std::cos(limited) * std::sin(azimuth), std::sin(limited), std::cos(limited) * std::cos(azimuth)};
}

Vec3 vectorOf(const nlohmann::json& json, const char* key) {
  const auto values = json.at(key).get<std::array<float, 3>>();
  return {values[0], values[1], values[2]};
}

nlohmann::json numbersOf(const Vec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

bool isUsable(const CameraPose& pose) {
  const Camera& c = pose.camera;
  return isFinite(c.position) && isFinite(c.up) && isFinite(c.right) && c.halfHeight > 0 &&
         std::isfinite(c.halfHeight) && pose.focus > 0 && std::isfinite(pose.focus);
}

CameraPose poseOf(const Camera& camera, const Bounds& scene) {
  CameraPose pose{camera, 1};
  const float size = scene.empty() || !(scene.radius() > 0) ? 1.0f : scene.radius();
  const float ahead = scene.empty() ? size : glm::dot(camera.position - scene.centre(), camera.back);
  // Inside a building its middle is behind walls: a tenth of it is a room.
  pose.focus = ahead > size ? ahead : 0.1f * size;
  return pose;
}

CameraPose orbited(CameraPose pose, Vec2 angles) {
  const Vec3 target = pose.target();
  look(pose.camera, turnedBack(pose.camera, {-angles.x, angles.y}));
  pose.camera.position = target + pose.focus * pose.camera.back;
  return pose;
}

CameraPose turned(CameraPose pose, Vec2 angles) {
  look(pose.camera, turnedBack(pose.camera, {-angles.x, -angles.y}));
  return pose;
}

CameraPose panned(CameraPose pose, Vec2 heights) {
  const float height = 2 * pose.camera.halfHeight * (pose.camera.orthographic ? 1 : pose.focus);
  pose.camera.position += height * (heights.y * pose.camera.up - heights.x * pose.camera.right);
  return pose;
}

CameraPose dollied(CameraPose pose, float notches) {
  const float factor = std::exp2(-0.2f * notches);
  const Vec3 target = pose.target();
  if (pose.camera.orthographic) pose.camera.halfHeight *= factor;
  pose.focus *= factor;
  pose.camera.position = target + pose.focus * pose.camera.back;
  return pose;
}

CameraPose flown(CameraPose pose, const Vec3& step) {
  pose.camera.position += step.x * pose.camera.right + step.y * kUp - step.z * pose.camera.back;
  return pose;
}

std::optional<Vec2> projectToFilm(const Camera& camera, const Vec3& p, glm::ivec2 size) {
  const Vec3 d = p - camera.position;
  const float ahead = -glm::dot(d, camera.back);
  if (!camera.orthographic && !(ahead > 0)) return std::nullopt;
  const float scale = camera.halfHeight * (camera.orthographic ? 1.0f : ahead);
  const Vec2 offset = Vec2(glm::dot(d, camera.right), glm::dot(d, camera.up)) / scale, half = 0.5f * Vec2(size);
  return Vec2(half.x + offset.x * half.y, half.y - offset.y * half.y);
}

std::string poseToJson(const CameraPose& pose) {
  const Camera& camera = pose.camera;
  return nlohmann::json{{"position", numbersOf(camera.position)},
                        {"back", numbersOf(camera.back)},
                        {"up", numbersOf(camera.up)},
                        {"half_height", camera.halfHeight},
                        {"focus", pose.focus},
                        {"orthographic", camera.orthographic}}
      .dump();
}

CameraPose poseFromJson(const std::string& text, const Bounds& scene) {
  const std::string place = "camera from the clipboard";
  try {
    checkJsonShape(text, place, "copy one with Ctrl+C first");
    const auto json = nlohmann::json::parse(text);
    Camera camera;
    camera.position = vectorOf(json, "position");
    const Vec3 back = vectorOf(json, "back"), up = vectorOf(json, "up");
    camera.halfHeight = json.at("half_height").get<float>();
    camera.orthographic = json.at("orthographic").get<bool>();
    camera.back = glm::normalize(back);
    camera.right = glm::normalize(glm::cross(up, camera.back));
    camera.up = glm::cross(camera.back, camera.right);
    CameraPose pose = poseOf(camera, scene);
    pose.focus = json.value("focus", pose.focus);
    if (!isUsable(pose)) throw InputError(place, "its numbers are no view; copy one with Ctrl+C first");
    return pose;
  } catch (const nlohmann::json::exception&) {
    throw InputError(place, "the clipboard holds no camera; copy one with Ctrl+C first");
  }
}

}  // namespace cellcut
