#include "renderer/scene/gltf_values.h"

#include "renderer/base/error.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace cellcut {

const tinygltf::Value* member(const tinygltf::Value& object, const char* key) {
  return object.Has(key) ? &object.Get(key) : nullptr;
}

const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found == extensions.end() ? nullptr : &found->second;
}

double numberOr(const tinygltf::Value& object, const char* key, double otherwise, const std::string& place) {
  const tinygltf::Value* value = member(object, key);
  if (!value) return otherwise;
  if (!value->IsNumber()) throw InputError(place, std::string(key) + " must be a number");
  return value->GetNumberAsDouble();
}

template <int N>
glm::vec<N, double> numbersOr(const tinygltf::Value& object, const char* key, glm::vec<N, double> otherwise,
                              const std::string& place) {
  const tinygltf::Value* value = member(object, key);
  if (!value) return otherwise;
  const auto refuse = [&] { throw InputError(place, std::string(key) + " must be " + std::to_string(N) + " numbers"); };
  if (value->ArrayLen() != static_cast<std::size_t>(N)) refuse();
  const auto& numbers = value->Get<tinygltf::Value::Array>();
  for (int i = 0; i < N; ++i) {
    const tinygltf::Value& number = numbers[static_cast<std::size_t>(i)];
    if (!number.IsNumber()) refuse();
    otherwise[i] = number.GetNumberAsDouble();
  }
  return otherwise;
}

std::optional<int> indexMember(const tinygltf::Value& object, const char* key, const std::string& place) {
  const tinygltf::Value* value = member(object, key);
  if (!value) return std::nullopt;
  if (!value->IsInt() || value->GetNumberAsInt() < 0) {
    throw InputError(place, std::string(key) + " must be a whole number");
  }
  return value->GetNumberAsInt();
}

template <int N>
glm::vec<N, double> vectorOr(const std::vector<double>& numbers, glm::vec<N, double> otherwise,
                             const std::string& place) {
  if (numbers.empty()) return otherwise;
  if (numbers.size() != static_cast<std::size_t>(N)) {
    throw InputError(place, "must be " + std::to_string(N) + " numbers");
  }
  for (int i = 0; i < N; ++i) otherwise[i] = numbers[static_cast<std::size_t>(i)];
  return otherwise;
}

template glm::dvec2 numbersOr<2>(const tinygltf::Value&, const char*, glm::dvec2, const std::string&);
template glm::dvec3 numbersOr<3>(const tinygltf::Value&, const char*, glm::dvec3, const std::string&);
template glm::dvec3 vectorOr<3>(const std::vector<double>&, glm::dvec3, const std::string&);
template glm::dvec4 vectorOr<4>(const std::vector<double>&, glm::dvec4, const std::string&);

}  // namespace cellcut
