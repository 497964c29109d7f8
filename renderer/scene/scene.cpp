#include "renderer/scene/scene.h"

namespace cellcut {
namespace {

template <class Vector>
std::size_t vectorBytes(const Vector& v) {
  return v.capacity() * sizeof(typename Vector::value_type);
}

std::size_t meshBytes(const Mesh& mesh) {
  return vectorBytes(mesh.positions) + vectorBytes(mesh.normals) + vectorBytes(mesh.tangents) +
         vectorBytes(mesh.texCoords[0]) + vectorBytes(mesh.texCoords[1]) + vectorBytes(mesh.colors) +
         vectorBytes(mesh.triangles);
}

}  // namespace

void Material::setSlot(TextureUse use, const TextureSlot& slot) {
  if (!slot.texture) return;
  TextureSlots changed = slots ? *slots : TextureSlots{};
  changed[static_cast<std::size_t>(use)] = slot;
  slots = std::make_shared<const TextureSlots>(changed);
}

glm::dvec3 facetNormal(const Mesh& mesh, const Triangle& triangle) {
  const glm::dvec3 a(mesh.positions[triangle.x]), b(mesh.positions[triangle.y]), c(mesh.positions[triangle.z]);
  return glm::cross(b - a, c - a);
}

std::size_t Scene::triangleCount() const {
  std::size_t count = 0;
  for (const Mesh& mesh : meshes) count += mesh.triangles.size();
  return count;
}

std::size_t Scene::bytes() const {
  std::size_t bytes = vectorBytes(meshes) + vectorBytes(materials) + vectorBytes(textures) + vectorBytes(pointLights) +
                      vectorBytes(spotLights) + vectorBytes(directionalLights);
  for (const Material& material : materials) bytes += material.slots ? sizeof(TextureSlots) : 0;
  for (const Mesh& mesh : meshes) bytes += meshBytes(mesh);
  for (const ImageRgba8& image : texels) bytes += image.bytes();
  if (environment) bytes += environment->radiance.bytes();
  return bytes;
}

}  // namespace cellcut
