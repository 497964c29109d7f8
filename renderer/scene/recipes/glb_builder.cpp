#include "renderer/scene/recipes/glb_builder.h"

#include <array>
#include <cassert>
#include <cstring>
#include <span>
#include <utility>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <nlohmann/json.hpp>

namespace cellcut {

namespace {

using Json = nlohmann::json;

// Numbers of the glTF 2.0 specification (those of OpenGL).
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kFloat = 5126;
constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr std::uint32_t kGlbMagic = 0x46546c67;
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
constexpr std::uint32_t kBinaryChunk = 0x004e4942;

/// Rounded to a few decimal places, so that JSON stays short where nobody can see the rest.
double decimal(float value, int places) {
  double power = 1;
  for (int i = 0; i < places; ++i) power *= 10;
  return std::round(static_cast<double>(value) * power) / power;
}

Json vectorJson(const Vec3& v) {
  return {v.x, v.y, v.z};
}
Json positionJson(const Vec3& v) {
  return {decimal(v.x, 4), decimal(v.y, 4), decimal(v.z, 4)};
}
Json rotationJson(const glm::quat& q) {
  return {decimal(q.x, 7), decimal(q.y, 7), decimal(q.z, 7), decimal(q.w, 7)};
}

/// Rotation whose −z looks along `direction`, with +y as far up as it can be.
glm::quat lookAlong(const Vec3& direction) {
  const Vec3 back = -glm::normalize(direction);
  const Vec3 up = std::abs(back.y) < 0.999f ? Vec3(0, 1, 0) : Vec3(0, 0, -1);
  const Vec3 right = glm::normalize(glm::cross(up, back));
  return glm::quat_cast(glm::mat3(right, glm::cross(back, right), back));
}

constexpr std::size_t padded(std::size_t size) {
  return (size + 3) / 4 * 4;
}

}  // namespace

GlbBuilder::GlbBuilder(std::string recipe, std::size_t lights, std::uint64_t seed)
    : recipe_(std::move(recipe)), lights_(lights), seed_(seed) {}

GlbMaterialId GlbBuilder::addMaterial(const GlbMaterial& material) {
  materials_.push_back(material);
  surfaces_.emplace_back();
  return static_cast<GlbMaterialId>(materials_.size() - 1);
}

GlbTextureId GlbBuilder::addPng(std::vector<std::byte> png) {
  pngs_.push_back(std::move(png));
  return static_cast<GlbTextureId>(pngs_.size() - 1);
}

void GlbBuilder::addPoint(const Vec3& position, const Vec3& intensity) {
  addLight({LightDefinition::Kind::kPoint, intensity.x, intensity.y, intensity.z, 0, 0}, position, {0, 0, -1});
}

void GlbBuilder::addSpot(const Vec3& position, const Vec3& axis, const Vec3& intensity, float inner, float outer) {
  assert(0 <= inner && inner < outer && outer <= kPi / 2);
  addLight({LightDefinition::Kind::kSpot, intensity.x, intensity.y, intensity.z, inner, outer}, position, axis);
}

void GlbBuilder::addDirectional(const Vec3& axis, const Vec3& irradiance) {
  addLight({LightDefinition::Kind::kDirectional, irradiance.x, irradiance.y, irradiance.z, 0, 0}, Vec3(0.0f), axis);
}

void GlbBuilder::addCamera(const std::string& name, const Vec3& from, const Vec3& to, float verticalFov) {
  cameras_.push_back({name, from, to, verticalFov});
}

void GlbBuilder::addLight(const LightDefinition& definition, const Vec3& position, const Vec3& axis) {
  const auto [entry, isNew] = definitionIndex_.try_emplace(definition, definitions_.size());
  if (isNew) definitions_.push_back(definition);
  lightNodes_.push_back({position, axis, entry->second});
}

std::size_t GlbBuilder::lightCount() const {
  std::size_t count = lightNodes_.size();
  for (std::size_t m = 0; m < materials_.size(); ++m) {
    if (!isBlack(materials_[m].emission))
      count += surfaces_[m].flat.triangleCount() + surfaces_[m].smooth.triangleCount();
  }
  return count;
}

/// Lays out one file. The binary chunk is a list of parts until it is written, so that large scenes are copied once.
class GlbWriter {
 public:
  explicit GlbWriter(const GlbBuilder& builder) : in_(builder) {}
  std::vector<std::byte> write();

 private:
  std::size_t addView(std::span<const std::byte> bytes, int target = 0);
  std::size_t addAccessor(std::size_t view, int componentType, std::size_t count, const char* type);
  Json primitive(const Surface& surface, std::size_t material);
  std::size_t indexAccessor(const Surface& surface);
  void addMeshes();
  void addMaterials();
  void addTextures();
  void addLightNodes();
  void addCameras();
  void addNode(Json node);
  void use(const char* extension);
  std::vector<std::byte> assemble() const;

  const GlbBuilder& in_;
  Json json_;
  std::deque<std::vector<std::uint16_t>> shortIndices_;
  std::vector<std::span<const std::byte>> parts_;
  std::size_t binarySize_ = 0;
};

std::vector<std::byte> GlbBuilder::finish() const {
  return GlbWriter(*this).write();
}

std::vector<std::byte> GlbWriter::write() {
  json_["asset"] = {{"version", "2.0"},
                    {"generator", "cellcut generate"},
                    {"extras", {{"recipe", in_.recipe_}, {"lights", in_.lights_}, {"seed", in_.seed_}}}};
  json_["scene"] = 0;
  json_["scenes"] = Json::array({{{"name", in_.recipe_}}});
  addCameras();
  addMeshes();
  addMaterials();
  addTextures();
  addLightNodes();
  if (!in_.environment_.empty()) {
    json_["extensions"]["CELLCUT_environment"] = {{"bufferView", addView(in_.environment_)}};
    use("CELLCUT_environment");
  }
  if (binarySize_ > 0) json_["buffers"] = Json::array({{{"byteLength", binarySize_}}});
  return assemble();
}

std::size_t GlbWriter::addView(std::span<const std::byte> bytes, int target) {
  Json view = {{"buffer", 0}, {"byteOffset", binarySize_}, {"byteLength", bytes.size()}};
  if (target != 0) view["target"] = target;
  json_["bufferViews"].push_back(std::move(view));
  parts_.push_back(bytes);
  binarySize_ += padded(bytes.size());
  return json_["bufferViews"].size() - 1;
}

std::size_t GlbWriter::addAccessor(std::size_t view, int componentType, std::size_t count, const char* type) {
  json_["accessors"].push_back(
      {{"bufferView", view}, {"componentType", componentType}, {"count", count}, {"type", type}});
  return json_["accessors"].size() - 1;
}

std::size_t GlbWriter::indexAccessor(const Surface& surface) {
  // 65535 is the restart index and may not be used (glTF 2.0, section 3.7.2.1).
  if (surface.positions.size() <= 65535) {
    std::vector<std::uint16_t>& narrow = shortIndices_.emplace_back(surface.indices.size());
    std::transform(surface.indices.begin(), surface.indices.end(), narrow.begin(),
                   [](std::uint32_t i) { return static_cast<std::uint16_t>(i); });
    return addAccessor(addView(std::as_bytes(std::span(narrow)), kElementArrayBuffer), kUnsignedShort, narrow.size(),
                       "SCALAR");
  }
  return addAccessor(addView(std::as_bytes(std::span(surface.indices)), kElementArrayBuffer), kUnsignedInt,
                     surface.indices.size(), "SCALAR");
}

Json GlbWriter::primitive(const Surface& surface, std::size_t material) {
  const auto attribute = [&](const auto& values, const char* type) {
    assert(values.size() == surface.positions.size());
    return addAccessor(addView(std::as_bytes(std::span(values)), kArrayBuffer), kFloat, values.size(), type);
  };
  Bounds bounds;
  for (const Vec3& p : surface.positions) bounds.add(p);
  Json attributes;
  attributes["POSITION"] = attribute(surface.positions, "VEC3");
  Json& accessor = json_["accessors"].back();
  accessor["min"] = vectorJson(bounds.lower);
  accessor["max"] = vectorJson(bounds.upper);
  if (!surface.normals.empty()) attributes["NORMAL"] = attribute(surface.normals, "VEC3");
  if (!surface.texCoords.empty()) attributes["TEXCOORD_0"] = attribute(surface.texCoords, "VEC2");
  return {{"attributes", std::move(attributes)}, {"indices", indexAccessor(surface)}, {"material", material}};
}

void GlbWriter::addMeshes() {
  for (std::size_t m = 0; m < in_.surfaces_.size(); ++m) {
    Json primitives = Json::array();
    for (const Surface* s : {&in_.surfaces_[m].flat, &in_.surfaces_[m].smooth}) {
      if (!s->indices.empty()) primitives.push_back(primitive(*s, m));
    }
    if (primitives.empty()) continue;
    json_["meshes"].push_back({{"name", in_.materials_[m].name}, {"primitives", std::move(primitives)}});
    addNode({{"mesh", json_["meshes"].size() - 1}});
  }
}

void GlbWriter::addMaterials() {
  for (const GlbMaterial& m : in_.materials_) {
    Json json = {
        {"name", m.name},
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {decimal(m.baseColor.x, 4), decimal(m.baseColor.y, 4), decimal(m.baseColor.z, 4), 1}},
          {"metallicFactor", decimal(m.metallic, 4)},
          {"roughnessFactor", decimal(m.roughness, 4)}}}};
    if (m.doubleSided) json["doubleSided"] = true;
    if (m.specular != 1) {
      json["extensions"]["KHR_materials_specular"] = {{"specularFactor", decimal(m.specular, 4)}};
      use("KHR_materials_specular");
    }
    if (!isBlack(m.emission)) {
      const float strength = maxComponent(m.emission);  // a factor is at most 1
      const Vec3 factor = m.emission / strength;
      json["emissiveFactor"] = {decimal(factor.x, 6), decimal(factor.y, 6), decimal(factor.z, 6)};
      json["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
      use("KHR_materials_emissive_strength");
    }
    if (m.emissionTexture) json["emissiveTexture"] = {{"index", static_cast<std::uint32_t>(*m.emissionTexture)}};
    json_["materials"].push_back(std::move(json));
  }
}

void GlbWriter::addTextures() {
  for (std::size_t i = 0; i < in_.pngs_.size(); ++i) {
    json_["images"].push_back({{"bufferView", addView(in_.pngs_[i])}, {"mimeType", "image/png"}});
    json_["textures"].push_back({{"source", i}});
  }
}

void GlbWriter::addLightNodes() {
  if (in_.definitions_.empty()) return;
  use("KHR_lights_punctual");
  Json& lights = json_["extensions"]["KHR_lights_punctual"]["lights"];
  static constexpr std::array kKinds{"point", "spot", "directional"};
  for (const auto& d : in_.definitions_) {
    const Vec3 rgb(d.r, d.g, d.b);
    const float intensity = maxComponent(rgb);
    const Vec3 color = rgb / intensity;
    Json light = {{"type", kKinds[static_cast<std::size_t>(d.kind)]},
                  {"color", {decimal(color.x, 6), decimal(color.y, 6), decimal(color.z, 6)}},
                  {"intensity", intensity}};
    if (d.kind == GlbBuilder::LightDefinition::Kind::kSpot) {
      light["spot"] = {{"innerConeAngle", d.inner}, {"outerConeAngle", d.outer}};
    }
    lights.push_back(std::move(light));
  }
  for (const auto& n : in_.lightNodes_) {
    const auto kind = in_.definitions_[n.definition].kind;
    Json node = {{"extensions", {{"KHR_lights_punctual", {{"light", n.definition}}}}}};
    if (kind != GlbBuilder::LightDefinition::Kind::kDirectional) node["translation"] = positionJson(n.position);
    if (kind != GlbBuilder::LightDefinition::Kind::kPoint) node["rotation"] = rotationJson(lookAlong(n.axis));
    addNode(std::move(node));
  }
}

void GlbWriter::addCameras() {
  for (const auto& c : in_.cameras_) {
    json_["cameras"].push_back(
        {{"name", c.name}, {"type", "perspective"}, {"perspective", {{"yfov", c.verticalFov}, {"znear", 0.01}}}});
    addNode({{"name", c.name},
             {"camera", json_["cameras"].size() - 1},
             {"translation", positionJson(c.from)},
             {"rotation", rotationJson(lookAlong(c.to - c.from))}});
  }
}

void GlbWriter::addNode(Json node) {
  json_["nodes"].push_back(std::move(node));
  json_["scenes"][0]["nodes"].push_back(json_["nodes"].size() - 1);
}

void GlbWriter::use(const char* extension) {
  Json& used = json_["extensionsUsed"];
  if (std::find(used.begin(), used.end(), extension) == used.end()) used.push_back(extension);
}

std::vector<std::byte> GlbWriter::assemble() const {
  std::string text = json_.dump();
  text.resize(padded(text.size()), ' ');
  const std::size_t total = 12 + 8 + text.size() + (binarySize_ > 0 ? 8 + binarySize_ : 0);
  assert(total <= 0xffffffffu);
  std::vector<std::byte> out(total);
  std::size_t at = 0;
  const auto put = [&](const void* data, std::size_t size) {
    std::memcpy(out.data() + at, data, size);
    at += size;
  };
  const auto word = [&](std::uint32_t value) {
    const std::array<std::uint8_t, 4> bytes{
        static_cast<std::uint8_t>(value & 0xff), static_cast<std::uint8_t>(value >> 8 & 0xff),
        static_cast<std::uint8_t>(value >> 16 & 0xff), static_cast<std::uint8_t>(value >> 24)};
    put(bytes.data(), bytes.size());
  };
  word(kGlbMagic);
  word(2);
  word(static_cast<std::uint32_t>(total));
  word(static_cast<std::uint32_t>(text.size()));
  word(kJsonChunk);
  put(text.data(), text.size());
  if (binarySize_ > 0) {
    word(static_cast<std::uint32_t>(binarySize_));
    word(kBinaryChunk);
    for (const auto& part : parts_) {
      put(part.data(), part.size());
      at += padded(part.size()) - part.size();  // zeros already
    }
  }
  assert(at == total);
  return out;
}

}  // namespace cellcut
