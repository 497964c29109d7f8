#include "app/output.h"

#include "renderer/base/error.h"

#include <optional>
#include <span>
#include <stdexcept>
#include <system_error>
#include <unistd.h>

namespace cellcut {
namespace {

namespace fs = std::filesystem;

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

/// Files that are still to come are told apart by their names.
bool isSame(const fs::path& a, const fs::path& b) {
  std::error_code ignored;  // what cannot be looked at is refused when it is read or written
  const auto whole = [&](const fs::path& file) { return fs::weakly_canonical(fs::absolute(file, ignored), ignored); };
  return fs::equivalent(a, b, ignored) || whole(a) == whole(b);
}

}  // namespace

bool isWritable(const fs::path& folder) {
  return access(folder.c_str(), W_OK | X_OK) == 0;
}

void requireWritable(const fs::path& file) {
  if (file == "-") throw InputError("-", "is not standard output here; name a file");
  if (!file.has_filename()) throw InputError(file.string(), "is a folder; name a file in it");
  const fs::path written = writtenFile(file);
  const fs::path folder = written.has_parent_path() ? written.parent_path() : fs::path(".");
  std::error_code ignored;  // what cannot be looked at is none
  if (!fs::is_directory(folder, ignored)) {
    throw InputError(written.string(), "its folder does not exist; create it first");
  }
  if (!isWritable(folder)) {
    throw InputError(written.string(), "its folder cannot be written to; choose another or change its permissions");
  }
}

void requireDistinct(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
  std::vector<NamedFile> others = inputs;
  for (const NamedFile& output : outputs) {
    if (output.file.empty()) continue;
    const fs::path written = writtenFile(output.file);
    for (const NamedFile& other : others) {
      if (other.file.empty() || !isSame(written, other.file)) continue;
      throw InputError(output.option, "'" + output.file.string() + "' is the file of " + other.option +
                                          " too and would replace it; name another");
    }
    others.push_back({output.option, written});
  }
}

Output checkedOutput(const fs::path& file) {
  const auto kind = kindFromExtension(lowerExtension(file));
  if (!kind) throw InputError(file.string(), "no known kind of picture; use .exr, .pfm or .png");
  requireWritable(file);
  return {file, *kind};
}

void writePicture(const Output& output, const Film& film, std::map<std::string, std::string> metadata) {
  if (output.kind != PictureKind::kExr) return writePicture(output, film.mean());
  writeOrFail([&] {
    LayeredImage layers = film.layers();
    layers.metadata = std::move(metadata);
    writeExr(writtenFile(output.file), layers);
  });
}

void writePicture(const Output& output, const ImageRgb& picture, std::map<std::string, std::string> metadata) {
  writeOrFail([&] {
    const fs::path file = writtenFile(output.file);
    switch (output.kind) {
      case PictureKind::kExr:
        writeExr(file, oneLayer(picture, std::move(metadata)));
        break;
      case PictureKind::kPfm:
        writePfm(file, picture);
        break;
      case PictureKind::kPng:
        writePng(file, picture);
        break;
    }
  });
}

void writeBytes(const fs::path& file, std::span<const std::byte> bytes) {
  writeOrFail([&] { writeFileAtomically(writtenFile(file), bytes); });
}

void writeText(const fs::path& file, std::string_view text) {
  writeBytes(file, std::as_bytes(std::span(text)));
}

}  // namespace cellcut
