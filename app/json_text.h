/// \file json_text.h
/// JSON as it is written into files and onto the terminal.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace cellcut {

/// Names of files and materials may be any bytes: what is no UTF-8 becomes U+FFFD.
/// \param indent  of a level; < 0: all on one line
inline std::string jsonText(const nlohmann::ordered_json& json, int indent = -1) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace cellcut
