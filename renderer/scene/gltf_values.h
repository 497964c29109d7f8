/// \file gltf_values.h
/// Numbers out of the extensions' JSON, which the parser hands on unchecked.
#pragma once

#include "renderer/scene/gltf_document.h"

#include <optional>
#include <string>

#include <glm/vec3.hpp>

namespace cellcut {

/// Member `key` of an object; null if the object is none or has no such member.
const tinygltf::Value* member(const tinygltf::Value& object, const char* key);

/// The extension's object, null if it is not there.
const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions, const char* name);

/// Number `key` of an object, or `otherwise` if there is none.
/// \throws InputError at `place` if it is there and no number
double numberOr(const tinygltf::Value& object, const char* key, double otherwise, const std::string& place);

/// The same for an array of `otherwise.length()` numbers.
template <int N>
glm::vec<N, double> numbersOr(const tinygltf::Value& object, const char* key, glm::vec<N, double> otherwise,
                              const std::string& place);

/// The same for a whole number ≥ 0.
std::optional<int> indexMember(const tinygltf::Value& object, const char* key, const std::string& place);

/// A parsed array of N numbers; `otherwise` if the array is empty.
/// \throws InputError at `place` if it has another length
template <int N>
glm::vec<N, double> vectorOr(const std::vector<double>& numbers, glm::vec<N, double> otherwise,
                             const std::string& place);

}  // namespace cellcut
