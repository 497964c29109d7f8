#include "renderer/scene/gltf_document.h"

#include "renderer/base/error.h"
#include "renderer/base/image_io.h"
#include "renderer/scene/gltf_container.h"
#include "renderer/scene/gltf_validation.h"
#include "renderer/scene/scene_folder.h"

#include <cstring>
#include <map>
#include <new>
#include <optional>
#include <set>

namespace cellcut {
namespace {

/// Most bytes that buffers may take because they name a file that another has named: the parser keeps a copy for each.
constexpr std::uintmax_t kMaxRepeatedBytes = std::uintmax_t{1} << 27;

/// What the parser's callbacks share. They report through the parser's own error path; the first InputError is kept
/// here, because the parser would drop it (a missing image is only a warning to it).
struct ParseContext {
  const std::string& name;
  const SceneFolder& folder;
  std::vector<std::vector<std::byte>>& images;
  std::optional<InputError> error = std::nullopt;
  std::string file = {};                        ///< that was asked for last
  std::set<std::string> filesRead = {};         ///< each once
  std::uintmax_t repeatedBytes = 0;             ///< of files that were read once more
  std::map<std::string, int> imageOfFile = {};  ///< the first that names it
  std::map<int, int> firstImageLike = {};       ///< of images that name a file once more

  bool fail(const InputError& reason) {
    if (!error) error = reason;
    return false;
  }
};

ParseContext& contextOf(void* user) {
  return *static_cast<ParseContext*>(user);
}

bool readBeside(std::vector<unsigned char>* bytes, std::string*, const std::string& reference, void* user) {
  ParseContext& context = contextOf(user);
  // Data of a kind that the parser does not know, such as WebP. A buffer cannot do without; an image may never be used.
  if (reference.starts_with("data:")) return false;
  try {
    context.file = context.folder.resolve(reference).string();
    if (context.imageOfFile.contains(context.file)) {  // an image again, for the parser reads all buffers first
      bytes->assign(1, 0);                             // not empty is all that it wants; keepEncoded knows better
      return true;
    }
    const std::vector<std::byte> file = context.folder.read(reference);
    if (!context.filesRead.insert(context.file).second) context.repeatedBytes += file.size();
    if (context.repeatedBytes > kMaxRepeatedBytes) {
      throw InputError(context.name + ": \"" + printable(reference) + '"',
                       "is named by too many buffers; let their views share one");
    }
    bytes->resize(file.size());
    if (!file.empty()) std::memcpy(bytes->data(), file.data(), file.size());
    return true;
  } catch (const InputError& error) {
    return context.fail(error);
  }
}

/// tinygltf asks for sizes, and limits them, from version 2.9 on.
template <class Callbacks, class Parser>
void setSizeLimits(Callbacks& callbacks, Parser& parser) {
  if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
    callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string&, void*) {
      *size = 1;  // any size that it accepts: readBeside looks at the real one
      return true;
    };
  }
  if constexpr (requires { parser.SetMaxExternalFileSize(std::size_t{}); }) {
    parser.SetMaxExternalFileSize(kMaxSceneFileBytes);
  }
}

/// Keeps the encoded bytes; images in buffer views are found there later, once the view is known to be sound.
bool keepEncoded(tinygltf::Image* image, int index, std::string*, std::string*, int, int, const unsigned char* bytes,
                 int size, void* user) {
  if (image->bufferView >= 0) return true;
  ParseContext& context = contextOf(user);
  if (!image->uri.empty()) {  // else its data are in the URI itself
    const auto [first, isNew] = context.imageOfFile.try_emplace(context.file, index);
    if (!isNew) {
      context.firstImageLike[index] = first->second;
      return true;
    }
  }
  const auto slot = static_cast<std::size_t>(index);
  if (size < 0) {
    return context.fail(InputError(context.name + ": images[" + std::to_string(index) + "]",
                                   "is larger than 2 GB; scale the picture down"));
  }
  if (context.images.size() <= slot) context.images.resize(slot + 1);
  const auto* first = reinterpret_cast<const std::byte*>(bytes);
  context.images[slot].assign(first, first + size);
  return true;
}

std::string firstLine(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \n");
  if (begin == std::string::npos) return "it is not a glTF file";
  return printable(text.substr(begin, text.find('\n', begin) - begin), 200);
}

/// tinygltf before 2.9 misses in a skin what that may leave out.
void dropUnfounded(std::string& errors) {
  constexpr std::string_view kUnfounded = "'inverseBindMatrices' property is missing in Skin.\n";
  for (std::size_t at; (at = errors.find(kUnfounded)) != std::string::npos;) errors.erase(at, kUnfounded.size());
}

/// False if the parser cannot go on; `complaint` then says why, and else what it goes on without.
bool parse(std::span<const std::byte> file, ParseContext& context, tinygltf::Model& model, std::string& complaint) {
  tinygltf::TinyGLTF parser;
  tinygltf::FsCallbacks callbacks{};
  callbacks.FileExists = [](const std::string&, void*) { return true; };  // so that reading reports what is wrong
  callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
  callbacks.ReadWholeFile = readBeside;
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  callbacks.user_data = &context;
  setSizeLimits(callbacks, parser);
  parser.SetFsCallbacks(callbacks);
  parser.SetImageLoader(keepEncoded, &context);

  std::string errors, warnings;
  const auto size = static_cast<unsigned int>(file.size());
  bool parsed = false;
  try {
    parsed = isBinaryGltf(file) ? parser.LoadBinaryFromMemory(&model, &errors, &warnings,
                                                              reinterpret_cast<const unsigned char*>(file.data()), size)
                                : parser.LoadASCIIFromString(&model, &errors, &warnings,
                                                             reinterpret_cast<const char*>(file.data()), size, "");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {  // the JSON library's, and at() on empty buffers
    errors += error.what();
  }
  dropUnfounded(errors);
  if (!parsed || !errors.empty()) complaint = firstLine(errors);
  return parsed;
}

}  // namespace

std::string placeOf(const GltfDocument& document, const char* array, std::size_t index) {
  return document.name + ": " + array + '[' + std::to_string(index) + ']';
}

std::span<const std::byte> bufferViewBytes(const tinygltf::Model& model, int bufferView) {
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(bufferView)];
  const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  return std::as_bytes(std::span(data)).subspan(view.byteOffset, view.byteLength);
}

GltfDocument readGltf(const std::filesystem::path& file) {
  GltfDocument document;
  document.name = file.filename().string();
  const SceneFolder folder(file);
  // One byte less than the limit: the parser counts in 32 bits.
  const std::vector<std::byte> bytes = readFile(file, kMaxSceneFileBytes - 1);
  if (bytes.empty()) throw InputError(document.name, "is empty; export the file again");
  checkJsonShape(gltfJson(bytes, document.name), document.name, "export the file again, or the scene in parts");

  ParseContext context{document.name, folder, document.images};
  const bool parsed = parse(bytes, context, document.model, document.complaint);
  checkExtensions(document);  // first: an unknown format inside explains what else is wrong
  if (context.error) throw *context.error;
  if (!parsed) throw InputError(document.name, document.complaint + "; export the file again");
  document.images.resize(document.model.images.size());
  for (tinygltf::Texture& texture : document.model.textures) {
    const auto repeated = context.firstImageLike.find(texture.source);
    if (repeated != context.firstImageLike.end()) texture.source = repeated->second;
  }
  checkDocument(document);
  return document;
}

}  // namespace cellcut
