/// \file exr_header_check.h
/// The attributes of an OpenEXR file, checked before the library reads them.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace cellcut {

/// The library allocates what an attribute's size asks for, and goes on reading wherever a value of a known type
/// happened to end: so each attribute must lie inside of the file and be as long as its type says. It keeps some
/// hundred bytes of every attribute and channel in each of its copies of a header: so there may only be so many.
/// `encoded` begins with the magic number. Source: "OpenEXR File Layout" and "Predefined attribute types", openexr.com.
/// \throws InputError naming `name`
void checkExrAttributes(std::span<const std::byte> encoded, const std::string& name);

}  // namespace cellcut
