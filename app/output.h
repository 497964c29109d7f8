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

namespace cellcut {

enum class PictureKind : std::uint8_t { kExr, kPfm, kPng };

struct Output {
  std::filesystem::path file;
  PictureKind kind = PictureKind::kExr;
};

/// \throws InputError if `file` is a folder, or its folder does not exist or cannot be written to
void requireWritable(const std::filesystem::path& file);

/// The file and the kind of picture that its extension (any case) names.
/// \throws InputError if that is not .exr, .pfm or .png, or as requireWritable
Output checkedOutput(const std::filesystem::path& file);

/// EXR: all layers with `metadata`, linear. PFM: raw linear radiance. PNG: tone mapped, sRGB.
/// \throws std::runtime_error if the file cannot be written; the old file then stays
void writePicture(const Output& output, const Film& film, std::map<std::string, std::string> metadata);

/// Whether files can be made in a folder that exists.
bool isWritable(const std::filesystem::path& folder);

/// The same of a picture alone: an EXR has one layer then.
void writePicture(const Output& output, const ImageRgb& picture, std::map<std::string, std::string> metadata = {});

/// \throws std::runtime_error if the file cannot be written; the old file then stays
void writeBytes(const std::filesystem::path& file, std::span<const std::byte> bytes);

}  // namespace cellcut
