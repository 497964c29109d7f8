#include "app/output.h"

#include "renderer/base/error.h"

#include <algorithm>
#include <optional>
#include <span>
#include <stdexcept>
#include <system_error>
#include <unistd.h>

namespace cellcut {
namespace {

/// Lower-case extension with its dot.
std::string extensionOf(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

std::optional<PictureKind> kindFromExtension(const std::string& extension) {
  if (extension == ".exr") return PictureKind::kExr;
  if (extension == ".pfm") return PictureKind::kPfm;
  if (extension == ".png") return PictureKind::kPng;
  return std::nullopt;
}

LayeredImage oneLayer(const ImageRgb& picture, std::map<std::string, std::string> metadata) {
  ImageLayer beauty{"", {"R", "G", "B"}, {}};
  beauty.values.reserve(3 * picture.size());
  for (const Vec3& p : picture) beauty.values.insert(beauty.values.end(), {p.x, p.y, p.z});
  return {picture.width(), picture.height(), {std::move(beauty)}, std::move(metadata)};
}

/// The folder was found writable before the work began, so what fails now (a full disk) is no bad input.
template <class Write>
void writeOrFail(const Write& write) {
  try {
    write();
  } catch (const InputError& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace

bool isWritable(const std::filesystem::path& folder) {
  return access(folder.c_str(), W_OK | X_OK) == 0;
}

void requireWritable(const std::filesystem::path& file) {
  std::error_code ignored;  // what cannot be looked at fails the tests below
  if (!file.has_filename() || std::filesystem::is_directory(file, ignored)) {
    throw InputError(file.string(), "is a folder; name a file in it");
  }
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder, ignored)) {
    throw InputError(file.string(), "its folder does not exist; create it first");
  }
  if (!isWritable(folder)) {
    throw InputError(file.string(), "its folder cannot be written to; choose another or change its permissions");
  }
}

Output checkedOutput(const std::filesystem::path& file) {
  const auto kind = kindFromExtension(extensionOf(file));
  if (!kind) throw InputError(file.string(), "no known kind of picture; use .exr, .pfm or .png");
  requireWritable(file);
  return {file, *kind};
}

void writePicture(const Output& output, const Film& film, std::map<std::string, std::string> metadata) {
  if (output.kind != PictureKind::kExr) return writePicture(output, film.mean());
  writeOrFail([&] {
    LayeredImage layers = film.layers();
    layers.metadata = std::move(metadata);
    writeExr(output.file, layers);
  });
}

void writePicture(const Output& output, const ImageRgb& picture, std::map<std::string, std::string> metadata) {
  writeOrFail([&] {
    switch (output.kind) {
      case PictureKind::kExr:
        writeExr(output.file, oneLayer(picture, std::move(metadata)));
        break;
      case PictureKind::kPfm:
        writePfm(output.file, picture);
        break;
      case PictureKind::kPng:
        writePng(output.file, picture);
        break;
    }
  });
}

void writeBytes(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  writeOrFail([&] { writeFileAtomically(file, bytes); });
}

}  // namespace cellcut
