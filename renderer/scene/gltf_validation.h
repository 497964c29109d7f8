/// \file gltf_validation.h
/// What must hold of a parsed glTF before anything in it is used. The parser checks nearly nothing of it.
#pragma once

#include "renderer/scene/gltf_document.h"
#include "renderer/scene/scene.h"

namespace cellcut {

/// \throws InputError naming the first required extension that is not supported
void checkExtensions(const GltfDocument& document);

/// Warns once about every extension that is used and not supported.
void warnOfIgnoredExtensions(const GltfDocument& document, Scene& scene);

/// Every buffer view lies in its buffer, every accessor in its view, every index names something that exists; the nodes
/// form trees, whose roots the scenes list.
/// \throws InputError naming the first place where this does not hold
void checkDocument(const GltfDocument& document);

}  // namespace cellcut
