/// \file output.h
/// Files that are written: what can be known to fail is said before the work is done, not after it.
#pragma once

#include "renderer/trace/film.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cellcut {

enum class PictureKind : std::uint8_t { kExr, kPfm, kPng };

struct Output {
  std::filesystem::path file;
  PictureKind kind = PictureKind::kExr;
};

/// \throws InputError if `file` is there and no regular file, or its folder does not exist or cannot be written to
void requireWritable(const std::filesystem::path& file);

struct NamedFile {
  std::string option;          ///< that names it
  std::filesystem::path file;  ///< empty: the option was not given
};

/// \throws InputError if an output is the same file as an input or as another output, whatever they are called
void requireDistinct(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

/// The file and the kind of picture that its extension (any case) names.
/// \throws InputError if that is not .exr, .pfm or .png, or as requireWritable
Output checkedOutput(const std::filesystem::path& file);

/// EXR: all layers with `metadata`, linear. PFM: raw linear radiance. PNG: tone mapped, sRGB. All that is written here goes
/// where links lead.
/// \throws std::runtime_error if the file cannot be written; the old file then stays
void writePicture(const Output& output, const Film& film, std::map<std::string, std::string> metadata);

/// The same of a picture alone: an EXR has one layer then.
void writePicture(const Output& output, const ImageRgb& picture, std::map<std::string, std::string> metadata = {});

/// Whether files can be made in a folder that exists.
bool isWritable(const std::filesystem::path& folder);

/// \throws std::runtime_error if the file cannot be written; the old file then stays
void writeBytes(const std::filesystem::path& file, std::span<const std::byte> bytes);
void writeText(const std::filesystem::path& file, std::string_view text);

}  // namespace cellcut
