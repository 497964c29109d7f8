/// \file option_text.h
/// Options whose values are texts, and the names that such a text may be.
#pragma once

#include "renderer/base/error.h"

#include <concepts>
#include <functional>
#include <string>
#include <string_view>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace cellcut {

/// An option whose text goes through a function of ours: the parser's own conversions read "010" as eight and "1e3x" as
/// a thousand.
CLI::Option* addText(CLI::App& verb, const std::string& name, const std::string& type,
                     const std::function<void(const std::string&)>& use, const std::string& description);

/// A table's entry is a name, has one, or is a value that nameOf() knows.
template <class Entry>
std::string_view nameIn(const Entry& entry) {
  if constexpr (std::convertible_to<Entry, std::string_view>) {
    return entry;
  } else if constexpr (requires { entry.name; }) {
    return entry.name;
  } else {
    return nameOf(entry);
  }
}

/// "uniform, power, ..."
/// \param before  a name that stands before them
template <class Entries>
std::string joinedNames(const Entries& entries, std::string_view before = "") {
  std::string names(before);
  for (const auto& entry : entries) names.append(names.empty() ? "" : ", ").append(nameIn(entry));
  return names;
}

/// The entry of that name.
/// \param alsoKnown  a name that the caller knows, for the list
/// \throws InputError that names `option` and lists what is known
template <class Entries>
typename Entries::value_type requireNamed(const Entries& entries, const std::string& option, const std::string& name,
                                          std::string_view alsoKnown = "") {
  for (const auto& entry : entries) {
    if (nameIn(entry) == name) return entry;
  }
  throw InputError(option, "'" + name + "' is none of " + joinedNames(entries, alsoKnown));
}

/// The entries of a table, a line each, for --help.
template <class Entries>
std::string explained(const Entries& entries) {
  std::string lines;
  for (const auto& entry : entries) {
    lines += "  " + std::string(entry.name) + ": " + std::string(entry.description) + "\n";
  }
  return lines;
}

}  // namespace cellcut
