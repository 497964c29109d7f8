#include "renderer/scene/scene_folder.h"

#include "renderer/base/error.h"
#include "renderer/base/image_io.h"

#include <algorithm>
#include <cctype>

namespace cellcut {
namespace {

bool hasControlCharacter(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

/// RFC 3986 section 3.1: a letter, then letters, digits, '+', '-' and '.', then a colon. Covers drive letters, too.
bool hasScheme(const std::string& reference) {
  const std::size_t colon = reference.find(':');
  if (colon == std::string::npos || colon == 0 || !std::isalpha(static_cast<unsigned char>(reference[0]))) return false;
  return std::all_of(reference.begin(), reference.begin() + static_cast<std::ptrdiff_t>(colon),
                     [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; });
}

bool isInside(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto [inFolder, inFile] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return inFolder == folder.end() && inFile != file.end();
}

}  // namespace

SceneFolder::SceneFolder(const std::filesystem::path& sceneFile) : scene_(sceneFile.filename().string()) {
  std::error_code error;
  const std::filesystem::path parent = sceneFile.has_parent_path() ? sceneFile.parent_path() : ".";
  folder_ = std::filesystem::weakly_canonical(parent, error);
  if (error)
    throw InputError(sceneFile.string(), "its folder cannot be read (" + error.message() + "); change its permissions");
}

std::filesystem::path SceneFolder::resolve(const std::string& reference) const {
  const auto refuse = [&](const std::string& problem) {
    throw InputError(scene_ + ": \"" + printable(reference) + '"', problem);
  };
  if (reference.empty()) refuse("names no file; export the scene again");
  if (hasControlCharacter(reference)) refuse("has control characters in a file name; rename the file");
  if (hasScheme(reference)) refuse("has a scheme that is not read; put the file beside the scene");
  const std::filesystem::path relative(reference);
  if (relative.is_absolute()) refuse("is an absolute path; name files relative to the scene");
  if (std::find(relative.begin(), relative.end(), "..") != relative.end()) {
    refuse("leads out of the scene's folder; put the file beside the scene");
  }
  std::error_code error;
  std::filesystem::path file = std::filesystem::weakly_canonical(folder_ / relative, error);
  if (error) refuse("cannot be found (" + error.message() + "); put the file itself beside the scene");
  if (!isInside(file, folder_)) refuse("is a link out of the scene's folder; put the file itself beside the scene");
  return file;
}

std::vector<std::byte> SceneFolder::read(const std::string& reference) const {
  const std::filesystem::path file = resolve(reference);
  try {
    return readFile(file, kMaxSceneFileBytes);
  } catch (const InputError& error) {
    throw InputError(scene_, error.what());  // who asks for a file that is missing is half of the answer
  }
}

}  // namespace cellcut
