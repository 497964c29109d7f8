#include "tests/support/scaling.h"

#include <cmath>

namespace cellcut::test {

Scene withLengthsTimesPowerOf2(Scene scene, int exponent) {
  const float scale = std::ldexp(1.0f, exponent);
  for (Mesh& mesh : scene.meshes) {
    for (Vec3& position : mesh.positions) position *= scale;
  }
  const auto move = [=](auto& light) {
    light.position *= scale;
    light.intensity *= scale * scale;
  };
  for (PointLight& light : scene.pointLights) move(light);
  for (SpotLight& light : scene.spotLights) move(light);
  for (Camera& camera : scene.cameras) {
    camera.position *= scale;
    if (camera.orthographic) camera.halfHeight *= scale;
  }
  scene.bounds.lower *= scale;
  scene.bounds.upper *= scale;
  return scene;
}

Scene withRadianceTimesPowerOf2(Scene scene, int exponent) {
  const float scale = std::ldexp(1.0f, exponent);
  for (PointLight& light : scene.pointLights) light.intensity *= scale;
  for (SpotLight& light : scene.spotLights) light.intensity *= scale;
  for (DirectionalLight& light : scene.directionalLights) light.irradiance *= scale;
  for (Material& material : scene.materials) material.emission *= scale;
  if (scene.environment) {
    for (Vec3& texel : scene.environment->radiance) texel *= scale;
  }
  return scene;
}

}  // namespace cellcut::test
