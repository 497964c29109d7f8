#include "tests/support/scenes.h"

#include "renderer/base/rng.h"
#include "tests/support/vectors.h"

namespace cellcut::test {
namespace {

/// Even directions over the sphere. Source: the Fibonacci lattice, Swinbank and Purser 2006.
Vec3 latticeDirection(int i, int count) {
  const double z = 1 - (2 * i + 1.0) / count;
  const double azimuth = 2 * std::numbers::pi * std::fmod(i * 0.6180339887498949, 1.0);
  const double r = std::sqrt(1 - z * z);
  return Vec3(glm::dvec3(r * std::cos(azimuth), z, r * std::sin(azimuth)));
}

/// A colour of luminance about 1, times 10^[−1, 1].
Vec3 lightColor(Rng& rng) {
  const Vec3 color(rng.uniform(0.5f, 1.5f), rng.uniform(0.5f, 1.5f), rng.uniform(0.5f, 1.5f));
  return color * std::pow(10.0f, rng.uniform(-1, 1));
}

void addPoints(Scene& scene, int count, Rng& rng) {
  for (int i = 0; i < count; ++i) {
    scene.pointLights.push_back({latticeDirection(i, count) * rng.uniform(3, 6), 10.0f * lightColor(rng)});
  }
}

void addSpots(Scene& scene, int count, Rng& rng) {
  for (int i = 0; i < count; ++i) {
    const Vec3 position = latticeDirection(i, count) * rng.uniform(3, 6);
    // Half aim at the origin, half past it: points are inside, on the ramp and outside.
    const Vec3 target = rng.uniform(0, i % 2 == 0 ? 0.5f : 3.0f) * randomUnit(rng);
    const float outer = rng.uniform(0.3f, 1.2f), inner = outer * rng.uniform(0, 0.9f);
    scene.spotLights.push_back(
        {position, glm::normalize(target - position), 10.0f * lightColor(rng), std::cos(inner), std::cos(outer)});
  }
}

void addTriangles(Scene& scene, int count, Rng& rng) {
  constexpr int kMaterials = 8;
  std::array<std::size_t, kMaterials> meshes;
  for (int m = 0; m < kMaterials; ++m) {
    meshes[static_cast<std::size_t>(m)] = scene.meshes.size();
    addMesh(scene, addMaterial(scene, emitter(20.0f * lightColor(rng), m % 2 == 1)));
  }
  // A third of the lattice's spacing, so that no triangle comes between another and the origin's neighbourhood.
  const float angle = std::min(0.2f, 0.6f * std::sqrt(4 * kPi / static_cast<float>(count)) / 3);
  for (int i = 0; i < count; ++i) {
    const float distance = rng.uniform(3, 6);
    const Vec3 centre = latticeDirection(i, count) * distance;
    const Frame frame(randomUnit(rng));
    const float size = angle * distance, turn = rng.uniform(0, 2 * kPi);
    const auto corner = [&](float at) { return centre + size * (std::cos(at) * frame.x + std::sin(at) * frame.y); };
    // Unequal sides.
    appendTriangle(scene.meshes[meshes[rng.below(kMaterials)]], corner(turn), corner(turn + 1.5f), corner(turn + 3.5f));
  }
}

void addDirectionals(Scene& scene, int count, Rng& rng) {
  for (int i = 0; i < count; ++i) scene.directionalLights.push_back({randomUnit(rng), lightColor(rng)});
}

void addEnvironment(Scene& scene, int texels, Rng& rng) {
  // Factors near 2 : 1; a prime count is a single row of texels.
  int height = 1;
  for (int h = 1; 2 * h * h <= texels + h; ++h) {
    if (texels % h == 0) height = h;
  }
  Environment environment;
  environment.radiance = ImageRgb(texels / height, height);
  for (Vec3& texel : environment.radiance) texel = lightColor(rng);
  environment.rotation = 0.7f;
  scene.environment = std::move(environment);
}

}  // namespace

Material lambertian(const Vec3& albedo) {
  Material material;
  material.baseColor = Vec4(albedo, 1.0f);
  material.metallic = 0;
  material.roughness = 1;
  material.specular = 0;
  return material;
}

Material metal(const Vec3& f0, float roughness) {
  Material material;
  material.baseColor = Vec4(f0, 1.0f);
  material.metallic = 1;
  material.roughness = roughness;
  return material;
}

Material emitter(const Vec3& radiance, bool doubleSided) {
  Material material = lambertian(Vec3(0));
  material.emission = radiance;
  material.doubleSided = doubleSided;
  return material;
}

MaterialId addMaterial(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<MaterialId>(scene.materials.size() - 1);
}

Mesh& addMesh(Scene& scene, MaterialId material) {
  scene.meshes.emplace_back().material = material;
  return scene.meshes.back();
}

void appendTriangle(Mesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : {a, b, c}) mesh.positions.push_back(p);
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

void addTriangle(Scene& scene, MaterialId material, const Vec3& a, const Vec3& b, const Vec3& c) {
  appendTriangle(addMesh(scene, material), a, b, c);
}

void addQuad(Scene& scene, MaterialId material, const Vec3& corner, const Vec3& edgeU, const Vec3& edgeV, int columns,
             int rows) {
  Mesh& mesh = addMesh(scene, material);
  const auto stride = static_cast<std::uint32_t>(columns + 1);
  for (int y = 0; y <= rows; ++y) {
    for (int x = 0; x <= columns; ++x) {
      const Vec2 uv(static_cast<float>(x) / static_cast<float>(columns),
                    static_cast<float>(y) / static_cast<float>(rows));
      mesh.positions.push_back(corner + uv.x * edgeU + uv.y * edgeV);
      mesh.texCoords[0].push_back(uv);
    }
  }
  for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(rows); ++y) {
    for (std::uint32_t x = 0; x + 1 < stride; ++x) {
      const std::uint32_t i = y * stride + x;
      mesh.triangles.emplace_back(i, i + 1, i + stride + 1);
      mesh.triangles.emplace_back(i, i + stride + 1, i + stride);
    }
  }
}

void addBox(Scene& scene, MaterialId material, const Vec3& lower, const Vec3& upper) {
  const Vec3 d = upper - lower;
  const Vec3 x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  addQuad(scene, material, lower, x, z);
  addQuad(scene, material, lower + y, z, x);
  addQuad(scene, material, lower, y, x);
  addQuad(scene, material, lower + z, x, y);
  addQuad(scene, material, lower, z, y);
  addQuad(scene, material, lower + x, y, z);
}

void addSphere(Scene& scene, MaterialId material, const Vec3& centre, float radius, int columns, int rows) {
  Mesh& mesh = addMesh(scene, material);
  const auto normalAt = [&](int row, int column) {
    const double polar = std::numbers::pi * row / rows, azimuth = 2 * std::numbers::pi * column / columns;
    const double sine = row == rows ? 0 : std::sin(polar);
    return Vec3(glm::dvec3(sine * std::cos(azimuth), std::cos(polar), sine * std::sin(azimuth)));
  };
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      mesh.normals.push_back(normalAt(row, column));
      mesh.positions.push_back(centre + radius * mesh.normals.back());
    }
  }
  const auto index = [&](int row, int column) { return static_cast<std::uint32_t>(row * columns + column % columns); };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a = index(row, column), b = index(row, column + 1);
      const std::uint32_t c = index(row + 1, column), d = index(row + 1, column + 1);
      if (row > 0) mesh.triangles.emplace_back(a, b, d);
      if (row + 1 < rows) mesh.triangles.emplace_back(a, d, c);
    }
  }
}

void finish(Scene& scene) {
  scene.bounds = Bounds{};
  for (const Mesh& mesh : scene.meshes) {
    for (const Vec3& p : mesh.positions) scene.bounds.add(p);
  }
  for (const PointLight& light : scene.pointLights) scene.bounds.add(light.position);
  for (const SpotLight& light : scene.spotLights) scene.bounds.add(light.position);
}

Camera perspective(const Vec3& from, const Vec3& to, float verticalFov) {
  Camera camera;
  camera.position = from;
  camera.back = glm::normalize(from - to);
  const Vec3 up = std::abs(camera.back.y) > 0.99f ? Vec3(0, 0, -1) : Vec3(0, 1, 0);
  camera.right = glm::normalize(glm::cross(up, camera.back));
  camera.up = glm::cross(camera.back, camera.right);
  camera.halfHeight = std::tan(0.5f * verticalFov);
  return camera;
}

Camera orthographic(const Vec3& from, const Vec3& to, float halfHeight) {
  Camera camera = perspective(from, to, 1);
  camera.orthographic = true;
  camera.halfHeight = halfHeight;
  return camera;
}

std::string nameOf(LightMix mix) {
  constexpr std::array names{"Point", "Spot", "Triangle", "Directional", "Environment", "All"};
  return names[static_cast<std::size_t>(mix)];
}

void addLights(Scene& scene, LightMix mix, int count, std::uint64_t seed) {
  Rng rng(seed);
  if (mix == LightMix::kAll) {
    const int share = std::max(1, count / 5);
    addPoints(scene, share, rng);
    addSpots(scene, share, rng);
    addTriangles(scene, share, rng);
    addDirectionals(scene, share, rng);
    addEnvironment(scene, share, rng);
    return;
  }
  switch (mix) {
    case LightMix::kPoint:
      return addPoints(scene, count, rng);
    case LightMix::kSpot:
      return addSpots(scene, count, rng);
    case LightMix::kTriangle:
      return addTriangles(scene, count, rng);
    case LightMix::kDirectional:
      return addDirectionals(scene, count, rng);
    case LightMix::kEnvironment:
      return addEnvironment(scene, count, rng);
    case LightMix::kAll:
      break;
  }
}

void addLightsAt(Scene& scene, LightMix mix, std::span<const Vec3> positions, std::uint64_t seed) {
  Rng rng(seed);
  if (mix == LightMix::kTriangle) addMesh(scene, addMaterial(scene, emitter(Vec3(1), true)));
  for (const Vec3& p : positions) {
    if (mix == LightMix::kPoint) scene.pointLights.push_back({p, Vec3(1)});
    if (mix == LightMix::kSpot) scene.spotLights.push_back({p, randomUnit(rng), Vec3(1), 0.9f, 0.2f});
    if (mix != LightMix::kTriangle) continue;
    const float size = 0.1f * maxComponent(glm::abs(p));
    appendTriangle(scene.meshes.back(), p, p + size * Vec3(1, 0, 0.3f), p + size * Vec3(-0.2f, 0.9f, 0.1f));
  }
}

Scene stage(LightMix mix, int count, std::uint64_t seed) {
  Scene scene;
  const MaterialId grey = addMaterial(scene, lambertian({0.7f, 0.6f, 0.5f}));
  const MaterialId red = addMaterial(scene, lambertian({0.8f, 0.2f, 0.2f}));
  const MaterialId gold = addMaterial(scene, metal({0.9f, 0.7f, 0.3f}, 0.6f));
  addQuad(scene, grey, {-1.5f, -1, 1.5f}, {3, 0, 0}, {0, 0, -3});
  addQuad(scene, red, {-1.5f, -1, -1.5f}, {3, 0, 0}, {0, 2.5f, 0});
  addQuad(scene, grey, {-1.5f, -1, 1.5f}, {0, 0, -3}, {0, 2.5f, 0});
  addBox(scene, grey, {-0.9f, -1, -0.9f}, {-0.2f, 0.2f, -0.2f});
  addSphere(scene, gold, {0.6f, -0.5f, 0.3f}, 0.5f);
  addLights(scene, mix, count, seed);
  scene.cameras.push_back(perspective({1.9f, 1.1f, 2.1f}, {-0.1f, -0.4f, -0.1f}, 0.85f));
  finish(scene);
  return scene;
}

}  // namespace cellcut::test
